// The job of the What if panel finds what worldy trace --what-if finds, keeps values over the flight, and ends when asked.
#include "app/trace/trace_what_if_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "planet/trace/trace_index.h"
#include "tests/support/job_result.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/traced_flight.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using Quantity = TracedQuantity;

TraceWhatIfRequest requestWith(const std::vector<double>& tausPx) {
    TraceWhatIfRequest request;
    for (const double tauPx : tausPx) {
        request.settings.emplace_back();
        request.settings.back().tauPx = tauPx;
    }
    return request;
}

float largest(const TracedValues& values, Quantity quantity) {
    const std::vector<float>& each = values[static_cast<std::size_t>(quantity)];
    return *std::ranges::max_element(each, [](float a, float b) { return std::isnan(a) || a < b; });
}

class TraceWhatIfJobs : public testing::Test {
protected:
    tests::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "made.lodtrace";
    test::TracedFlight flight_{file_};
};

TEST_F(TraceWhatIfJobs, findTheNumbersOfTheCommand) {
    const TraceWhatIfRequest request = requestWith({1, 4});
    TraceWhatIfJob job(file_, request);
    const auto found = tests::resultOf(job);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(job.progress(), 1);
    auto file = planet::TraceFile::open(file_);
    const auto expected = planet::whatIfOfTrace(*file, request.settings);
    ASSERT_EQ(found->report.views.size(), 1u);
    const planet::TraceWhatIfView &view = found->report.views[0], &right = expected->views[0];
    EXPECT_EQ(view.engine.frames, test::TracedFlight::frames);
    for (const auto& [one, other] :
         {std::pair(view.engine, right.engine), std::pair(view.rows[0].totals, right.rows[0].totals),
          std::pair(view.rows[1].totals, right.rows[1].totals)}) {
        EXPECT_EQ(one.meanDrawn, other.meanDrawn);
        EXPECT_EQ(one.mostBytes, other.mostBytes);
        EXPECT_EQ(one.worstErrorPx, other.worstErrorPx);
        EXPECT_EQ(one.worstFrame, other.worstFrame);
        EXPECT_EQ(one.splits, other.splits);
        EXPECT_EQ(one.unknown, other.unknown);
    }
    EXPECT_GT(view.rows[0].totals.mostTriangles, view.engine.mostTriangles);
    EXPECT_LT(view.rows[1].totals.mostTriangles, view.engine.mostTriangles);
    EXPECT_EQ(found->fronts[0].bytes, planet::traceFront(right.rows, planet::TraceCost::Bytes));
    ASSERT_EQ(found->report.disagreements.size(), 1u);
    EXPECT_EQ(found->report.disagreements[0].node, flight_.planted());
    EXPECT_EQ(found->report.disagreements[0].firstFrame, test::TracedFlight::plantedFirst);
}

TEST_F(TraceWhatIfJobs, keepTheLargestValuesOverTheFlight) {
    const auto found = runTraceWhatIf(file_, requestWith({1, 4}), {});
    ASSERT_TRUE(found);
    const TraceWhatIfSeries& series = found->series.at(0);
    EXPECT_EQ(series.framesInPoint, 1u);
    ASSERT_EQ(series.frames.size(), test::TracedFlight::frames);
    EXPECT_EQ(series.frames.back(), test::TracedFlight::frames);
    EXPECT_NEAR(series.timesS.back(), 359.0 / 30, 1e-4);
    const planet::TraceWhatIfView& view = found->report.views[0];
    EXPECT_EQ(largest(series.engine, Quantity::Drawn), static_cast<float>(view.engine.mostDrawn));
    for (std::size_t row = 0; row < 2; ++row) {
        const planet::TraceSelectionTotals& totals = view.rows[row].totals;
        EXPECT_EQ(largest(series.rows[row], Quantity::Triangles), static_cast<float>(totals.mostTriangles));
        EXPECT_EQ(largest(series.rows[row], Quantity::Bytes), static_cast<float>(totals.mostBytes));
        EXPECT_EQ(largest(series.rows[row], Quantity::ErrorPx), static_cast<float>(totals.worstErrorPx));
        EXPECT_EQ(series.rows[row][static_cast<std::size_t>(Quantity::ErrorPx)][totals.worstFrame - 1],
                  static_cast<float>(totals.worstErrorPx));
        EXPECT_EQ(largest(series.rows[row], Quantity::Unknown) > 0, totals.unknown > 0);
    }
}

TEST(TraceWhatIfRecorder, mergesPointsOfLongTracesByTheirLargestValues) {
    TraceWhatIfRecorder recorder(1);
    planet::TraceState state;
    constexpr std::uint64_t frames = 5 * maxTraceWhatIfPoints + 3;
    constexpr std::uint64_t peak = 7001;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        state.add(planet::TraceFrameBegan{frame, frame, static_cast<double>(frame)});
        state.add(planet::TraceFrameEnded{frame, -1, -1});
        planet::TraceSelection selection;
        selection.triangles = frame == peak ? 1000 : 10;
        recorder.add(state, 3, -2, selection);
        if (frame % 2 == 0) recorder.add(state, 3, 0, selection);
    }
    const std::vector<TraceWhatIfSeries> all = recorder.finish();
    ASSERT_EQ(all.size(), 1u);
    const TraceWhatIfSeries& series = all[0];
    EXPECT_EQ(series.view, 3);
    EXPECT_EQ(series.framesInPoint, 8u);
    EXPECT_LE(series.frames.size(), maxTraceWhatIfPoints);
    EXPECT_EQ(series.frames.size(), (frames + 7) / 8);
    for (std::size_t i = 0; i < series.frames.size(); ++i) {
        EXPECT_EQ(series.frames[i], 8 * i + 1);
        const bool hasPeak = series.frames[i] <= peak && peak < series.frames[i] + 8;
        EXPECT_EQ(series.engine[static_cast<std::size_t>(Quantity::Triangles)][i], hasPeak ? 1000.f : 10.f);
    }
    EXPECT_EQ(largest(series.rows[0], Quantity::Triangles), 10.f);
    EXPECT_TRUE(std::isnan(series.own[0][0]));
}

TEST(TraceWhatIfRecorder, aClockThatGoesBackOrIsNoNumberStandsStill) {
    TraceWhatIfRecorder recorder(0);
    planet::TraceState state;
    std::uint64_t frame = 0;
    for (const double timeS : {5.0, 7.0, 6.0, std::nan(""), 9.0}) {
        state.add(planet::TraceFrameBegan{++frame, frame, timeS});
        state.add(planet::TraceFrameEnded{frame, -1, -1});
        recorder.add(state, 0, -2, {});
    }
    EXPECT_EQ(recorder.finish().at(0).timesS, (std::vector<float>{0, 2, 2, 2, 4}));
}

TEST_F(TraceWhatIfJobs, suggestATauWithTheOtherSettingsOfTheFirstRow) {
    TraceWhatIfRequest request = requestWith({4});
    request.settings[0].hysteresis = 0.3;
    request.goal = planet::TraceTauGoal{.errorPx = 3};
    std::vector<double> shares;
    const auto found = runTraceWhatIf(file_, request, [&](double share) {
        shares.push_back(share);
        return true;
    });
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->suggestion);
    auto file = planet::TraceFile::open(file_);
    const auto expected = planet::suggestTraceTau(*file, request.settings[0], *request.goal);
    EXPECT_EQ(found->suggestion->tauPx, expected->tauPx);
    EXPECT_EQ(found->suggestion->bytes, expected->bytes);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_LE(shares.back(), 1);
    EXPECT_FALSE(runTraceWhatIf(file_, requestWith({4}), {})->suggestion);
}

TEST_F(TraceWhatIfJobs, endWhenAsked) {
    TraceWhatIfRequest request = requestWith({0.5, 1, 2, 4});
    request.goal = planet::TraceTauGoal{.errorPx = 3};
    int calls = 0;
    const auto stopped = runTraceWhatIf(file_, request, [&](double) { return ++calls < 3; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(calls, 3);
    TraceWhatIfJob job(file_, request);
    job.cancel();
    EXPECT_TRUE(job.cancelling());
    const auto found = tests::resultOf(job);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().kind, planet::ErrorKind::Cancelled);
}

TEST_F(TraceWhatIfJobs, aDamagedTraceGivesWhatCameBefore) {
    const auto size = static_cast<std::streamoff>(std::filesystem::file_size(file_));
    {
        std::fstream bytes(file_, std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekp(size * 2 / 3);
        bytes.write("\xff\xff\xff\xff", 4);
    }
    TraceWhatIfRequest request = requestWith({2});
    request.goal = planet::TraceTauGoal{.errorPx = 3};
    const auto found = runTraceWhatIf(file_, request, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->report.isDamaged);
    EXPECT_THAT(found->report.problem.value_or(""), HasSubstr("made.lodtrace"));
    EXPECT_FALSE(found->suggestion);
    EXPECT_LT(found->report.frames, test::TracedFlight::frames);
    EXPECT_EQ(found->series.size(), found->report.views.size());
    EXPECT_EQ(found->fronts.size(), found->report.views.size());
}

TEST_F(TraceWhatIfJobs, aTraceThatIsCutOffIsReadToItsEnd) {
    std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 5);
    const auto found = runTraceWhatIf(file_, requestWith({2}), {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_THAT(found->report.problem.value_or(""), HasSubstr("made.lodtrace"));
    EXPECT_FALSE(found->report.isDamaged);
    EXPECT_GT(found->report.frames, 0u);
}

TEST_F(TraceWhatIfJobs, aDeletedTraceIsAnErrorThatNamesIt) {
    std::filesystem::remove(file_);
    TraceWhatIfJob job(file_, requestWith({2}));
    const auto found = tests::resultOf(job);
    ASSERT_FALSE(found);
    EXPECT_THAT(found.error().message, HasSubstr("made.lodtrace"));
}

}  // namespace
}  // namespace worldy
