#include "planet/bake/finest_distance.h"
#include "planet/base/try.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

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

    // Returns the largest squared distance of samples `first` to `last` of a row from a line that passes
    // through `from` at column 0 and moves by `step` per column. Columns count from the cell's west edge.
    double largestSquared(std::size_t start, std::size_t first, std::size_t last, const glm::dvec3& from,
                          const glm::dvec3& step) const {
        const double* const x = grid.x.data() + start;
        const double* const y = grid.y.data() + start;
        const double* const z = grid.z.data() + start;
        double largest = 0;
        for (std::size_t i = first; i <= last; ++i) {
            const auto along = static_cast<double>(i);
            const double dx = x[i] - (from.x + along * step.x);
            const double dy = y[i] - (from.y + along * step.y);
            const double dz = z[i] - (from.z + along * step.z);
            largest = std::max(largest, dx * dx + dy * dy + dz * dz);
        }
        return largest;
    }

    // Returns the largest squared distance of all samples on a cell of a coarser level, including its edges,
    // from the cell's two triangles.
    double largestSquaredOnCell(std::size_t column, std::size_t row, std::size_t cells) const {
        const glm::dvec3 southWest = at(column, row);
        const glm::dvec3 southEast = at(column + cells, row);
        const glm::dvec3 northWest = at(column, row + cells);
        const glm::dvec3 northEast = at(column + cells, row + cells);
        const double share = 1 / static_cast<double>(cells);
        const glm::dvec3 alongSouth = (southEast - southWest) * share;
        const glm::dvec3 alongNorth = (northEast - northWest) * share;
        const glm::dvec3 upWest = (northWest - southWest) * share;
        const glm::dvec3 upEast = (northEast - southEast) * share;
        double largest = 0;
        for (std::size_t j = 0; j <= cells; ++j) {
            const auto up = static_cast<double>(j);
            const std::size_t start = (row + j) * side + column;
            const double west = largestSquared(start, 0, j, southWest + up * upWest, alongNorth);
            const double east = largestSquared(start, j, cells, southWest + up * upEast, alongSouth);
            largest = std::max({largest, west, east});
        }
        return largest;
    }
};

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
        double largest = 0;
        for (std::size_t j = 0; j < side; ++j) {
            const double row = std::ldexp(static_cast<double>(firstRow + j), -levels);
            for (std::size_t i = 0; i < side; ++i) {
                const double column = std::ldexp(static_cast<double>(firstColumn + i), -levels);
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
    if (out.coarsestLevel > deepestLevelOf(shape) - 2) return;
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
                ofChunk = std::max(ofChunk, grid.largestSquaredOnCell(column, row, cell));
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
