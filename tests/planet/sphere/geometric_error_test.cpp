#include "planet/sphere/geometric_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace planet {
namespace {

struct Grid {
    PlanetShape shape;
    ChunkId chunk;
    std::vector<std::int16_t> steps;

    Grid(const ChunkId& id, int faceCellsLog2 = 11) : chunk(id) {
        shape.faceCellsLog2 = faceCellsLog2;
        steps.assign(side() * side(), 0);
    }
    std::size_t side() const { return static_cast<std::size_t>(2 * chunkCells(shape) + 1); }
    glm::dvec3 direction(std::size_t i, std::size_t j) const {
        const FaceSquare square = faceSquareOf(chunk);
        const double step = square.side / static_cast<double>(side() - 1);
        return sphereFromCube(cubePoint(chunk.face, square.u + step * static_cast<double>(i),
                                        square.v + step * static_cast<double>(j)));
    }
    glm::dvec3 position(std::size_t i, std::size_t j) const {
        return positionM(shape, direction(i, j), heightM(shape, steps[j * side() + i]));
    }
    double error() const {
        GeometricErrorScratch scratch;
        return geometricErrorM(shape, chunk, steps, scratch);
    }
};

// A chunk of a level beside the middle of its face.
ChunkId nearMiddle(Face face, int level) {
    return chunkAt({face, 1e-9, 1e-9}, level);
}

TEST(GeometricError, bareSphereHasTheSagittaOfACellsDiagonal) {
    for (const Face face : allFaces) {
        for (int level = 3; level <= 6; ++level) {
            const Grid grid(nearMiddle(face, level));
            double largestAngle = 0;
            for (std::size_t j = 0; j + 2 < grid.side(); j += 2) {
                for (std::size_t i = 0; i + 2 < grid.side(); i += 2) {
                    const double cosine = glm::dot(grid.direction(i, j), grid.direction(i + 2, j + 2));
                    largestAngle = std::max(largestAngle, std::acos(std::min(1.0, cosine)));
                }
            }
            const double sagittaM = grid.shape.radiusM * (1 - std::cos(largestAngle / 2));
            EXPECT_NEAR(grid.error() / sagittaM, 1, 0.02) << toString(grid.chunk);
        }
    }
}

TEST(GeometricError, bareSphereIsNeverBelowTheSagittaAnywhere) {
    for (const ChunkId id :
         {ChunkId{Face::PosX, 0, 0, 0}, ChunkId{Face::NegZ, 2, 3, 3}, ChunkId{Face::PosY, 3, 0, 4}}) {
        const Grid grid(id);
        double sagittaM = 0;
        for (std::size_t j = 1; j < grid.side(); j += 2) {
            for (std::size_t i = 1; i < grid.side(); i += 2) {
                const glm::dvec3 chord = (grid.position(i - 1, j - 1) + grid.position(i + 1, j + 1)) / 2.0;
                sagittaM = std::max(sagittaM, grid.shape.radiusM - glm::length(chord));
            }
        }
        EXPECT_GE(grid.error(), sagittaM) << toString(id);
        EXPECT_LE(grid.error(), sagittaM * 2)
            << toString(id);  // the map's stretch at a corner adds less than that
    }
}

TEST(GeometricError, singleSpikeIsItsOwnHeight) {
    // One spike on each kind of removed vertex: west-east edge, south-north edge, diagonal.
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{31, 20}, {40, 33}, {17, 45}}) {
        Grid grid(nearMiddle(Face::PosY, 6));
        const double sphereAlone = grid.error();
        grid.steps[j * grid.side() + i] = 3000;
        EXPECT_NEAR(grid.error(), 3000, 2 * sphereAlone);
    }
}

TEST(GeometricError, spikeThatTheParentKeepsTiltsItsNeighboursHalfway) {
    Grid grid(nearMiddle(Face::PosY, 6));
    const double sphereAlone = grid.error();
    grid.steps[32 * grid.side() + 30] = 3000;
    EXPECT_NEAR(grid.error(), 1500, 2 * sphereAlone);
}

TEST(GeometricError, planeHasNoErrorBeyondRounding) {
    // The heights that turn a piece of the sphere into the plane x = R + 10 m, at 1 cm a step.
    Grid grid(nearMiddle(Face::PosX, 8), 13);
    grid.shape.quantumM = 0.01;
    for (std::size_t j = 0; j < grid.side(); ++j) {
        for (std::size_t i = 0; i < grid.side(); ++i) {
            const double height = (grid.shape.radiusM + 10) / grid.direction(i, j).x - grid.shape.radiusM;
            grid.steps[j * grid.side() + i] =
                static_cast<std::int16_t>(std::lround(height / grid.shape.quantumM));
        }
    }
    EXPECT_GT(*std::max_element(grid.steps.begin(), grid.steps.end()), 2000);  // it is really tilted
    EXPECT_LT(grid.error(), 0.015);
}

TEST(GeometricError, matchesTheTrianglesDrawnInTheWorldsAxes) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> height(-8000, 8000);
    for (const Face face : allFaces) {
        Grid grid({face, 2, 1, 3});
        for (std::int16_t& step : grid.steps) step = static_cast<std::int16_t>(height(random));
        double largest = 0;
        for (std::size_t j = 0; j < grid.side(); ++j) {
            for (std::size_t i = 0; i < grid.side(); ++i) {
                const std::size_t di = i % 2;
                const std::size_t dj = j % 2;
                if (di + dj == 0) continue;
                const glm::dvec3 middle =
                    (grid.position(i - di, j - dj) + grid.position(i + di, j + dj)) / 2.0;
                largest = std::max(largest, glm::length(grid.position(i, j) - middle));
            }
        }
        EXPECT_NEAR(grid.error(), largest, 1e-6);
    }
}

TEST(GeometricError, partOfAFinerGridHasTheSameBits) {
    // The grids of a chunk, of its children and of theirs, as parts of one grid with every sample of the last.
    constexpr int levels = 3;
    std::mt19937 random(11);
    std::uniform_int_distribution<int> height(-8000, 8000);
    const ChunkId top{Face::NegY, 3, 2, 5};
    const Grid any(top);
    const std::size_t cells = any.side() - 1;
    const std::size_t side = (cells << (levels - 1)) + 1;
    std::vector<std::int16_t> finestSteps(side * side);
    for (std::int16_t& step : finestSteps) step = static_cast<std::int16_t>(height(random));
    GeometricErrorScratch positions;
    facePositions(any.shape, faceSquareOf(top), side, finestSteps, positions);
    for (int below = 0; below < levels; ++below) {
        const std::size_t stride = std::size_t{1} << (levels - 1 - below);
        for (std::uint32_t y = 0; y < 1u << below; ++y) {
            for (std::uint32_t x = 0; x < 1u << below; ++x) {
                Grid own({top.face, static_cast<std::uint8_t>(top.level + below), (top.x << below) + x,
                          (top.y << below) + y});
                const RefinedSquare square{x * cells * stride, y * cells * stride, stride, cells};
                for (std::size_t j = 0; j <= cells; ++j) {
                    for (std::size_t i = 0; i <= cells; ++i) {
                        own.steps[j * own.side() + i] = finestSteps[(square.firstRow + j * stride) * side +
                                                                    square.firstColumn + i * stride];
                    }
                }
                EXPECT_EQ(geometricErrorOnGridM(positions, side, square), own.error()) << toString(own.chunk);
            }
        }
    }
}

TEST(GeometricError, otherDiagonalWouldBeMeasuredDifferently) {
    // A ridge along the drawn diagonals costs nothing; the same ridge across them does.
    Grid along(nearMiddle(Face::PosX, 6));
    Grid across(nearMiddle(Face::PosX, 6));
    for (std::size_t k = 0; k < along.side(); ++k) {
        along.steps[k * along.side() + k] = 1000;
        across.steps[k * along.side() + (along.side() - 1 - k)] = 1000;
    }
    EXPECT_GT(across.error(), 900);
    EXPECT_LT(along.error(), 600);  // beside the ridge, edge middles lie half-way up
}

TEST(GeometricError, roundedUpIsNeverBelow) {
    for (const double value : {0.1, 1.0 / 3, 12345.678901234, 0.0}) {
        EXPECT_GE(static_cast<double>(roundedUp(value)), value);
        EXPECT_NEAR(roundedUp(value), value, 1e-6 * value + 1e-30);
    }
}

}  // namespace
}  // namespace planet
