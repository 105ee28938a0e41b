#include "planet/sphere/chunk_surface.h"

#include <algorithm>
#include <cmath>

namespace planet {

double stepOnTriangles(StepsView heights, int cells, double x, double y) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    const double column = std::clamp(std::floor(x), 0.0, cells - 1.0);
    const double row = std::clamp(std::floor(y), 0.0, cells - 1.0);
    const double s = std::clamp(x - column, 0.0, 1.0);
    const double t = std::clamp(y - row, 0.0, 1.0);
    const std::size_t southWest = static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column);
    const double sw = heights[southWest];
    const double se = heights[southWest + 1];
    const double nw = heights[southWest + side];
    const double ne = heights[southWest + side + 1];
    if (s >= t) return sw + s * (se - sw) + t * (ne - se);
    return sw + t * (nw - sw) + s * (ne - nw);
}

void placeQuarter(StepsView quarter, int cells, int quadrant, std::span<std::int32_t> refined) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    const std::size_t refinedSide = 2 * side - 1;
    const std::size_t column = (quadrant & 1) != 0 ? side - 1 : 0;
    const std::size_t row = (quadrant & 2) != 0 ? side - 1 : 0;
    for (std::size_t j = 0; j < side; ++j) {
        quarter.subspan(j * side, side).copyTo(refined.subspan((row + j) * refinedSide + column, side));
    }
}

}  // namespace planet
