// The outline of what a mosaic of rasters covers. Internal to the library; any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "planet/sphere/cube_sphere.h"

namespace planet {

class RasterMosaic;

// A closed line on the planet; the last point equals the first one.
using Outline = std::vector<Geographic>;

struct CoverageOutline {
    // Around the tiles, joined where they touch or overlap; the longest first. Straight sides in the reference system
    // of the tiles have points between their ends, because they may be curved on the planet. Points that the projection
    // does not reach are left out.
    std::vector<Outline> lines;
    bool wholePlanet = false;  // the tiles cover the planet; there are no lines then
};

// At most mostLines lines, and about mostPoints points in all. Of more tiles than that can show, the longest lines are
// kept, with some of their corners.
CoverageOutline outlineOf(const RasterMosaic& mosaic, std::size_t mostLines = 64,
                          std::size_t mostPoints = 4096);

}  // namespace planet
