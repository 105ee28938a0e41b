// The layout of a tile of colours or of normals.
//
// A tile of level l covers one of the 2^l x 2^l squares of its face, in the grid of tileCells << l cells per
// side. It has (tileCells + 1)^2 texels of its own and shares those on its edges with its neighbours. A
// border surrounds them; beyond a face's edge it holds texels of the next face, so that filtering never
// leaves the tile. Rows run upwards along v.
#pragma once

#include <cstdint>

#include "planet/sphere/cube_sphere.h"

namespace planet {

inline constexpr int tileCellsLog2 = 8;
inline constexpr int tileCells = 1 << tileCellsLog2;
inline constexpr int tileBorderBefore = 7;  // texels west of and below the tile's own
inline constexpr int tileBorderAfter = 8;   // texels east of and above the tile's own
inline constexpr int tileTexels = tileBorderBefore + tileCells + 1 + tileBorderAfter;
inline constexpr int maxTileLevel = 10;  // faces of 262,145 texels per side: about 40 m on Earth

// Returns the number of tiles of all levels down to leafLevel, [0, maxTileLevel].
constexpr std::uint64_t tileCountOf(int leafLevel) {
    return faceCount * ((std::uint64_t{1} << (2 * (leafLevel + 1))) - 1) / 3;
}

}  // namespace planet
