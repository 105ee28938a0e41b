#include "planet/raster/rim_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "planet/base/try.h"

namespace planet {

namespace {

constexpr std::int64_t blockCells = 64;        // per side
constexpr std::int64_t mostReachCells = 2000;  // columns, near a pole
constexpr double cellsPerReach = 16;
constexpr std::size_t rimCacheBytes = 8u << 20;
constexpr std::int64_t bandSamples = 4 << 20;  // read at once

int halvings(double samples) {
    return samples > 2 ? static_cast<int>(std::floor(std::log2(samples))) : 0;
}

// Which cells of a rectangle of cells are covered.
struct CoveredCells {
    std::int64_t columns = 0;
    std::vector<std::uint8_t> covered;
};

Result<CoveredCells> coveredCells(const RasterMosaic& mosaic, RimDistance::Rims rims,
                                  const GridReduction& cell, const GridRect& cells) {
    CoveredCells result{cells.columns,
                        std::vector<std::uint8_t>(static_cast<std::size_t>(cells.columns * cells.rows), 1)};
    const std::int64_t width = cells.columns << cell.columnsLog2;
    const std::int64_t cellRows = std::int64_t{1} << cell.rowsLog2;
    const std::int64_t bandRows = std::clamp<std::int64_t>(bandSamples / width, 1, cellRows);
    std::vector<float> heights;
    for (std::int64_t row = 0; row < cells.rows; ++row) {
        for (std::int64_t done = 0; done < cellRows; done += bandRows) {
            const std::int64_t rows = std::min(bandRows, cellRows - done);
            heights.resize(static_cast<std::size_t>(width * rows));
            const GridRect band{cells.column << cell.columnsLog2, ((cells.row + row) << cell.rowsLog2) + done,
                                width, rows};
            if (rims == RimDistance::Rims::Tiles) {
                mosaic.markTiles(band, heights);
            } else {
                TRY(mosaic.read({}, band, heights));
            }
            for (std::size_t i = 0; i < heights.size(); ++i) {
                if (!std::isnan(heights[i])) continue;
                const auto column =
                    static_cast<std::int64_t>(i % static_cast<std::size_t>(width)) >> cell.columnsLog2;
                result.covered[static_cast<std::size_t>(row * cells.columns + column)] = 0;
            }
        }
    }
    return result;
}

// Sets each cell of a row to the number of cells to the nearest one that is not covered, to the left or right.
void distancesInRow(std::span<const std::uint8_t> covered, std::span<float> distances) {
    float distance = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < covered.size(); ++i) {
        distance = covered[i] == 0 ? 0 : distance + 1;
        distances[i] = distance;
    }
    distance = std::numeric_limits<float>::infinity();
    for (std::size_t i = covered.size(); i-- > 0;) {
        distance = covered[i] == 0 ? 0 : distance + 1;
        distances[i] = std::min(distances[i], distance);
    }
}

}  // namespace

RimDistance::RimDistance(const RasterArea& area, double reachRad, Rims rims)
    : area_(&area),
      reachRad_(reachRad),
      rims_(rims),
      cache_(std::make_shared<HeightBlockCache>(rimCacheBytes)) {
    const RasterPlacement& placement = area.mosaic.placement();
    SampleDensity density{placement.columnsAround() / (2 * std::numbers::pi), placement.rowsPerRad()};
    if (!placement.isGeographic()) density = densitiesAt(placement, {area.centre})[0];
    const double cellRad = reachRad / cellsPerReach;
    cell_ = {halvings(cellRad * density.columnsPerRad), halvings(cellRad * density.rowsPerRad)};
    columnRad_ = std::ldexp(1 / density.columnsPerRad, cell_.columnsLog2);
    rowRad_ = std::ldexp(1 / density.rowsPerRad, cell_.rowsLog2);
}

// Returns the width of the cells of a row of cells.
double RimDistance::columnRad(double row) const {
    const RasterPlacement& placement = area_->mosaic.placement();
    if (!placement.isGeographic()) return columnRad_;
    const double sampleRow = std::ldexp(row + 0.5, cell_.rowsLog2) - 0.5;
    const double fromPole =
        (sampleRow - placement.northRow()) / (placement.southRow() - placement.northRow());
    return columnRad_ * std::max(0.01, std::sin(std::numbers::pi * std::clamp(fromPole, 0.0, 1.0)));
}

// Returns the distances of one more cell than a block has along each side, so that any place between the middles of
// cells lies in one block.
Result<std::vector<float>> RimDistance::block(int blockX, int blockY) const {
    const std::int64_t firstColumn = blockX * blockCells;
    const std::int64_t firstRow = blockY * blockCells;
    const double narrowest = std::min(columnRad(static_cast<double>(firstRow)),
                                      columnRad(static_cast<double>(firstRow + blockCells)));
    const auto marginColumns =
        std::min(mostReachCells, static_cast<std::int64_t>(std::ceil(reachRad_ / narrowest)) + 1);
    const auto marginRows = static_cast<std::int64_t>(std::ceil(reachRad_ / rowRad_)) + 1;
    const std::int64_t side = blockCells + 1;
    const GridRect cells{firstColumn - marginColumns, firstRow - marginRows, side + 2 * marginColumns,
                         side + 2 * marginRows};
    TRY_ASSIGN(const auto covered, coveredCells(area_->mosaic, rims_, cell_, cells));
    std::vector<float> across(covered.covered.size());
    const auto width = static_cast<std::size_t>(cells.columns);
    for (std::size_t row = 0; row < static_cast<std::size_t>(cells.rows); ++row)
        distancesInRow(std::span(covered.covered).subspan(row * width, width),
                       std::span(across).subspan(row * width, width));
    std::vector<float> distances;
    for (std::int64_t row = marginRows; row < marginRows + side; ++row) {
        const double cellWidth = columnRad(static_cast<double>(cells.row + row));
        for (std::int64_t column = marginColumns; column < marginColumns + side; ++column) {
            double least = reachRad_ + cellWidth;
            for (std::int64_t other = row - marginRows; other <= row + marginRows; ++other) {
                const auto cellsAcross =
                    static_cast<double>(across[static_cast<std::size_t>(other * cells.columns + column)]);
                least = std::min(
                    least, std::hypot(cellsAcross * cellWidth, static_cast<double>(other - row) * rowRad_));
            }
            distances.push_back(static_cast<float>(least));
        }
    }
    return distances;
}

Result<double> RimDistance::distanceAt(double column, double row) const {
    // Positions on the grid of cells, whose middles are whole numbers.
    const double x = std::ldexp(column + 0.5, -cell_.columnsLog2) - 0.5;
    const double y = std::ldexp(row + 0.5, -cell_.rowsLog2) - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    const auto blockX = static_cast<std::int32_t>(std::floor(left / blockCells));
    const auto blockY = static_cast<std::int32_t>(std::floor(top / blockCells));
    TRY_ASSIGN(const auto found, cache_->get({0, blockX, blockY}, [&] { return block(blockX, blockY); }));
    const auto i = static_cast<std::size_t>(left - static_cast<double>(blockX) * blockCells);
    const auto j = static_cast<std::size_t>(top - static_cast<double>(blockY) * blockCells);
    const auto distance = [&](std::size_t down, std::size_t across) {
        return static_cast<double>((*found)[(j + down) * (blockCells + 1) + i + across]);
    };
    const double above = std::lerp(distance(0, 0), distance(0, 1), x - left);
    const double below = std::lerp(distance(1, 0), distance(1, 1), x - left);
    // The rim is the edge of a cell, half a cell from its middle.
    const double halfCell = std::min(columnRad(y), rowRad_) / 2;
    return std::clamp(std::lerp(above, below, y - top) - halfCell, 0.0, reachRad_);
}

Result<void> RimDistance::at(std::span<const double> columns, std::span<const double> rows,
                             std::span<double> distancesRad) const {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        TRY_ASSIGN(distancesRad[i], distanceAt(columns[i], rows[i]));
    }
    return {};
}

}  // namespace planet
