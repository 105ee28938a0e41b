#include "planet/gl/draw/chunk_grid.h"

#include <algorithm>
#include <cassert>

namespace planet::gl {

namespace {

// Wide grids are drawn in strips, so that a row's vertices are still in the cache when the next row uses
// them.
constexpr int stripCells = 32;

struct Walker {
    ChunkGrid& grid;
    int cells;

    std::uint16_t at(int column, int row) const {
        return static_cast<std::uint16_t>(row * (cells + 1) + column);
    }
    void triangle(std::uint16_t a, std::uint16_t b, std::uint16_t c) const {
        grid.indices.insert(grid.indices.end(), {a, b, c});
    }
};

void addCells(const Walker& walker) {
    for (int strip = 0; strip < walker.cells; strip += stripCells) {
        for (int row = 0; row < walker.cells; ++row) {
            for (int column = strip; column < std::min(strip + stripCells, walker.cells); ++column) {
                const std::uint16_t southWest = walker.at(column, row);
                const std::uint16_t northEast = walker.at(column + 1, row + 1);
                walker.triangle(southWest, walker.at(column + 1, row), northEast);
                walker.triangle(southWest, northEast, walker.at(column, row + 1));
            }
        }
    }
}

// Returns the border from the south-west corner, counter-clockwise as seen from above; each vertex once.
std::vector<GridVertex> border(int cells) {
    std::vector<GridVertex> vertices;
    const auto add = [&](int column, int row) {
        vertices.push_back({static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row), 1, 0});
    };
    for (int i = 0; i < cells; ++i) add(i, 0);
    for (int i = 0; i < cells; ++i) add(cells, i);
    for (int i = cells; i > 0; --i) add(i, cells);
    for (int i = cells; i > 0; --i) add(0, i);
    return vertices;
}

void addSkirt(const Walker& walker) {
    const std::vector<GridVertex> lower = border(walker.cells);
    const std::size_t first = walker.grid.vertices.size();
    walker.grid.vertices.insert(walker.grid.vertices.end(), lower.begin(), lower.end());
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const std::size_t next = (i + 1) % lower.size();
        const std::uint16_t top = walker.at(lower[i].column, lower[i].row);
        const std::uint16_t nextTop = walker.at(lower[next].column, lower[next].row);
        const auto bottom = static_cast<std::uint16_t>(first + i);
        const auto nextBottom = static_cast<std::uint16_t>(first + next);
        walker.triangle(bottom, nextBottom, nextTop);
        walker.triangle(bottom, nextTop, top);
    }
}

}  // namespace

ChunkGrid chunkGrid(int cells) {
    assert(cells >= 2 && cells <= 128);
    ChunkGrid grid;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            grid.vertices.push_back(
                {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row), 0, 0});
        }
    }
    const Walker walker{grid, cells};
    addCells(walker);
    grid.gridIndexCount = static_cast<std::uint32_t>(grid.indices.size());
    addSkirt(walker);
    return grid;
}

}  // namespace planet::gl
