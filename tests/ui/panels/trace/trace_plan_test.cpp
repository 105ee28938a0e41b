// The nodes of a trace lie where their ids, their bounds and their parents say.
#include "ui/panels/trace/trace_plan.h"

#include <gtest/gtest.h>

#include "planet/trace/lod_trace.h"

namespace worldy::ui {
namespace {

TracedNode planned(planet::TraceNodeIndex index, planet::TraceNodeIndex parent, std::uint32_t level,
                   std::uint64_t id) {
    TracedNode node{.index = index, .parent = parent, .node = {}};
    node.node.isTold = true;
    node.node.id = id;
    node.node.level = level;
    return node;
}

// A root that is split, with four children by ids of a quadtree, on a square of 8 units.
class TracePlans : public testing::Test {
protected:
    explicit TracePlans(planet::TraceShape shape = planet::TraceShape::Flat) {
        frame_.description.emplace();
        frame_.description->shape = shape;
        frame_.description->ids = planet::TraceIds::Quadtree;
        frame_.description->radius = 100;
        add(planned(0, planet::noTraceNode, 0, lod_trace_quadtree_id(0, 0, 0, 0)), TracedPlace::Split,
            {4, 4, 0}, 4);
        for (unsigned i = 0; i < 4; ++i)
            add(planned(1 + i, 0, 1, lod_trace_quadtree_id(0, 1, i % 2, i / 2)), TracedPlace::Drawn,
                {2.0 + 4 * (i % 2), 2.0 + 4 * (i / 2), 0}, 2);
    }
    void add(TracedNode node, TracedPlace place, const glm::dvec3& centre, double half) {
        node.place = place;
        node.node.bounds = {.shape = planet::TraceBoundsShape::Box,
                            .centre = centre,
                            .axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)},
                            .halfSize = {half, half, 1}};
        view_.nodes.push_back(node);
    }
    std::size_t at(const TracePlan& plan, double x, double y) { return nodeAt(plan, {x, y}); }

    TracedFrame frame_;
    TracedView view_;
};

TEST_F(TracePlans, theNetOfAFlatWorldIsASquareWithNorthUp) {
    const TracePlan plan = planOf(TraceLayout::Net, frame_, view_);
    EXPECT_EQ(plan.size.width, 1);
    EXPECT_EQ(plan.shapes.size(), 5u);
    EXPECT_EQ(at(plan, 0.2, 0.8), 1u);  // x 0, y 0 is at the bottom left
    EXPECT_EQ(at(plan, 0.8, 0.8), 2u);
    EXPECT_EQ(at(plan, 0.2, 0.2), 3u);
    EXPECT_EQ(at(plan, 1.2, 0.2), noTracedNode);
}

TEST_F(TracePlans, sixFacesOfASphereUnfold) {
    frame_.description->shape = planet::TraceShape::Sphere;
    add(planned(9, planet::noTraceNode, 0, lod_trace_quadtree_id(4, 0, 0, 0)), TracedPlace::Drawn,
        {0, 0, 100}, 50);
    const TracePlan plan = planOf(TraceLayout::Net, frame_, view_);
    EXPECT_EQ(plan.size.width, 4);
    EXPECT_EQ(at(plan, 1.5, 0.5), 5u);  // z_pos lies above x_pos
    EXPECT_EQ(at(plan, 1.2, 1.8), 1u);
    frame_.description->ids = planet::TraceIds::Opaque;
    EXPECT_FALSE(planOf(TraceLayout::Net, frame_, view_).problem.empty());
}

TEST_F(TracePlans, twoFacesOfASphereLieSideBySide) {
    frame_.description->shape = planet::TraceShape::Sphere;
    add(planned(9, planet::noTraceNode, 0, lod_trace_quadtree_id(1, 0, 0, 0)), TracedPlace::Drawn,
        {0, 0, 100}, 50);
    const TracePlan plan = planOf(TraceLayout::Net, frame_, view_);
    EXPECT_EQ(plan.size.width, 2);
    EXPECT_EQ(at(plan, 1.5, 0.5), 5u);
}

TEST_F(TracePlans, theMapOfAFlatWorldIsSeenFromAbove) {
    const TracePlan plan = planOf(TraceLayout::Map, frame_, view_);
    EXPECT_DOUBLE_EQ(plan.size.width, 1);
    EXPECT_DOUBLE_EQ(plan.size.height, 1);
    EXPECT_EQ(at(plan, 0.2, 0.8), 1u);
    EXPECT_EQ(at(plan, 0.8, 0.2), 4u);
}

TEST_F(TracePlans, anUpAxisOfYTurnsTheMap) {
    for (TracedNode& node : view_.nodes) {
        planet::TraceBounds& bounds = node.node.bounds;
        bounds.centre = {bounds.centre.x, 0, bounds.centre.y};
        bounds.axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)};
    }
    const TracePlan plan = planOf(TraceLayout::Map, frame_, view_);
    EXPECT_EQ(at(plan, 0.2, 0.2), 1u);  // z is down
    EXPECT_EQ(at(plan, 0.8, 0.8), 4u);
}

TEST_F(TracePlans, theMapOfASphereHasLongitudesAndLatitudes) {
    frame_.description->shape = planet::TraceShape::Sphere;
    view_.nodes.clear();
    const auto place = [&](planet::TraceNodeIndex index, const glm::dvec3& up, const glm::dvec3& east) {
        add(planned(index, planet::noTraceNode, 1, index), TracedPlace::Drawn, 100.0 * up, 10);
        view_.nodes.back().node.bounds.axes = {east, glm::cross(up, east), up};
    };
    place(0, {1, 0, 0}, {0, 1, 0});    // latitude 0, longitude 0
    place(1, {0, 1, 0}, {-1, 0, 0});   // longitude 90 east
    place(2, {-1, 0, 0}, {0, -1, 0});  // the date line
    place(3, {0, 0, 1}, {0, 1, 0});    // the north pole
    const TracePlan plan = planOf(TraceLayout::Map, frame_, view_);
    EXPECT_EQ(at(plan, 1, 0.5), 0u);
    EXPECT_EQ(at(plan, 1.5, 0.5), 1u);
    EXPECT_EQ(at(plan, 0.01, 0.5), 2u);
    EXPECT_EQ(at(plan, 1.99, 0.5), 2u);
    EXPECT_EQ(at(plan, 0.3, 0.01), 3u);
    EXPECT_EQ(at(plan, 1.7, 0.01), 3u);
    EXPECT_EQ(at(plan, 0.5, 0.5), noTracedNode);
}

TEST_F(TracePlans, aTreeHasARowForEachLevel) {
    const TracePlan plan = planOf(TraceLayout::Tree, frame_, view_);
    EXPECT_EQ(at(plan, 0.1, 0.2), 0u);
    EXPECT_EQ(at(plan, 1.9, 0.2), 0u);
    EXPECT_EQ(at(plan, 0.1, 0.7), 1u);
    EXPECT_EQ(at(plan, 1.9, 0.7), 4u);
}

TEST_F(TracePlans, parentsInARingAreLeftOutOfTheTree) {
    view_.nodes[0].parent = 1;
    EXPECT_TRUE(planOf(TraceLayout::Tree, frame_, view_).shapes.empty());
}

TEST_F(TracePlans, aNodeBelowADrawnOneIsAMarkInside) {
    add(planned(7, 1, 2, lod_trace_quadtree_id(0, 2, 0, 0)), TracedPlace::Below, {1, 1, 0}, 1);
    const TracePlan plan = planOf(TraceLayout::Net, frame_, view_);
    EXPECT_EQ(at(plan, 0.125, 0.875), 5u);
    EXPECT_EQ(at(plan, 0.02, 0.98), 1u);
}

TEST_F(TracePlans, withoutBoundsThereIsNoMap) {
    for (TracedNode& node : view_.nodes) node.node.bounds = {};
    EXPECT_FALSE(planOf(TraceLayout::Map, frame_, view_).problem.empty());
    frame_.description->ids = planet::TraceIds::Opaque;
    EXPECT_EQ(suitingLayout(frame_, view_), TraceLayout::Tree);
}

}  // namespace
}  // namespace worldy::ui
