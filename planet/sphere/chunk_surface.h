// The surface drawn from a chunk's grid. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <span>

#include "planet/sphere/steps.h"

namespace planet {

// Returns the height, in steps, at (x, y) cells from the chunk's west and south edges, both in [0, cells], on
// the two triangles of the cell. The diagonal of each cell runs from its south-west to its north-east corner.
// heights: (cells + 1)^2, row-major.
double stepOnTriangles(StepsView heights, int cells, double x, double y);

// Copies a child's grid of (cells + 1)^2 into its quarter of the (2 cells + 1)^2 grid that four siblings
// cover.
void placeQuarter(StepsView quarter, int cells, int quadrant, std::span<std::int32_t> refined);

}  // namespace planet
