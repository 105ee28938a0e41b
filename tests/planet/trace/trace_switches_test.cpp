// A switch has the size and the cause that the numbers of the trace give it.
#include "planet/trace/trace_switches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace planet {
namespace {

TraceNode switchedNode(std::uint64_t id, std::optional<std::uint64_t> parent, double errorM) {
    TraceNode node;
    node.id = id;
    node.isTold = true;
    node.hasParent = parent.has_value();
    node.parent = parent.value_or(0);
    node.level = parent ? 1 : 0;
    node.bounds = {.shape = TraceBoundsShape::Sphere, .radius = 3};
    node.error = errorM;
    return node;
}

// A root with two children. The error of the root on screen is 10 px at 100 from its bounds.
class TraceSwitches : public testing::Test {
protected:
    static constexpr TraceNodeIndex root = 0, left = 1, right = 2;

    TraceSwitches() {
        state_.add(TraceDescription{});
        state_.add(TraceNodeTold{root, switchedNode(10, {}, 10)});
        state_.add(TraceNodeTold{left, switchedNode(11, 10, 5)});
        state_.add(TraceNodeTold{right, switchedNode(12, 10, 5)});
        state_.add(TraceNamed{0, "tau"});
        state_.add(TraceNamed{1, "hysteresis"});
        set(0, 8);
        for (const TraceNodeIndex node : {root, left, right}) page(TraceStep::Arrived, node);
    }

    void set(TraceNameIndex name, double value) { state_.add(TraceSet{name, value}); }
    void page(TraceStep step, TraceNodeIndex node) { state_.add(TracePaged{.step = step, .node = node}); }
    // Draws nodes from a distance to the bounds, at which the root's error is 1000 / distance px.
    const std::vector<TraceSwitch>& frame(double distance, const std::vector<TraceNodeIndex>& drawn,
                                          float morph = 0) {
        state_.add(TraceFrameBegan{++number_, number_ * 1000, static_cast<double>(number_) / 60});
        TraceView view;
        view.eye = {0, 0, 3 + distance};
        view.width = 200;
        state_.add(TraceViewTold{0, view});
        for (const TraceNodeIndex node : drawn) state_.add(TraceDrawn{.node = node, .morph = morph});
        state_.add(TraceFrameEnded{number_ * 1000 + 1, 1, 1});
        return finder_.add(state_, *state_.frame().view(0));
    }

    TraceState state_;
    TraceSwitchFinder finder_;
    std::uint64_t number_ = 0;
};

TEST_F(TraceSwitches, nothingSwitchesWhileTheSameNodesAreDrawn) {
    EXPECT_TRUE(frame(200, {root}).empty());
    EXPECT_TRUE(frame(190, {root}).empty());
    EXPECT_TRUE(frame(180, {}).empty());  // the root left the view
    EXPECT_TRUE(frame(170, {left}).empty());
}

TEST_F(TraceSwitches, anErrorThatCrossesTauSplits) {
    frame(200, {root});
    const auto& found = frame(100, {left, right});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].cause, TraceSwitchCause::Error);
    EXPECT_TRUE(found[0].isSplit);
    EXPECT_EQ(found[0].node, 10u);
    EXPECT_EQ(found[0].frame, 2u);
    EXPECT_NEAR(found[0].errorPx, 10, 1e-9);
    EXPECT_EQ(found[0].limitPx, 8);
    EXPECT_FALSE(found[0].isMorphed);
    // 200 px see two units at a distance of one. The sphere of radius 3 at 103 is seen under 2 asin(3 / 103).
    EXPECT_NEAR(found[0].sizePx, 200 * std::tan(std::asin(3.0 / 103)), 1e-9);
}

TEST_F(TraceSwitches, aChangedTauIsTheCauseOfItsSwitches) {
    frame(200, {root});
    set(0, 4);
    const auto& found = frame(200, {left, right});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].cause, TraceSwitchCause::Settings);
}

TEST_F(TraceSwitches, aSplitThatWaitedForDataIsCausedByItsArrival) {
    page(TraceStep::Evicted, right);
    frame(100, {root});
    page(TraceStep::Arrived, right);
    const auto& found = frame(99, {left, right});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].cause, TraceSwitchCause::Arrival);
}

TEST_F(TraceSwitches, aSplitThatTheNumbersAskedForBeforeHasAnotherCause) {
    frame(100, {root});
    const auto& late = frame(99, {left, right});
    ASSERT_EQ(late.size(), 1u);
    EXPECT_EQ(late[0].cause, TraceSwitchCause::Other);
    frame(200, {root});
    const auto& early = frame(201, {left, right});
    ASSERT_EQ(early.size(), 1u);
    EXPECT_EQ(early[0].cause, TraceSwitchCause::Other);
}

TEST_F(TraceSwitches, aMergeObeysHysteresis) {
    set(1, 0.5);
    frame(200, {left, right});
    const auto& found = frame(300, {root});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].isSplit);
    EXPECT_EQ(found[0].limitPx, 4);
    EXPECT_EQ(found[0].cause, TraceSwitchCause::Error);
}

TEST_F(TraceSwitches, aMergeAboveItsLimitIsCausedByEvictedData) {
    frame(100, {left, right});
    page(TraceStep::Evicted, left);
    const auto& found = frame(100, {root});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].cause, TraceSwitchCause::Eviction);
}

TEST_F(TraceSwitches, withoutTauTheCauseIsUnknown) {
    set(0, std::numeric_limits<double>::quiet_NaN());
    frame(200, {root});
    const auto& found = frame(100, {left, right});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].cause, TraceSwitchCause::Unknown);
}

TEST_F(TraceSwitches, fullyMorphedNodesSwitchWithoutAJump) {
    frame(200, {root});
    EXPECT_TRUE(frame(100, {left, right}, 1).at(0).isMorphed);
    frame(300, {left, right}, 1);
    EXPECT_TRUE(frame(301, {root}).at(0).isMorphed);
    frame(100, {left, right}, 0.5f);
    EXPECT_FALSE(frame(301, {root}).at(0).isMorphed);
}

TEST_F(TraceSwitches, nothingIsKnownAfterALostFrame) {
    frame(200, {root});
    ++number_;
    EXPECT_TRUE(frame(100, {left, right}).empty());
}

}  // namespace
}  // namespace planet
