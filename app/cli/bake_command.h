// worldy bake: a height source into a chunk file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planet/bake/bake.h"
#include "planet/source/height_source.h"

namespace worldy {

struct BakeOptions {
    std::filesystem::path source;       // a path, a terrain's text or a world's name
    std::optional<std::string> detail;  // parameters of the detail that is added: "strength=0.8,octaves=4"
    std::filesystem::path output;
    planet::HeightSourceSettings sourceSettings;
    planet::BakeSettings settings;  // all but the radius
    std::optional<double> radiusM;  // a world's own, or the Earth's
    bool listPresets = false;       // instead: tells the worlds there are, and what made terrain can be told
    std::filesystem::path colour;   // an image; empty: no colours
    bool json = false;
};

planet::Result<void> runBake(const BakeOptions& options);

}  // namespace worldy
