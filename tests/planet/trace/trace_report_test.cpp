// A report counts what the events say, no more.
#include "planet/trace/trace_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "planet/trace/lod_trace.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

constexpr double noBudget = std::numeric_limits<double>::infinity();

TraceNode reportedNode(std::uint64_t id, std::optional<std::uint64_t> parent = {}, std::uint32_t level = 0) {
    TraceNode node;
    node.id = id;
    node.isTold = true;
    node.hasParent = parent.has_value();
    node.parent = parent.value_or(0);
    node.level = level;
    node.bytes = 100;
    node.triangles = 8;
    return node;
}

// A root, 0, with the children 1 and 2; 3 is a child of 1.
class TraceReports : public testing::Test {
protected:
    TraceReports() {
        TraceDescription description;
        description.error = TraceErrorUnit::Pixels;
        description.kinds[1] = "colours";
        add(description);
        add(TraceNodeTold{0, reportedNode(10)});
        add(TraceNodeTold{1, reportedNode(11, 10, 1)});
        add(TraceNodeTold{2, reportedNode(12, 10, 1)});
        add(TraceNodeTold{3, reportedNode(13, 11, 2)});
        add(TraceNamed{0, "tau"});
        add(TraceSet{0, 2.0});
    }

    void add(const TraceEvent& event) {
        if (state_.add(event)) reporter_.add(state_);
    }
    void frame(double timeS, const std::vector<TraceNodeIndex>& drawn, float errorPx = 1, double cpuMs = 5) {
        add(TraceFrameBegan{++frames_, frames_ * 1000, timeS});
        for (const TraceNodeIndex node : drawn)
            add(TraceDrawn{.node = node, .hasErrorPx = true, .errorPx = errorPx});
        add(TraceFrameEnded{frames_ * 1000 + 500, cpuMs, -1});
    }
    TraceReport report() { return reporter_.finish(state_); }

    TraceState state_;
    TraceReporter reporter_{16, {}};
    std::uint64_t frames_ = 0;
};

TEST_F(TraceReports, emptyTraceHasNothing) {
    const TraceReport report = this->report();
    EXPECT_EQ(report.frames, 0u);
    EXPECT_EQ(report.missingFrames, 0u);
    EXPECT_EQ(report.cpuMs.count, 0u);
    EXPECT_TRUE(std::isnan(report.cpuMs.median));
    EXPECT_TRUE(report.views.empty());
    EXPECT_TRUE(report.kinds.empty());
}

TEST_F(TraceReports, changesOfLevelAreCountedAndThoseOfViewAreNot) {
    frame(0, {0});
    frame(0.1, {1, 2});  // a split of 0
    frame(0.2, {3, 2});  // a split of 1
    frame(0.3, {2});     // 1 left the view: no merge, because nothing covers it
    frame(0.4, {0});     // a merge of 0, back within a second
    frame(5.0, {1, 2});  // a split of 0, much later
    const TraceReport report = this->report();
    ASSERT_EQ(report.views.size(), 1u);
    EXPECT_EQ(report.views[0].splits, 3u);
    EXPECT_EQ(report.views[0].merges, 1u);
    EXPECT_EQ(report.views[0].thrashes, 1u);
    EXPECT_EQ(report.views[0].mostDrawn, 2u);
    EXPECT_EQ(report.views[0].mostTriangles, 16u);
    EXPECT_EQ(report.durationS, 5.0);
}

TEST_F(TraceReports, jumpOverLevelsCountsEveryNodeThatIsSplit) {
    frame(0, {0});
    frame(0.1, {3});
    EXPECT_EQ(report().views[0].splits, 2u);
}

TEST_F(TraceReports, nothingIsAChangeAcrossAGap) {
    frame(0, {0});
    ++frames_;
    frame(0.1, {1, 2});
    add(TraceFrameBegan{++frames_, frames_ * 1000, 0.2});
    add(TraceDropped{5});
    add(TraceDrawn{.node = 0});
    add(TraceFrameEnded{frames_ * 1000 + 500, 5, -1});
    frame(0.3, {0});
    const TraceReport report = this->report();
    EXPECT_EQ(report.views[0].splits, 0u);
    EXPECT_EQ(report.views[0].merges, 0u);
    EXPECT_EQ(report.missingFrames, 1u);
    EXPECT_EQ(report.droppedEvents, 5u);
}

TEST_F(TraceReports, numbersThatGoBackAreNoMissingFrames) {
    for (const std::uint64_t number : {5u, 3u, 4u, 7u}) {
        frames_ = number - 1;
        frame(0, {0});
    }
    EXPECT_EQ(report().missingFrames, 2u);
}

TEST_F(TraceReports, worstErrorNamesItsFrameAndNode) {
    frame(0, {0}, 1);
    frame(0.1, {1, 2}, 3);
    frame(0.2, {2}, 2);
    const TraceReport report = this->report();
    EXPECT_EQ(report.views[0].worstErrorPx, 3);
    EXPECT_EQ(report.views[0].worstFrame, 2u);
    EXPECT_EQ(report.views[0].worstNode, 11u);
    EXPECT_EQ(report.views[0].tauPx, 2);
    EXPECT_EQ(report.views[0].framesOverTau, 1u);
}

TEST_F(TraceReports, framesOverTheBudgetAreCounted) {
    frame(0, {0}, 1, 15.9);
    frame(0.1, {0}, 1, 16.1);
    add(TraceFrameBegan{++frames_, frames_ * 1000, 0.2});
    add(TraceFrameEnded{frames_ * 1000 + 500, -1, 40});
    const TraceReport report = this->report();
    EXPECT_EQ(report.framesOverBudget, 2u);
    EXPECT_EQ(report.cpuMs.count, 2u);
    EXPECT_FLOAT_EQ(static_cast<float>(report.cpuMs.most), 16.1f);
    EXPECT_EQ(report.gpuMs.median, 40);
}

TEST_F(TraceReports, latenciesAreThoseOfTheMonotonicClock) {
    add(TraceFrameBegan{++frames_, 1, 0});
    const auto paged = [&](TraceStep step, TraceNodeIndex node, std::uint64_t ns) {
        add(TracePaged{.step = step, .kind = 1, .node = node, .ns = ns});
    };
    for (const TraceNodeIndex node : {1u, 2u, 3u}) paged(TraceStep::Requested, node, 1'000'000'000);
    paged(TraceStep::Started, 1, 1'250'000'000);
    paged(TraceStep::Arrived, 1, 1'500'000'000);
    paged(TraceStep::Cancelled, 2, 1'600'000'000);
    paged(TraceStep::Failed, 3, 1'700'000'000);
    paged(TraceStep::Evicted, 1, 1'800'000'000);
    add(TraceFrameEnded{2'000'000'000, 5, -1});
    const TraceReport report = this->report();
    ASSERT_EQ(report.kinds.size(), 1u);
    const TraceKindReport& kind = report.kinds[0];
    EXPECT_EQ(kind.name, "colours");
    EXPECT_EQ(kind.requested, 3u);
    EXPECT_EQ(kind.arrived, 1u);
    EXPECT_EQ(kind.cancelled, 1u);
    EXPECT_EQ(kind.failed, 1u);
    EXPECT_EQ(kind.evicted, 1u);
    EXPECT_EQ(kind.arrivedBytes, 100u);
    EXPECT_FLOAT_EQ(static_cast<float>(kind.latencyS.median), 0.5f);
    EXPECT_FLOAT_EQ(static_cast<float>(kind.waitS.median), 0.25f);
}

TEST(TraceReporter, errorsOfAnEngineThatDescribesNothingAreWorldUnits) {
    TraceState state;
    TraceReporter reporter(16, {});
    TraceNode node = reportedNode(1);
    node.bounds = {.shape = TraceBoundsShape::Sphere, .centre = {0, 0, -11}, .radius = 1};
    node.error = 0.1;
    TraceView view;
    view.width = 1000;  // K' is 500 px
    for (const TraceEvent& event : std::initializer_list<TraceEvent>{
             TraceNodeTold{0, node}, TraceNamed{0, "tau"}, TraceSet{0, 2.0}, TraceFrameBegan{1, 1, 0},
             TraceViewTold{0, view}, TraceDrawn{.node = 0}, TraceFrameEnded{2, 1, -1}})
        if (state.add(event)) reporter.add(state);
    const TraceReport report = reporter.finish(state);
    ASSERT_EQ(report.views.size(), 1u);
    EXPECT_NEAR(report.views[0].worstErrorPx, 5, 1e-9);
    EXPECT_EQ(report.views[0].framesOverTau, 1u);
}

TEST(TraceSpread, isTheNearestRank) {
    std::vector<float> values;
    for (int i = 200; i > 0; --i) values.push_back(static_cast<float>(i));
    values.push_back(NAN);
    const TraceSpread spread = spreadOf(values);
    EXPECT_EQ(spread.count, 200u);
    EXPECT_EQ(spread.median, 100);
    EXPECT_EQ(spread.p99, 198);
    EXPECT_EQ(spread.most, 200);
}

std::filesystem::path writeTrace(const tests::TemporaryFolder& folder) {
    const std::filesystem::path path = folder.path() / "engine.lodtrace";
    char error[256] = "";
    lod_trace* const trace = lod_trace_open(path.c_str(), nullptr, error, sizeof error);
    EXPECT_NE(trace, nullptr) << error;
    lod_trace_node_info root{};
    root.id = 7;
    lod_trace_node(trace, &root);
    for (int frame = 0; frame < 50; ++frame) {
        lod_trace_frame_begin(trace, frame * 0.02);
        lod_trace_drawn(trace, 0, 7, 0);
        lod_trace_frame_end(trace, 2, 3);
    }
    lod_trace_close(trace);
    return path;
}

TEST(TraceReportOfFile, readsWhatTheHeaderWrote) {
    const tests::TemporaryFolder folder;
    auto file = TraceFile::open(writeTrace(folder));
    ASSERT_TRUE(file) << file.error().message;
    const auto report = reportOfTrace(*file, noBudget);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->frames, 50u);
    EXPECT_EQ(report->missingFrames, 0u);
    EXPECT_EQ(report->framesOverBudget, 0u);
    EXPECT_EQ(report->cpuMs.median, 2);
    EXPECT_FALSE(report->problem);
    EXPECT_TRUE(report->faults.empty());
    EXPECT_EQ(reportOfTrace(*file, noBudget, {}, [] { return false; }).error().kind, ErrorKind::Cancelled);
}

TEST(TraceReportOfFile, wrongBytesAreDamage) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path path = writeTrace(folder);
    {
        std::fstream bytes(path, std::ios::binary | std::ios::in | std::ios::out);
        bytes.seekp(static_cast<std::streamoff>(std::filesystem::file_size(path)) - 1);
        bytes.put('\x7f');
    }
    auto file = TraceFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    const auto report = reportOfTrace(*file, noBudget);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->isDamaged);
    EXPECT_TRUE(report->problem);
}

TEST(TraceReportOfFile, traceThatIsCutOffIsReportedUpToThere) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path path = writeTrace(folder);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
    auto file = TraceFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    const auto report = reportOfTrace(*file, noBudget);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->problem);
    EXPECT_FALSE(report->isDamaged);
    EXPECT_LT(report->frames, 50u);
}

}  // namespace
}  // namespace planet
