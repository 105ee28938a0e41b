// The built-in materials, made of noise: the same seed and size give the same textures, bit for bit. Pure
// functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace planet {

enum class Material : std::uint8_t { Sand, Grass, Forest, Rock, Snow, SeaBed };
// In the order of Material, as in file names.
inline constexpr std::array<std::string_view, 6> materialNames = {"sand", "grass", "forest",
                                                                  "rock", "snow",  "sea_bed"};

inline constexpr int shippedMaterialSize = 512;  // texels per side in data/layers/
inline constexpr std::uint32_t shippedMaterialSeed = 1;

// Tileable textures, row 0 at the top.
struct MaterialMaps {
    int size = 0;                         // texels per side
    std::vector<std::uint8_t> albedo;     // RGBA: sRGB, and the relief, 255 is highest
    std::vector<std::uint8_t> normal;     // RGB: red along columns, green up, 128 is flat
    std::vector<std::uint8_t> roughness;  // grey
};

// Makes a material's textures. size: a power of two, [16, 4096].
MaterialMaps makeMaterial(Material material, int size, std::uint32_t seed);

}  // namespace planet
