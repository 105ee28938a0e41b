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

#include "planet/source/height_geographic.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

namespace {

constexpr int leastPlacesApart = 4;  // places of the filter's grid between points of a lattice
// The spacing of a lattice is this share of the square root of samplesPerRad, in samples: most projections bend by less
// than 0.02 samples from point to point then, and what a parabola leaves of that is a small part.
constexpr double spacingShare = 0.1;

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
        for (std::size_t row = 0; row < height; ++row) {
            geographicRow(piece.face, cells, 2 * firstGroupColumn_,
                          2 * firstGroupRow_ + static_cast<int>(row),
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

    // Interpolates both values at a place of the face's grid between the points of its group. On a point of the lattice,
    // they are that point's values.
    std::array<double, 2> at(int column, int row) const {
        const int perGroup = 1 << groupLog2_;
        const auto left = static_cast<std::size_t>(2 * ((column >> groupLog2_) - firstGroupColumn_));
        const auto top = static_cast<std::size_t>(2 * ((row >> groupLog2_) - firstGroupRow_));
        const auto share = [&](int along) { return static_cast<double>(along & (perGroup - 1)) / perGroup; };
        const std::array<double, 3> across = weightsAt(share(column));
        const std::array<double, 3> down = weightsAt(share(row));
        std::array<double, 2> found{};
        for (std::size_t value = 0; value < 2; ++value) {
            const double* from = &values_[value][top * width_ + left];
            for (std::size_t j = 0; j < 3; ++j, from += width_)
                found[value] += down[j] * (across[0] * from[0] + across[1] * from[1] + across[2] * from[2]);
        }
        return found;
    }

private:
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
        values[i] = places.longitudeRad[wanted[i]];
        values[count + i] = places.latitudeRad[wanted[i]];
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
    const std::optional<SampleTile>& tile = places.tile;
    // All places of a grid that is no finer than the lattice are points of it.
    if (!tile || latticeCells <= 0 || tile->faceCells <= latticeCells || wanted.empty())
        return atPlaces(places, wanted, function, first, second);
    const Lattice lattice(*tile, latticeCells, function);
    const std::vector<std::uint8_t> even = lattice.evenGroups(mostBend);
    const auto width = static_cast<std::size_t>(tile->columns);
    std::vector<std::size_t> single;
    for (const std::size_t place : wanted) {
        const int column = tile->firstColumn + static_cast<int>(place % width);
        const int row = tile->firstRow + static_cast<int>(place / width);
        // On the edges of the cube, the lattices of two faces meet, which may not agree on what is even.
        const bool onEdge = column == 0 || row == 0 || column == tile->faceCells || row == tile->faceCells;
        if (onEdge || even[lattice.groupOf(column, row)] == 0) {
            single.push_back(place);
            continue;
        }
        const auto [one, other] = lattice.at(column, row);
        first[place] = one;
        second[place] = other;
    }
    atPlaces(places, single, function, first, second);
}

}  // namespace planet
