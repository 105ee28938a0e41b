// Tiles of normals: the slopes of the heights at their own resolution, derived from the chunks of a file on
// request. They are not stored in the file.
//
// tile_layout.h describes the texels of a tile. The texels of level l are vertices of the grid of 256 << l
// cells per face, so of the chunks of level l + 8 - log2(cells per chunk). A texel is the slope there along u
// and along v, by central differences over two cells,
//
//   g_u = dh/du / R,   g_v = dh/dv / R,    u, v in [-1, 1] across the face, R the planet's radius,
//
// of true heights, so an exaggeration is a factor on all slopes. It is stored as two half floats. Their error
// is at most 2^-11 of the slope, however flat the land is, and samplers filter them correctly. (Eight bits
// would halve the size, but would either lose flat land beside a cliff or, companded, be filtered to wrong
// slopes between texels.)
//
// On the edge of a face, the sample beyond it lies on the next face, and the lines of the grid bend. Let a =
// dd/du and b = dd/dv be the tangents of Nowell's mapping on the edge u = +-1. The line beyond the edge is
// this line mirrored in the plane of the edge. The normal m of that plane satisfies a = p m + alpha b, with
// alpha = a.b / b.b. A central difference thus measures p m alone, and
//
//   g_u = difference + alpha g_v.
//
// At a corner of the cube this applies to both axes, each with the slope of the other, which gives two
// equations. So both faces of an edge have the same slope for the same ground.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/format/tile_layout.h"
#include "planet/paging/finest_heights.h"
#include "planet/paging/pager.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

inline constexpr std::size_t normalTileBytes = std::size_t{4} * tileTexels * tileTexels;

// Returns the finest tile level that the heights can fill: the level of the heights, or maxTileLevel. Returns
// -1 for no tiles if the faces have fewer than tileCells cells, because such meshes reach full resolution
// soon.
int normalLeafLevel(const PlanetShape& shape);

// Derives tiles. Thread-safe. Heights decoded for one tile are cached for its neighbours; the cache does not
// change the tiles.
class NormalDeriver {
public:
    // shape: as in the file.
    NormalDeriver(const PlanetShape& shape, const std::array<HeldChunk, faceCount>& roots, LoadChildren load);

    // Sets the limit of cached heights, bytes, >= 0; 0 by default. Blocks beyond it are dropped and read
    // again.
    void keepHeights(std::size_t bytes) { heights_.setCacheBytes(bytes); }

    // Return derived tiles. The Errors name the file and the chunk that could not be read.
    Result<TileData> tile(const ChunkId& id);
    Result<TileBlock> childrenOf(const ChunkId& parent);

    std::uint64_t bytesRead() const { return bytesRead_; }  // from the file

private:
    const PlanetShape shape_;
    const std::array<HeldChunk, faceCount> roots_;
    std::atomic<std::uint64_t> bytesRead_ = 0;
    FinestHeights heights_;
};

}  // namespace planet
