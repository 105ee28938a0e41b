// The slopes that a tile of normals stores.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "planet/paging/normal_tile.h"

namespace planet {

// Returns g_u and g_v of a texel; column and row: [0, tileTexels).
inline std::array<float, 2> slopeOfTexel(const TileData& tile, int column, int row) {
    assert(column >= 0 && column < tileTexels && row >= 0 && row < tileTexels);
    std::array<std::uint16_t, 2> halves{};
    const std::size_t at =
        (static_cast<std::size_t>(row) * tileTexels + static_cast<std::size_t>(column)) * sizeof halves;
    assert(tile.texels.size() == normalTileBytes);
    std::memcpy(halves.data(), tile.texels.data() + at, sizeof halves);
    return {glm::unpackHalf1x16(halves[0]), glm::unpackHalf1x16(halves[1])};
}

}  // namespace planet
