// The tight metric: the largest 3-D distance, metres, between a chunk's own surface and the finest samples
// under it, each sample compared with the point of the chunk's triangles at the same place of the face.
//
// Like delta_g it compares at the same place, so it bounds the whole finest surface and not its samples
// alone: the finest triangles subdivide the chunk's, and the difference of two surfaces that are linear on a
// triangle is largest at a corner. delta_c adds up the errors that each level may have; the tight metric is
// the actual error, so it is never larger.
//
// It is computed in two ways. While a bake holds a tile's finest heights, it measures every level whose cells
// lie within the tile, sample by sample. Chunks with larger cells are searched afterwards: the distance of a
// child's vertices plus the child's tight metric bounds everything under it, so most of the pyramid is never
// read.
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

// Returns the level that lies `levels` above the finest, at least that of the roots; by default the level of
// chunks that are 128 finest cells wide, or twice as wide as a leaf if that is more.
int tileLevelOf(const PlanetShape& shape, std::optional<int> levels);

// Returns the coarsest level whose cells are no wider than a tile of tileLevel.
int coarsestLevelOfTiles(const PlanetShape& shape, int tileLevel);

// The distances of a tile's finest samples from the chunks above and within it.
struct TileDistances {
    ChunkId tile;
    int coarsestLevel = 0;
    // The largest distances, metres, by level from the coarsest down to two above the finest: for the tile's
    // level and those above it, of the one chunk that holds the tile; for levels below, of its chunks in rows
    // along v. A chunk above the tile is measured over the tile alone; its own distance is the largest over
    // all its tiles.
    std::vector<std::vector<double>> largestM;

    // Returns the distance of a chunk of those levels that lies within the tile or holds it. The distance of
    // a leaf's parent is delta_g (geometric_error.h).
    double of(const ChunkId& chunk) const;
    // Returns the distance of the one chunk of a level above the tile.
    double above(int level) const;
};

// Measures a tile. finest: the (c + 1)^2 samples of its square in steps, row-major, c = faceCells >>
// tile.level.
void measureTile(const PlanetShape& shape, const ChunkId& tile, std::span<const std::int16_t> finest,
                 GeometricErrorScratch& scratch, TileDistances& out);

// Reads the four children of a chunk above the finest level, whose tight metrics are known.
using ReadChildren = std::function<Result<std::array<ChunkData, quadrantCount>>(const ChunkData& parent)>;

// Returns the distance of a chunk above the finest level. Holds one path of chunks. Calls goOn before each
// block is read; false cancels.
Result<double> searchFinestDistance(const PlanetShape& shape, const ChunkData& chunk,
                                    const ReadChildren& readChildren, const std::function<bool()>& goOn = {});

// Returns the metric as it is stored: at least the chunk's own distance and its children's metrics, and at
// most delta_c, whose sum may have lost the last bit.
float tightMetric(double ownDistanceM, float largestOfChildrenM, float deltaCM);

}  // namespace planet
