// The state of a frame is what the events say, and errors on screen are those that the library selects by.
#include "planet/trace/trace_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat3x3.hpp>

#include "planet/select/screen_error.h"
#include "planet/sphere/bounds.h"
#include "planet/sphere/view.h"
#include "planet/trace/lod_trace.h"

namespace planet {
namespace {

TraceNode toldNode(std::uint64_t id, std::optional<std::uint64_t> parent = {}) {
    TraceNode node;
    node.id = id;
    node.isTold = true;
    node.hasParent = parent.has_value();
    node.parent = parent.value_or(0);
    return node;
}

void addAll(TraceState& state, const std::vector<TraceEvent>& events) {
    for (const TraceEvent& event : events) state.add(event);
}

TEST(TraceState, childrenAreLinkedInAnyOrder) {
    TraceState state;
    addAll(state, {TraceNodeTold{0, toldNode(10, 5)}, TraceNodeTold{1, toldNode(11, 5)},
                   TraceNodeTold{2, toldNode(5)}, TraceNodeTold{3, toldNode(12, 5)}});
    EXPECT_EQ(state.nodes()[2].children, (std::vector<TraceNodeIndex>{0, 1, 3}));
    EXPECT_EQ(state.nodes()[0].parent, 2u);
    // A node may move to another parent, also to one that is not told.
    addAll(state, {TraceNodeTold{0, toldNode(10, 12)}, TraceNodeTold{1, toldNode(11, 99)}});
    EXPECT_EQ(state.nodes()[2].children, (std::vector<TraceNodeIndex>{3}));
    EXPECT_EQ(state.nodes()[3].children, (std::vector<TraceNodeIndex>{0}));
    EXPECT_EQ(state.nodes()[1].parent, noTraceNode);
}

TEST(TraceState, aFrameEndsWithItsEndOrWithTheNextOne) {
    TraceState state;
    state.add(TraceNodeTold{0, toldNode(1)});
    EXPECT_FALSE(state.add(TraceFrameBegan{1, 100, 0.5}));
    EXPECT_FALSE(state.add(TraceDrawn{.view = 2, .node = 0, .morph = 0.5f}));
    EXPECT_TRUE(state.add(TraceFrameEnded{200, 3, 4}));
    EXPECT_EQ(state.frame().number, 1u);
    EXPECT_EQ(state.frame().cpuMs, 3);
    EXPECT_TRUE(state.frame().isComplete());
    ASSERT_NE(state.frame().view(2), nullptr);
    EXPECT_EQ(state.frame().view(2)->drawn.size(), 1u);
    EXPECT_EQ(state.frame().view(0), nullptr);
    EXPECT_FALSE(state.add(TraceFrameBegan{2, 300, 1}));
    EXPECT_TRUE(state.add(TraceFrameBegan{4, 400, 2}));
    EXPECT_EQ(state.frame().number, 2u);
    EXPECT_FALSE(state.frame().isComplete());
    EXPECT_TRUE(state.add(TraceFrameEnded{500, 3, 4}));
    EXPECT_TRUE(state.frame().followsGap);
}

TEST(TraceState, residencyIsByNodeOrByParent) {
    for (const TraceRequests requests : {TraceRequests::Node, TraceRequests::Children}) {
        TraceState state;
        TraceDescription description;
        description.requests = requests;
        addAll(state, {description, TraceNodeTold{0, toldNode(1)}, TraceNodeTold{1, toldNode(2, 1)}});
        EXPECT_TRUE(state.isResident(1));  // no paging is told
        state.add(TracePaged{.step = TraceStep::Arrived, .node = 0});
        const bool byParent = requests == TraceRequests::Children;
        EXPECT_EQ(state.isResident(0), true);
        EXPECT_EQ(state.isResident(1), byParent);
        state.add(TracePaged{.step = TraceStep::Evicted, .node = 0});
        EXPECT_EQ(state.isResident(0), byParent);
        EXPECT_EQ(state.isResident(1), false);
    }
}

TEST(TraceState, stepsOfPagingKnowTheirRequest) {
    TraceState state;
    addAll(state, {TraceNodeTold{0, toldNode(1)}, TraceFrameBegan{7, 100, 2.5},
                   TracePaged{.kind = 1, .hasPriority = true, .node = 0, .ns = 110, .priority = 4},
                   TracePaged{.step = TraceStep::Started, .kind = 1, .node = 0, .ns = 120},
                   TracePaged{.step = TraceStep::Arrived, .kind = 1, .node = 0, .ns = 150},
                   TraceFrameEnded{200, 1, 1}});
    ASSERT_EQ(state.frame().paged.size(), 3u);
    const TraceDataState& before = state.frame().paged[2].before;
    EXPECT_EQ(before.data, TraceData::Started);
    EXPECT_EQ(before.requestedNs, 110u);
    EXPECT_EQ(before.startedNs, 120u);
    EXPECT_EQ(before.requestedS, 2.5);
    EXPECT_EQ(before.requestedFrame, 7u);
    EXPECT_EQ(before.priority, 4);
    EXPECT_EQ(state.nodes()[0].data[1].data, TraceData::Resident);
    EXPECT_EQ(state.nodes()[0].data[0].data, TraceData::Absent);
}

TEST(TraceState, aKeyReplacesWhatWasSetAndPaged) {
    TraceState state;
    addAll(state, {TraceNamed{0, "tau"}, TraceNamed{1, "old"}, TraceNodeTold{0, toldNode(1)},
                   TraceNodeTold{1, toldNode(2)}, TraceSet{0, 2.0}, TraceSet{1, 1.0},
                   TracePaged{.step = TraceStep::Arrived, .node = 0}, TraceFrameBegan{1, 5, 0.25},
                   TracePaged{.node = 1, .ns = 50}, TraceKey{2, 100}, TraceSet{0, 3.0},
                   TraceRestored{.data = TraceData::Requested, .node = 1, .requestedNs = 50}});
    EXPECT_EQ(state.setting("tau", 0), 3.0);
    EXPECT_EQ(state.settings().count("old"), 0u);
    EXPECT_EQ(state.nodes()[0].data[0].data, TraceData::Absent);
    EXPECT_EQ(state.nodes()[1].data[0].data, TraceData::Requested);
    EXPECT_EQ(state.nodes()[1].data[0].requestedS, 0.25);  // the key does not tell it
    state.add(TraceRestarted{});
    EXPECT_TRUE(state.nodes().empty());
}

TEST(TraceState, aSettingOfAViewComesBeforeTheGeneralOne) {
    TraceState state;
    addAll(state, {TraceNamed{0, "tau"}, TraceNamed{1, "tau/2"}, TraceNamed{2, "mode"}, TraceSet{0, 2.0},
                   TraceSet{1, 5.0}, TraceSet{2, std::string("fast")}});
    EXPECT_EQ(state.setting("tau", 0), 2.0);
    EXPECT_EQ(state.setting("tau", 2), 5.0);
    EXPECT_EQ(state.setting("mode", 0), std::nullopt);
}

TEST(TraceState, idsAreWrittenAsTheSchemeSays) {
    TraceDescription description;
    const std::uint64_t id = lod_trace_quadtree_id(4, 3, 5, 2);
    EXPECT_EQ(id, keyOf({Face::PosZ, 3, 5, 2}));
    EXPECT_EQ(traceIdText(description, id), std::to_string(id));
    description.ids = TraceIds::Quadtree;
    EXPECT_EQ(traceIdText(description, id), "3/5/2");
    description.shape = TraceShape::Sphere;
    EXPECT_EQ(traceIdText(description, id), toString({Face::PosZ, 3, 5, 2}));
}

TraceView traceViewOf(const View& view) {
    TraceView traced;
    traced.eye = view.eyeM;
    const glm::dmat3 rotation = cameraFromWorldRotation(view);
    traced.view = glm::dmat4(rotation);
    traced.view[3] = glm::dvec4(-(rotation * view.eyeM), 1);
    traced.projection[0][0] = 1 / std::tan(view.horizontalFovRad / 2);
    traced.width = view.widthPx;
    traced.height = view.heightPx;
    return traced;
}

TEST(TraceState, errorsOnScreenAreThoseOfTheLibrary) {
    constexpr double radiusM = 6'371'000;
    const View view =
        viewFromPose({.latitudeDeg = 12, .longitudeDeg = 34, .altitudeM = 5000}, radiusM, 1.1, 1280, 720);
    TraceDescription description;
    for (int level = 0; level <= 12; ++level) {
        const ChunkId id = chunkAt({Face::PosX, 0.3, 0.2}, level);
        ChunkNode node;
        node.bounds = chunkBounds(id, radiusM, -200, 3000);
        node.deltaCM = 1e5f / static_cast<float>(1 << level);
        TraceNode traced = toldNode(keyOf(id));
        traced.error = static_cast<double>(node.deltaCM);
        traced.bounds = {.shape = TraceBoundsShape::Box,
                         .centre = node.bounds.box.centreM,
                         .axes = node.bounds.box.axes,
                         .halfSize = node.bounds.box.halfSizeM};
        const double expected = epsPxOf(node, view.eyeM, screenScalePx(view), ErrorMetric::Additive);
        EXPECT_NEAR(traceErrorPx(description, traced, traceViewOf(view)), expected, 1e-9 * expected);
    }
}

TEST(TraceState, errorsWithoutBoundsAreUnknownAndPixelsStayAsTold) {
    TraceDescription description;
    TraceNode node = toldNode(1);
    node.error = 3;
    EXPECT_TRUE(std::isnan(traceErrorPx(description, node, {})));
    description.error = TraceErrorUnit::Pixels;
    EXPECT_EQ(traceErrorPx(description, node, {}), 3);
}

TEST(TraceState, dataIsCountedByState) {
    TraceState state;
    addAll(state, {TraceNodeTold{0, toldNode(1)}, TraceNodeTold{1, toldNode(2)},
                   TracePaged{.step = TraceStep::Requested, .node = 0},
                   TracePaged{.step = TraceStep::Requested, .kind = 1, .node = 0},
                   TracePaged{.step = TraceStep::Started, .node = 0},
                   TracePaged{.step = TraceStep::Arrived, .node = 1}});
    EXPECT_EQ(state.count(0, TraceData::Requested), 0u);
    EXPECT_EQ(state.count(0, TraceData::Started), 1u);
    EXPECT_EQ(state.count(0, TraceData::Resident), 1u);
    EXPECT_EQ(state.count(1, TraceData::Requested), 1u);
    addAll(state, {TracePaged{.step = TraceStep::Evicted, .node = 1},
                   TracePaged{.step = TraceStep::Failed, .node = 0},
                   TracePaged{.step = TraceStep::Cancelled, .kind = 1, .node = 0}});
    EXPECT_EQ(state.count(0, TraceData::Started), 0u);
    EXPECT_EQ(state.count(0, TraceData::Resident), 0u);
    EXPECT_EQ(state.count(0, TraceData::Failed), 1u);
    EXPECT_EQ(state.count(1, TraceData::Requested), 0u);
    // A key tells everything anew.
    addAll(state, {TraceKey{1, 0}, TraceRestored{.data = TraceData::Resident, .node = 1}});
    EXPECT_EQ(state.count(0, TraceData::Failed), 0u);
    EXPECT_EQ(state.count(0, TraceData::Resident), 1u);
}

}  // namespace
}  // namespace planet
