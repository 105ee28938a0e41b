// Worlds to bake by name: the sources that come with Worldy. "preset:moon" stands wherever a source does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/data/bake_request.h"
#include "planet/base/result.h"

namespace worldy {

// Describes a source that comes with Worldy.
struct World {
    std::string name;   // "earth-amplified"
    std::string title;  // "Earth amplified"
    std::string about;
    BakeRequest request;  // source, radius, face size and colours
};

// The Earth, the Earth with detail, a moon, a ridged world; each with its radius and a face size.
std::vector<World> worlds();

// Whether it is meant as one of them: "preset:NAME".
bool isWorldName(const std::filesystem::path& path);
// The Error names the nearest.
planet::Result<World> worldNamed(const std::filesystem::path& name);

// What is baked where a source and settings are named: a world's source, and its radius and face size in
// place of the usual ones; others as they are.
struct NamedSource {
    std::filesystem::path source;
    planet::BakeSettings settings;
};
planet::Result<NamedSource> sourceNamed(const std::filesystem::path& named,
                                        const planet::BakeSettings& settings);

}  // namespace worldy
