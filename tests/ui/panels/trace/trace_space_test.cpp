// The bounds of a trace are seen in space where they are.
#include "ui/panels/trace/trace_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>

#include "ui/panels/trace/trace_plan.h"

namespace worldy::ui {
namespace {

constexpr Rect picture{100, 50, 400, 300};

TracedNode boxed(std::uint64_t id, const glm::dvec3& centre, double half) {
    TracedNode node;
    node.node.id = id;
    node.node.bounds = {.shape = planet::TraceBoundsShape::Box,
                        .centre = centre,
                        .axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)},
                        .halfSize = glm::dvec3(half)};
    return node;
}

TEST(TraceSpace, theEnginesCameraSeesABoxWhereItsMatricesPutIt) {
    planet::TraceView camera;
    camera.eye = {1e7, 0, 10};
    camera.view[3] = glm::dvec4(-camera.eye, 1);
    camera.projection = glm::perspective(1.2, 4.0 / 3, 1.0, 1e4);
    camera.width = 800;
    camera.height = 600;
    const SpaceView space = spaceView(camera, picture);
    EXPECT_FLOAT_EQ(space.area.width, 400);
    EXPECT_FLOAT_EQ(space.area.height, 300);
    const glm::dvec3 place(1e7 + 2, 1, 0);
    const auto seen = space.segment(place, place);
    ASSERT_TRUE(seen);
    const glm::dvec4 clip = camera.projection * glm::dvec4(place - camera.eye, 1);
    EXPECT_NEAR((*seen)[0].x, 100 + 400 * (0.5 + 0.5 * clip.x / clip.w), 1e-6);
    EXPECT_NEAR((*seen)[0].y, 50 + 300 * (0.5 - 0.5 * clip.y / clip.w), 1e-6);
    EXPECT_FALSE(space.segment({1e7, 0, 20}, {1e7, 5, 30}));
    EXPECT_TRUE(space.segment({1e7, 0, 20}, {1e7, 0, 0}));
}

TEST(TraceSpace, aCameraAroundTheNodesSeesThemInTheMiddle) {
    TracedFrame frame;
    TracedView view;
    view.nodes = {boxed(1, {1000, 1000, 0}, 10), boxed(2, {1040, 1000, 0}, 10)};
    const SpaceCamera camera = cameraAround(frame, view);
    EXPECT_NEAR(glm::length(camera.target - glm::dvec3(1020, 1000, 0)), 0, 1e-9);
    const auto shapes = spaceShapes(spaceView(camera, picture), frame, view, {});
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_GE(shapes[0].distance, shapes[1].distance);
    for (const SpaceShape& shape : shapes) {
        EXPECT_EQ(shape.edges.size(), 12u);
        for (const glm::dvec2& at : shape.hull) {
            EXPECT_TRUE(at.x > 100 && at.x < 500 && at.y > 50 && at.y < 350) << at.x << " " << at.y;
        }
        glm::dvec2 middle(0);
        for (const glm::dvec2& at : shape.hull) middle += at / static_cast<double>(shape.hull.size());
        EXPECT_EQ(nodeAt(shapes, middle), shape.node);
    }
    EXPECT_EQ(nodeAt(shapes, {101, 51}), noTracedNode);
}

TEST(TraceSpace, aCameraAroundAGlobeIsOnTheSideOfTheEnginesCamera) {
    TracedFrame frame;
    frame.description.emplace();
    frame.description->shape = planet::TraceShape::Sphere;
    frame.description->radius = 100;
    TracedView view;
    view.info.emplace();
    view.nodes = {boxed(1, {0, -100, 0}, 5), boxed(2, {0, 100, 0}, 5)};
    for (const glm::dvec3 eye :
         {glm::dvec3(0, -300, 0), glm::dvec3(100, -200, 50), glm::dvec3(-10, 20, 290)}) {
        view.info->eye = eye;
        const SpaceView space = spaceView(cameraAround(frame, view), picture);
        EXPECT_NEAR(glm::dot(glm::normalize(space.eye), glm::normalize(eye)), 1, 1e-9);
    }
    view.info->eye = {0, -300, 0};
    const auto shapes = spaceShapes(spaceView(cameraAround(frame, view), picture), frame, view, {});
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_TRUE(shapes[0].isBehind);
    EXPECT_FALSE(shapes[1].isBehind);
}

TEST(TraceSpace, onlyDrawnNodesAndTheSelectedOneAreShown) {
    TracedFrame frame;
    TracedView view;
    view.nodes = {boxed(1, {0, 0, 0}, 1), boxed(2, {5, 0, 0}, 1), boxed(3, {9, 0, 0}, 1)};
    view.nodes[1].place = TracedPlace::Split;
    view.nodes[2].place = TracedPlace::Split;
    const SpaceView space = spaceView(cameraAround(frame, view), picture);
    EXPECT_EQ(spaceShapes(space, frame, view, {}).size(), 1u);
    EXPECT_EQ(spaceShapes(space, frame, view, 3).size(), 2u);
    view.nodes[0].node.bounds.centre.x = std::nan("");
    EXPECT_TRUE(spaceShapes(space, frame, view, {}).empty());
}

}  // namespace
}  // namespace worldy::ui
