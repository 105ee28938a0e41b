#include "planet/gl/draw/chunk_grid.h"

#include <gtest/gtest.h>

#include <set>

namespace planet::gl {
namespace {

struct Triangle {
    GridVertex a, b, c;
};

std::vector<Triangle> triangles(const ChunkGrid& grid, std::size_t first, std::size_t last) {
    std::vector<Triangle> all;
    for (std::size_t i = first; i < last; i += 3)
        all.push_back({grid.vertices[grid.indices[i]], grid.vertices[grid.indices[i + 1]],
                       grid.vertices[grid.indices[i + 2]]});
    return all;
}

int twiceArea(const Triangle& t) {
    return (t.b.column - t.a.column) * (t.c.row - t.a.row) - (t.c.column - t.a.column) * (t.b.row - t.a.row);
}

class Grid : public testing::TestWithParam<int> {
protected:
    ChunkGrid grid_ = chunkGrid(GetParam());
};

TEST_P(Grid, CoversTheSquareOnceCounterClockwise) {
    const int cells = GetParam();
    std::set<std::pair<int, int>> halves;
    int area = 0;
    for (const Triangle& t : triangles(grid_, 0, grid_.gridIndexCount)) {
        EXPECT_EQ(twiceArea(t), 1);
        area += twiceArea(t);
        const int column = std::min({t.a.column, t.b.column, t.c.column});
        const int row = std::min({t.a.row, t.b.row, t.c.row});
        const int upper = (t.a.row + t.b.row + t.c.row) - 3 * row == 2 ? 1 : 0;
        halves.insert({column * 2 + upper, row});
    }
    EXPECT_EQ(area, 2 * cells * cells);
    EXPECT_EQ(halves.size(), static_cast<std::size_t>(2 * cells * cells));
}

TEST_P(Grid, DiagonalsRunFromSouthWestToNorthEast) {
    for (const Triangle& t : triangles(grid_, 0, grid_.gridIndexCount)) {
        const int column = std::min({t.a.column, t.b.column, t.c.column});
        const int row = std::min({t.a.row, t.b.row, t.c.row});
        int corners = 0;
        for (const GridVertex& v : {t.a, t.b, t.c}) corners += v.column - column == v.row - row;
        EXPECT_EQ(corners, 2);
    }
}

// With height as the third axis, pointing up, a skirt's triangle must face away from the chunk's middle.
TEST_P(Grid, TheSkirtGoesAllAroundAndFacesOutwards) {
    const int cells = GetParam();
    std::size_t count = 0;
    for (const Triangle& t : triangles(grid_, grid_.gridIndexCount, grid_.indices.size())) {
        const auto edge = [](const GridVertex& p, const GridVertex& q) {
            return std::array<int, 3>{q.column - p.column, q.row - p.row, p.skirt - q.skirt};
        };
        const auto e = edge(t.a, t.b);
        const auto f = edge(t.a, t.c);
        const std::array<int, 2> normal = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2]};
        const int outwards = normal[0] * (t.a.column + t.b.column + t.c.column - 3 * cells / 2) +
                             normal[1] * (t.a.row + t.b.row + t.c.row - 3 * cells / 2);
        EXPECT_GT(outwards, 0);
        ++count;
    }
    EXPECT_EQ(count, static_cast<std::size_t>(2 * 4 * cells));
}

TEST_P(Grid, FitsSixteenBitIndices) {
    EXPECT_LE(grid_.vertices.size(), 65536u);
    for (const std::uint16_t index : grid_.indices) EXPECT_LT(index, grid_.vertices.size());
}

INSTANTIATE_TEST_SUITE_P(Sizes, Grid, testing::Values(16, 32, 64, 128));

}  // namespace
}  // namespace planet::gl
