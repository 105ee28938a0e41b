// Tiles of normals, held to the heights that they are derived from.
#include "planet/paging/normal_tile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <thread>

#include "planet/sphere/face_fold.h"
#include "tests/support/made_chunks.h"
#include "tests/support/texel_slope.h"

namespace planet {
namespace {

using test::MadeChunks;
using testing::HasSubstr;

constexpr double halfError = 1.0 / 2048;  // of a half float, relative

PlanetShape shapeOf(int faceCellsLog2, int chunkCellsLog2) {
    return {.radiusM = 1e5,
            .quantumM = 0.25,
            .baseHeightM = 40,
            .faceCellsLog2 = faceCellsLog2,
            .chunkCellsLog2 = chunkCellsLog2};
}

double smoothM(const glm::dvec3& d) {
    return 2000 * std::sin(3 * d.x + 1) * std::cos(4 * d.y - 2 * d.z) + 300 * std::sin(9 * d.z + 5 * d.x);
}

double roughM(const glm::dvec3& d) {
    return smoothM(d) + 500 * std::sin(137 * d.x + 111 * d.z) * std::sin(141 * d.y - 95 * d.x);
}

std::unique_ptr<NormalDeriver> deriverOf(const MadeChunks& made, std::size_t keptBytes = 4 << 20) {
    auto deriver = std::make_unique<NormalDeriver>(made.shape, made.roots(), made.loader());
    deriver->keepHeights(keptBytes);
    return deriver;
}

// Of the vertex of a level's grid that a texel is.
struct GridVertex {
    int column;
    int row;
};
GridVertex vertexOf(const ChunkId& tile, int i, int j) {
    return {static_cast<int>(tile.x) * tileCells - tileBorderBefore + i,
            static_cast<int>(tile.y) * tileCells - tileBorderBefore + j};
}
int texelOf(int vertex, std::uint32_t tile) {
    return vertex - static_cast<int>(tile) * tileCells + tileBorderBefore;
}

// The formula's own slope along u and v, which Nowell's map continues beyond the face.
glm::dvec2 trueSlope(const MadeChunks& made, Face face, double u, double v) {
    constexpr double e = 1e-5;
    const auto at = [&](double x, double y) { return made.heightM(sphereFromCube(cubePoint(face, x, y))); };
    return glm::dvec2(at(u + e, v) - at(u - e, v), at(u, v + e) - at(u, v - e)) /
           (2 * e * made.shape.radiusM);
}

glm::dvec2 texel(const TileData& tile, int i, int j) {
    const auto [u, v] = slopeOfTexel(tile, i, j);
    return {u, v};
}

// The ground's normal, in world axes.
glm::dvec3 normalOf(Face face, double u, double v, const glm::dvec2& slope) {
    constexpr double e = 1e-5;
    const auto at = [&](double x, double y) { return sphereFromCube(cubePoint(face, x, y)); };
    const glm::dvec3 d = at(u, v);
    const glm::dvec3 du = (at(u + e, v) - at(u - e, v)) / (2 * e) + slope.x * d;
    const glm::dvec3 dv = (at(u, v + e) - at(u, v - e)) / (2 * e) + slope.y * d;
    return glm::normalize(glm::cross(du, dv));
}

TEST(NormalTile, ATexelIsTheCentralDifferenceOfItsLevelsHeights) {
    std::mt19937 random(3);
    for (const int chunkCellsLog2 : {4, 5, 7}) {
        const MadeChunks made(shapeOf(10, chunkCellsLog2), roughM);
        const auto deriver = deriverOf(made);
        for (const int level : {0, 1, 2}) {
            const int across = 1 << level;
            const ChunkId id{allFaces[random() % 6], static_cast<std::uint8_t>(level),
                             static_cast<std::uint32_t>(random()) % static_cast<std::uint32_t>(across),
                             static_cast<std::uint32_t>(random()) % static_cast<std::uint32_t>(across)};
            const TileData tile = deriver->tile(id).value();
            const int cells = tileCells << level;
            for (int n = 0; n < 3000; ++n) {
                const int i = static_cast<int>(random() % tileTexels);
                const int j = static_cast<int>(random() % tileTexels);
                const auto [column, row] = vertexOf(id, i, j);
                if (column <= 0 || row <= 0 || column >= cells || row >= cells) continue;
                const auto step = [&](int c, int r) { return made.step(id.face, c, r, cells); };
                const double scale = cells / 4.0 * made.shape.quantumM / made.shape.radiusM;
                const glm::dvec2 expected(scale * (step(column + 1, row) - step(column - 1, row)),
                                          scale * (step(column, row + 1) - step(column, row - 1)));
                const glm::dvec2 found = texel(tile, i, j);
                ASSERT_NEAR(found.x, expected.x, halfError * std::abs(expected.x) + 1e-7)
                    << toString(id) << " " << i << " " << j;
                ASSERT_NEAR(found.y, expected.y, halfError * std::abs(expected.y) + 1e-7);
            }
        }
    }
}

// On the face, on its edges and corners, and in the border beyond its edges.
TEST(NormalTile, EveryTexelIsTheSlopeOfTheGround) {
    PlanetShape shape = shapeOf(9, 5);
    shape.quantumM = 0.1;
    const MadeChunks made(shape, smoothM);
    const auto deriver = deriverOf(made);
    for (const Face face : allFaces) {
        for (const ChunkId id : {ChunkId{face, 0, 0, 0}, {face, 1, 0, 0}, {face, 1, 1, 0}, {face, 1, 1, 1}}) {
            const TileData tile = deriver->tile(id).value();
            const int cells = tileCells << id.level;
            // What a difference over two cells leaves out, and the rounding of two heights.
            const double allowed = 12.0 / cells * 0.05 + cells / 4.0 * shape.quantumM / shape.radiusM;
            double worstOnFace = 0;
            double worstBeyond = 0;
            for (int j = 0; j < tileTexels; ++j) {
                for (int i = 0; i < tileTexels; ++i) {
                    const auto [column, row] = vertexOf(id, i, j);
                    const bool overU = column < 0 || column > cells;
                    const bool overV = row < 0 || row > cells;
                    if (overU && overV) continue;
                    const glm::dvec2 expected =
                        trueSlope(made, face, 2.0 * column / cells - 1, 2.0 * row / cells - 1);
                    const double off = glm::length(texel(tile, i, j) - expected);
                    double& worst = overU || overV ? worstBeyond : worstOnFace;
                    worst = std::max(worst, off);
                }
            }
            EXPECT_LE(worstOnFace, allowed) << toString(id);
            // The lines break there, so the farther out the less they are the face's own.
            EXPECT_LE(worstBeyond, allowed + 0.3 * tileBorderAfter * 2.0 / cells) << toString(id);
        }
    }
}

TEST(NormalTile, BothFacesTellTheSameOfTheirEdgeAndAllThreeOfACorner) {
    const MadeChunks made(shapeOf(9, 4), roughM);
    const auto deriver = deriverOf(made);
    const int cells = 512;
    std::array<std::array<TileData, quadrantCount>, faceCount> tiles;
    for (const Face face : allFaces)
        tiles[static_cast<std::size_t>(face)] = deriver->childrenOf({face, 0, 0, 0}).value();
    const auto normalAt = [&](const FaceGridPoint& point) {
        const auto x = static_cast<std::uint32_t>(std::min(point.column / tileCells, 1));
        const auto y = static_cast<std::uint32_t>(std::min(point.row / tileCells, 1));
        const TileData& tile = tiles[static_cast<std::size_t>(point.face)][x + 2 * y];
        return normalOf(point.face, 2.0 * point.column / cells - 1, 2.0 * point.row / cells - 1,
                        texel(tile, texelOf(point.column, x), texelOf(point.row, y)));
    };
    double worst = 0;
    int compared = 0;
    for (const Face face : allFaces) {
        for (int along = 0; along <= cells; along += 8) {
            for (const auto& [column, row] :
                 {GridVertex{0, along}, {cells, along}, {along, 0}, {along, cells}}) {
                const glm::dvec3 own = normalAt({face, column, row});
                const glm::dvec3 place = cubePoint(face, 2.0 * column / cells - 1, 2.0 * row / cells - 1);
                for (const Face other : allFaces) {
                    const FaceAxes& axes = faceAxes(other);
                    if (other == face || glm::dot(place, axes.normal) < 1) continue;
                    const glm::dvec3 theirs = normalAt(
                        {other, static_cast<int>(std::lround((glm::dot(place, axes.u) + 1) * cells / 2)),
                         static_cast<int>(std::lround((glm::dot(place, axes.v) + 1) * cells / 2))});
                    worst = std::max(worst, glm::length(own - theirs));
                    ++compared;
                }
            }
        }
    }
    EXPECT_GT(compared, 6 * 4 * 64);
    EXPECT_LT(worst, 0.0015);  // half floats: of slopes up to some 1
}

TEST(NormalTile, TilesBesideEachOtherHoldTheSameTexels) {
    const MadeChunks made(shapeOf(10, 5), roughM);
    const auto deriver = deriverOf(made);
    const ChunkId west{Face::NegY, 2, 1, 2};
    const ChunkId east{Face::NegY, 2, 2, 2};
    const ChunkId north{Face::NegY, 2, 1, 3};
    const TileData tile = deriver->tile(west).value();
    const TileData eastTile = deriver->tile(east).value();
    const TileData northTile = deriver->tile(north).value();
    for (int j = 0; j < tileTexels; ++j) {
        for (int i = tileCells; i < tileTexels; ++i) {
            ASSERT_EQ(slopeOfTexel(tile, i, j), slopeOfTexel(eastTile, i - tileCells, j));
            ASSERT_EQ(slopeOfTexel(tile, j, i), slopeOfTexel(northTile, j, i - tileCells));
        }
    }
}

TEST(NormalTile, IsTheSameWhateverIsKeptAndOnManyThreads) {
    const MadeChunks made(shapeOf(10, 5), roughM);
    const auto alone = deriverOf(made, 0);
    const auto shared = deriverOf(made, 200'000);
    std::array<TileBlock, 2> blocks;
    {
        std::vector<std::jthread> threads;
        for (std::size_t q = 0; q < blocks.size(); ++q) {
            threads.emplace_back([&, q] {
                blocks[q] = shared->childrenOf({Face::PosZ, 1, static_cast<std::uint32_t>(q), 1}).value();
            });
        }
    }
    EXPECT_GT(shared->bytesRead(), 0u);
    for (const TileBlock& block : blocks) {
        const TileData& tile = block[1];
        EXPECT_EQ(tile.texels, alone->tile(tile.id).value().texels) << toString(tile.id);
    }
}

TEST(NormalTile, ABlockThatCannotBeReadIsNamedWithTheTile) {
    MadeChunks made(shapeOf(10, 5), roughM);
    made.broken = ChunkId{Face::PosX, 3, 4, 4};
    const auto deriver = deriverOf(made);
    const auto failed = deriver->tile({Face::PosX, 2, 2, 2});
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, HasSubstr("normals of tile x_pos/2/2/2"));
    EXPECT_THAT(failed.error().message, HasSubstr("made.chk: the block of chunk x_pos/3/4/4 is damaged"));
    EXPECT_TRUE(deriver->tile({Face::PosX, 2, 0, 0}));
    made.broken.reset();
    EXPECT_TRUE(deriver->tile({Face::PosX, 2, 2, 2}));
}

TEST(NormalTile, TheSteepestHeightsThereCanBeAreFiniteSlopes) {
    PlanetShape shape = shapeOf(8, 4);
    shape.radiusM = 1;
    shape.quantumM = 1000;
    const MadeChunks made(shape, [](const glm::dvec3& d) {
        return std::fmod(std::floor(1e4 * d.x) + std::floor(1e4 * d.y), 2) == 0 ? 3.2e7 : -3.2e7;
    });
    const TileData tile = deriverOf(made)->tile({Face::PosZ, 0, 0, 0}).value();
    float most = 0;
    for (int j = 0; j < tileTexels; ++j) {
        for (int i = 0; i < tileTexels; ++i) {
            for (const float slope : slopeOfTexel(tile, i, j)) {
                ASSERT_TRUE(std::isfinite(slope));
                most = std::max(most, std::abs(slope));
            }
        }
    }
    EXPECT_GT(most, 50'000);
}

TEST(NormalTile, ThereAreNoneWhereFacesAreSmallerThanATile) {
    EXPECT_EQ(normalLeafLevel(shapeOf(4, 4)), -1);
    EXPECT_EQ(normalLeafLevel(shapeOf(7, 4)), -1);
    EXPECT_EQ(normalLeafLevel(shapeOf(8, 7)), 0);
    EXPECT_EQ(normalLeafLevel(shapeOf(12, 5)), 4);
    EXPECT_EQ(normalLeafLevel(shapeOf(22, 7)), maxTileLevel);
}

}  // namespace
}  // namespace planet
