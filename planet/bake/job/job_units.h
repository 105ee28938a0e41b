// Divides a bake into units of work for several processes: subtrees of heights, and runs of blocks of colours. All
// processes divide it alike. Pure functions apart from the source; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/bake/bake_tree.h"
#include "planet/bake/colour_bake.h"

namespace planet {

// A bake is divided into about this many units if it is large enough, so that they are small beside what each of some
// hundred processes has to do, and few enough to be listed in memory.
inline constexpr std::uint64_t wantedJobUnits = 4096;

// Returns the levels between the root of a unit and those of its tiles (TreeUnit), [0, shape.chunkCellsLog2]. Then no
// chunk in it is held back (subtree_merging.h), so all its blocks lie together. leafCells: of the whole tree. tileLevels:
// as for TreeWalk.
int jobUnitLevels(const PlanetShape& shape, std::uint64_t leafCells, int tileLevels);

// Returns the roots of all units of heights, in quadtree order.
std::vector<ChunkId> jobUnits(const HeightSource& source, const PlanetShape& shape, int tileLevels,
                              int unitLevels);

// A run of blocks of one level of colour tiles.
struct ColourUnit {
    std::size_t level = 0;
    std::size_t firstTile = 0;  // in ColourTree::Level
    std::size_t tiles = 0;
};
inline constexpr std::size_t colourBlocksInUnit = 8;

// Returns the units of colours in the order in which they lie in the file: the finest level first.
std::vector<ColourUnit> colourUnits(const ColourTree& tree);

// Returns the number of tiles in each block of a level of colours.
constexpr std::size_t colourTilesInBlock(std::size_t level) {
    return level == 0 ? 1 : quadrantCount;
}

}  // namespace planet
