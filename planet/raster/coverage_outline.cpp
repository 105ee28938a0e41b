#include "planet/raster/coverage_outline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>

#include "planet/raster/raster_mosaic.h"

namespace planet {

namespace {

constexpr std::size_t mostCells = 4u << 20;

// A corner of the outline, in samples: the sample (column, row) lies to the right of it and below.
struct Corner {
    std::int64_t column = 0;
    std::int64_t row = 0;

    bool operator==(const Corner&) const = default;
};
using Loop = std::vector<Corner>;

// The rows and columns at which tiles begin and end cut the grid into cells, each of which is covered or not.
struct Cells {
    std::vector<std::int64_t> columns;  // ascending; one more than there are cells in a row
    std::vector<std::int64_t> rows;
    std::vector<std::uint8_t> covered;

    std::size_t across() const { return columns.size() - 1; }
    std::size_t down() const { return rows.size() - 1; }
    bool isCovered(std::size_t x, std::size_t y) const {
        return x < across() && y < down() && covered[y * across() + x] != 0;  // -1 wraps to beyond the end
    }
};

void sortUniquely(std::vector<std::int64_t>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::size_t indexIn(const std::vector<std::int64_t>& sorted, std::int64_t value) {
    return static_cast<std::size_t>(std::ranges::lower_bound(sorted, value) - sorted.begin());
}

Cells cellsOf(const RasterMosaic& mosaic) {
    Cells cells;
    const auto cut = [&](const GridRect& rect) {
        cells.columns.insert(cells.columns.end(), {rect.column, rect.column + rect.columns});
        cells.rows.insert(cells.rows.end(), {rect.row, rect.row + rect.rows});
    };
    for (const RasterMosaic::Tile& tile : mosaic.tiles()) cut(tile.rect);
    sortUniquely(cells.columns);
    sortUniquely(cells.rows);
    const bool tooMany = cells.across() * cells.down() > mostCells;
    if (tooMany) {  // the rectangle around all tiles stands for them
        cells.columns.clear();
        cells.rows.clear();
        cut(mosaic.bounds());
    }
    cells.covered.assign(cells.across() * cells.down(), tooMany ? 1 : 0);
    for (const RasterMosaic::Tile& tile : mosaic.tiles()) {
        if (tooMany) break;
        const std::size_t left = indexIn(cells.columns, tile.rect.column);
        const std::size_t right = indexIn(cells.columns, tile.rect.column + tile.rect.columns);
        const std::size_t bottom = indexIn(cells.rows, tile.rect.row + tile.rect.rows);
        for (std::size_t y = indexIn(cells.rows, tile.rect.row); y < bottom; ++y)
            std::fill_n(cells.covered.begin() + static_cast<std::ptrdiff_t>(y * cells.across() + left),
                        right - left, 1);
    }
    return cells;
}

// Sides between a cell that is covered and one that is not, with the covered one to the right. At most two begin at a
// corner; corners are numbered row by row.
class Sides {
public:
    explicit Sides(const Cells& cells)
        : across_(cells.across() + 1), ends_(2 * across_ * (cells.down() + 1), none) {
        for (std::size_t y = 0; y < cells.down(); ++y) {
            for (std::size_t x = 0; x < cells.across(); ++x) {
                if (!cells.isCovered(x, y)) continue;
                if (!cells.isCovered(x, y - 1)) add(corner(x, y), corner(x + 1, y));
                if (!cells.isCovered(x + 1, y)) add(corner(x + 1, y), corner(x + 1, y + 1));
                if (!cells.isCovered(x, y + 1)) add(corner(x + 1, y + 1), corner(x, y + 1));
                if (!cells.isCovered(x - 1, y)) add(corner(x, y + 1), corner(x, y));
            }
        }
    }

    std::size_t corners() const { return ends_.size() / 2; }
    // Removes a side that begins at a corner, and returns its end; none if there is no side.
    std::size_t take(std::size_t from) {
        std::size_t& first = ends_[2 * from];
        std::size_t& second = ends_[2 * from + 1];
        return std::exchange(second != none ? second : first, none);
    }
    std::size_t columnOf(std::size_t at) const { return at % across_; }
    std::size_t rowOf(std::size_t at) const { return at / across_; }

    static constexpr std::size_t none = ~std::size_t{0};

private:
    std::size_t corner(std::size_t x, std::size_t y) const { return y * across_ + x; }
    void add(std::size_t from, std::size_t to) {
        ends_[ends_[2 * from] == none ? 2 * from : 2 * from + 1] = to;
    }

    std::size_t across_;
    std::vector<std::size_t> ends_;
};

bool onOneLine(const Corner& a, const Corner& b, const Corner& c) {
    return (a.column == b.column && b.column == c.column) || (a.row == b.row && b.row == c.row);
}

// Returns the closed lines around the covered cells, without corners in the middle of a side.
std::vector<Loop> loopsAround(const Cells& cells) {
    Sides sides(cells);
    std::vector<Loop> loops;
    for (std::size_t start = 0; start < sides.corners(); ++start) {
        for (std::size_t at = sides.take(start); at != Sides::none; at = sides.take(start)) {
            const auto cornerAt = [&](std::size_t i) {
                return Corner{cells.columns[sides.columnOf(i)], cells.rows[sides.rowOf(i)]};
            };
            Loop loop{cornerAt(start)};
            for (; at != start; at = sides.take(at)) {
                if (loop.size() > 1 && onOneLine(loop[loop.size() - 2], loop.back(), cornerAt(at)))
                    loop.back() = cornerAt(at);
                else
                    loop.push_back(cornerAt(at));
            }
            if (onOneLine(loop[loop.size() - 2], loop.back(), loop.front())) loop.pop_back();
            loops.push_back(std::move(loop));
        }
    }
    return loops;
}

double lengthOf(const Loop& loop) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Corner& to = loop[(i + 1) % loop.size()];
        length += std::hypot(static_cast<double>(to.column - loop[i].column),
                             static_cast<double>(to.row - loop[i].row));
    }
    return length;
}

// Keeps every n-th corner.
void thinOut(Loop& loop, std::size_t n) {
    if (loop.size() < 4 * n) return;
    Loop kept;
    for (std::size_t i = 0; i < loop.size(); i += n) kept.push_back(loop[i]);
    loop = std::move(kept);
}

// Returns the line on the planet, with points at most `apart` samples from one another.
Outline onPlanet(const RasterPlacement& placement, const Loop& loop, double apart) {
    std::vector<double> columns;
    std::vector<double> rows;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Corner& from = loop[i];
        const Corner& to = loop[(i + 1) % loop.size()];
        const auto right = static_cast<double>(to.column - from.column);
        const auto down = static_cast<double>(to.row - from.row);
        const auto parts =
            std::max<std::int64_t>(1, std::llround(std::ceil(std::hypot(right, down) / apart)));
        for (std::int64_t part = 0; part < parts; ++part) {
            const double share = static_cast<double>(part) / static_cast<double>(parts);
            columns.push_back(static_cast<double>(from.column) - 0.5 + right * share);
            rows.push_back(static_cast<double>(from.row) - 0.5 + down * share);
        }
    }
    std::vector<double> longitudes(columns.size());
    std::vector<double> latitudes(columns.size());
    placement.toPlanet(columns, rows, longitudes, latitudes);
    Outline outline;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const double latitude = std::clamp(latitudes[i], -std::numbers::pi / 2, std::numbers::pi / 2);
        if (std::isfinite(longitudes[i]) && std::isfinite(latitudes[i]))
            outline.push_back({latitude, longitudes[i]});
    }
    if (!outline.empty()) outline.push_back(outline.front());
    return outline;
}

// Returns whether one rectangle goes once around the planet and from pole to pole.
bool coversAll(const RasterMosaic& mosaic, const std::vector<Loop>& loops) {
    const RasterPlacement& placement = mosaic.placement();
    if (placement.columnsAround() <= 0 || loops.size() != 1 || loops[0].size() != 4) return false;
    const GridRect& bounds = mosaic.bounds();
    const double top = std::min(placement.northRow(), placement.southRow());
    const double bottom = std::max(placement.northRow(), placement.southRow());
    // Rows of points lie on the poles, rows of pixels half a row from them.
    constexpr double rowsOff = 0.75;
    return static_cast<double>(bounds.columns) > placement.columnsAround() - 0.5 &&
           static_cast<double>(bounds.row)<top + rowsOff&& static_cast<double>(bounds.row + bounds.rows - 1)>
                   bottom - rowsOff;
}

}  // namespace

CoverageOutline outlineOf(const RasterMosaic& mosaic, std::size_t mostLines, std::size_t mostPoints) {
    std::vector<Loop> loops = loopsAround(cellsOf(mosaic));
    if (coversAll(mosaic, loops)) return {{}, true};
    std::ranges::stable_sort(loops, std::greater(), lengthOf);
    if (loops.size() > mostLines) loops.resize(mostLines);
    std::size_t corners = 0;
    double length = 0;
    for (const Loop& loop : loops) {
        corners += loop.size();
        length += lengthOf(loop);
    }
    const std::size_t half = mostPoints / 2;
    CoverageOutline outline;
    for (Loop& loop : loops) {
        if (corners > half) thinOut(loop, (corners + half - 1) / half);
        Outline line = onPlanet(mosaic.placement(), loop, length / static_cast<double>(half));
        if (line.size() > 2) outline.lines.push_back(std::move(line));
    }
    return outline;
}

}  // namespace planet
