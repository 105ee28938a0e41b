#include "planet/measure/pick.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"

namespace planet {
namespace {

Selection select(const ChunkTree& tree, const View& view, double tauPx, bool culling) {
    LodSettings settings = withoutCulling(tauPx);
    settings.frustumCulling = settings.horizonCulling = culling;
    return select(tree, view, settings);
}

glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// Moller and Trumbore 1997: the distance, or infinity; from the front only.
double hitFromAboveM(const glm::dvec3& eyeM, const glm::dvec3& along, const glm::dvec3& a,
                     const glm::dvec3& b, const glm::dvec3& c) {
    const double miss = std::numeric_limits<double>::infinity();
    const glm::dvec3 cross = glm::cross(along, c - a);
    const double determinant = glm::dot(b - a, cross);
    if (determinant <= 0) return miss;
    const double u = glm::dot(eyeM - a, cross) / determinant;
    const glm::dvec3 other = glm::cross(eyeM - a, b - a);
    const double v = glm::dot(along, other) / determinant;
    const double t = glm::dot(c - a, other) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 ? t : miss;
}

// Over all triangles of all chunks.
std::optional<SurfaceHit> pickByTryingAll(const ChunkTree& tree, const Selection& selection,
                                          const glm::dvec3& eyeM, const glm::dvec3& along) {
    SurfaceHit hit;
    hit.distanceM = std::numeric_limits<double>::infinity();
    const int cells = chunkCells(tree.shape);
    for (const DrawItem& item : selection.draw) {
        const ChunkNode& node = tree.nodes[item.node];
        std::vector<glm::dvec3> vertices;
        for (int j = 0; j <= cells; ++j) {
            for (int i = 0; i <= cells; ++i) {
                const auto at = static_cast<std::size_t>(j * (cells + 1) + i);
                vertices.push_back(
                    vertexM(tree.shape, item.id, i, j, heightM(tree.shape, (*node.heights)[at])));
            }
        }
        for (int j = 0; j < cells; ++j) {
            for (int i = 0; i < cells; ++i) {
                const glm::dvec3* const sw = &vertices[static_cast<std::size_t>(j * (cells + 1) + i)];
                const glm::dvec3* const nw = sw + cells + 1;
                const double distanceM = std::min(hitFromAboveM(eyeM, along, *sw, sw[1], nw[1]),
                                                  hitFromAboveM(eyeM, along, *sw, nw[1], *nw));
                if (distanceM >= hit.distanceM) continue;
                hit.distanceM = distanceM;
                hit.id = item.id;
                hit.node = item.node;
            }
        }
    }
    if (hit.node == noNode) return std::nullopt;
    return hit;
}

TEST(PickSurface, AgreesWithTryingAllTriangles) {
    std::mt19937 random(51);
    std::uniform_real_distribution<double> within(-1, 1);
    int hits = 0;
    int misses = 0;
    for (int i = 0; i < 60; ++i) {
        const View view = randomView(random, 1e5);
        const Selection selection = select(wholeTree(), view, 12, i % 3 != 0);
        for (int k = 0; k < 12; ++k) {
            const glm::dvec3 along =
                glm::normalize(within(random) * view.right + within(random) * view.up - view.back);
            const auto expected = pickByTryingAll(wholeTree(), selection, view.eyeM, along);
            const auto got = pickSurface(wholeTree(), selection.draw, view.eyeM, 7.5 * along);
            ASSERT_EQ(got.has_value(), expected.has_value()) << "view " << i << " ray " << k;
            ++(got ? hits : misses);
            if (!got) continue;
            EXPECT_EQ(got->id, expected->id);
            EXPECT_EQ(got->node, expected->node);
            EXPECT_NEAR(got->distanceM, expected->distanceM, 1e-7 * (1e5 + expected->distanceM));
            EXPECT_LT(glm::distance(got->positionM, view.eyeM + got->distanceM * along), 1e-6);
        }
    }
    EXPECT_GT(hits, 150);
    EXPECT_GT(misses, 100);
}

TEST(PickSurface, StraightDownAgreesWithTheResidentHeight) {
    std::mt19937 random(52);
    const Selection finest = select(wholeTree(), viewFromPose({}, 1e5, 1, 1280, 720), 1e-6, false);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 up = randomDirection(random);
        const auto hit = pickSurface(wholeTree(), finest.draw, 1.5e5 * up, -up);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(1.5e5 - hit->distanceM, 1e5 + residentHeightM(wholeTree(), up), 1e-6);
        EXPECT_EQ(hit->node, findNode(wholeTree(), hit->id));
    }
}

TEST(PickSurface, NoRayPassesBetweenTwoTriangles) {
    std::mt19937 random(53);
    const ChunkTree tree = residentTree(fakePyramid(), 2);
    const Selection finest = select(tree, viewFromPose({}, 1e5, 1, 1280, 720), 1e-6, false);
    ASSERT_EQ(finest.draw.size(), 96u);
    const int cells = chunkCells(tree.shape);
    for (int i = 0; i < 3000; ++i) {
        // At a vertex, or the middle of an edge or a diagonal, corners of the cube among them.
        const DrawItem& item = finest.draw[random() % finest.draw.size()];
        const auto vertex = [&](unsigned column, unsigned row) {
            const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(cells + 1) + column;
            return vertexM(tree.shape, item.id, static_cast<int>(column), static_cast<int>(row),
                           heightM(tree.shape, (*tree.nodes[item.node].heights)[at]));
        };
        const auto column = static_cast<unsigned>(random() % static_cast<unsigned>(cells));
        const auto row = static_cast<unsigned>(random() % static_cast<unsigned>(cells));
        const glm::dvec3 target =
            (vertex(column, row) + vertex(column + (random() & 1), row + (random() & 1))) / 2.0;
        const glm::dvec3 eye = 1.6 * target;
        const auto hit = pickSurface(tree, finest.draw, eye, target - eye);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distanceM, glm::distance(eye, target), 1e-5);
    }
}

TEST(PickSurface, ARayPastThePlanetHitsNothing) {
    const Selection all = select(wholeTree(), viewFromPose({}, 1e5, 1, 1280, 720), 5, false);
    EXPECT_FALSE(pickSurface(wholeTree(), all.draw, {3e5, 0, 0}, {0, 0, 1}));
    EXPECT_FALSE(pickSurface(wholeTree(), all.draw, {3e5, 0, 0}, {1, 0, 0}));
    EXPECT_TRUE(pickSurface(wholeTree(), all.draw, {3e5, 0, 0}, {-1, 0, 0}));
    EXPECT_FALSE(pickSurface(wholeTree(), {}, {3e5, 0, 0}, {-1, 0, 0}));
}

TEST(PickSurface, FromUnderTheGroundOneSeesOut) {
    const Selection all = select(wholeTree(), viewFromPose({}, 1e5, 1, 1280, 720), 5, false);
    std::mt19937 random(54);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 up = randomDirection(random);
        EXPECT_FALSE(pickSurface(wholeTree(), all.draw, 9e4 * up, up));
        EXPECT_FALSE(pickSurface(wholeTree(), all.draw, {0, 0, 0}, up));
    }
}

TEST(PickSurface, AnEyeInsideTheBoxOfAChunkSeesTheGroundBelowIt) {
    const Selection roots =
        select(residentTree(fakePyramid(), 0), viewFromPose({}, 1e5, 1, 1280, 720), 5, false);
    const ChunkTree tree = residentTree(fakePyramid(), 0);
    std::mt19937 random(55);
    int inside = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 up = randomDirection(random);
        const double groundM = 1e5 + residentHeightM(tree, up);
        const glm::dvec3 eye = (groundM + 10) * up;
        inside += std::any_of(roots.draw.begin(), roots.draw.end(), [&](const DrawItem& item) {
            return distanceM(tree.nodes[item.node].bounds.box, eye) == 0;
        });
        const auto hit = pickSurface(tree, roots.draw, eye, -up);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distanceM, 10, 1e-6);
    }
    EXPECT_GT(inside, 190);
}

}  // namespace
}  // namespace planet
