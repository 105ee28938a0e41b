// A selection over a trace draws what its settings say, and what contradicts the engine's own settings is listed. The engine
// is made here: a flat binary tree of spheres, whose errors and distances are round numbers.
#include "planet/trace/trace_what_if.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "tests/support/trace_events.h"

namespace planet {
namespace {

using Residency = TraceResidency;
using Ids = std::set<std::uint64_t>;

// Nodes 1 to 31: the children of n are 2 n and 2 n + 1. All bounds are points at the origin, so a node's error on screen
// is its error times 100 over the distance of the eye.
constexpr double scalePx = 100;

std::uint32_t levelOf(std::uint64_t id) {
    return static_cast<std::uint32_t>(std::log2(static_cast<double>(id)));
}

class TraceWhatIfs : public testing::Test {
protected:
    explicit TraceWhatIfs(TraceRequests requests = TraceRequests::Node,
                          TraceErrorUnit unit = TraceErrorUnit::World) {
        TraceDescription description;
        description.error = unit;
        description.requests = requests;
        add(description);
        add(TraceNamed{0, "tau"});
        add(TraceNamed{1, "hysteresis"});
        add(TraceNamed{2, "fade_s"});
        add(TraceSet{0, 1.0});
    }

    void add(const TraceEvent& event) {
        if (state_.add(event)) whatIf_->add(state_);
    }
    void selectWith(const std::vector<TraceSelectorSettings>& settings) {
        settings_ = settings;
        whatIf_ = std::make_unique<TraceWhatIf>(
            settings_, [this](const TraceState& state, int, int row, const TraceSelection& selection) {
                Ids& ids = drawn_[row];
                ids.clear();
                for (const TraceNodeIndex node : selection.drawn) ids.insert(state.nodes()[node].node.id);
                last_[row] = selection;
            });
    }
    // Tells the nodes 1 to `last`: an error of 8 at the root, half of it on each level below.
    void tellNodes(std::uint64_t last) {
        for (std::uint64_t id = 1; id <= last; ++id) {
            TraceNode node;
            node.id = id;
            node.isTold = true;
            node.hasParent = id > 1;
            node.parent = id / 2;
            node.level = levelOf(id);
            node.bounds.shape = TraceBoundsShape::Sphere;
            node.error = std::ldexp(8, -static_cast<int>(node.level));
            node.bytes = 1000;
            node.triangles = 10;
            add(TraceNodeTold{static_cast<TraceNodeIndex>(id - 1), node});
        }
    }
    static TraceNodeIndex at(std::uint64_t id) { return static_cast<TraceNodeIndex>(id - 1); }

    // Tells a frame in which the root has this error on screen, pixels.
    void frame(double rootPx, const Ids& drawn, const Ids& culled = {}, float morph = 0) {
        add(TraceFrameBegan{++frames_, frames_ * 1000, static_cast<double>(frames_) * 0.1});
        TraceViewTold view;
        view.info.eye = {0, 0, 8 * scalePx / rootPx};
        view.info.projection[0][0] = 1;
        view.info.projection[2][3] = -1;
        view.info.projection[3][3] = 0;
        view.info.view[3][2] = -view.info.eye.z;
        view.info.width = 2 * static_cast<int>(scalePx);
        view.info.height = view.info.width;
        add(view);
        for (const std::uint64_t id : drawn) add(TraceDrawn{.node = at(id), .morph = morph});
        for (const std::uint64_t id : culled) add(TraceCulled{.node = at(id)});
        add(TraceFrameEnded{frames_ * 1000 + 500, -1, -1});
    }
    void page(TraceStep step, std::uint64_t id) { add(TracePaged{.step = step, .node = at(id)}); }
    TraceWhatIfReport report() { return whatIf_->finish(state_); }
    const Ids& drawn(int row = 0) { return drawn_[row]; }
    const TraceSelection& last(int row = 0) { return last_[row]; }

    TraceState state_;
    std::vector<TraceSelectorSettings> settings_;
    std::unique_ptr<TraceWhatIf> whatIf_ =
        std::make_unique<TraceWhatIf>(std::span<const TraceSelectorSettings>{});
    std::map<int, Ids> drawn_;
    std::map<int, TraceSelection> last_;
    std::uint64_t frames_ = 0;
};

TraceSelectorSettings withTau(double tauPx, Residency residency = Residency::AllThere) {
    TraceSelectorSettings settings;
    settings.tauPx = tauPx;
    settings.residency = residency;
    return settings;
}

TEST_F(TraceWhatIfs, aNodeIsSplitWhileItsErrorExceedsTau) {
    selectWith({withTau(1), withTau(1.5), withTau(3), withTau(0.7)});
    tellNodes(15);
    frame(2.9, {2, 3});  // levels have 2.9, 1.45, 0.725 and 0.3625 px
    EXPECT_EQ(drawn(0), (Ids{4, 5, 6, 7}));
    EXPECT_EQ(drawn(1), (Ids{2, 3}));
    EXPECT_EQ(drawn(2), (Ids{1}));
    EXPECT_EQ(drawn(3), (Ids{8, 9, 10, 11, 12, 13, 14, 15}));
    EXPECT_NEAR(last(0).worstErrorPx, 0.725, 1e-12);
    EXPECT_EQ(last(0).triangles, 40u);
    EXPECT_EQ(last(0).bytes, 7000u);
    EXPECT_EQ(last(-2).bytes, 3000u);  // what the engine drew
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.views.size(), 1u);
    EXPECT_EQ(report.views[0].rows[0].nodesThatDiffer, 6u);
    EXPECT_EQ(report.views[0].rows[1].framesThatDiffer, 0u);
}

TEST_F(TraceWhatIfs, whatTheEngineCulledStaysCulled) {
    selectWith({withTau(0.7), withTau(1.5)});
    tellNodes(15);
    frame(2.9, {2, 6}, {7});
    EXPECT_EQ(drawn(0), (Ids{8, 9, 10, 11, 12, 13}));
    EXPECT_EQ(drawn(1), (Ids{2, 3}));
}

TEST_F(TraceWhatIfs, belowDrawnNodesBoundsAreComparedWithTheFrustum) {
    selectWith({withTau(1)});
    tellNodes(3);
    TraceNode aside = state_.nodes()[at(3)].node;
    aside.bounds.centre = {1e4, 0, 0};
    aside.bounds.radius = 1;
    add(TraceNodeTold{at(3), aside});
    frame(1.9, {1});
    EXPECT_EQ(drawn(), (Ids{2}));
}

TEST_F(TraceWhatIfs, childrenThatWereNeverDescribedAreUnknown) {
    selectWith({withTau(0.5)});
    tellNodes(7);
    frame(2.9, {2, 3});
    EXPECT_EQ(drawn(), (Ids{4, 5, 6, 7}));
    EXPECT_EQ(last().unknown, 4u);
    frame(1.9, {2, 3});
    EXPECT_EQ(last().unknown, 0u);
    const TraceWhatIfReport report = this->report();
    EXPECT_EQ(report.views[0].rows[0].totals.unknown, 4u);
    EXPECT_EQ(report.views[0].rows[0].totals.unknownFrames, 1u);
}

// The eye is 40 before the centre: 39 from the box, 40 - 3 from the sphere around it.
TEST_F(TraceWhatIfs, aMetricSaysWhatTheDistanceIsMeasuredTo) {
    std::vector<TraceSelectorSettings> settings;
    for (const double tauPx : {19.0, 20.2, 20.8, 22.0}) {
        for (const TraceMetric metric : {TraceMetric::Bounds, TraceMetric::Sphere, TraceMetric::Centre}) {
            settings.push_back(withTau(tauPx));
            settings.back().metric = metric;
        }
    }
    selectWith(settings);
    tellNodes(3);
    for (std::uint64_t id = 1; id <= 3; ++id) {
        TraceNode node = state_.nodes()[at(id)].node;
        node.bounds = {.shape = TraceBoundsShape::Box,
                       .axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)},
                       .halfSize = {2, 2, 1}};
        add(TraceNodeTold{at(id), node});
    }
    frame(20, {2, 3});
    // The root has 20.51 px by the box, 21.62 px by the sphere, and 20 px by the centre.
    const std::array splits = {true, true, true, true, true, false, false, true, false, false, false, false};
    for (std::size_t row = 0; row < splits.size(); ++row) {
        EXPECT_EQ(drawn(static_cast<int>(row)), splits[row] ? (Ids{2, 3}) : (Ids{1})) << row;
        // Errors are told by the bounds, whatever decides.
        EXPECT_NEAR(last(static_cast<int>(row)).worstErrorPx, (splits[row] ? 400 : 800) / 39.0, 1e-9);
    }
}

TEST_F(TraceWhatIfs, aSplitNodeStaysSplitWithinTheHysteresis) {
    TraceSelectorSettings settings = withTau(1);
    settings.hysteresis = 0.2;
    selectWith({settings, withTau(1)});
    tellNodes(3);
    frame(0.9, {1});
    EXPECT_EQ(drawn(), (Ids{1}));
    frame(1.1, {1});
    EXPECT_EQ(drawn(), (Ids{2, 3}));
    EXPECT_EQ(last().splits, 1u);
    frame(0.9, {1});
    EXPECT_EQ(drawn(), (Ids{2, 3}));
    EXPECT_EQ(drawn(1), (Ids{1}));
    frame(0.79, {1});
    EXPECT_EQ(drawn(), (Ids{1}));
    EXPECT_EQ(last().merges, 1u);
}

TEST_F(TraceWhatIfs, theFirstFrameTakesOverWhatTheEngineHadSplit) {
    add(TraceSet{1, 0.2});
    selectWith({withTau(1)});
    tellNodes(3);
    frame(0.9, {2, 3});
    EXPECT_EQ(drawn(), (Ids{2, 3}));
    EXPECT_EQ(report().disagreements.size(), 0u);
}

TEST_F(TraceWhatIfs, aBudgetSplitsTheLargestErrorsFirst) {
    TraceSelectorSettings settings = withTau(0.1);
    settings.budgetBytes = 5000;
    selectWith({settings});
    tellNodes(15);
    TraceNode worse = state_.nodes()[at(3)].node;
    worse.error *= 1.5;
    add(TraceNodeTold{at(3), worse});
    frame(1.9, {1});
    EXPECT_EQ(drawn(), (Ids{2, 6, 7}));
    EXPECT_EQ(last().bytes, 5000u);
    EXPECT_EQ(last().limited, 3u);
}

// ---- data ----

TEST_F(TraceWhatIfs, dataAsTracedStopsWhereTheEngineHadNone) {
    selectWith({withTau(0.5), withTau(0.5, Residency::AsTraced)});
    tellNodes(7);
    for (const std::uint64_t id : {2u, 3u, 4u, 5u}) page(TraceStep::Arrived, id);
    frame(1.9, {1});  // what has just arrived may not be there yet
    EXPECT_EQ(drawn(1), (Ids{1}));
    EXPECT_EQ(last(1).waiting, 1u);
    frame(1.9, {1});
    EXPECT_EQ(drawn(0), (Ids{4, 5, 6, 7}));
    EXPECT_EQ(drawn(1), (Ids{3, 4, 5}));
    EXPECT_EQ(last(1).waiting, 1u);
}

TEST_F(TraceWhatIfs, aDiskDeliversTheLargestErrorFirst) {
    TraceSelectorSettings settings = withTau(0.8, Residency::Disk);
    settings.disk = {
        .latencyS = 0.05, .bytesPerS = 10'000, .loaders = 1};  // 0.15 s for a node; a frame is 0.1 s
    selectWith({settings});
    tellNodes(7);
    frame(2.9, {1});  // at 0.1 s; 2 and 3 are asked for
    for (const auto& expected : {Ids{1}, Ids{1}, Ids{1}}) {
        EXPECT_EQ(drawn(), expected);
        frame(2.9, {1});
    }
    EXPECT_EQ(drawn(), (Ids{2, 3}));  // at 0.4 s
    EXPECT_EQ(last().waiting, 2u);
}

TEST_F(TraceWhatIfs, moreLoadersDeliverSooner) {
    TraceSelectorSettings settings = withTau(0.8, Residency::Disk);
    settings.disk = {.latencyS = 0.05, .bytesPerS = 10'000, .loaders = 2};
    selectWith({settings});
    tellNodes(7);
    for (int i = 0; i < 3; ++i) frame(2.9, {1});
    EXPECT_EQ(drawn(), (Ids{2, 3}));  // at 0.3 s
}

TEST(TraceDisks, whatNothingWantsAnyMoreIsNotStarted) {
    TraceDisk disk({.latencyS = 1, .bytesPerS = 1e9, .loaders = 1}, {});
    disk.beginFrame(0);
    disk.ask(1, 2, 0);
    disk.ask(2, 1, 0);
    disk.beginFrame(0.5);  // 1 has begun, and 2 is not asked for again
    disk.beginFrame(10);
    EXPECT_TRUE(disk.isThere(1));
    EXPECT_FALSE(disk.isThere(2));
}

TEST(TraceDisks, aBudgetEvictsWhatWasNotUsedForTheLongestTime) {
    TraceDisk disk({.latencyS = 0, .bytesPerS = 1e9, .loaders = 1}, 150);
    disk.beginFrame(0);
    disk.ask(1, 2, 100);
    disk.ask(2, 1, 100);
    disk.beginFrame(1);
    disk.endFrame();
    disk.beginFrame(2);
    disk.use(1);
    disk.endFrame();
    EXPECT_TRUE(disk.isThere(1));
    EXPECT_FALSE(disk.isThere(2));
    EXPECT_EQ(disk.bytes(), 100u);
}

class TraceWhatIfsOfChildren : public TraceWhatIfs {
protected:
    TraceWhatIfsOfChildren() : TraceWhatIfs(TraceRequests::Children) {}
};

TEST_F(TraceWhatIfsOfChildren, aRequestDeliversAllChildren) {
    TraceSelectorSettings settings = withTau(0.8, Residency::Disk);
    settings.disk = {.latencyS = 0.04, .bytesPerS = 1e5, .loaders = 1};  // 0.06 s for two nodes
    selectWith({settings});
    tellNodes(7);
    frame(1.9, {1});
    EXPECT_EQ(drawn(), (Ids{1}));
    frame(1.9, {1});
    EXPECT_EQ(drawn(), (Ids{2, 3}));
    frame(1.9, {1});
    EXPECT_EQ(drawn(), (Ids{3, 4, 5}));  // of equal errors the first node's
}

class TraceWhatIfsInPixels : public TraceWhatIfs {
protected:
    TraceWhatIfsInPixels() : TraceWhatIfs(TraceRequests::Node, TraceErrorUnit::Pixels) {}
};

TEST_F(TraceWhatIfsInPixels, errorsBelowDrawnNodesAreUnknown) {
    selectWith({withTau(3), withTau(5), withTau(10)});
    tellNodes(15);  // 8, 4, 2 and 1 px
    frame(1, {2, 3});
    EXPECT_EQ(drawn(0), (Ids{4, 5, 6, 7}));
    EXPECT_EQ(last(0).unknown, 4u);
    EXPECT_TRUE(std::isnan(last(0).worstErrorPx));
    EXPECT_EQ(drawn(1), (Ids{2, 3}));
    EXPECT_EQ(last(1).unknown, 0u);
    EXPECT_EQ(drawn(2), (Ids{1}));
}

// ---- the engine against its own numbers ----

TEST_F(TraceWhatIfs, anEngineThatDoesWhatItsNumbersSayIsNotListed) {
    add(TraceSet{1, 0.2});
    tellNodes(15);
    frame(1.9, {2, 3});
    frame(2.1, {4, 5, 6, 7});
    frame(1.9, {4, 5, 6, 7});
    frame(1.5, {2, 3});
    const TraceWhatIfReport report = this->report();
    EXPECT_TRUE(report.disagreements.empty()) << report.disagreements[0].sentence;
    EXPECT_EQ(report.views[0].own.nodesThatDiffer, 0u);
    EXPECT_EQ(report.framesThatDisagree, 0u);
}

TEST_F(TraceWhatIfs, aFrameInWhichTheEngineIgnoresItsTauIsListed) {
    tellNodes(15);
    frame(2.9, {4, 5, 6, 7});
    frame(2.9, {2, 6, 7});  // 2 has 1.45 px
    frame(2.9, {4, 5, 6, 7});
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.disagreements.size(), 1u);
    const TraceDisagreement& found = report.disagreements[0];
    EXPECT_EQ(found.kind, TraceDisagreementKind::TooCoarse);
    EXPECT_EQ(found.node, 2u);
    EXPECT_EQ(found.firstFrame, 2u);
    EXPECT_EQ(found.lastFrame, 2u);
    EXPECT_FALSE(found.isFade);
    EXPECT_EQ(found.sentence,
              "2 is drawn with 1.450 px although its children are there, in frame 2; expected at most 1 px");
    EXPECT_EQ(report.framesThatDisagree, 1u);
    EXPECT_EQ(report.views[0].own.framesThatDiffer, 1u);
    EXPECT_EQ(report.views[0].own.nodesThatDiffer, 3u);
}

TEST_F(TraceWhatIfs, aSplitBelowTauIsListed) {
    tellNodes(15);
    frame(1.9, {2, 3});
    frame(1.9, {2, 6, 7});
    frame(1.9, {2, 6, 7});
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.disagreements.size(), 1u);
    EXPECT_EQ(report.disagreements[0].sentence,
              "3 is split with 0.950 px, in 2 frames from 2 to 3; expected more than 1 px");
}

TEST_F(TraceWhatIfs, aSplitAtTheLargestLevelIsListedWithThatLevel) {
    add(TraceNamed{3, "max_level"});
    add(TraceSet{3, 1.0});
    tellNodes(15);
    frame(2.9, {4, 5, 3});  // 2 and 3 have 1.45 px, and no finer level
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.disagreements.size(), 1u);
    EXPECT_EQ(report.disagreements[0].kind, TraceDisagreementKind::TooFine);
    EXPECT_EQ(report.disagreements[0].sentence,
              "2 of level 1 is split, in frame 1; expected no split from max_level 1 on");
}

TEST_F(TraceWhatIfs, aSplitThatTheHysteresisKeepsIsNotListed) {
    add(TraceSet{1, 0.2});
    tellNodes(15);
    frame(2.1, {2, 6, 7});  // 2 has 1.05 px: listed
    frame(1.9, {2, 6, 7});  // 3 has 0.95 px, and was split
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.disagreements.size(), 1u);
    EXPECT_EQ(report.disagreements[0].node, 2u);
    EXPECT_EQ(report.disagreements[0].frames, 1u);
}

TEST_F(TraceWhatIfs, nodesThatWaitForDataAreNotListed) {
    tellNodes(15);
    for (const std::uint64_t id : {2u, 3u, 4u}) page(TraceStep::Arrived, id);
    frame(2.9, {2, 3});
    frame(2.9, {2, 3});
    EXPECT_TRUE(report().disagreements.empty());
}

TEST_F(TraceWhatIfs, switchesThatMayWaitForAFadeAreMarked) {
    add(TraceSet{2, 0.25});
    tellNodes(3);
    frame(0.9, {1});
    frame(1.1, {1}, {}, 0.5f);
    frame(1.1, {2, 3});
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.disagreements.size(), 1u);
    EXPECT_TRUE(report.disagreements[0].isFade);
    EXPECT_EQ(report.framesThatDisagree, 0u);
}

TEST_F(TraceWhatIfs, aSwitchThatWaitsLongerThanAFadeIsListed) {
    add(TraceSet{2, 0.26});
    tellNodes(3);
    for (int i = 0; i < 8; ++i) frame(1.1, {1});
    const TraceWhatIfReport report = this->report();
    ASSERT_EQ(report.disagreements.size(), 1u);
    EXPECT_FALSE(report.disagreements[0].isFade);
    EXPECT_EQ(report.framesThatDisagree, 2u);  // after 0.52 s
}

TEST_F(TraceWhatIfs, framesThatLostEventsAreSkipped) {
    tellNodes(15);
    frame(2.9, {4, 5, 6, 7});
    add(TraceDropped{3});
    frame(2.9, {2});
    const TraceWhatIfReport report = this->report();
    EXPECT_EQ(report.frames, 2u);
    EXPECT_EQ(report.skippedFrames, 1u);
    EXPECT_TRUE(report.disagreements.empty());
    EXPECT_EQ(report.views[0].engine.frames, 1u);
}

TEST_F(TraceWhatIfs, withoutTauNothingIsJudged) {
    add(TraceSet{0, std::string("fine")});
    selectWith({withTau(1)});
    tellNodes(3);
    frame(1.9, {1});
    const TraceWhatIfReport report = this->report();
    EXPECT_EQ(report.views[0].own.totals.frames, 0u);
    EXPECT_EQ(report.views[0].rows[0].totals.frames, 1u);
    EXPECT_TRUE(report.disagreements.empty());
}

TEST_F(TraceWhatIfs, parentsInARingEnd) {
    tellNodes(3);
    TraceNode root = state_.nodes()[at(1)].node;
    root.hasParent = true;
    root.parent = 3;
    add(TraceNodeTold{at(1), root});
    selectWith({withTau(0.01)});
    frame(1.9, {2, 3});
    EXPECT_EQ(report().frames, 1u);
}

// ---- files and sweeps ----

TraceWhatIfRow rowWith(double errorPx, std::uint64_t bytes) {
    TraceWhatIfRow row;
    row.totals.worstErrorPx = errorPx;
    row.totals.mostBytes = bytes;
    return row;
}

TEST(TraceFronts, aRowThatAnotherOneBeatsIsNotOnTheFront) {
    const std::vector rows = {rowWith(1, 100), rowWith(2, 60),  rowWith(2, 70),          rowWith(3, 60),
                              rowWith(4, 10),  rowWith(1, 100), rowWith(std::nan(""), 1)};
    EXPECT_EQ(traceFront(rows, TraceCost::Bytes), (std::vector{true, true, false, false, true, true, false}));
}

// A file of the same tree: nodes are described late, when the engine first needs them.
class TraceWhatIfFiles : public testing::Test {
protected:
    TraceWhatIfFiles() {
        test::OpenTrace trace(file_.string());
        lod_trace_description description{};
        description.name = "tree";
        lod_trace_describe(trace, &description);
        lod_trace_setting(trace, LOD_TRACE_TAU, 1);
        std::uint64_t told = 0;
        for (int frame = 0; frame < 40; ++frame) {
            const double rootPx = frame < 20 ? 1.9 : 3.9;
            const std::uint64_t first = frame < 20 ? 2 : 4;
            while (told < 2 * first - 1) tell(trace, ++told);
            lod_trace_frame_begin(trace, frame / 10.0);
            lod_trace_view_info view{};
            view.eye[2] = 8 * scalePx / rootPx;
            for (int i = 0; i < 4; ++i) view.view[5 * i] = 1;
            view.view[14] = -view.eye[2];
            view.projection[0] = view.projection[5] = 1;
            view.projection[10] = view.projection[11] = -1;
            view.viewport[2] = view.viewport[3] = 2 * static_cast<int>(scalePx);
            lod_trace_view(trace, 0, &view);
            for (std::uint64_t id = first; id < 2 * first; ++id) lod_trace_drawn(trace, 0, id, 0);
            lod_trace_frame_end(trace, -1, -1);
            // A block ends, so that its definitions lack what is described later.
            if (frame == 19) lod_trace_flush(trace, 10'000);
        }
    }
    static void tell(lod_trace* trace, std::uint64_t id) {
        lod_trace_node_info node{};
        node.id = id;
        node.has_parent = id > 1;
        node.parent = id / 2;
        node.level = levelOf(id);
        node.bounds = LOD_TRACE_BOUNDS_SPHERE;
        node.error = std::ldexp(8, -static_cast<int>(node.level));
        node.bytes = 1000;
        node.triangles = 10;
        ASSERT_EQ(lod_trace_node(trace, &node), 1);
    }
    TraceTauSuggestion suggest(const TraceTauGoal& goal) const {
        auto file = TraceFile::open(file_);
        return suggestTraceTau(*file, {}, goal).value();
    }

    const tests::TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "tree.lodtrace";
};

TEST_F(TraceWhatIfFiles, nodesAreKnownBeforeTheEngineDescribesThem) {
    auto file = TraceFile::open(file_);
    ASSERT_TRUE(file);
    const std::vector settings = {withTau(0.5)};
    const auto report = whatIfOfTrace(*file, settings);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->frames, 40u);
    EXPECT_TRUE(report->disagreements.empty());
    EXPECT_EQ(report->views[0].own.nodesThatDiffer, 0u);
    const TraceSelectionTotals& finer = report->views[0].rows[0].totals;
    EXPECT_EQ(finer.mostDrawn, 4u);
    EXPECT_EQ(finer.meanDrawn, 4);
    EXPECT_EQ(finer.unknownFrames, 20u);
}

TEST_F(TraceWhatIfFiles, aDamagedTraceGivesWhatCameBefore) {
    std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 3);
    auto file = TraceFile::open(file_);
    ASSERT_TRUE(file);
    const auto report = whatIfOfTrace(*file, {});
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->problem.has_value());
    EXPECT_FALSE(report->isDamaged);
}

TEST_F(TraceWhatIfFiles, suggestsTheLargestTauForAnErrorAndTheSmallestForACost) {
    // The root has at most 3.9 px, the levels below 1.95 and 0.975.
    const TraceTauSuggestion error = suggest({.errorPx = 2.0});
    EXPECT_TRUE(error.isMet);
    EXPECT_NEAR(error.errorPx, 1.95, 1e-12);
    EXPECT_NEAR(error.tauPx, 2.0, 2.0);
    EXPECT_GE(error.tauPx, 1.95);
    EXPECT_LT(error.tauPx, 3.9);
    const TraceTauSuggestion cost = suggest({.bytes = 3000});
    EXPECT_TRUE(cost.isMet);
    EXPECT_EQ(cost.bytes, 3000u);
    EXPECT_NEAR(cost.tauPx, 1.95, 0.02);
    const TraceTauSuggestion both = suggest({.errorPx = 2.0, .bytes = 3000});
    EXPECT_TRUE(both.isMet);
    EXPECT_NEAR(both.tauPx, 1.95, 0.02);
    EXPECT_FALSE(suggest({.errorPx = 1.0, .bytes = 3000}).isMet);
    EXPECT_FALSE(suggest({.bytes = 500}).isMet);
}

}  // namespace
}  // namespace planet
