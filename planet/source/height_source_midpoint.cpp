// Midpoint displacement on the cube, from its eight corners down to any grid, for one rectangle at a time.
//
// The required samples are found from the finest grid upwards: each level needs its parent's samples around
// it and, at an edge of the cube, those of the next face's first cells. So each level has one rectangle per
// face. These are filled from the cube's corners downwards. Heights are integers, whose sums are exact in any
// order.
#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "planet/source/terrain_sources.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

namespace {

constexpr int fractionBits = 30;        // the first offsets lie within +-2^30
constexpr int measuredLevel = 6;        // level of the grid whose extremes are measured
constexpr int numberedLevel = 22;       // points of levels down to this are numbered on its grid
constexpr int midpointPieceSide = 129;  // samples per side, 133 kB

struct Midpoint {
    std::uint64_t seed = 0;
    // The largest offsets by level, of cells' middles and of edges' middles.
    std::array<std::int64_t, maxFaceCellsLog2 + 1> middle{};
    std::array<std::int64_t, maxFaceCellsLog2 + 1> edge{};
    double metres = 0;  // per unit of height
    double offsetM = 0;
    double minM = 0;
    double maxM = 0;
};

// Samples of a face's grid, both ends included.
struct Rect {
    int left = 0;
    int bottom = 0;
    int right = 0;
    int top = 0;

    void add(int column, int row) {
        left = std::min(left, column);
        bottom = std::min(bottom, row);
        right = std::max(right, column);
        top = std::max(top, row);
    }
};

// The rectangle of each face that a level needs.
using Needs = std::array<std::optional<Rect>, faceCount>;

std::optional<Rect>& of(Needs& needs, Face face) {
    return needs[static_cast<std::size_t>(face)];
}

void addTo(Needs& needs, Face face, int column, int row) {
    std::optional<Rect>& rect = of(needs, face);
    if (!rect) rect = Rect{column, row, column, row};
    rect->add(column, row);
}

// Adds the cells beyond an edge of a face, on the next face: the corner far from the edge and the one on it.
void addBeyond(Needs& needs, Face face, int farColumn, int farRow, int edgeColumn, int edgeRow, int cells) {
    const FaceGridPoint farPlace = foldedOver({face, farColumn, farRow}, cells);
    const FaceGridPoint edgePlace = placeOnFace(farPlace.face, {face, edgeColumn, edgeRow}, cells);
    addTo(needs, farPlace.face, farPlace.column, farPlace.row);
    addTo(needs, farPlace.face, edgePlace.column, edgePlace.row);
}

// Returns the samples that the next coarser level needs.
Needs parentsOf(const Needs& needs, int level) {
    const int half = 1 << (level - 1);
    Needs parents;
    for (const Face face : allFaces) {
        const std::optional<Rect>& rect = needs[static_cast<std::size_t>(face)];
        if (!rect) continue;
        // >> rounds down, also for negative numbers.
        const Rect wide{(rect->left - 1) >> 1, (rect->bottom - 1) >> 1, (rect->right + 2) >> 1,
                        (rect->top + 2) >> 1};
        const Rect own{std::max(wide.left, 0), std::max(wide.bottom, 0), std::min(wide.right, half),
                       std::min(wide.top, half)};
        addTo(parents, face, own.left, own.bottom);
        addTo(parents, face, own.right, own.top);
        for (const int row : {own.bottom, own.top}) {
            if (wide.left < 0) addBeyond(parents, face, -1, row, 0, row, half);
            if (wide.right > half) addBeyond(parents, face, half + 1, row, half, row, half);
        }
        for (const int column : {own.left, own.right}) {
            if (wide.bottom < 0) addBeyond(parents, face, column, -1, column, 0, half);
            if (wide.top > half) addBeyond(parents, face, column, half + 1, column, half, half);
        }
    }
    return parents;
}

struct Patch {
    Rect rect;
    std::vector<std::int64_t> heights;  // rows from the bottom up

    std::size_t indexOf(int column, int row) const {
        assert(column >= rect.left && column <= rect.right && row >= rect.bottom && row <= rect.top);
        const auto width = static_cast<std::size_t>(rect.right - rect.left + 1);
        return static_cast<std::size_t>(row - rect.bottom) * width +
               static_cast<std::size_t>(column - rect.left);
    }
    std::int64_t at(int column, int row) const { return heights[indexOf(column, row)]; }
};
using Patches = std::array<std::optional<Patch>, faceCount>;

const Patch& of(const Patches& patches, Face face) {
    return *patches[static_cast<std::size_t>(face)];
}

// Returns the random offset of a point of the cube, within +-most. Each point has one offset, on the level
// that adds the point.
std::int64_t offsetAt(const Midpoint& terrain, Face face, int column, int row, int level, std::int64_t most) {
    const int cells = 1 << level;
    const glm::dvec3 point = cubePoint(face, 2 * column - cells, 2 * row - cells);
    const FaceAxes& axes = faceAxes(face);
    // cubePoint's normal component is 1.
    const int numbered = level <= numberedLevel ? numberedLevel : maxFaceCellsLog2;
    const glm::dvec3 whole = (point + double(cells - 1) * axes.normal) * std::ldexp(1.0, numbered - level);
    const auto bits = [](double coordinate) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate));
    };
    const std::uint64_t first = scrambled64(terrain.seed ^ ((bits(whole.x) << 32) + bits(whole.y)));
    const std::uint64_t hash = scrambled64(first + bits(whole.z));
    return ((static_cast<std::int64_t>(hash >> 32) - (std::int64_t{1} << 31)) * most) >> 31;
}

// Computes the heights of a level from those of its parent.
class Halving {
public:
    Halving(const Midpoint& terrain, const Patches& parents, int level)
        : terrain_(terrain), parents_(parents), level_(level), cells_(1 << level) {}

    std::int64_t heightAt(Face face, int column, int row) const {
        const bool oddColumn = (column & 1) != 0;
        const bool oddRow = (row & 1) != 0;
        if (oddColumn && oddRow) return middleAt(face, column, row);
        if (!oddColumn && !oddRow) return of(parents_, face).at(column / 2, row / 2);
        return edgeAt(face, column, row, oddColumn);
    }

private:
    static std::int64_t meanOfFour(std::int64_t sum) { return (sum + 2) >> 2; }

    std::int64_t middleAt(Face face, int column, int row) const {
        const Patch& parent = of(parents_, face);
        const int c = column >> 1, r = row >> 1;
        const std::int64_t sum =
            parent.at(c, r) + parent.at(c + 1, r) + parent.at(c, r + 1) + parent.at(c + 1, r + 1);
        return meanOfFour(sum) + offsetAt(terrain_, face, column, row, level_, levelOf(terrain_.middle));
    }

    std::int64_t edgeAt(Face face, int column, int row, bool alongU) const {
        const Patch& parent = of(parents_, face);
        const int c = column >> 1, r = row >> 1;
        const std::int64_t ends = parent.at(c, r) + (alongU ? parent.at(c + 1, r) : parent.at(c, r + 1));
        const std::int64_t middles =
            alongU ? middleNear(face, column, row - 1) + middleNear(face, column, row + 1)
                   : middleNear(face, column - 1, row) + middleNear(face, column + 1, row);
        return meanOfFour(ends + middles) +
               offsetAt(terrain_, face, column, row, level_, levelOf(terrain_.edge));
    }

    // Returns the middle of a cell near an edge, also beyond an edge of the cube.
    std::int64_t middleNear(Face face, int column, int row) const {
        if (column > 0 && column < cells_ && row > 0 && row < cells_) return middleAt(face, column, row);
        const FaceGridPoint place = foldedOver({face, column, row}, cells_);
        return middleAt(place.face, place.column, place.row);
    }

    std::int64_t levelOf(const auto& offsets) const { return offsets[static_cast<std::size_t>(level_)]; }

    const Midpoint& terrain_;
    const Patches& parents_;
    int level_;
    int cells_;
};

template <class HeightAt>
Patches filled(const Needs& needs, const HeightAt& heightAt) {
    Patches patches;
    for (const Face face : allFaces) {
        const std::optional<Rect>& rect = needs[static_cast<std::size_t>(face)];
        if (!rect) continue;
        Patch patch{*rect, {}};
        patch.heights.reserve(static_cast<std::size_t>(rect->right - rect->left + 1) *
                              static_cast<std::size_t>(rect->top - rect->bottom + 1));
        for (int row = rect->bottom; row <= rect->top; ++row) {
            for (int column = rect->left; column <= rect->right; ++column) {
                patch.heights.push_back(heightAt(face, column, row));
            }
        }
        patches[static_cast<std::size_t>(face)] = std::move(patch);
    }
    return patches;
}

// Returns the heights of the required parts of the grid of 2^level cells per side.
Patches heightsOf(const Midpoint& terrain, const Needs& finest, int level) {
    std::vector<Needs> needs(static_cast<std::size_t>(level) + 1);
    needs.back() = finest;
    for (int l = level; l > 0; --l) {
        needs[static_cast<std::size_t>(l) - 1] = parentsOf(needs[static_cast<std::size_t>(l)], l);
    }
    Patches patches = filled(needs[0], [&](Face face, int column, int row) {
        return offsetAt(terrain, face, column, row, 0, terrain.middle[0]);
    });
    for (int l = 1; l <= level; ++l) {
        const Halving halving(terrain, patches, l);
        patches = filled(needs[static_cast<std::size_t>(l)],
                         [&](Face face, int column, int row) { return halving.heightAt(face, column, row); });
    }
    return patches;
}

// Returns how far the heights of finer grids may exceed those of a grid: 5 times their root mean square.
// Taking a mean roughly halves the variance, and a uniform offset adds a third of its square.
double reachBelow(const Midpoint& terrain, int level) {
    double variance = 0, most = 0;
    for (std::size_t l = static_cast<std::size_t>(level) + 1; l < terrain.middle.size(); ++l) {
        const auto middle = static_cast<double>(terrain.middle[l]);
        variance = variance / 2 + middle * middle / 3;
        most = std::max(most, variance);
    }
    return noiseReach * std::sqrt(most);
}

Result<void> samplePiece(const Midpoint& terrain, const SampleTile& piece, float* out, std::size_t stride) {
    assert(std::has_single_bit(static_cast<unsigned>(piece.faceCells)));
    const int level = std::countr_zero(static_cast<unsigned>(piece.faceCells));
    Needs needs;
    addTo(needs, piece.face, piece.firstColumn, piece.firstRow);
    addTo(needs, piece.face, piece.firstColumn + piece.columns - 1, piece.firstRow + piece.rows - 1);
    const Patches patches = heightsOf(terrain, needs, level);
    const std::vector<std::int64_t>& heights = of(patches, piece.face).heights;
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const double heightM = terrain.offsetM + terrain.metres * static_cast<double>(heights[i]);
        out[i / columns * stride + i % columns] =
            static_cast<float>(std::clamp(heightM, terrain.minM, terrain.maxM));
    }
    return {};
}

// Computes the offsets by level. Seeds that differ by 1 give different offsets everywhere.
Midpoint scaledBy(const MidpointTerrain& settings) {
    Midpoint terrain;
    terrain.seed = scrambled64(settings.seed);
    terrain.offsetM = settings.offsetM;
    const double perLevel = std::exp2(settings.roughness - 1);
    const double first = std::ldexp(1.0, fractionBits);
    for (std::size_t level = 0; level < terrain.middle.size(); ++level) {
        const double most = level == 0 ? first : first * std::pow(perLevel, static_cast<double>(level) - 1);
        terrain.middle[level] = std::llround(most);
        terrain.edge[level] = std::llround(most * std::sqrt(perLevel));
    }
    return terrain;
}

// Returns the rectangles of a whole coarse grid.
Needs wholeCube(int cells) {
    Needs needs;
    for (const Face face : allFaces) needs[static_cast<std::size_t>(face)] = Rect{0, 0, cells, cells};
    return needs;
}

}  // namespace

HeightSource midpointSource(const MidpointTerrain& settings) {
    Midpoint terrain = scaledBy(settings);
    std::int64_t lowest = 0, highest = 0;
    for (const std::optional<Patch>& patch :
         heightsOf(terrain, wholeCube(1 << measuredLevel), measuredLevel)) {
        const auto [low, high] = std::minmax_element(patch->heights.begin(), patch->heights.end());
        lowest = std::min(lowest, *low);
        highest = std::max(highest, *high);
    }
    const double below = reachBelow(terrain, measuredLevel);
    const double reach = static_cast<double>(std::max(highest, -lowest)) + below;
    terrain.metres = settings.amplitudeM / reach;
    terrain.minM = terrain.offsetM + terrain.metres * (static_cast<double>(lowest) - below);
    terrain.maxM = terrain.offsetM + terrain.metres * (static_cast<double>(highest) + below);

    const TerrainExtent extent{mostNaturalCells, terrain.minM, terrain.maxM};
    return pieceSource(settings, extent, midpointPieceSide, terrain, samplePiece);
}

}  // namespace planet
