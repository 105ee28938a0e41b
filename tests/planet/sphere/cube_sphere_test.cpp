#include "planet/sphere/cube_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace planet {
namespace {

std::mt19937 seeded() {
    return std::mt19937(20240607);
}

TEST(CubeSphere, FaceAxesAreRightHanded) {
    for (const Face face : allFaces) {
        const FaceAxes& axes = faceAxes(face);
        EXPECT_EQ(glm::cross(axes.u, axes.v), axes.normal) << faceName(face);
    }
}

TEST(CubeSphere, MappedPointsLieOnTheUnitSphere) {
    std::mt19937 random = seeded();
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int i = 0; i < 10000; ++i) {
        const Face face = allFaces[static_cast<std::size_t>(i) % allFaces.size()];
        const glm::dvec3 d = sphereFromCube(cubePoint(face, coordinate(random), coordinate(random)));
        EXPECT_NEAR(glm::length(d), 1, 4e-16);
    }
}

TEST(CubeSphere, MatchesNowellsFormulaInExtendedPrecision) {
    std::mt19937 random = seeded();
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int i = 0; i < 10000; ++i) {
        const Face face = allFaces[static_cast<std::size_t>(i) % allFaces.size()];
        const glm::dvec3 p = cubePoint(face, coordinate(random), coordinate(random));
        const glm::dvec3 d = sphereFromCube(p);
        const auto reference = [](long double a, long double b, long double c) {
            return static_cast<double>(a * std::sqrt(1 - b * b / 2 - c * c / 2 + b * b * c * c / 3));
        };
        EXPECT_NEAR(d.x, reference(p.x, p.y, p.z), 3e-16);
        EXPECT_NEAR(d.y, reference(p.y, p.z, p.x), 3e-16);
        EXPECT_NEAR(d.z, reference(p.z, p.x, p.y), 3e-16);
    }
}

TEST(CubeSphere, FacesMeetBitForBitAlongTheirEdges) {
    constexpr int cells = 64;
    int shared = 0;
    for (const Face a : allFaces) {
        for (const Face b : allFaces) {
            if (a == b) continue;
            for (int i = 0; i <= cells; ++i) {
                const double t = 2.0 * i / cells - 1;
                for (const auto& [u, v] : {std::pair{t, 1.0}, {t, -1.0}, {1.0, t}, {-1.0, t}}) {
                    const glm::dvec3 p = cubePoint(a, u, v);
                    if (glm::dot(p, faceAxes(b).normal) != 1) continue;
                    const glm::dvec3 q = cubePoint(b, glm::dot(p, faceAxes(b).u), glm::dot(p, faceAxes(b).v));
                    EXPECT_EQ(p, q);
                    EXPECT_EQ(sphereFromCube(p), sphereFromCube(q));
                    ++shared;
                }
            }
        }
    }
    EXPECT_GE(shared, 6 * 4 * (cells + 1));
}

TEST(CubeSphere, InverseReturnsThePointItCameFrom) {
    std::mt19937 random = seeded();
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int i = 0; i < 60000; ++i) {
        // Every third on a small square about the middle, where the closed form alone loses digits.
        const double scale = i % 3 == 0 ? 1e-5 : 1;
        const Face face = allFaces[static_cast<std::size_t>(i) % allFaces.size()];
        const glm::dvec3 p = cubePoint(face, scale * coordinate(random), scale * coordinate(random));
        EXPECT_LT(glm::length(cubeFromSphere(sphereFromCube(p) * 6.4e6) - p), 1e-14);
    }
}

TEST(CubeSphere, InverseHoldsOnEdgesAndCorners) {
    for (const Face face : allFaces) {
        for (const double u : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
            for (const double v : {-1.0, 1.0}) {
                const glm::dvec3 p = cubePoint(face, u, v);
                EXPECT_LT(glm::length(cubeFromSphere(sphereFromCube(p)) - p), 1e-14);
            }
        }
    }
}

TEST(CubeSphere, PolesAndMeridiansAreWhereTheHeaderSays) {
    EXPECT_LT(glm::length(directionFromGeographic({std::numbers::pi / 2, 0}) - glm::dvec3(0, 0, 1)), 1e-15);
    EXPECT_LT(glm::length(directionFromGeographic({0, 0}) - glm::dvec3(1, 0, 0)), 1e-15);
    EXPECT_LT(glm::length(directionFromGeographic({0, std::numbers::pi / 2}) - glm::dvec3(0, 1, 0)), 1e-15);
    const Geographic back = geographicFromDirection(directionFromGeographic({0.3, -2.9}) * 17.0);
    EXPECT_NEAR(back.latitudeRad, 0.3, 1e-15);
    EXPECT_NEAR(back.longitudeRad, -2.9, 1e-15);
}

TEST(CubeSphere, FaceNamesRoundTripAndOthersAreRefused) {
    for (const Face face : allFaces) EXPECT_EQ(faceFromName(faceName(face)), face);
    EXPECT_EQ(faceFromName("w_pos"), std::nullopt);
}

}  // namespace
}  // namespace planet
