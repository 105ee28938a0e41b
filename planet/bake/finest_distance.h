// The tight metric: the largest 3-D distance, metres, between a chunk's own surface and its finest samples,
// each compared with the point of the chunk's triangles at the same place of the face.
//
// Like δg it compares at the same place, so it bounds the whole finest surface and not only its samples: the
// finest triangles subdivide the chunk's, and the difference of two surfaces that are linear on a triangle is
// largest at a corner. δc sums the largest possible errors of the levels; the tight metric is the actual
// error, so it is never larger.
//
// It is computed in two ways. While a bake has a tile's finest heights in memory, it measures every level
// whose cells are no wider than the tile, sample by sample. Chunks with larger cells are searched afterwards:
// the distance of a child's vertices plus the child's tight metric bounds everything under the child, so most
// of the pyramid is never read.
//
// A tile is a complete subtree, whose leaves all have one level. In a sparse planet tiles have different
// leaves; the shape that is passed with a tile is that of a planet with the tile's leaves as its finest.
//
// Pure functions apart from readChildren; any thread, each with its own scratch.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planet/format/chunk_file.h"
#include "planet/sphere/geometric_error.h"

namespace planet {

// Returns the level that lies `levels` above the finest, at least that of the roots. By default it is the
// level of chunks that are 128 finest cells wide, or twice as wide as a leaf if that is more.
int tileLevelOf(const PlanetShape& shape, std::optional<int> levels);

// Returns the coarsest level whose cells are no wider than a chunk of tileLevel.
int coarsestLevelOfTiles(int tileLevel, const PlanetShape& shape);

// The distances of a tile's finest samples from the chunks above and within it.
struct TileDistances {
    ChunkId tile;
    int coarsestLevel = 0;
    // The largest distances, metres, by level from the coarsest down to two above the finest. For the tile's
    // level and those above, of the one chunk that contains the tile; for levels below, of the tile's chunks
    // in rows along v. A chunk above the tile is measured over the tile only; its own distance is the largest
    // over all its tiles.
    std::vector<std::vector<double>> largestM;

    // Returns the distance of a chunk of those levels that lies within the tile or contains it. The distance
    // of a leaf's parent is δg (geometric_error.h).
    double of(const ChunkId& chunk) const;
    // Returns the distance of the one chunk of a level above the tile.
    double above(int level) const;
};

// Measures a tile. finest: the (c + 1)^2 samples of its square in steps, row-major, c = faceCells >>
// tile.level. Leaves their positions in scratch.
void measureTile(const PlanetShape& shape, const ChunkId& tile, std::span<const std::int32_t> finest,
                 GeometricErrorScratch& scratch, TileDistances& out);

// Reads the four children of a chunk that has children. Their tight metrics are known.
using ReadChildren = std::function<Result<std::array<ChunkData, quadrantCount>>(const ChunkData& parent)>;

// Returns the distance of a chunk that has children. Keeps one path of chunks in memory. Calls goOn
// before each block is read; returning false cancels.
Result<double> searchFinestDistance(const PlanetShape& shape, const ChunkData& chunk,
                                    const ReadChildren& readChildren, const std::function<bool()>& goOn = {});

// Returns the metric to store: at least the chunk's own distance and its children's metrics, and at most δc,
// whose sum may have lost the last bit.
float tightMetric(double ownDistanceM, float largestOfChildrenM, float deltaCM);

}  // namespace planet
