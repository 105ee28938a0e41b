// Chooses the viewpoints of an atlas. Pure functions, any thread.
//
// The cells of each altitude form quadtrees of their own on the cube's faces. A survey begins with all cells of the
// grid's coarsest level, or of a coarser one if the viewpoints would not suffice for three times as many. Then it splits
// cells in rounds, until the viewpoints are used up or no cell is worth it. What a split cell has measured is kept.
//
// A cell's value of a measure is the largest over its headings. The score of a cell is the largest over all measures of
//
//     max(largest |value - value of a neighbour|, value - 99th percentile) / (largest value - smallest value)
//
// over the cells of its altitude that are not split, where no bound counts as twice the largest one, times 2^-(l / 2) for a cell l levels below the coarsest one. So
// cells are split where neighbours differ, and where the worst is. A cell narrower than the altitude is not split,
// because the views from its quarters would show the same.
#pragma once

#include <span>
#include <vector>

#include "planet/measure/atlas.h"

namespace planet {

// A cell that is not split, with its values.
struct AtlasCell {
    ChunkId cell;
    std::uint8_t altitude = 0;
    AtlasFigures values{};  // the largest over the headings; NaN for what was not measured
};

// Returns the cells that are not split, by altitude, then by ChunkId's order. Viewpoints of cells of which some heading
// is missing count with those that are there.
std::vector<AtlasCell> cellsOf(const AtlasGrid& grid, std::span<const AtlasViewpoint> viewpoints);

// Returns the level of the first cells.
int firstLevelOf(const AtlasGrid& grid);

// Returns the next viewpoints, after those of all earlier rounds; none if the survey is complete. radiusM: of the planet.
std::vector<AtlasPlace> nextPlaces(const AtlasGrid& grid, double radiusM,
                                   std::span<const AtlasViewpoint> measured);

}  // namespace planet
