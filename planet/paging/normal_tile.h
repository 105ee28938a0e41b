// A tile of normals: the heights' slopes at their own resolution, derived from the chunks of a file when they
// are asked for. It takes no room in the file.
//
// tile_layout.h says what it covers. The texels of level l are vertices of the grid of 256 << l cells a face,
// so of the chunks of one level, l + 8 - log2(cells a chunk): heights as that level's meshes have them. A
// texel is the slope there along u and along v, by central differences over two cells,
//
//   g_u = dh/du / R,   g_v = dh/dv / R,    u, v in [-1, 1] across the face, R the planet's radius,
//
// of true heights, so that a factor on it is a factor on all slopes. Two half floats: an error of 2^-11 of
// the slope at most, however flat the land is, and a sampler filters them as they are meant. (Eight bits
// would halve that, but either lose flat land beside one cliff or, companded, filter to the wrong slope
// between two texels.)
//
// On a face's edge the sample beyond it is the next face's. There the grid's lines break: with a = dd/du and
// b = dd/dv the tangents of Nowell's map on the edge u = +-1, the line beyond is this one mirrored in the
// plane of the edge, whose normal m has a = p m + alpha b, alpha = a.b / b.b. A central difference thus
// measures p m alone, and
//
//   g_u = difference + alpha g_v.
//
// At a corner of the cube that holds of both axes, each with the other's slope, which makes two equations.
// What both faces tell of an edge is then the same slope of the same ground.
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

// The finest level of tiles that the heights fill: theirs, or maxTileLevel. -1 where the faces have fewer
// than tileCells cells: there are none, and the meshes are at full resolution soon enough.
int normalLeafLevel(const PlanetShape& shape);

// Derives tiles. Any thread, several at once. What has been decoded for one tile is kept for those beside
// it; which tiles come out does not depend on it.
class NormalDeriver {
public:
    // shape: as the file has it.
    NormalDeriver(const PlanetShape& shape, const std::array<HeldChunk, faceCount>& roots, LoadChildren load);

    // Bytes of decoded heights that are kept, >= 0, at first 0; less: blocks are read again.
    void keepHeights(std::size_t bytes) { heights_.setCacheBytes(bytes); }
    std::size_t keptBytes() const { return heights_.cachedBytes(); }

    // The Errors name the file and the chunk that could not be read.
    Result<TileData> tile(const ChunkId& id);
    Result<TileBlock> childrenOf(const ChunkId& parent);

    std::uint64_t bytesRead() const { return bytesRead_; }  // from the file

private:
    const PlanetShape shape_;
    const std::array<HeldChunk, faceCount> roots_;
    std::atomic<std::uint64_t> bytesRead_ = 0;
    FinestHeights heights_;
};

// A texel, column and row in [0, tileTexels): g_u and g_v.
std::array<float, 2> slopeOfTexel(const TileData& tile, int column, int row);

}  // namespace planet
