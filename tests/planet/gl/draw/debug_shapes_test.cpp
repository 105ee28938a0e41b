#include "planet/gl/draw/debug_shapes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "planet/sphere/chunk_surface.h"
#include "tests/support/fake_pyramid.h"

namespace planet {
namespace {

constexpr LineColour colour = {1, 2, 3, 4};

int timesFound(const Lines& lines, const glm::dvec3& pointM, double withinM) {
    int found = 0;
    for (const LineVertex& vertex : lines) found += glm::length(vertex.positionM - pointM) < withinM;
    return found;
}

View someView() {
    return viewFromPose({30, 40, 5000, 20, -30}, 6.371e6, glm::radians(70.0), 1600, 900);
}

TEST(DebugShapes, ABoxHasTwelveEdgesBetweenItsCorners) {
    OrientedBox box;
    box.centreM = {100, 200, 300};
    const double c = std::cos(0.4);
    const double s = std::sin(0.4);
    box.axes = {glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1)};
    box.halfSizeM = {10, 20, 30};
    Lines lines;
    appendBox(box, colour, lines);
    ASSERT_EQ(lines.size(), 24u);
    for (const double x : {-10.0, 10.0}) {
        for (const double y : {-20.0, 20.0}) {
            for (const double z : {-30.0, 30.0}) {
                const glm::dvec3 corner = box.centreM + x * box.axes[0] + y * box.axes[1] + z * box.axes[2];
                EXPECT_EQ(timesFound(lines, corner, 1e-9), 3) << "three edges meet in a corner";
            }
        }
    }
    double lengthM = 0;
    for (std::size_t i = 0; i < lines.size(); i += 2)
        lengthM += glm::length(lines[i].positionM - lines[i + 1].positionM);
    EXPECT_NEAR(lengthM, 4 * (20 + 40 + 60), 1e-9);
    EXPECT_EQ(lines[7].colour, colour);
}

// What lies on all of a frustum's corner edges lies on two of its planes, and inside the others.
TEST(DebugShapes, AFrustumsEdgesRunThroughTheViewsCorners) {
    const View view = someView();
    Lines lines;
    appendFrustum(view, 9000, colour, lines);
    EXPECT_EQ(lines.size(), 2u * (4 + 3 * 4));
    EXPECT_EQ(timesFound(lines, view.eyeM, 1e-9), 4);
    const Frustum frustum = frustumOf(view);
    std::array<int, 3> rectangles{};
    for (const LineVertex& vertex : lines) {
        const glm::dvec3 fromEye = vertex.positionM - view.eyeM;
        if (glm::length(fromEye) < 1) continue;
        int onPlanes = 0;
        for (const Plane& plane : frustum) {
            const double inside = glm::dot(plane.normal, vertex.positionM) + plane.offsetM;
            EXPECT_GT(inside, -1e-3);
            onPlanes += std::abs(inside) < 1e-3;
        }
        EXPECT_EQ(onPlanes, 2) << "a corner of the view";
        const double depth = -glm::dot(fromEye, view.back);
        for (int third = 1; third <= 3; ++third)
            rectangles[static_cast<std::size_t>(third - 1)] += std::abs(depth - 3000 * third) < 1e-3;
    }
    EXPECT_EQ(rectangles, (std::array{8, 8, 12}));
}

TEST(DebugShapes, TheHorizonsCircleIsWhereSightTouchesTheOccluder) {
    const glm::dvec3 eyeM = 9e6 * glm::normalize(glm::dvec3(1, -2, 0.5));
    const double occluderM = 6.3e6;
    const Horizon horizon = horizonOf(eyeM, occluderM);
    Lines lines;
    appendHorizon(horizon, eyeM, colour, lines);
    ASSERT_GT(lines.size(), 100u);
    int onCircle = 0;
    for (const LineVertex& vertex : lines) {
        if (glm::length(vertex.positionM - eyeM) < 1) continue;
        EXPECT_NEAR(glm::length(vertex.positionM), occluderM, 1e-3);
        EXPECT_NEAR(glm::dot(glm::normalize(vertex.positionM), horizon.eyeDirection), occluderM / 9e6, 1e-9);
        // The line of sight is at right angles to the radius.
        EXPECT_NEAR(glm::dot(glm::normalize(vertex.positionM - eyeM), glm::normalize(vertex.positionM)), 0,
                    1e-9);
        ++onCircle;
    }
    EXPECT_EQ(timesFound(lines, eyeM, 1e-3), static_cast<int>(lines.size()) - onCircle);
    EXPECT_GE(timesFound(lines, eyeM, 1e-3), 4);
}

TEST(DebugShapes, AnEyeInsideTheOccluderHasNoHorizon) {
    Lines lines;
    appendHorizon(horizonOf({1000, 0, 0}, 6.3e6), {1000, 0, 0}, colour, lines);
    EXPECT_TRUE(lines.empty());
}

TEST(DebugShapes, ASpheresCirclesLieOnItAndClose) {
    const glm::dvec3 centreM(1e6, -2e6, 3e6);
    Lines lines;
    appendSphere(centreM, 50000, colour, lines);
    double lengthM = 0;
    for (std::size_t i = 0; i < lines.size(); i += 2) {
        EXPECT_NEAR(glm::length(lines[i].positionM - centreM), 50000, 1e-3);
        EXPECT_GE(timesFound(lines, lines[i].positionM, 1e-6), 2);
        lengthM += glm::length(lines[i].positionM - lines[i + 1].positionM);
    }
    EXPECT_NEAR(lengthM, 3 * 2 * std::numbers::pi * 50000, 0.001 * lengthM);
}

TEST(DebugShapes, AnOutlineGoesAroundItsChunkOnTheSurface) {
    const ChunkTree tree = residentTree(fakePyramid(), 2);
    const ChunkNode& node = tree.nodes[findNode(tree, {Face::NegY, 2, 1, 3})];
    for (const double liftM : {0.0, 25.0}) {
        Lines lines;
        appendOutline(tree, node, liftM, colour, lines);
        const int cells = chunkCells(tree.shape);
        ASSERT_EQ(lines.size(), static_cast<std::size_t>(2 * 4 * cells));
        const FaceSquare square = faceSquareOf(node.id);
        int corners = 0;
        for (const LineVertex& vertex : lines) {
            const FacePoint point = facePointFromDirection(vertex.positionM);
            const glm::dvec3 cube = cubeFromSphere(vertex.positionM);
            const double x = (glm::dot(cube, faceAxes(node.id.face).u) - square.u) / square.side * cells;
            const double y = (glm::dot(cube, faceAxes(node.id.face).v) - square.v) / square.side * cells;
            const double toBorder =
                std::min({std::abs(x), std::abs(y), std::abs(x - cells), std::abs(y - cells)});
            EXPECT_NEAR(toBorder, 0, 1e-6) << faceName(point.face);
            const double step = stepOnTriangles(*node.heights, cells, std::round(x), std::round(y));
            EXPECT_NEAR(glm::length(vertex.positionM),
                        tree.shape.radiusM + tree.shape.baseHeightM + step * tree.shape.quantumM + liftM,
                        1e-3);
            corners += (x < 1e-6 || x > cells - 1e-6) && (y < 1e-6 || y > cells - 1e-6);
            EXPECT_EQ(timesFound(lines, vertex.positionM, 1e-6), 2) << "the outline closes";
        }
        EXPECT_EQ(corners, 8);
    }
}

}  // namespace
}  // namespace planet
