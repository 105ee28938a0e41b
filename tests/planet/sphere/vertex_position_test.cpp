#include "planet/sphere/vertex_position.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <vector>

namespace planet {
namespace {

struct StoredVertex {
    Face face;
    std::int32_t gridU, gridV;
    std::int32_t step;
};

PlanetShape finestEarth() {
    PlanetShape shape;
    shape.faceCellsLog2 = maxFaceCellsLog2;
    return shape;
}

glm::dvec3 reference(const PlanetShape& shape, const StoredVertex& vertex) {
    const double cell = 2.0 / (1 << fineGridLog2);
    const glm::dvec3 cube = cubePoint(vertex.face, vertex.gridU * cell - 1, vertex.gridV * cell - 1);
    return positionM(shape, sphereFromCube(cube), heightM(shape, vertex.step));
}

double errorM(const PlanetShape& shape, const glm::dvec3& eyeM, const StoredVertex& vertex) {
    const VertexFrame frame = vertexFrame(shape, eyeM);
    const glm::dvec3 position = vertexFromEyeM(frame, vertex.face, vertex.gridU, vertex.gridV, vertex.step);
    return glm::length(position - (reference(shape, vertex) - eyeM));
}

class VertexPosition : public testing::Test {
protected:
    glm::dvec3 randomOffset(double lengthM) {
        std::normal_distribution<double> normal;
        const glm::dvec3 direction(normal(random_), normal(random_), normal(random_));
        return lengthM * glm::normalize(direction);
    }
    // Among the middle, edges and corners of faces as often as anywhere.
    std::int32_t randomGridLine(std::int32_t reach) {
        const std::int32_t side = 1 << fineGridLog2;
        std::uniform_int_distribution<int> kind(0, 3);
        std::uniform_int_distribution<std::int32_t> near(0, reach);
        std::uniform_int_distribution<std::int32_t> anywhere(0, side);
        switch (kind(random_)) {
            case 0:
                return near(random_);
            case 1:
                return side - near(random_);
            case 2:
                return side / 2 + near(random_);
            default:
                return anywhere(random_);
        }
    }
    StoredVertex randomVertex() {
        std::uniform_int_distribution<int> face(0, faceCount - 1);
        std::uniform_int_distribution<int> step(-11000, 9000);
        return {static_cast<Face>(face(random_)), randomGridLine(100), randomGridLine(100), step(random_)};
    }
    std::mt19937 random_{7};
};

TEST_F(VertexPosition, NearTheEyeIsWithinAMillimetre) {
    const PlanetShape shape = finestEarth();
    std::uniform_real_distribution<double> distance(1, 2000);
    for (int i = 0; i < 20000; ++i) {
        const StoredVertex vertex = randomVertex();
        const glm::dvec3 eyeM = reference(shape, vertex) + randomOffset(distance(random_));
        EXPECT_LT(errorM(shape, eyeM, vertex), 1e-3)
            << faceName(vertex.face) << " " << vertex.gridU << " " << vertex.gridV;
    }
}

TEST_F(VertexPosition, ErrorGrowsNoFasterThanDistance) {
    const PlanetShape shape = finestEarth();
    std::uniform_real_distribution<double> exponent(2, 8.5);
    for (int i = 0; i < 20000; ++i) {
        const StoredVertex vertex = randomVertex();
        const double away = std::pow(10.0, exponent(random_));
        const glm::dvec3 eyeM = reference(shape, vertex) + randomOffset(away);
        EXPECT_LT(errorM(shape, eyeM, vertex), 4e-7 * away) << faceName(vertex.face) << " " << away;
    }
}

TEST_F(VertexPosition, FineQuantumAndABaseHeightLoseNothing) {
    PlanetShape shape = finestEarth();
    shape.quantumM = 0.1;
    shape.baseHeightM = 1234.567;
    for (int i = 0; i < 5000; ++i) {
        const StoredVertex vertex = randomVertex();
        const glm::dvec3 eyeM = reference(shape, vertex) + randomOffset(900);
        EXPECT_LT(errorM(shape, eyeM, vertex), 1e-3);
    }
}

TEST_F(VertexPosition, FractionsOfTheQuantumLoseNothing) {
    PlanetShape shape = finestEarth();
    shape.fractionBits = 8;
    shape.quantumM = 1.0 / 256;
    std::uniform_int_distribution<std::int32_t> step(-11000 * 256, 9000 * 256);
    for (int i = 0; i < 5000; ++i) {
        StoredVertex vertex = randomVertex();
        vertex.step = step(random_);
        const glm::dvec3 eyeM = reference(shape, vertex) + randomOffset(900);
        EXPECT_LT(errorM(shape, eyeM, vertex), 1e-3);
    }
}

TEST_F(VertexPosition, TheSkirtHangsTowardsTheCentre) {
    const PlanetShape shape = finestEarth();
    for (int i = 0; i < 1000; ++i) {
        const StoredVertex vertex = randomVertex();
        const glm::dvec3 eyeM = reference(shape, vertex) + randomOffset(500);
        const glm::dvec3 dropped = vertexFromEyeM(vertexFrame(shape, eyeM), vertex.face, vertex.gridU,
                                                  vertex.gridV, vertex.step, 250);
        const glm::dvec3 expected =
            reference(shape, vertex) - 250.0 * glm::normalize(reference(shape, vertex)) - eyeM;
        EXPECT_LT(glm::length(dropped - expected), 1e-3);
    }
}

// Every place on the cube's edges is reached from two faces, a corner from three.
TEST_F(VertexPosition, FacesMakeTheSameOfTheVerticesTheyShare) {
    const PlanetShape shape = finestEarth();
    constexpr std::int32_t side = 1 << fineGridLog2;
    const VertexFrame frame = vertexFrame(shape, {4e6, 3e6, 4.5e6});
    std::map<std::array<double, 3>, std::vector<glm::vec3>> byPlace;
    for (const Face face : allFaces) {
        for (const std::int32_t along : {0, 1, 1234567, side / 2, 3 * side / 4, side - 1, side}) {
            for (const auto& [u, v] : {std::pair{along, 0},
                                       {along, side},
                                       {0, along},
                                       {side, along},
                                       {side - along, side},
                                       {side, side - along},
                                       {side - along, 0},
                                       {0, side - along}}) {
                const glm::dvec3 cube = cubePoint(face, u * 2.0 / side - 1, v * 2.0 / side - 1);
                byPlace[{cube.x, cube.y, cube.z}].push_back(vertexFromEyeM(frame, face, u, v, 77));
                const FineGridPoint owner = onOwningFace({face, u, v});
                EXPECT_EQ(cubePoint(owner.face, owner.gridU * 2.0 / side - 1, owner.gridV * 2.0 / side - 1),
                          cube);
                EXPECT_EQ(owner.face, facePointFromCube(cube).face);
            }
        }
    }
    EXPECT_EQ(byPlace.size(), 12u * 7 + 8);
    for (const auto& [place, positions] : byPlace) {
        EXPECT_GE(positions.size(), 2u);
        for (const glm::vec3& position : positions) EXPECT_EQ(position, positions.front());
    }
    const FineGridPoint inside{Face::NegZ, 1, side - 1};
    EXPECT_EQ(onOwningFace(inside), inside);
}

TEST_F(VertexPosition, AnEyeAtTheCentreIsNoTrouble) {
    const PlanetShape shape = finestEarth();
    EXPECT_LT(errorM(shape, {0, 0, 0}, {Face::PosZ, 0, 0, 0}), 4e-7 * shape.radiusM);
}

}  // namespace
}  // namespace planet
