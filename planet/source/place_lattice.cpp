#include "planet/source/place_lattice.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "planet/base/cpu_clones.h"
#include "planet/source/height_geographic.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

namespace {

constexpr int leastPlacesApart = 4;  // places of the filter's grid between points of a lattice
// The spacing of a lattice is this share of the square root of samplesPerRad, in samples: most projections bend by less
// than 0.02 samples from point to point then, and what a parabola leaves of that is a small part.
constexpr double spacingShare = 0.1;

// Interpolates between three rows that follow one another.
PLANET_CPU_CLONES void interpolateRow(const double* rows, std::size_t count,
                                      const std::array<double, 3>& weights, double* __restrict out) {
    const double* const middle = rows + count;
    const double* const last = middle + count;
    const auto [first, second, third] = weights;
    for (std::size_t i = 0; i < count; ++i) out[i] = first * rows[i] + second * middle[i] + third * last[i];
}

// The values of a function at the points of a lattice that surround a piece. Two by two cells are a group: parabolas go
// through its nine points, which also show how much the function bends over it.
class Lattice {
public:
    Lattice(const SampleTile& piece, int cells, const PlaceFunction& function)
        : groupLog2_(std::countr_zero(static_cast<unsigned>(2 * (piece.faceCells / cells)))),
          firstGroupColumn_(piece.firstColumn >> groupLog2_),
          firstGroupRow_(piece.firstRow >> groupLog2_) {
        const auto groupsTo = [&](int first, int count, int firstGroup) {
            const int last = std::min((first + count - 1) >> groupLog2_, cells / 2 - 1);
            return static_cast<std::size_t>(std::max(last - firstGroup + 1, 1));
        };
        groupColumns_ = groupsTo(piece.firstColumn, piece.columns, firstGroupColumn_);
        groupRows_ = groupsTo(piece.firstRow, piece.rows, firstGroupRow_);
        // A piece may begin on the far edge of its face.
        firstGroupColumn_ = std::min(firstGroupColumn_, cells / 2 - 1);
        firstGroupRow_ = std::min(firstGroupRow_, cells / 2 - 1);
        width_ = 2 * groupColumns_ + 1;
        const std::size_t height = 2 * groupRows_ + 1;
        std::vector<double> longitudes(width_ * height);
        std::vector<double> latitudes(width_ * height);
        std::vector<double> ring(width_);
        const GeographicColumns grid(piece.face, cells, 2 * firstGroupColumn_, static_cast<int>(width_));
        for (std::size_t row = 0; row < height; ++row) {
            grid.placesOfRow(2 * firstGroupRow_ + static_cast<int>(row),
                             {std::span(longitudes).subspan(row * width_, width_),
                              std::span(latitudes).subspan(row * width_, width_), ring});
        }
        for (std::vector<double>& values : values_) values.resize(width_ * height);
        function(longitudes, latitudes, values_[0], values_[1]);
    }

    // Returns which groups, row by row, bend so little that their places are interpolated.
    std::vector<std::uint8_t> evenGroups(double mostBend) const {
        std::vector<std::uint8_t> even;
        for (std::size_t row = 0; row < groupRows_; ++row) {
            for (std::size_t column = 0; column < groupColumns_; ++column)
                even.push_back(bend(2 * column, 2 * row) <= mostBend ? 1 : 0);  // false for NaN
        }
        return even;
    }

    std::size_t groupOf(int column, int row) const {
        return static_cast<std::size_t>((row >> groupLog2_) - firstGroupRow_) * groupColumns_ +
               static_cast<std::size_t>((column >> groupLog2_) - firstGroupColumn_);
    }

    // Interpolates a value, 0 or 1, at all places of the piece, row by row, between the points of their groups. On a point
    // of the lattice, it is that point's value. Parabolas go along the rows of the lattice first, because many rows of
    // the piece lie between two of those.
    void interpolate(std::size_t value, const SampleTile& piece, std::span<double> out) const {
        const auto columns = static_cast<std::size_t>(piece.columns);
        const std::size_t latticeRows = 2 * groupRows_ + 1;
        std::vector<double> across(latticeRows * columns);
        for (std::size_t column = 0; column < columns; ++column) {
            const int onFace = piece.firstColumn + static_cast<int>(column);
            const std::array<double, 3> weights = weightsAt(shareOf(onFace));
            const double* from = &values_[value][2 * groupAlong(onFace, firstGroupColumn_, groupColumns_)];
            for (std::size_t row = 0; row < latticeRows; ++row, from += width_)
                across[row * columns + column] =
                    weights[0] * from[0] + weights[1] * from[1] + weights[2] * from[2];
        }
        for (std::size_t row = 0; row < static_cast<std::size_t>(piece.rows); ++row) {
            const int onFace = piece.firstRow + static_cast<int>(row);
            const std::size_t top = 2 * groupAlong(onFace, firstGroupRow_, groupRows_);
            interpolateRow(&across[top * columns], columns, weightsAt(shareOf(onFace)), &out[row * columns]);
        }
    }

private:
    // Returns the group of a column or row of the face's grid. The far edge of the face belongs to the last one.
    std::size_t groupAlong(int along, int firstGroup, std::size_t groups) const {
        return std::min(static_cast<std::size_t>((along >> groupLog2_) - firstGroup), groups - 1);
    }

    // Returns where a column or row of the face's grid lies in its group, [0, 1).
    double shareOf(int along) const {
        const int perGroup = 1 << groupLog2_;
        return static_cast<double>(along & (perGroup - 1)) / perGroup;
    }

    // Returns the weights of a parabola's points at 0, 1/2 and 1.
    static std::array<double, 3> weightsAt(double t) {
        return {(2 * t - 1) * (t - 1), 4 * t * (1 - t), t * (2 * t - 1)};
    }

    // Returns the largest distance of a value at the points within a group from the plane through its corners.
    double bend(std::size_t column, std::size_t row) const {
        double most = 0;
        for (const std::vector<double>& values : values_) {
            const auto point = [&](std::size_t x, std::size_t y) {
                return values[(row + y) * width_ + column + x];
            };
            const double top = (point(0, 0) + point(2, 0)) / 2;
            const double bottom = (point(0, 2) + point(2, 2)) / 2;
            for (const double off :
                 {point(1, 0) - top, point(1, 2) - bottom, point(0, 1) - (point(0, 0) + point(0, 2)) / 2,
                  point(2, 1) - (point(2, 0) + point(2, 2)) / 2, point(1, 1) - (top + bottom) / 2}) {
                if (!std::isfinite(off)) return off * 0;  // NaN
                most = std::max(most, std::abs(off));
            }
        }
        return most;
    }

    int groupLog2_;  // of the grid's cells along a group
    int firstGroupColumn_;
    int firstGroupRow_;
    std::size_t groupColumns_ = 0;
    std::size_t groupRows_ = 0;
    std::size_t width_ = 0;  // points
    std::array<std::vector<double>, 2> values_;
};

// Computes the function at single places of a piece.
void atPlaces(const PiecePlaces& places, std::span<const std::size_t> wanted, const PlaceFunction& function,
              std::span<double> first, std::span<double> second) {
    if (wanted.empty()) return;
    const std::size_t count = wanted.size();
    std::vector<double> values(4 * count);
    const std::span all(values);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = places.geographic().longitudeRad[wanted[i]];
        values[count + i] = places.geographic().latitudeRad[wanted[i]];
    }
    function(all.first(count), all.subspan(count, count), all.subspan(2 * count, count), all.last(count));
    for (std::size_t i = 0; i < count; ++i) {
        first[wanted[i]] = values[2 * count + i];
        second[wanted[i]] = values[3 * count + i];
    }
}

}  // namespace

int latticeCellsFor(int filterCells, double samplesPerRad) {
    if (!(samplesPerRad > 1)) return 0;
    const double spacingRad = spacingShare / std::sqrt(samplesPerRad);
    const int cells = std::max(powerOfTwoCells(std::numbers::pi / 2 / spacingRad), 2);
    return cells <= filterCells / leastPlacesApart ? cells : 0;
}

void overPiece(const PiecePlaces& places, std::span<const std::size_t> wanted, int latticeCells,
               double mostBend, const PlaceFunction& function, std::span<double> first,
               std::span<double> second) {
    const std::optional<SampleTile>& tile = places.tile();
    // All places of a grid that is no finer than the lattice are points of it.
    if (!tile || latticeCells <= 0 || tile->faceCells <= latticeCells || wanted.empty())
        return atPlaces(places, wanted, function, first, second);
    const Lattice lattice(*tile, latticeCells, function);
    const std::vector<std::uint8_t> even = lattice.evenGroups(mostBend);
    lattice.interpolate(0, *tile, first);
    lattice.interpolate(1, *tile, second);
    // On the edges of the cube, the lattices of two faces meet, which may not agree on what is even.
    const int lastColumn = tile->firstColumn + tile->columns - 1;
    const int lastRow = tile->firstRow + tile->rows - 1;
    const bool meetsEdge = tile->firstColumn == 0 || tile->firstRow == 0 || lastColumn == tile->faceCells ||
                           lastRow == tile->faceCells;
    if (!meetsEdge && std::ranges::all_of(even, [](std::uint8_t isEven) { return isEven != 0; })) return;
    const auto width = static_cast<std::size_t>(tile->columns);
    std::vector<std::size_t> single;
    for (const std::size_t place : wanted) {
        const int column = tile->firstColumn + static_cast<int>(place % width);
        const int row = tile->firstRow + static_cast<int>(place / width);
        const bool onEdge = column == 0 || row == 0 || column == tile->faceCells || row == tile->faceCells;
        if (onEdge || even[lattice.groupOf(column, row)] == 0) single.push_back(place);
    }
    atPlaces(places, single, function, first, second);
}

}  // namespace planet
