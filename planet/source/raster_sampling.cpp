#include "planet/source/raster_sampling.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "planet/base/cpu_clones.h"
#include "planet/base/try.h"
#include "planet/source/height_filter.h"
#include "planet/source/place_lattice.h"

namespace planet {

namespace {

constexpr std::int64_t mostRegionSamples = 3 << 20;  // samples in memory at once: 12 MB
// How far a projection may bend over two cells of its lattice to be interpolated there.
constexpr double mostPlaceBend = 0.1;     // samples
constexpr double mostDensityBend = 0.01;  // of the samples in a radian
constexpr double reducedAt = 4;           // a kernel stretched by more is applied to means

// Return what std::floor and std::llround do, for numbers within the range of the result; those are calls of functions.
std::int64_t floorOf(double value) {
    const auto towardsZero = static_cast<std::int64_t>(value);
    return towardsZero - (static_cast<double>(towardsZero) > value ? 1 : 0);
}
std::int64_t roundedOf(double value) {
    const auto towardsZero = static_cast<std::int64_t>(value);
    const double rest = value - static_cast<double>(towardsZero);  // exact
    return towardsZero + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

// A place on the grid of a mosaic, at a reduced resolution.
struct Position {
    std::size_t index = 0;  // in the piece
    double column = 0;
    double row = 0;
    float columnStretch = 1;
    float rowStretch = 1;
    std::int64_t firstColumn = 0;  // of the taps
    std::int64_t firstRow = 0;
    std::int64_t nearestColumn = 0;
    std::int64_t nearestRow = 0;
};

// Returns the sample nearest to a position. One on the outer edge belongs to the outermost sample.
PLANET_ALWAYS_INLINE GridCell nearestIn(const GridRect& bounds, double column, double row) {
    return {std::clamp(roundedOf(column), bounds.column, bounds.column + bounds.columns - 1),
            std::clamp(roundedOf(row), bounds.row, bounds.row + bounds.rows - 1)};
}

std::int64_t firstTap(double at, float stretch) {
    return floorOf(at - 2.0 * static_cast<double>(stretch)) + 1;
}

// Positions that are read from one region, in ascending order of their samples. A grid that repeats is read on
// either side of the middle of a turn alone, because a piece across its end would need the whole turn.
struct Region {
    GridReduction reduction;
    bool east = false;

    auto operator<=>(const Region&) const = default;
};
using Positions = std::map<Region, std::vector<Position>>;

// Halves a resolution while the kernel is wide; returns the number of halvings.
int reduce(double& position, double& stretch) {
    int halvings = 0;
    while (stretch >= reducedAt) {
        stretch /= 2;
        position = (position + 0.5) / 2 - 0.5;
        ++halvings;
    }
    return halvings;
}

double middleColumn(const RasterMosaic& mosaic) {
    const GridRect& bounds = mosaic.bounds();
    return static_cast<double>(bounds.column) + static_cast<double>(bounds.columns - 1) / 2;
}

// Moves a column by whole turns to the turn around the middle of the mosaic.
double inTurn(const RasterMosaic& mosaic, double column) {
    const double around = mosaic.placement().columnsAround();
    if (around <= 0) return column;
    return column - std::floor((column - middleColumn(mosaic)) / around + 0.5) * around;
}

bool isOnGrid(const RasterMosaic& mosaic, double columnInTurn, double row) {
    const GridRect& bounds = mosaic.bounds();
    const double fromLeft = columnInTurn - static_cast<double>(bounds.column) + 0.5;
    const double fromTop = row - static_cast<double>(bounds.row) + 0.5;
    return fromLeft >= 0 && fromLeft <= static_cast<double>(bounds.columns) && fromTop >= 0 &&
           fromTop <= static_cast<double>(bounds.rows);  // false for NaN
}

// Keeps the places whose nearest sample lies on a tile. The rectangle around tiles that lie apart can be a continent.
void keepPlacesOnTiles(const RasterMosaic& mosaic, PlacesOnGrid& places) {
    if (mosaic.tiles().size() < 2 || places.index.empty()) return;
    const auto [left, right] = std::ranges::minmax(places.column);
    const auto [top, bottom] = std::ranges::minmax(places.row);
    const GridCell first = nearestSample(mosaic, left, top);
    const GridCell last = nearestSample(mosaic, right, bottom);
    const std::vector<GridRect> tiles =
        mosaic.tilesIn({first.column, first.row, last.column - first.column + 1, last.row - first.row + 1});
    std::size_t kept = 0;
    for (std::size_t i = 0; i < places.index.size(); ++i) {
        const GridCell sample = nearestSample(mosaic, places.column[i], places.row[i]);
        const auto holds = [&](const GridRect& tile) {
            return sample.column >= tile.column && sample.column < tile.column + tile.columns &&
                   sample.row >= tile.row && sample.row < tile.row + tile.rows;
        };
        if (std::ranges::none_of(tiles, holds)) continue;
        places.index[kept] = places.index[i];
        places.column[kept] = places.column[i];
        places.row[kept] = places.row[i];
        ++kept;
    }
    places.index.resize(kept);
    places.column.resize(kept);
    places.row.resize(kept);
}

// Returns the cells along a face of the lattice on which the places of a piece are converted; 0: each is converted.
int latticeCellsOf(const RasterArea& area, const PiecePlaces& places) {
    if (!places.tile() || !area.mosaic.placement().isProjected()) return 0;
    return latticeCellsFor(filterCellsOf(*places.tile()), area.samplesPerRad);
}

// Returns how many samples lie in a radian along each axis at each wanted place; nothing if the grid of the planet is
// finer than the mosaic everywhere.
std::vector<SampleDensity> densitiesFor(const RasterArea& area, const PiecePlaces& places,
                                        std::span<const std::size_t> wanted) {
    if (places.spacingRad() * area.samplesPerRad * mostUneven <= 1) return {};
    const RasterPlacement& placement = area.mosaic.placement();
    if (!placement.isGeographic()) {
        const auto exact = [&](std::span<const double> longitudes, std::span<const double> latitudes,
                               std::span<double> columns, std::span<double> rows) {
            std::vector<glm::dvec3> directions;
            for (std::size_t i = 0; i < longitudes.size(); ++i)
                directions.push_back(directionFromGeographic({latitudes[i], longitudes[i]}));
            const std::vector<SampleDensity> found = densitiesAt(placement, directions);
            for (std::size_t i = 0; i < found.size(); ++i) {
                columns[i] = found[i].columnsPerRad;
                rows[i] = found[i].rowsPerRad;
            }
        };
        std::vector<double> columns(places.count());
        std::vector<double> rows(columns.size());
        overPiece(places, wanted, latticeCellsOf(area, places), mostDensityBend * area.samplesPerRad, exact,
                  columns, rows);
        std::vector<SampleDensity> densities;
        for (const std::size_t i : wanted) densities.push_back({columns[i], rows[i]});
        return densities;
    }
    const double perRad = placement.columnsAround() / (2 * std::numbers::pi);
    std::vector<SampleDensity> densities;
    for (const std::size_t i : wanted)
        densities.push_back({perRad / std::max(places.geographic().ring[i], 1e-12), placement.rowsPerRad()});
    return densities;
}

double stretchOf(double samplesPerRad, double spacingRad) {
    const double stretch = samplesPerRad * spacingRad;
    return std::isfinite(stretch) ? std::clamp(stretch, 1.0, 4e6) : 1;
}

// Sorts the places without a height into regions.
Positions positionsOf(const RasterArea& area, const PiecePlaces& places, const PlacesOnGrid& onGrid,
                      std::span<const SampleDensity> densities, std::span<const float> heights) {
    const double middle = middleColumn(area.mosaic);
    const std::int64_t period = area.mosaic.period();
    Positions positions;
    Region region;
    std::vector<Position>* inRegion = nullptr;  // the last one, which is mostly the next one's too
    for (std::size_t i = 0; i < onGrid.index.size(); ++i) {
        if (!std::isnan(heights[onGrid.index[i]])) continue;
        double column = onGrid.column[i];
        double row = onGrid.row[i];
        const SampleDensity density = densities.empty() ? SampleDensity{} : densities[i];
        double columnStretch = stretchOf(density.columnsPerRad, places.spacingRad());
        double rowStretch = stretchOf(density.rowsPerRad, places.spacingRad());
        // Near a pole the kernel covers the whole turn, but no sample twice.
        if (period >= 4) columnStretch = std::min(columnStretch, static_cast<double>(period) / 4);
        const bool east = period > 0 && column > middle;
        const GridCell nearest = nearestIn(area.mosaic.bounds(), column, row);
        const int columnsLog2 = reduce(column, columnStretch);
        const int rowsLog2 = reduce(row, rowStretch);
        const Region own{{columnsLog2, rowsLog2}, east};
        if (!inRegion || own != region) {
            region = own;
            inRegion = &positions[region];
            inRegion->reserve(onGrid.index.size());
        }
        const auto kernelColumns = static_cast<float>(columnStretch);
        const auto kernelRows = static_cast<float>(rowStretch);
        inRegion->push_back({onGrid.index[i], column, row, kernelColumns, kernelRows,
                             firstTap(column, kernelColumns), firstTap(row, kernelRows),
                             nearest.column >> columnsLog2, nearest.row >> rowsLog2});
    }
    return positions;
}

GridRect boundsOf(std::span<const Position> positions) {
    std::int64_t left = positions[0].firstColumn;
    std::int64_t top = positions[0].firstRow;
    std::int64_t right = left;
    std::int64_t bottom = top;
    for (const Position& position : positions) {
        left = std::min(left, position.firstColumn);
        top = std::min(top, position.firstRow);
        right = std::max(right, position.firstColumn + tapCount(position.columnStretch));
        bottom = std::max(bottom, position.firstRow + tapCount(position.rowStretch));
    }
    return {left, top, right - left, bottom - top};
}

// The samples of a region of a mosaic.
struct RegionSamples {
    GridRect rect;
    std::vector<float> heights;

    const float* at(std::int64_t column, std::int64_t row) const {
        return &heights[static_cast<std::size_t>((row - rect.row) * rect.columns + column - rect.column)];
    }
};

// Filters the samples around a position, all of which have heights; NaN if one has none.
class PositionFilter {
public:
    float filtered(const RegionSamples& samples, const Position& position) {
        const std::int64_t column = position.firstColumn;
        const std::int64_t row = position.firstRow;
        if (position.columnStretch == 1 && position.rowStretch == 1) {
            const float height = fourByFour(samples, position.column, position.row, column, row);
            if (!std::isnan(height)) return height;
        }
        columnWeights_.resize(static_cast<std::size_t>(tapCount(position.columnStretch)));
        rowWeights_.resize(static_cast<std::size_t>(tapCount(position.rowStretch)));
        kernelWeights(static_cast<float>(position.column - static_cast<double>(column)),
                      position.columnStretch, columnWeights_);
        kernelWeights(static_cast<float>(position.row - static_cast<double>(row)), position.rowStretch,
                      rowWeights_);
        const auto asRead = [](const float* from, std::size_t, std::size_t i) {
            return loadFloat4(from + i);
        };
        const float height = weighted(samples, column, row, asRead);
        if (!std::isnan(height)) return height;
        // The groups of four taps reach beyond the kernel. A sample without a height out there must not change the sum.
        const auto withinKernel = [&](const float* from, std::size_t j, std::size_t i) {
            Float4 heights = loadFloat4(from + i);
            for (std::size_t k = 0; k < 4; ++k) {
                if (rowWeights_[j] == 0 || columnWeights_[i + k] == 0) heights[k] = 0;
            }
            return heights;
        };
        const float heightWithin = weighted(samples, column, row, withinKernel);
        return std::isnan(heightWithin) ? filteredWithout(samples, column, row) : heightWithin;
    }

    // Does the same for four by four taps from a column and a row on; NaN if a sample has no height.
    PLANET_ALWAYS_INLINE static float fourByFour(const RegionSamples& samples, double column, double row,
                                                 std::int64_t firstColumn, std::int64_t firstRow) {
        const Float4 across =
            catmullRomWeights(static_cast<float>(column - static_cast<double>(firstColumn)) - 1);
        const Float4 down = catmullRomWeights(static_cast<float>(row - static_cast<double>(firstRow)) - 1);
        const float* const from = samples.at(firstColumn, firstRow);
        const std::int64_t stride = samples.rect.columns;
        Float4 sum = down[0] * (across * loadFloat4(from));
        sum += down[1] * (across * loadFloat4(from + stride));
        sum += down[2] * (across * loadFloat4(from + 2 * stride));
        sum += down[3] * (across * loadFloat4(from + 3 * stride));
        return sumOfLanes(sum);
    }

private:
    // Sums the samples with their weights. load(from, j, i) returns four samples of row j from column i on.
    template <class Load>
    float weighted(const RegionSamples& samples, std::int64_t column, std::int64_t row,
                   const Load& load) const {
        Float4 sum{};
        for (std::size_t j = 0; j < rowWeights_.size(); ++j) {
            const float* const from = samples.at(column, row + static_cast<std::int64_t>(j));
            Float4 rowSum{};
            for (std::size_t i = 0; i < columnWeights_.size(); i += 4)
                rowSum += loadFloat4(columnWeights_.data() + i) * load(from, j, i);
            sum += rowWeights_[j] * rowSum;
        }
        return sumOfLanes(sum);
    }

    // Leaves out samples without a height, and the negative parts of the kernel, without which the sum of the
    // remaining weights could be near 0.
    float filteredWithout(const RegionSamples& samples, std::int64_t column, std::int64_t row) const {
        double sum = 0;
        double weights = 0;
        for (std::size_t j = 0; j < rowWeights_.size(); ++j) {
            const float* const from = samples.at(column, row + static_cast<std::int64_t>(j));
            for (std::size_t i = 0; i < columnWeights_.size(); ++i) {
                if (std::isnan(from[i])) continue;
                const double weight = static_cast<double>(std::max(0.0f, columnWeights_[i])) *
                                      static_cast<double>(std::max(0.0f, rowWeights_[j]));
                weights += weight;
                sum += weight * static_cast<double>(from[i]);
            }
        }
        return static_cast<float>(sum / weights);
    }

    std::vector<float> columnWeights_;
    std::vector<float> rowWeights_;
};

Result<void> fillPositions(const RasterMosaic& mosaic, const GridReduction& reduction,
                           std::span<const Position> positions, std::span<float> heights) {
    RegionSamples samples{boundsOf(positions), {}};
    if (samples.rect.columns * samples.rect.rows > mostRegionSamples && positions.size() > 1) {
        const std::size_t half = positions.size() / 2;
        TRY(fillPositions(mosaic, reduction, positions.first(half), heights));
        return fillPositions(mosaic, reduction, positions.subspan(half), heights);
    }
    samples.heights.resize(static_cast<std::size_t>(samples.rect.columns * samples.rect.rows));
    TRY(mosaic.read(reduction, samples.rect, samples.heights));
    PositionFilter filter;
    for (const Position& position : positions) {
        const float nearest = *samples.at(position.nearestColumn, position.nearestRow);
        if (!std::isnan(nearest)) heights[position.index] = filter.filtered(samples, position);
    }
    return {};
}

// Widens [least, most] to hold the values of the places without a height. Several are compared at once.
PLANET_CPU_CLONES void widenTo(std::span<const double> values, std::span<const std::size_t> index,
                               std::span<const float> heights, double& least, double& most) {
    constexpr std::size_t lanes = 8;
    std::array<double, lanes> low{}, high{};
    low.fill(least);
    high.fill(most);
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes) {
        for (std::size_t k = 0; k < lanes; ++k) {
            const bool counts = std::isnan(heights[index[i + k]]);
            const double value = values[i + k];
            low[k] = counts && value < low[k] ? value : low[k];
            high[k] = counts && value > high[k] ? value : high[k];
        }
    }
    for (; i < values.size(); ++i) {
        if (!std::isnan(heights[index[i]])) continue;
        low[0] = std::min(low[0], values[i]);
        high[0] = std::max(high[0], values[i]);
    }
    least = *std::ranges::min_element(low);
    most = *std::ranges::max_element(high);
}

// Returns the samples that four by four taps around the places without a height lie on; empty if there is none.
GridRect tapsAround(const PlacesOnGrid& onGrid, std::span<const float> heights) {
    constexpr double most = std::numeric_limits<double>::infinity();
    double left = most, top = most, right = -most, bottom = -most;
    widenTo(onGrid.column, onGrid.index, heights, left, right);
    widenTo(onGrid.row, onGrid.index, heights, top, bottom);
    if (left == most) return {};
    const GridRect first{firstTap(left, 1), firstTap(top, 1)};
    const int taps = tapCount(1);
    return {first.column, first.row, firstTap(right, 1) + taps - first.column,
            firstTap(bottom, 1) + taps - first.row};
}

// Four groups of four lanes. Passed by reference, because how it is passed by value depends on the processor.
using FourFloat4 = float __attribute__((vector_size(64)));

PLANET_ALWAYS_INLINE void join(Float4 a, Float4 b, Float4 c, Float4 d, FourFloat4& out) {
    const auto first = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
    const auto second = __builtin_shufflevector(c, d, 0, 1, 2, 3, 4, 5, 6, 7);
    out = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

PLANET_ALWAYS_INLINE void joinTaps(const std::array<const float*, 4>& from, std::int64_t offset,
                                   FourFloat4& out) {
    join(loadFloat4(from[0] + offset), loadFloat4(from[1] + offset), loadFloat4(from[2] + offset),
         loadFloat4(from[3] + offset), out);
}

// Computes in each group the weights at one of four t.
PLANET_ALWAYS_INLINE void weightsOfFour(const std::array<float, 4>& t, FourFloat4& out) {
    using W = CatmullRomWeights;
    FourFloat4 cubic, square, linear, constant;
    join(W::cubic, W::cubic, W::cubic, W::cubic, cubic);
    join(W::square, W::square, W::square, W::square, square);
    join(W::linear, W::linear, W::linear, W::linear, linear);
    join(W::constant, W::constant, W::constant, W::constant, constant);
    FourFloat4 each;
    join(Float4{} + t[0], Float4{} + t[1], Float4{} + t[2], Float4{} + t[3], each);
    out = ((cubic * each + square) * each + linear) * each + constant;
}

// Returns PositionFilter::fourByFour of four places from the i-th on, bit for bit.
PLANET_ALWAYS_INLINE Float4 fourByFourOfFour(const RegionSamples& samples, const PlacesOnGrid& onGrid,
                                             std::size_t i) {
    std::array<const float*, 4> from{};
    std::array<float, 4> column{}, row{};
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 4; ++k) {
        const std::int64_t firstColumn = firstTap(onGrid.column[i + k], 1);
        const std::int64_t firstRow = firstTap(onGrid.row[i + k], 1);
        from[k] = samples.at(firstColumn, firstRow);
        column[k] = static_cast<float>(onGrid.column[i + k] - static_cast<double>(firstColumn)) - 1;
        row[k] = static_cast<float>(onGrid.row[i + k] - static_cast<double>(firstRow)) - 1;
    }
    FourFloat4 across, down, taps;
    weightsOfFour(column, across);
    weightsOfFour(row, down);
    const std::int64_t stride = samples.rect.columns;
    joinTaps(from, 0, taps);
    FourFloat4 sum = __builtin_shufflevector(down, down, 0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12) *
                     (across * taps);
    joinTaps(from, stride, taps);
    sum += __builtin_shufflevector(down, down, 1, 1, 1, 1, 5, 5, 5, 5, 9, 9, 9, 9, 13, 13, 13, 13) *
           (across * taps);
    joinTaps(from, 2 * stride, taps);
    sum += __builtin_shufflevector(down, down, 2, 2, 2, 2, 6, 6, 6, 6, 10, 10, 10, 10, 14, 14, 14, 14) *
           (across * taps);
    joinTaps(from, 3 * stride, taps);
    sum += __builtin_shufflevector(down, down, 3, 3, 3, 3, 7, 7, 7, 7, 11, 11, 11, 11, 15, 15, 15, 15) *
           (across * taps);
    // Each group is summed in the order of sumOfLanes.
    sum += __builtin_shufflevector(sum, sum, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13);
    return Float4{sum[0] + sum[1], sum[4] + sum[5], sum[8] + sum[9], sum[12] + sum[13]};
}

// Filters the places without a height from four by four samples, all of which lie in the region.
PLANET_CPU_CLONES void filterUnstretched(const GridRect& bounds, const RegionSamples& samples,
                                         const PlacesOnGrid& onGrid, std::span<float> heights) {
    PositionFilter filter;
    // The height is NaN where a sample is missing. If the nearest one is not, the others are left out.
    const auto complete = [&](float& height, std::size_t i) {
        const double column = onGrid.column[i];
        const double row = onGrid.row[i];
        const GridCell nearest = nearestIn(bounds, column, row);
        if (std::isnan(*samples.at(nearest.column, nearest.row))) return;
        height = filter.filtered(
            samples,
            {.column = column, .row = row, .firstColumn = firstTap(column, 1), .firstRow = firstTap(row, 1)});
    };
    const std::size_t count = onGrid.index.size();
    for (std::size_t i = 0; i < count;) {
        const auto hasHeight = [&](std::size_t k) { return !std::isnan(heights[onGrid.index[k]]); };
        if (i + 4 <= count && !hasHeight(i) && !hasHeight(i + 1) && !hasHeight(i + 2) && !hasHeight(i + 3)) {
            const Float4 four = fourByFourOfFour(samples, onGrid, i);
            for (std::size_t k = 0; k < 4; ++k, ++i) {
                float& height = heights[onGrid.index[i]] = four[k];
                if (std::isnan(height)) complete(height, i);
            }
            continue;
        }
        if (!hasHeight(i)) {
            float& height = heights[onGrid.index[i]] =
                PositionFilter::fourByFour(samples, onGrid.column[i], onGrid.row[i],
                                           firstTap(onGrid.column[i], 1), firstTap(onGrid.row[i], 1));
            if (std::isnan(height)) complete(height, i);
        }
        ++i;
    }
}

// Does for places whose kernel covers four by four samples of the full resolution what fillPositions does.
Result<void> fillUnstretched(const RasterMosaic& mosaic, const PlacesOnGrid& onGrid, const GridRect& taps,
                             std::span<float> heights) {
    RegionSamples samples{taps, std::vector<float>(static_cast<std::size_t>(taps.columns * taps.rows))};
    TRY(mosaic.read({}, taps, samples.heights));
    filterUnstretched(mosaic.bounds(), samples, onGrid, heights);
    return {};
}

}  // namespace

GridCell nearestSample(const RasterMosaic& mosaic, double column, double row) {
    return nearestIn(mosaic.bounds(), column, row);
}

namespace {

void convertPlaces(const RasterArea& area, const PiecePlaces& places, std::span<double> column,
                   std::span<double> row) {
    const RasterPlacement& placement = area.mosaic.placement();
    const int latticeCells = latticeCellsOf(area, places);
    if (latticeCells == 0)
        return placement.toGrid(places.geographic().longitudeRad, places.geographic().latitudeRad, column,
                                row);
    std::vector<std::size_t> wanted(places.count());
    std::iota(wanted.begin(), wanted.end(), std::size_t{0});
    const auto exact = [&](std::span<const double> longitudes, std::span<const double> latitudes,
                           std::span<double> columns, std::span<double> rows) {
        placement.toGrid(longitudes, latitudes, columns, rows);
    };
    overPiece(places, wanted, latticeCells, mostPlaceBend, exact, column, row);
}

}  // namespace

PlacesOnGrid placesOnGrid(const RasterArea& area, const PiecePlaces& places) {
    const double apart = std::acos(std::clamp(glm::dot(area.centre, places.centre()), -1.0, 1.0));
    if (apart > area.radiusRad + places.radiusRad()) return {};
    const std::size_t count = places.count();
    PlacesOnGrid all{std::vector<std::size_t>(count), std::vector<double>(count), std::vector<double>(count)};
    convertPlaces(area, places, all.column, all.row);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double column = inTurn(area.mosaic, all.column[i]);
        if (!isOnGrid(area.mosaic, column, all.row[i])) continue;
        all.index[kept] = i;
        all.column[kept] = column;
        all.row[kept] = all.row[i];
        ++kept;
    }
    all.index.resize(kept);
    all.column.resize(kept);
    all.row.resize(kept);
    keepPlacesOnTiles(area.mosaic, all);
    return all;
}

Result<void> fillFrom(const RasterArea& area, const PiecePlaces& places, const PlacesOnGrid& onGrid,
                      std::span<float> heightsM) {
    const std::vector<SampleDensity> densities = densitiesFor(area, places, onGrid.index);
    // Most places of a grid that is finer than the raster's take this short way to the same heights.
    const bool isStretched = std::ranges::any_of(densities, [&](const SampleDensity& density) {
        return stretchOf(density.columnsPerRad, places.spacingRad()) > 1 ||
               stretchOf(density.rowsPerRad, places.spacingRad()) > 1;
    });
    if (!isStretched && area.mosaic.period() == 0) {
        const GridRect taps = tapsAround(onGrid, heightsM);
        if (taps.columns == 0) return {};
        if (taps.columns * taps.rows <= mostRegionSamples)
            return fillUnstretched(area.mosaic, onGrid, taps, heightsM);
    }
    for (const auto& [region, positions] : positionsOf(area, places, onGrid, densities, heightsM))
        TRY(fillPositions(area.mosaic, region.reduction, positions, heightsM));
    return {};
}

namespace {

// The height at a place between four samples, some of which may have none, and their share of the weights.
struct PartlyKnown {
    double heightM = 0;
    double share = 0;  // [0, 1]
};

Result<PartlyKnown> betweenFour(const RasterMosaic& mosaic, int halvings, double column, double row) {
    const double x = std::ldexp(column + 0.5, -halvings) - 0.5;
    const double y = std::ldexp(row + 0.5, -halvings) - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    std::array<float, 4> four{};
    TRY(mosaic.read({halvings, halvings},
                    {static_cast<std::int64_t>(left), static_cast<std::int64_t>(top), 2, 2}, four));
    const std::array<double, 2> across = {1 - (x - left), x - left};
    const std::array<double, 2> down = {1 - (y - top), y - top};
    PartlyKnown known;
    for (std::size_t i = 0; i < four.size(); ++i) {
        if (std::isnan(four[i])) continue;
        const double weight = across[i % 2] * down[i / 2];
        known.share += weight;
        known.heightM += weight * static_cast<double>(four[i]);
    }
    if (known.share > 0) known.heightM /= known.share;
    return known;
}

}  // namespace

Result<void> fillVoids(const RasterArea& area, const PlacesOnGrid& onGrid, std::span<float> heightsM) {
    const GridRect& bounds = area.mosaic.bounds();
    const int coarsest =
        static_cast<int>(std::ceil(std::log2(static_cast<double>(std::max(bounds.columns, bounds.rows)))));
    for (std::size_t i = 0; i < onGrid.index.size(); ++i) {
        float& height = heightsM[onGrid.index[i]];
        if (!std::isnan(height)) continue;
        double sum = 0;
        double remaining = 1;  // the share that coarser means decide
        double coarsestM = std::numeric_limits<double>::quiet_NaN();
        for (int halvings = 0; halvings <= coarsest && remaining > 1e-9; ++halvings) {
            TRY_ASSIGN(const auto known, betweenFour(area.mosaic, halvings, onGrid.column[i], onGrid.row[i]));
            if (known.share <= 0) continue;
            coarsestM = known.heightM;
            sum += remaining * known.share * known.heightM;
            remaining *= 1 - known.share;
        }
        height = static_cast<float>(sum + remaining * coarsestM);
    }
    return {};
}

}  // namespace planet
