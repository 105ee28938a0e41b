#include "planet/sphere/bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "planet/tree/sphere_polygon.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/random_view.h"

namespace planet {
namespace {

// Chunks of all levels and faces: corners and middles of faces, and others at random.
std::vector<ChunkId> manyChunks(std::mt19937& random) {
    std::vector<ChunkId> ids;
    for (const Face face : allFaces) {
        for (int level = 0; level <= maxLevel; ++level) {
            const std::uint32_t last = (1u << level) - 1;
            const auto l = static_cast<std::uint8_t>(level);
            ids.push_back({face, l, 0, 0});
            ids.push_back({face, l, last, last / 2});
            ids.push_back({face, l, last / 2, last / 2});
            for (int i = 0; i < 4; ++i) {
                std::uniform_int_distribution<std::uint32_t> coordinate(0, last);
                ids.push_back({face, l, coordinate(random), coordinate(random)});
            }
        }
    }
    return ids;
}

// The library computes many directions at once.
TEST(Bounds, HaveTheBitsOfSampledDirections) {
    std::mt19937 random(2);
    constexpr int cells = 8;
    for (const ChunkId& id : manyChunks(random)) {
        const ChunkDirections directions = chunkDirections(id);
        const FaceSquare square = faceSquareOf(id);
        glm::dvec3 low(2), high(-2);
        double chord = 0;
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const glm::dvec3 direction = sphereFromCube(cubePoint(
                    id.face, square.u + square.side * i / cells, square.v + square.side * j / cells));
                for (int a = 0; a < 3; ++a) {
                    const double along = glm::dot(directions.axes[static_cast<std::size_t>(a)], direction);
                    low[a] = std::min(low[a], along);
                    high[a] = std::max(high[a], along);
                }
                chord = std::max(chord, glm::length(direction - directions.cone.axis));
            }
        }
        const double g = square.side / cells;
        const double margin = g * g / 8 * 3 + 1e-14;
        for (int a = 0; a < 3; ++a) {
            EXPECT_EQ(directions.low[a], low[a] - margin) << toString(id);
            EXPECT_EQ(directions.high[a], std::min(high[a] + margin, 1 + 1e-14)) << toString(id);
        }
        EXPECT_EQ(directions.cone.halfAngleRad, 2 * std::asin(std::min(1.0, (chord + margin) / 2)))
            << toString(id);
    }
}

TEST(Bounds, HoldEveryPointOfTheChunkAtEveryHeight) {
    std::mt19937 random(1);
    constexpr double radiusM = 6.371e6;
    constexpr double lowM = -11000;
    constexpr double highM = 9000;
    constexpr int dense = 48;  // no multiple of what the bounds sample, nor a divisor
    for (const ChunkId& id : manyChunks(random)) {
        const ChunkBounds bounds = chunkBounds(id, radiusM, lowM, highM);
        const FaceSquare square = faceSquareOf(id);
        double farthestM = 0;
        double widestRad = 0;
        for (int j = 0; j <= dense; ++j) {
            for (int i = 0; i <= dense; ++i) {
                const glm::dvec3 direction = sphereFromCube(cubePoint(
                    id.face, square.u + square.side * i / dense, square.v + square.side * j / dense));
                for (const double height : {lowM, 0.0, highM}) {
                    farthestM = std::max(farthestM, distanceM(bounds.box, (radiusM + height) * direction));
                }
                widestRad = std::max(widestRad, angleBetweenRad(bounds.cone.axis, direction));
            }
        }
        EXPECT_EQ(farthestM, 0) << toString(id);
        EXPECT_LE(widestRad, bounds.cone.halfAngleRad) << toString(id);
        EXPECT_EQ(bounds.maxRadiusM, radiusM + highM);
    }
}

// The extent of the chunk itself along the box's axes, against the box.
TEST(Bounds, AreTight) {
    std::mt19937 random(2);
    constexpr double radiusM = 6.371e6;
    constexpr int dense = 32;
    for (const ChunkId& id : manyChunks(random)) {
        if (id.level > 12) continue;
        const ChunkBounds bounds = chunkBounds(id, radiusM, 0, 0);
        const FaceSquare square = faceSquareOf(id);
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        double widestRad = 0;
        for (int j = 0; j <= dense; ++j) {
            for (int i = 0; i <= dense; ++i) {
                const glm::dvec3 direction = sphereFromCube(cubePoint(
                    id.face, square.u + square.side * i / dense, square.v + square.side * j / dense));
                widestRad = std::max(widestRad, angleBetweenRad(bounds.cone.axis, direction));
                for (int a = 0; a < 3; ++a) {
                    const double along = radiusM * glm::dot(direction, bounds.box.axes[std::size_t(a)]);
                    low[a] = std::min(low[a], along);
                    high[a] = std::max(high[a], along);
                }
            }
        }
        const glm::dvec3 extent = (high - low) / 2.0;
        for (int a = 0; a < 2; ++a) EXPECT_LE(bounds.box.halfSizeM[a], 1.05 * extent[a]) << toString(id);
        // Across, where the extent is the sagitta alone.
        EXPECT_LE(bounds.box.halfSizeM[2], 1.12 * extent[2] + 1e-5) << toString(id);
        EXPECT_LE(bounds.cone.halfAngleRad, 1.05 * widestRad + 1e-12) << toString(id);
    }
}

TEST(Bounds, HoldEveryVertexOfEveryChunkBelow) {
    const FakePyramid& pyramid = fakePyramid();
    for (const auto& [id, chunk] : pyramid.chunks) {
        for (ChunkId above = id;; above = parentOf(above)) {
            const ChunkData& data = pyramid.at(above);
            const ChunkBounds bounds =
                chunkBounds(above, pyramid.shape.radiusM, heightM(pyramid.shape, data.minStep),
                            heightM(pyramid.shape, data.maxStep));
            for (int row = 0; row <= 16; row += 4) {
                for (int column = 0; column <= 16; column += 4) {
                    const glm::dvec3 vertex = vertexM(pyramid.shape, chunk, column, row);
                    ASSERT_EQ(distanceM(bounds.box, vertex), 0);
                    ASSERT_LE(glm::length(vertex), bounds.maxRadiusM * (1 + 1e-15));
                }
            }
            if (above.level == 0) break;
        }
    }
}

TEST(Bounds, BoxDistanceIsTheDistanceToItsNearestPoint) {
    OrientedBox box;
    box.centreM = {10, 20, 30};
    box.axes = {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)};
    box.halfSizeM = {1, 2, 3};
    EXPECT_EQ(distanceM(box, {10, 20, 30}), 0);
    EXPECT_EQ(distanceM(box, {13, 21, 32}), 0);
    EXPECT_EQ(distanceM(box, {10, 26, 30}), 5);
    EXPECT_EQ(distanceM(box, {10, 24, 36}), 5);  // 3 along y, 4 along z
    EXPECT_EQ(distanceM(box, {0, 20, 30}), 7);
}

TEST(Bounds, BoxesAreClassifiedByTheirCorners) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::array<int, 3> seen{};
    for (int i = 0; i < 3000; ++i) {
        const OrientedBox box = chunkBounds({Face::NegY, 2, 1, 3}, 1000, -20 + 10 * unit(random), 30).box;
        const glm::dvec3 normal = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        const Plane plane{normal, -glm::dot(normal, box.centreM) + 600 * unit(random)};
        int inside = 0;
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 point = box.centreM;
            for (int a = 0; a < 3; ++a) {
                const double sign = (corner >> a) & 1 ? 1 : -1;
                point += sign * box.halfSizeM[a] * box.axes[std::size_t(a)];
            }
            inside += glm::dot(plane.normal, point) + plane.offsetM >= 0;
        }
        const Containment expected = inside == 0   ? Containment::Outside
                                     : inside == 8 ? Containment::Inside
                                                   : Containment::Crossing;
        EXPECT_EQ(classify(box, plane), expected);
        ++seen[static_cast<std::size_t>(expected)];
    }
    for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(Bounds, HorizonHidesOnlyWhatTheOccluderHides) {
    std::mt19937 random(4);
    constexpr double radiusM = 1e5;
    constexpr double occluderM = 0.97e5;
    std::array<int, 3> seen{};
    for (int i = 0; i < 20000; ++i) {
        const View view = randomView(random, radiusM);
        std::uniform_int_distribution<int> levels(0, 6);
        const int level = levels(random);
        std::uniform_int_distribution<std::uint32_t> coordinate(0, (1u << level) - 1);
        const ChunkId id{allFaces[static_cast<std::size_t>(i) % 6], static_cast<std::uint8_t>(level),
                         coordinate(random), coordinate(random)};
        const double highM = 1000.0 * (i % 5);
        const ChunkBounds bounds = chunkBounds(id, radiusM, 0, highM);
        const Containment where = classify(bounds, horizonOf(view.eyeM, occluderM));
        ++seen[static_cast<std::size_t>(where)];
        if (where == Containment::Crossing) continue;
        const FaceSquare square = faceSquareOf(id);
        for (int j = 0; j <= 6; ++j) {
            for (int k = 0; k <= 6; ++k) {
                const glm::dvec3 direction = sphereFromCube(
                    cubePoint(id.face, square.u + square.side * j / 6, square.v + square.side * k / 6));
                const bool hidden = sphereHides(view.eyeM, (radiusM + highM) * direction, occluderM);
                EXPECT_EQ(hidden, where == Containment::Outside);
            }
        }
    }
    for (const int count : seen) EXPECT_GT(count, 1000);
}

// A mountain's top that just clears the horizon is seen, one that just does not is hidden.
TEST(Bounds, HorizonIsExactForTheCone) {
    constexpr double occluderM = 1e6;
    const glm::dvec3 eye(1.1e6, 0, 0);
    const double reach = std::acos(1 / 1.1) + std::acos(1 / 1.05);
    for (const double beyond : {-1e-9, 1e-9}) {
        ChunkBounds bounds;
        bounds.maxRadiusM = 1.05e6;
        bounds.cone.halfAngleRad = 0.01;
        bounds.coneSine = std::sin(0.01);
        const double angle = reach + 0.01 + beyond;
        bounds.cone.axis = {std::cos(angle), std::sin(angle), 0};
        EXPECT_EQ(classify(bounds, horizonOf(eye, occluderM)) == Containment::Outside, beyond > 0);
    }
}

// Cosines are compared instead of angles, which must not change the answer.
TEST(Bounds, TheHorizonIsClassifiedAsTheAnglesSay) {
    constexpr double radiusM = 6.4e6;
    std::mt19937 random(33);
    std::uniform_real_distribution<double> exponent(-9, 1), share(0, 1);
    std::uniform_int_distribution<int> levels(0, 20);
    std::normal_distribution<double> gauss;
    std::array<int, 3> seen{};
    for (int i = 0; i < 200'000; ++i) {
        const int level = levels(random);
        const auto coordinate = [&] {
            return static_cast<std::uint32_t>(share(random) * static_cast<double>((1u << level) - 1));
        };
        const ChunkId id{allFaces[static_cast<std::size_t>(i) % 6], static_cast<std::uint8_t>(level),
                         coordinate(), coordinate()};
        const double highM = 9000 * share(random);
        const ChunkBounds bounds = chunkBounds(id, radiusM, 0, highM);
        const double occluderM = radiusM * (0.9 + 0.1 * share(random));
        // Half of the eyes are close over the chunk, on a scale of the chunk or of its distance to the horizon.
        const glm::dvec3 towards(gauss(random), gauss(random), gauss(random));
        const double apart = i % 2 ? 10 : std::pow(10.0, exponent(random));
        const glm::dvec3 eyeM = glm::normalize(bounds.cone.axis + apart * towards) * radiusM *
                                (1 + std::pow(10.0, exponent(random)));
        const Horizon horizon = horizonOf(eyeM, occluderM);
        if (horizon.seesAll) continue;

        const auto angleOf = [](long double adjacent, long double hypotenuse) {
            return std::atan2(std::sqrt((hypotenuse - adjacent) * (hypotenuse + adjacent)), adjacent);
        };
        const long double touch = angleOf(occluderM, glm::length(eyeM));
        const long double top = angleOf(occluderM, std::max(bounds.maxRadiusM, occluderM));
        const glm::dvec3 across = glm::cross(horizon.eyeDirection, bounds.cone.axis);
        const long double toAxis =
            std::atan2(static_cast<long double>(glm::length(across)),
                       static_cast<long double>(glm::dot(horizon.eyeDirection, bounds.cone.axis)));
        const long double inner = touch - bounds.cone.halfAngleRad - toAxis;
        const long double outer = touch + top + bounds.cone.halfAngleRad - toAxis;
        if (std::abs(inner) < 1e-12L || std::abs(outer) < 1e-12L) continue;
        const Containment expected = inner > 0   ? Containment::Inside
                                     : outer < 0 ? Containment::Outside
                                                 : Containment::Crossing;
        ++seen[static_cast<std::size_t>(expected)];
        ASSERT_EQ(classify(bounds, horizon), expected)
            << toString(id) << ", eye at " << glm::length(eyeM) << " m, inner " << static_cast<double>(inner)
            << ", outer " << static_cast<double>(outer);
    }
    for (const int count : seen) EXPECT_GT(count, 1000);
}

TEST(Bounds, AnEyeInsideTheOccluderSeesEverything) {
    const ChunkBounds bounds = chunkBounds({Face::NegX, 5, 16, 16}, 1e6, 0, 0);
    EXPECT_EQ(classify(bounds, horizonOf({0.9e6, 0, 0}, 0.95e6)), Containment::Inside);
    EXPECT_EQ(classify(bounds, horizonOf({0, 0, 0}, 0.95e6)), Containment::Inside);
    EXPECT_EQ(classify(bounds, horizonOf({0.96e6, 0, 0}, 0.95e6)), Containment::Outside);
}

// Of a triangle whose corners lie on the unit sphere: at the foot of the perpendicular from the centre where
// that is inside, else at the middle of the longest edge.
double nearestRadius(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const glm::dvec3 foot = glm::dot(normal, a) * normal;
    const auto leftOf = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(glm::cross(q - p, foot - p), normal) >= 0;
    };
    if (leftOf(a, b) && leftOf(b, c) && leftOf(c, a)) return glm::length(foot);
    return std::min({glm::length(a + b), glm::length(b + c), glm::length(c + a)}) / 2;
}

TEST(Bounds, TheOccluderLiesInsideEveryTriangle) {
    for (const int rootCells : {16, 32}) {
        const double inside = radiusInsideTriangles(1, rootCells);
        double nearest = 1;
        for (const int cells : {rootCells, 2 * rootCells, 8 * rootCells}) {
            const auto vertex = [&](int i, int j) {
                return sphereFromCube(cubePoint(Face::NegZ, 2.0 * i / cells - 1, 2.0 * j / cells - 1));
            };
            for (int j = 0; j < cells; ++j) {
                for (int i = 0; i < cells; ++i) {
                    for (const bool south : {true, false}) {
                        const glm::dvec3 a = vertex(i, j);
                        const glm::dvec3 b = south ? vertex(i + 1, j) : vertex(i + 1, j + 1);
                        const glm::dvec3 c = south ? vertex(i + 1, j + 1) : vertex(i, j + 1);
                        nearest = std::min(nearest, nearestRadius(a, b, c));
                    }
                }
            }
        }
        EXPECT_LT(inside, nearest);
        EXPECT_LT(1 - inside, 1.5 * (1 - nearest));  // and not by much
    }
}

}  // namespace
}  // namespace planet
