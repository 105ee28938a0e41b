// The comparison of two trace files finds planted differences and no others, reads both as a whole, and ends when asked.
#include "app/trace/trace_compare_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/job_result.h"
#include "tests/support/small_trace.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using planet::Result;
using testing::HasSubstr;

class TraceCompareJobs : public testing::Test {
protected:
    // B draws only the root in five frames in which A draws seven nodes.
    TraceCompareJobs() {
        test::writeSmallTrace(a_);
        test::writeSmallTrace(b_, test::smallTraceFrames, {.rootFrame = 50, .rootFrames = 5});
    }

    tests::TemporaryFolder folder_;
    const std::filesystem::path a_ = folder_ / "a.lodtrace", b_ = folder_ / "b.lodtrace";
};

TEST_F(TraceCompareJobs, findPlantedDifferencesAndNoOthers) {
    TraceCompareJob job({.fileA = a_, .fileB = b_});
    const auto compared = tests::resultOf(job);
    ASSERT_TRUE(compared) << compared.error().message;
    EXPECT_EQ(job.progress(), 1);
    const planet::TraceComparison& found = compared->found;
    EXPECT_EQ(found.frames, test::smallTraceFrames);
    EXPECT_EQ(found.framesThatDiffer, 5u);
    ASSERT_EQ(found.differences.size(), 5u);
    EXPECT_EQ(found.differences[0].frameA, 50u);
    EXPECT_EQ(found.differences[0].onlyInA, 7u);
    EXPECT_EQ(found.differences[0].nodesB, std::vector{test::smallTraceId(0, 0, 0)});
    ASSERT_EQ(compared->texts.size(), 5u);
    EXPECT_THAT(compared->texts[0], HasSubstr("50"));
    EXPECT_THAT(compared->texts[0], HasSubstr(" 2/1/1"));
    EXPECT_EQ(whyNothingCompared(*compared), "");
}

TEST_F(TraceCompareJobs, findNothingInATraceAndItself) {
    const auto compared = compareTraceFiles({.fileA = a_, .fileB = a_}, {});
    ASSERT_TRUE(compared);
    EXPECT_EQ(compared->found.frames, test::smallTraceFrames);
    EXPECT_EQ(compared->found.framesThatDiffer, 0u);
    EXPECT_TRUE(compared->texts.empty());
    EXPECT_EQ(compared->reportA.kinds.at(0).latencyS.p99, compared->reportB.kinds.at(0).latencyS.p99);
}

TEST_F(TraceCompareJobs, readBothAsAWhole) {
    const auto compared = compareTraceFiles({.fileA = a_, .fileB = b_}, {});
    ASSERT_TRUE(compared);
    EXPECT_EQ(compared->reportA.views.at(0).thrashes, 0u);
    EXPECT_GT(compared->reportB.views.at(0).thrashes, 0u);
    EXPECT_EQ(compared->reportA.kinds.at(0).requested, 5u);
}

TEST_F(TraceCompareJobs, sayWhyNoFrameWasCompared) {
    const auto late = folder_ / "late.lodtrace";
    test::writeSmallTrace(late, test::smallTraceFrames, {.timeOffsetS = 100});
    const auto byTime = compareTraceFiles({.fileA = a_, .fileB = late}, {});
    ASSERT_TRUE(byTime);
    EXPECT_THAT(whyNothingCompared(*byTime), HasSubstr("late.lodtrace: no frame has the same time"));
    const auto byNumber =
        compareTraceFiles({.fileA = a_, .fileB = late, .match = planet::TraceMatch::Number}, {});
    ASSERT_TRUE(byNumber);
    EXPECT_EQ(whyNothingCompared(*byNumber), "");
    EXPECT_EQ(byNumber->found.framesThatDiffer, 0u);
}

TEST_F(TraceCompareJobs, endWhenAsked) {
    std::vector<double> shares;
    const auto all = compareTraceFiles({.fileA = a_, .fileB = b_}, [&](double share) {
        shares.push_back(share);
        return true;
    });
    ASSERT_TRUE(all);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.back(), 1);
    for (const std::size_t calls : {std::size_t{1}, shares.size()}) {
        std::size_t made = 0;
        const auto ended =
            compareTraceFiles({.fileA = a_, .fileB = b_}, [&](double) { return ++made < calls; });
        ASSERT_FALSE(ended);
        EXPECT_EQ(ended.error().kind, planet::ErrorKind::Cancelled);
        EXPECT_EQ(made, calls);
    }
}

TEST_F(TraceCompareJobs, refuseWhatIsNoTrace) {
    const auto notes = folder_ / "notes.txt";
    std::ofstream(notes) << "no trace at all";
    for (const auto& request : {TraceCompareRequest{.fileA = a_, .fileB = notes},
                                TraceCompareRequest{.fileA = notes, .fileB = b_}}) {
        const auto compared = compareTraceFiles(request, {});
        ASSERT_FALSE(compared);
        EXPECT_THAT(compared.error().message, HasSubstr("notes.txt"));
    }
}

}  // namespace
}  // namespace worldy
