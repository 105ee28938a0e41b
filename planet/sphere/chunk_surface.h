// A chunk's grid as the surface that is drawn from it. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <span>

namespace planet {

// The height, in steps, at (x, y) cells from the chunk's west and south edges, both in [0, cells], on the two
// triangles of the cell: each cell's diagonal runs from its (west, south) to its (east, north) corner.
// heights is (cells + 1)^2, row-major.
double stepOnTriangles(std::span<const std::int16_t> heights, int cells, double x, double y);

// Lays a child's grid of (cells + 1)^2 into its quarter of the (2 cells + 1)^2 grid that four siblings cover
// together.
void placeQuarter(std::span<const std::int16_t> quarter, int cells, int quadrant,
                  std::span<std::int16_t> refined);

}  // namespace planet
