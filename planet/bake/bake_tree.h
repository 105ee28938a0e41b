// The tree that a bake makes: which chunks have children, and the units of work that it falls into. Pure
// functions, any thread.
//
// A chunk is refined, that is, has four children, while it lies above the deepest level and the source has
// finer samples under it than its own (HeightSource::finestCells). Chunks above a minimum level are always
// refined, so that the sphere stays round where the source has no data: to faces of at least 513 samples, or
// to the deepest level if that is coarser. If the source does not say where it is fine, every leaf is at the
// deepest level.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "planet/format/chunk_file_types.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// A bake never makes leaves on coarser grids than this, unless the whole planet is coarser.
inline constexpr int leastFaceCells = 512;

bool isRefined(const HeightSource& source, const PlanetShape& shape, const ChunkId& id);

// A complete subtree: all leaves under its root have one level. A leaf is one too.
struct TreeUnit {
    ChunkId root;
    int leafLevel = 0;  // [root.level, the shape's leafLevel]
};

// Returns the cells of a unit's leaves, along a side of its root.
constexpr int cellsAlong(const TreeUnit& unit, const PlanetShape& shape) {
    return chunkCells(shape) << (unit.leafLevel - unit.root.level);
}

// Returns the shape of a planet whose finest grid is that of a level's chunks.
constexpr PlanetShape shapeOfLevel(const PlanetShape& shape, int level) {
    PlanetShape coarser = shape;
    coarser.faceCellsLog2 = shape.chunkCellsLog2 + level;
    return coarser;
}

// Returns the unit that a chunk is the root of: all leaves under it have one level, at most `levels` below it.
std::optional<TreeUnit> unitAt(const HeightSource& source, const PlanetShape& shape, const ChunkId& id,
                               int levels);

// Returns the units of at most `levels` levels under a chunk, in quadtree order. Returns none if the root of one lies deeper
// than `levelsAbove` below the chunk.
std::vector<TreeUnit> unitsUnder(const HeightSource& source, const PlanetShape& shape, const ChunkId& id,
                                 int levels, int levelsAbove);

// Divides the tree into the largest units of at most `levels` levels of children, in quadtree order. Visits
// only refined chunks and their children, so places without fine data cost nothing.
class TreeWalk {
public:
    // source: must outlive the walk.
    TreeWalk(const HeightSource& source, const PlanetShape& shape, int levels);

    std::optional<TreeUnit> next();  // nothing at the end

private:
    const HeightSource& source_;
    PlanetShape shape_;
    int levels_;
    std::vector<ChunkId> open_;  // the next one last
};

struct TreeCount {
    std::uint64_t chunks = 0;
    int coarsestLeafLevel = 0;
    std::uint64_t leafCells = 0;  // of all leaves
    // Refined chunks by their height: the number of levels under them, minus 1.
    std::array<std::uint64_t, maxLevel + 1> refinedByHeight{};
};

// Counts the tree; calls finestCells for each chunk, unless it is null. Calls goOn now and then; returning
// false cancels, and the count is then nothing.
std::optional<TreeCount> countTree(const HeightSource& source, const PlanetShape& shape,
                                   const std::function<bool()>& goOn = {});

}  // namespace planet
