// The built-in worlds. A name such as "preset:moon" can be given wherever a source can.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/data/bake_request.h"
#include "planet/base/result.h"

namespace worldy {

// Describes a built-in world.
struct World {
    std::string name;   // "earth-amplified"
    std::string title;  // "Earth amplified"
    std::string about;
    BakeRequest request;  // source, radius, face size and colours
};

// Returns the Earth, the Earth with detail, a moon, and a ridged world.
std::vector<World> worlds();

// Returns true for a path of the form "preset:NAME", even if there is no such world.
bool isWorldName(const std::filesystem::path& path);
// An unknown name is an Error that lists all names.
planet::Result<World> worldNamed(const std::filesystem::path& name);

// Replaces the name of a world by its source, and a default radius and an unset face size by those of the
// world. Returns other sources unchanged.
struct NamedSource {
    std::filesystem::path source;
    planet::BakeSettings settings;
};
planet::Result<NamedSource> sourceNamed(const std::filesystem::path& named,
                                        const planet::BakeSettings& settings);

}  // namespace worldy
