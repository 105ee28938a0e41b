// The tight metric: the largest 3-D distance, metres, between a chunk's own surface and the finest samples
// under it, each sample compared with the point of the chunk's triangles at the same place of the face.
//
// Like delta_g it compares at the same place, so it bounds the whole finest surface and not its samples
// alone: the finest triangles subdivide the chunk's, and the difference of two surfaces that are linear on a
// triangle is largest at a corner. Unlike delta_c, which adds up what each level may lose, it is what is
// really lost; so it is never the larger of the two.
//
// Two ways to the same number. While a bake has a tile's finest heights at hand, every level whose cells lie
// within the tile is measured there, sample by sample. Chunks with larger cells are searched for afterwards:
// what a child chunk's vertices lie off, plus the child's own tight metric, bounds all that lies under it, so
// most of the pyramid is never looked at.
//
// Pure functions but for what readChildren does; any thread, each with a scratch of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planet/format/chunk_file.h"
#include "planet/sphere/geometric_error.h"

namespace planet {

// The level of the chunks that lie so many levels above the finest, or of the roots; by default those that
// are 128 finest cells wide, or twice as wide as a leaf where that is more.
int tileLevelOf(const PlanetShape& shape, std::optional<int> levels);

// The coarsest level whose cells are no wider than a tile of tileLevel.
int coarsestLevelOfTiles(const PlanetShape& shape, int tileLevel);

// What a tile's finest samples lie off the chunks above and within it.
struct TileDistances {
    ChunkId tile;
    int coarsestLevel = 0;
    // By level from the coarsest down to two above the finest, metres: of a level above the tile, or its own,
    // the one chunk that holds it; of one below, its chunks in rows along v. A chunk above the tile is
    // measured over the tile alone; the largest over all its tiles is the chunk's own.
    std::vector<std::vector<double>> largestM;

    // Of a chunk within the tile, or of the one that holds it, of those levels. At a leaf's parent the
    // distance is delta_g (geometric_error.h).
    double of(const ChunkId& chunk) const;
    // Of the one chunk of a level above the tile.
    double above(int level) const;
};

// Finest: the (c + 1)^2 samples of the tile's square in steps, row-major, c = faceCells >> tile.level.
void measureTile(const PlanetShape& shape, const ChunkId& tile, std::span<const std::int16_t> finest,
                 GeometricErrorScratch& scratch, TileDistances& out);

// The four children of a chunk above the finest level, their tight metrics known.
using ReadChildren = std::function<Result<std::array<ChunkData, quadrantCount>>(const ChunkData& parent)>;

// The distance of any chunk above the finest level. Holds one path of chunks. Called before each block is
// read, goOn ends the search with Cancelled when it is false.
Result<double> searchFinestDistance(const PlanetShape& shape, const ChunkData& chunk,
                                    const ReadChildren& readChildren, const std::function<bool()>& goOn = {});

// The metric as it is stored: never below the chunk's own distance or a child's metric, but where adding up
// delta_c lost the last bit.
float tightMetric(double ownDistanceM, float largestOfChildrenM, float deltaCM);

}  // namespace planet
