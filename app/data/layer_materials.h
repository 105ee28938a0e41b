// worldy make-layers: the materials that come with Worldy, and the sets that use them, into a folder.
#pragma once

#include <cstdint>
#include <filesystem>

#include "planet/base/result.h"
#include "planet/surface/layer_material.h"

namespace worldy {

struct MakeLayersOptions {
    std::filesystem::path output;  // a folder, made where it is missing
    int texels = planet::shippedMaterialSize;
    std::uint32_t seed = planet::shippedMaterialSeed;
    bool json = false;
};

// Six materials of three PNG files each, earth.toml and two_layer_height_blend.toml.
planet::Result<void> makeLayers(const MakeLayersOptions& options);

}  // namespace worldy
