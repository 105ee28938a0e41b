#include "planet/bake/finest_distance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "planet/base/cpu_clones.h"
#include "planet/base/try.h"

namespace planet {

namespace {

// --- Measuring a tile

struct MeasuredTile {
    const GeometricErrorScratch& grid;
    std::size_t side;  // samples

    glm::dvec3 at(std::size_t column, std::size_t row) const {
        const std::size_t index = row * side + column;
        return {grid.x[index], grid.y[index], grid.z[index]};
    }
};

// A line that passes through `from` at column 0 and moves by `step` per column. Columns count from the cell's west edge.
struct Line {
    glm::dvec3 from;
    glm::dvec3 step;
};

PLANET_ALWAYS_INLINE double squaredFrom(const Line& line, int column, const double* x, const double* y,
                                        const double* z) {
    const double along = column;
    const double dx = x[column] - (line.from.x + along * line.step.x);
    const double dy = y[column] - (line.from.y + along * line.step.y);
    const double dz = z[column] - (line.from.z + along * line.step.z);
    return dx * dx + dy * dy + dz * dz;
}

// Returns the largest squared distance of all samples on a cell of a coarser level, including its edges,
// from the cell's two triangles. Samples on the diagonal are compared with both. cells: a multiple of 4.
PLANET_ALWAYS_INLINE double largestSquaredOnCell(const MeasuredTile& tile, std::size_t column,
                                                 std::size_t row, std::size_t cells) {
    const glm::dvec3 southWest = tile.at(column, row);
    const glm::dvec3 southEast = tile.at(column + cells, row);
    const glm::dvec3 northWest = tile.at(column, row + cells);
    const glm::dvec3 northEast = tile.at(column + cells, row + cells);
    const double share = 1 / static_cast<double>(cells);
    const glm::dvec3 alongSouth = (southEast - southWest) * share;
    const glm::dvec3 alongNorth = (northEast - northWest) * share;
    const glm::dvec3 upWest = (northWest - southWest) * share;
    const glm::dvec3 upEast = (northEast - southEast) * share;
    const int last = static_cast<int>(cells);
    double largest = 0;
    for (int j = 0; j <= last; ++j) {
        const double up = j;
        const std::size_t start = (row + static_cast<std::size_t>(j)) * tile.side + column;
        const double* const x = tile.grid.x.data() + start;
        const double* const y = tile.grid.y.data() + start;
        const double* const z = tile.grid.z.data() + start;
        const Line west{southWest + up * upWest, alongNorth};
        const Line east{southWest + up * upEast, alongSouth};
        // Whole rows with selects, so that the compiler vectorises them; then what they leave out.
        for (int i = 0; i < (last & ~3); ++i) {
            const bool isWest = i <= up;
            const Line line{{isWest ? west.from.x : east.from.x, isWest ? west.from.y : east.from.y,
                             isWest ? west.from.z : east.from.z},
                            {isWest ? west.step.x : east.step.x, isWest ? west.step.y : east.step.y,
                             isWest ? west.step.z : east.step.z}};
            largest = std::max(largest, squaredFrom(line, i, x, y, z));
        }
        largest = std::max(largest, squaredFrom(east, j, x, y, z));
        largest = std::max(largest, squaredFrom(j < last ? east : west, last, x, y, z));
    }
    return largest;
}

PLANET_CPU_CLONES double largestSquaredOnAnyCell(const MeasuredTile& tile, std::size_t column,
                                                 std::size_t row, std::size_t cells) {
    return largestSquaredOnCell(tile, column, row, cells);
}

// Does the same for the smallest cells, in rows of constant length, because most cells are the smallest ones.
PLANET_CPU_CLONES double largestSquaredOnSmallCell(const MeasuredTile& tile, std::size_t column,
                                                   std::size_t row) {
    return largestSquaredOnCell(tile, column, row, 4);
}

// Returns the number of chunks of a level along one side of a tile; 1 for levels above the tile.
std::size_t chunksAlong(int level, int tileLevel) {
    return std::size_t{1} << std::max(0, level - tileLevel);
}

// --- Searching the pyramid

class Search {
public:
    Search(const PlanetShape& shape, const ChunkData& chunk, const ReadChildren& readChildren,
           const std::function<bool()>& goOn)
        : shape_(shape), id_(chunk.id), readChildren_(readChildren), goOn_(goOn), own_(gridOf(chunk)) {}

    // Searches everything under a chunk whose own vertices have been compared.
    Result<void> descend(const ChunkData& chunk) {
        if (goOn_ && !goOn_()) return cancelled();
        TRY_ASSIGN(const auto children, readChildren_(chunk));
        std::array<std::pair<double, std::size_t>, quadrantCount> mostUnder;
        for (std::size_t q = 0; q < children.size(); ++q) {
            const ChunkData& child = children[q];
            const double atVerticesM = distanceToVerticesM(child);
            largestM_ = std::max(largestM_, atVerticesM);
            mostUnder[q] = {atVerticesM + child.deltaTightM, q};
        }
        // The largest bounds come first, so that the others can be skipped. Under a leaf there is nothing,
        // and its vertices are compared already.
        std::sort(mostUnder.rbegin(), mostUnder.rend());
        for (const auto& [mostM, q] : mostUnder) {
            if (mostM <= largestM_) return {};
            if (!children[q].children.exists()) continue;
            TRY(descend(children[q]));
        }
        return {};
    }

    double largestM() const { return largestM_; }

private:
    std::vector<glm::dvec3> gridOf(const ChunkData& chunk) {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        facePositions(shape_, faceSquareOf(chunk.id), side, chunk.heights, scratch_);
        std::vector<glm::dvec3> positions;
        positions.reserve(side * side);
        for (std::size_t i = 0; i < side * side; ++i) {
            positions.emplace_back(scratch_.x[i], scratch_.y[i], scratch_.z[i]);
        }
        return positions;
    }

    // Returns the point of the searched chunk's triangles at a place in its cells.
    glm::dvec3 surfaceM(double column, double row) const {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const std::size_t i = std::min(static_cast<std::size_t>(column), side - 2);
        const std::size_t j = std::min(static_cast<std::size_t>(row), side - 2);
        const double s = column - static_cast<double>(i);
        const double t = row - static_cast<double>(j);
        const glm::dvec3& southWest = own_[j * side + i];
        const glm::dvec3& northEast = own_[(j + 1) * side + i + 1];
        if (s >= t) {
            const glm::dvec3& southEast = own_[j * side + i + 1];
            return southWest + s * (southEast - southWest) + t * (northEast - southEast);
        }
        const glm::dvec3& northWest = own_[(j + 1) * side + i];
        return southWest + t * (northWest - southWest) + s * (northEast - northWest);
    }

    double distanceToVerticesM(const ChunkData& below) {
        const auto side = static_cast<std::size_t>(chunkSize(shape_));
        const int levels = below.id.level - id_.level;
        const auto firstColumn = (below.id.x - (id_.x << levels)) << shape_.chunkCellsLog2;
        const auto firstRow = (below.id.y - (id_.y << levels)) << shape_.chunkCellsLog2;
        facePositions(shape_, faceSquareOf(below.id), side, below.heights, scratch_);
        const double perVertex = std::ldexp(1.0, -levels);  // cells of the searched chunk; exact
        double largest = 0;
        for (std::size_t j = 0; j < side; ++j) {
            const double row = static_cast<double>(firstRow + j) * perVertex;
            for (std::size_t i = 0; i < side; ++i) {
                const double column = static_cast<double>(firstColumn + i) * perVertex;
                const std::size_t at = j * side + i;
                const glm::dvec3 off =
                    glm::dvec3(scratch_.x[at], scratch_.y[at], scratch_.z[at]) - surfaceM(column, row);
                largest = std::max(largest, glm::dot(off, off));
            }
        }
        return std::sqrt(largest);
    }

    const PlanetShape& shape_;
    ChunkId id_;
    const ReadChildren& readChildren_;
    const std::function<bool()>& goOn_;
    GeometricErrorScratch scratch_;
    std::vector<glm::dvec3> own_;  // the searched chunk's vertices
    double largestM_ = 0;
};

}  // namespace

int tileLevelOf(const PlanetShape& shape, std::optional<int> levels) {
    constexpr int cellsLog2 = 7;
    return std::max(0,
                    deepestLevelOf(shape) - levels.value_or(std::max(1, cellsLog2 - shape.chunkCellsLog2)));
}

int coarsestLevelOfTiles(int tileLevel, const PlanetShape& shape) {
    return std::max(0, tileLevel - shape.chunkCellsLog2);
}

void measureTile(const PlanetShape& shape, const ChunkId& tile, std::span<const std::int32_t> finest,
                 GeometricErrorScratch& scratch, TileDistances& out) {
    const auto cells = static_cast<std::size_t>(faceCells(shape) >> tile.level);
    assert(finest.size() == (cells + 1) * (cells + 1));
    out.tile = tile;
    out.coarsestLevel = coarsestLevelOfTiles(tile.level, shape);
    out.largestM.clear();
    facePositions(shape, faceSquareOf(tile), cells + 1, finest, scratch);
    const MeasuredTile grid{scratch, cells + 1};
    for (int level = out.coarsestLevel; level <= deepestLevelOf(shape) - 2; ++level) {
        const std::size_t cell = std::size_t{1} << (deepestLevelOf(shape) - level);
        const std::size_t chunks = chunksAlong(level, tile.level);
        const std::size_t chunk = cells / chunks;
        std::vector<double>& largest = out.largestM.emplace_back(chunks * chunks);
        for (std::size_t row = 0; row < cells; row += cell) {
            for (std::size_t column = 0; column < cells; column += cell) {
                double& ofChunk = largest[row / chunk * chunks + column / chunk];
                ofChunk = std::max(ofChunk, cell == 4 ? largestSquaredOnSmallCell(grid, column, row)
                                                      : largestSquaredOnAnyCell(grid, column, row, cell));
            }
        }
        for (double& squared : largest) squared = std::sqrt(squared);
    }
}

double TileDistances::of(const ChunkId& chunk) const {
    const std::size_t chunks = chunksAlong(chunk.level, tile.level);
    const std::vector<double>& largest = largestM[static_cast<std::size_t>(chunk.level - coarsestLevel)];
    return largest[(chunk.y & (chunks - 1)) * chunks + (chunk.x & (chunks - 1))];
}

double TileDistances::above(int level) const {
    assert(level < tile.level);
    return largestM[static_cast<std::size_t>(level - coarsestLevel)].front();
}

Result<double> searchFinestDistance(const PlanetShape& shape, const ChunkData& chunk,
                                    const ReadChildren& readChildren, const std::function<bool()>& goOn) {
    assert(chunk.children.exists());
    Search search(shape, chunk, readChildren, goOn);
    TRY(search.descend(chunk));
    return search.largestM();
}

float tightMetric(double ownDistanceM, float largestOfChildrenM, float deltaCM) {
    return std::min(std::max(roundedUp(ownDistanceM), largestOfChildrenM), deltaCM);
}

}  // namespace planet
