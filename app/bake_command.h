// worldy bake: a height source into a chunk file.
#pragma once

#include <filesystem>

#include "planet/bake.h"
#include "planet/height_source.h"

namespace worldy {

struct BakeOptions {
    std::filesystem::path source;
    std::filesystem::path output;
    planet::HeightSourceSettings sourceSettings;
    planet::BakeSettings settings;
    std::filesystem::path colour;  // an image; empty: no colours
    bool json = false;
};

planet::Result<void> runBake(const BakeOptions& options);

}  // namespace worldy
