#include "planet/raster/raster_mosaic.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "planet/base/cpu_clones.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr double offGrid = 0.01;           // samples by which a raster of a grid may lie off it
constexpr std::int64_t reducedSide = 128;  // samples per side of a cached block of a reduced resolution
constexpr int mostHalvings = 2 * 22;       // of both axes together
// A piece of a coarse planet reaches over several blocks, and each takes thousands of samples to make again.
constexpr std::size_t leastReducedBytes =
    24 * reducedSide * reducedSide * sizeof(float);  // cached of a resolution
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

std::int64_t floorDivided(std::int64_t value, std::int64_t by) {
    return value / by - (value % by < 0 ? 1 : 0);
}

GridRect spannedBy(const GridRect& a, const GridRect& b) {
    const std::int64_t column = std::min(a.column, b.column);
    const std::int64_t row = std::min(a.row, b.row);
    return {column, row, std::max(a.column + a.columns, b.column + b.columns) - column,
            std::max(a.row + a.rows, b.row + b.rows) - row};
}

bool isEmpty(const GridRect& rect) {
    return rect.columns <= 0 || rect.rows <= 0;
}

std::size_t countOf(const GridRect& rect) {
    return static_cast<std::size_t>(rect.columns * rect.rows);
}

std::size_t indexIn(const GridRect& rect, std::int64_t column, std::int64_t row) {
    return static_cast<std::size_t>((row - rect.row) * rect.columns + column - rect.column);
}

PLANET_CPU_CLONES void copyRowHeights(const float* from, std::size_t count, float* __restrict out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = std::isnan(from[i]) ? out[i] : from[i];
}

// Copies the samples that have a height from one rectangle to another.
void copyHeights(const GridRect& from, std::span<const float> samples, const GridRect& to,
                 std::span<float> out) {
    const GridRect both = sharedBy(from, to);
    if (isEmpty(both)) return;
    for (std::int64_t row = both.row; row < both.row + both.rows; ++row)
        copyRowHeights(&samples[indexIn(from, both.column, row)], static_cast<std::size_t>(both.columns),
                       &out[indexIn(to, both.column, row)]);
}

float meanOf(float a, float b) {
    if (std::isnan(a)) return b;
    return std::isnan(b) ? a : a + (b - a) / 2;
}

// Returns the position of a raster's sample on the grid of another.
std::pair<double, double> positionOn(const RasterLayout& grid, const RasterLayout& raster, int column,
                                     int row) {
    const double area = grid.x[1] * grid.y[2] - grid.x[2] * grid.y[1];
    const double dx = raster.x[0] + raster.x[1] * column + raster.x[2] * row - grid.x[0];
    const double dy = raster.y[0] + raster.y[1] * column + raster.y[2] * row - grid.y[0];
    return {(dx * grid.y[2] - dy * grid.x[2]) / area, (dy * grid.x[1] - dx * grid.y[1]) / area};
}

// Returns whether the samples of two rasters lie on one grid.
bool onOneGrid(const RasterLayout& grid, const RasterLayout& raster) {
    if (grid.crs != raster.crs) return false;
    const auto [left, top] = positionOn(grid, raster, 0, 0);
    const double column = std::round(left);
    const double row = std::round(top);
    if (!(std::abs(column) < 1e9 && std::abs(row) < 1e9)) return false;
    const int lastColumn = raster.width - 1;
    const int lastRow = raster.height - 1;
    return std::ranges::all_of(std::array{std::pair(0, 0), std::pair(lastColumn, 0), std::pair(0, lastRow)},
                               [&](const std::pair<int, int>& corner) {
                                   const auto at = positionOn(grid, raster, corner.first, corner.second);
                                   return std::abs(at.first - column - corner.first) < offGrid &&
                                          std::abs(at.second - row - corner.second) < offGrid;
                               });
}

using RasterPtr = std::shared_ptr<const Raster>;

// Returns the rasters of each grid, in the order of their first ones.
std::vector<std::vector<RasterPtr>> sortedByGrid(const std::vector<RasterPtr>& rasters) {
    std::vector<std::vector<RasterPtr>> grids;
    for (const RasterPtr& raster : rasters) {
        const auto grid = std::ranges::find_if(
            grids, [&](const auto& others) { return onOneGrid(others[0]->layout(), raster->layout()); });
        if (grid != grids.end()) {
            grid->push_back(raster);
        } else {
            grids.push_back({raster});
        }
    }
    return grids;
}

// Returns the raster from whose first sample the grid is counted: the topmost one, and of those the leftmost. It does
// not depend on their order, so that positions on the grid are rounded alike in any order.
const Raster& firstOnGrid(const std::vector<RasterPtr>& rasters) {
    return **std::ranges::min_element(rasters, {}, [&](const RasterPtr& raster) {
        const auto [column, row] = positionOn(rasters[0]->layout(), raster->layout(), 0, 0);
        return std::pair(std::llround(row), std::llround(column));
    });
}

}  // namespace

MosaicCache::MosaicCache(std::size_t bytes) {
    byHalvings_.emplace_back([this, bytes] {
        std::size_t reduced = 0;
        for (std::size_t i = 1; i < byHalvings_.size(); ++i) reduced += byHalvings_[i].bytes();
        return std::max(bytes / 3, bytes - std::min(reduced, bytes));
    });
    for (int halvings = 1; halvings <= mostHalvings; ++halvings)
        byHalvings_.emplace_back(std::max(leastReducedBytes, (bytes / 3) >> halvings));
}

HeightBlockCache& MosaicCache::of(const GridReduction& reduction) {
    return byHalvings_[static_cast<std::size_t>(reduction.columnsLog2 + reduction.rowsLog2)];
}

RasterMosaic::RasterMosaic(const Raster& first, RasterPlacement placement, std::shared_ptr<MosaicCache> cache)
    : placement_(std::move(placement)),
      layout_(first.layout()),
      cache_(std::move(cache)),
      number_(cache_->newNumber()) {
    const double around = placement_.columnsAround();
    // A header that lies can put the poles where the rows do not fit in integers.
    const double farthest =
        placement_.isGeographic()
            ? std::max({around, std::abs(placement_.northRow()), std::abs(placement_.southRow())})
            : around;
    if (around >= 1 && farthest < 1e9 && std::abs(around - std::round(around)) < offGrid)
        period_ = std::llround(around);
}

Result<std::vector<RasterMosaic>> RasterMosaic::join(const std::vector<RasterPtr>& rasters,
                                                     const std::shared_ptr<MosaicCache>& cache) {
    std::vector<RasterMosaic> mosaics;
    for (const std::vector<RasterPtr>& grid : sortedByGrid(rasters)) {
        const Raster& first = firstOnGrid(grid);
        const RasterLayout& layout = first.layout();
        TRY_ASSIGN(auto placement,
                   RasterPlacement::make(first.path().string(), {layout.x, layout.y, layout.crs}));
        RasterMosaic mosaic(first, std::move(placement), cache);
        for (const RasterPtr& raster : grid) mosaic.add(raster);
        mosaic.sortIntoBands();
        mosaics.push_back(std::move(mosaic));
    }
    return mosaics;
}

void RasterMosaic::add(const RasterPtr& raster) {
    const auto [column, row] = positionOn(layout_, raster->layout(), 0, 0);
    GridRect rect{std::llround(column), std::llround(row), raster->layout().width, raster->layout().height};
    // The turn is chosen that brings the raster nearest to the first one.
    if (period_ > 0) rect.column -= floorDivided(rect.column + period_ / 2, period_) * period_;
    tiles_.push_back({raster, rect});
    bounds_ = tiles_.size() == 1 ? rect : spannedBy(bounds_, rect);
}

void RasterMosaic::sortIntoBands() {
    for (const Tile& tile : tiles_) bandRows_ = std::max(bandRows_, tile.rect.rows);
    bands_.resize(static_cast<std::size_t>((bounds_.rows + bandRows_ - 1) / bandRows_));
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
        const GridRect& rect = tiles_[tile].rect;
        const std::int64_t last = (rect.row + rect.rows - 1 - bounds_.row) / bandRows_;
        for (std::int64_t band = (rect.row - bounds_.row) / bandRows_; band <= last; ++band)
            bands_[static_cast<std::size_t>(band)].push_back(tile);
    }
}

Result<std::vector<float>> RasterMosaic::readBlock(std::size_t tile, int blockX, int blockY) const {
    const Raster& raster = *tiles_[tile].raster;
    TRY_ASSIGN(auto heights, raster.readBlock(blockX, blockY));
    if (!raster.samplesRead()) *samplesRead_ += heights.size();
    return heights;
}

std::uint64_t RasterMosaic::samplesRead() const {
    std::uint64_t samples = *samplesRead_;
    for (const Tile& tile : tiles_) samples += tile.raster->samplesRead().value_or(0);
    return samples;
}

// Copies the samples of a tile that lie in a rectangle. `rect` is the tile's place, and `target` the rectangle of
// `out`, in the same turn.
Result<void> RasterMosaic::readTile(std::size_t tile, const GridRect& rect, const GridRect& target,
                                    std::span<float> out) const {
    const GridRect wanted = sharedBy(rect, target);
    const Raster& raster = *tiles_[tile].raster;
    const std::int64_t width = raster.layout().blockWidth;
    const std::int64_t height = raster.layout().blockHeight;
    const std::uint64_t key = (static_cast<std::uint64_t>(number_) << 32) | tile;
    for (std::int64_t y = (wanted.row - rect.row) / height; y * height < wanted.row + wanted.rows - rect.row;
         ++y) {
        for (std::int64_t x = (wanted.column - rect.column) / width;
             x * width < wanted.column + wanted.columns - rect.column; ++x) {
            const int blockX = static_cast<int>(x);
            const int blockY = static_cast<int>(y);
            TRY_ASSIGN(const auto block, cache_->of({}).get({key, blockX, blockY},
                                                            [&] { return readBlock(tile, blockX, blockY); }));
            const GridRect blockRect{rect.column + x * width, rect.row + y * height,
                                     std::min(width, rect.columns - x * width),
                                     std::min(height, rect.rows - y * height)};
            copyHeights(blockRect, *block, target, out);
        }
    }
    return {};
}

// Calls visit(tile, place) for each tile that touches a rectangle, in each turn in which it does, with its place
// in that turn. Tiles come in ascending order. Stops at the first Error.
template <class Visit>
Result<void> RasterMosaic::forTilesIn(const GridRect& rect, const Visit& visit) const {
    const GridRect rows = sharedBy(rect, {rect.column, bounds_.row, rect.columns, bounds_.rows});
    if (isEmpty(rows)) return {};
    std::vector<std::size_t> candidates;
    const std::int64_t lastBand = (rows.row + rows.rows - 1 - bounds_.row) / bandRows_;
    for (std::int64_t band = (rows.row - bounds_.row) / bandRows_; band <= lastBand; ++band) {
        const auto& inBand = bands_[static_cast<std::size_t>(band)];
        candidates.insert(candidates.end(), inBand.begin(), inBand.end());
    }
    std::ranges::sort(candidates);
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    for (const std::size_t tile : candidates) {
        GridRect place = tiles_[tile].rect;
        if (period_ > 0)
            place.column -= floorDivided(place.column + place.columns - 1 - rect.column, period_) * period_;
        do {
            if (!isEmpty(sharedBy(place, rect))) TRY(visit(tile, place));
            place.column += period_;
        } while (period_ > 0 && place.column < rect.column + rect.columns);
    }
    return {};
}

// Returns whether a rectangle touches a tile, perhaps beyond a pole.
bool RasterMosaic::mayHaveHeightsIn(const GridRect& rect) const {
    bool found = false;
    const auto visit = [&](std::size_t, const GridRect&) -> Result<void> {
        found = true;
        return {};
    };
    const auto touches = [&](const GridRect& part) { return forTilesIn(part, visit) && found; };
    const auto beyond = [&](double pole) {
        return GridRect{rect.column + period_ / 2, std::llround(2 * pole) - (rect.row + rect.rows - 1),
                        rect.columns, rect.rows};
    };
    if (touches(rect)) return true;
    if (period_ == 0) return false;
    const double firstPole = std::min(placement_.northRow(), placement_.southRow());
    const double lastPole = std::max(placement_.northRow(), placement_.southRow());
    return (static_cast<double>(rect.row) < firstPole && touches(beyond(firstPole))) ||
           (static_cast<double>(rect.row + rect.rows - 1) > lastPole && touches(beyond(lastPole)));
}

// Reads samples between the poles.
Result<void> RasterMosaic::readTiles(const GridRect& rect, std::span<float> out) const {
    return forTilesIn(
        rect, [&](std::size_t tile, const GridRect& place) { return readTile(tile, place, rect, out); });
}

// Reads samples of the full resolution, also beyond the poles.
Result<void> RasterMosaic::readSamples(const GridRect& rect, std::span<float> out) const {
    const double firstPole = std::min(placement_.northRow(), placement_.southRow());
    const double lastPole = std::max(placement_.northRow(), placement_.southRow());
    const bool foldsBack = period_ > 0 && period_ % 2 == 0 && placement_.isGeographic();
    const std::int64_t end = rect.row + rect.rows;
    for (std::int64_t row = rect.row; row < end;) {
        const double pole = static_cast<double>(row) < firstPole ? firstPole : lastPole;
        const bool beyond =
            foldsBack && (static_cast<double>(row) < firstPole || static_cast<double>(row) > lastPole);
        std::int64_t rows = beyond ? 1 : end - row;
        if (foldsBack && !beyond)
            rows = std::min(rows, static_cast<std::int64_t>(std::floor(lastPole)) + 1 - row);
        const std::span part =
            out.subspan(indexIn(rect, rect.column, row), static_cast<std::size_t>(rows * rect.columns));
        const std::int64_t from = beyond ? std::llround(2 * pole) - row : row;
        TRY(readTiles({rect.column + (beyond ? period_ / 2 : 0), from, rect.columns, rows}, part));
        row += rows;
    }
    return {};
}

std::vector<GridRect> RasterMosaic::tilesIn(const GridRect& rect) const {
    std::vector<GridRect> places;
    const Result<void> visited = forTilesIn(rect, [&](std::size_t, const GridRect& place) -> Result<void> {
        places.push_back(place);
        return {};
    });
    assert(visited);
    static_cast<void>(visited);
    return places;
}

void RasterMosaic::markTiles(const GridRect& rect, std::span<float> out) const {
    assert(out.size() == countOf(rect));
    std::ranges::fill(out, missing);
    const auto mark = [&](const GridRect& part) {
        for (std::int64_t row = part.row; row < part.row + part.rows; ++row)
            std::fill_n(&out[indexIn(rect, part.column, row)], part.columns, 0.0f);
    };
    for (const GridRect& place : tilesIn(rect)) mark(sharedBy(place, rect));
    if (period_ == 0) return;
    const double firstPole = std::min(placement_.northRow(), placement_.southRow());
    const double lastPole = std::max(placement_.northRow(), placement_.southRow());
    for (std::int64_t row = rect.row; row < rect.row + rect.rows; ++row) {
        if (static_cast<double>(row) < firstPole || static_cast<double>(row) > lastPole)
            mark({rect.column, row, rect.columns, 1});
    }
}

// Returns a block of a reduced resolution as the means of pairs of the next finer one, along the axis that is
// reduced more.
Result<std::vector<float>> RasterMosaic::reducedBlock(GridReduction reduction, std::int64_t blockX,
                                                      std::int64_t blockY) const {
    const bool across = reduction.columnsLog2 >= reduction.rowsLog2;
    GridReduction finer = reduction;
    GridRect rect{blockX * reducedSide, blockY * reducedSide, reducedSide, reducedSide};
    if (across) {
        --finer.columnsLog2;
        rect.column *= 2;
        rect.columns *= 2;
    } else {
        --finer.rowsLog2;
        rect.row *= 2;
        rect.rows *= 2;
    }
    std::vector<float> samples(countOf(rect));
    TRY(read(finer, rect, samples));
    std::vector<float> means(static_cast<std::size_t>(reducedSide * reducedSide));
    const std::size_t step = across ? 2 : 1;
    const auto next = across ? std::size_t{1} : static_cast<std::size_t>(rect.columns);
    for (std::size_t i = 0; i < means.size(); ++i) {
        const std::size_t row = i / reducedSide;
        const std::size_t first = across ? step * i : 2 * row * next + i % reducedSide;
        means[i] = meanOf(samples[first], samples[first + next]);
    }
    return means;
}

Result<void> RasterMosaic::read(GridReduction reduction, const GridRect& rect, std::span<float> out) const {
    assert(out.size() == countOf(rect));
    std::ranges::fill(out, missing);
    if (reduction == GridReduction{}) return readSamples(rect, out);
    const std::uint64_t key = (std::uint64_t{1} << 63) | (static_cast<std::uint64_t>(number_) << 32) |
                              (static_cast<std::uint64_t>(reduction.columnsLog2) << 8) |
                              static_cast<std::uint64_t>(reduction.rowsLog2);
    for (std::int64_t y = floorDivided(rect.row, reducedSide); y * reducedSide < rect.row + rect.rows; ++y) {
        for (std::int64_t x = floorDivided(rect.column, reducedSide);
             x * reducedSide < rect.column + rect.columns; ++x) {
            const GridRect full{x * reducedSide << reduction.columnsLog2,
                                y * reducedSide << reduction.rowsLog2, reducedSide << reduction.columnsLog2,
                                reducedSide << reduction.rowsLog2};
            if (!mayHaveHeightsIn(full)) continue;
            TRY_ASSIGN(
                const auto block,
                cache_->of(reduction).get({key, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)},
                                          [&] { return reducedBlock(reduction, x, y); }));
            copyHeights({x * reducedSide, y * reducedSide, reducedSide, reducedSide}, *block, rect, out);
        }
    }
    return {};
}

}  // namespace planet
