// The command make-layers, which writes the built-in materials and the layer sets that use them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "planet/base/result.h"
#include "planet/surface/layer_material.h"

namespace worldy {

struct MakeLayersOptions {
    std::filesystem::path output;  // a folder; created if it does not exist
    int texels = planet::shippedMaterialSize;
    std::uint32_t seed = planet::shippedMaterialSeed;
    bool json = false;
};

// Writes six materials of three PNG files each, earth.toml and two_layer_height_blend.toml.
planet::Result<void> makeLayers(const MakeLayersOptions& options);

}  // namespace worldy
