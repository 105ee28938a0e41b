// The distance of places from the rim of what a mosaic of rasters covers, for blends at its rim. Internal to the library; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/raster_area.h"

namespace planet {

// Distances up to a reach. They are found on cells of about a sixteenth of the reach, or of one sample if that is
// larger, and interpolated between the middles of cells, so they are continuous. A cell counts as covered only if all
// its samples are. Copies share the cache.
class RimDistance {
public:
    // The coverage ends at the edges of tiles, or also at samples without a height.
    enum class Rims : std::uint8_t { Tiles, TilesAndVoids };

    // area: must outlive this. reachRad: (0, 1].
    RimDistance(const RasterArea& area, double reachRad, Rims rims);

    double reachRad() const { return reachRad_; }

    // Computes the distances in radians at positions on the grid, [0, reach]; 0 outside of the coverage.
    Result<void> at(std::span<const double> columns, std::span<const double> rows,
                    std::span<double> distancesRad) const;

private:
    double columnRad(double row) const;
    Result<std::vector<float>> block(int blockX, int blockY) const;
    Result<double> distanceAt(double column, double row) const;

    const RasterArea* area_;
    double reachRad_;
    Rims rims_;
    GridReduction cell_;  // a cell has 2^columnsLog2 x 2^rowsLog2 samples
    double rowRad_ = 0;   // the height of a cell
    double columnRad_ =
        0;  // the width of a cell at the equator of a grid along the meridians, anywhere in others
    std::shared_ptr<HeightBlockCache> cache_;
};

}  // namespace planet
