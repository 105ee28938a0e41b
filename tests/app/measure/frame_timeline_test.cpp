#include "app/measure/frame_timeline.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/planted_spans.h"

namespace worldy {
namespace {

void add(FrameTimeline& timeline, std::size_t lane, const char* name, std::vector<planet::Span> spans,
         std::uint64_t dropped = 0) {
    timeline.add(planet::SpanBatch{lane, name, spans, dropped});
}

// Frames of these times in ms, one after another from 0.
void addFrames(FrameTimeline& timeline, const std::vector<int>& ms) {
    std::int64_t atNs = 0;
    std::uint64_t number = 0;
    timeline.beginFrame(number++, atNs, atNs);
    for (const int each : ms) {
        atNs += 1'000'000 * each;
        timeline.beginFrame(number++, atNs, atNs);
    }
}

TEST(FrameTimes, percentilesAreTimesOfFramesByNearestRank) {
    std::vector<double> frameMs;
    for (int i = 100; i >= 1; --i) frameMs.push_back(i);
    const FrameTimes times = frameTimesOf(frameMs);
    EXPECT_EQ(times.frames, 100u);
    EXPECT_EQ(times.p50Ms, 50);
    EXPECT_EQ(times.p95Ms, 95);
    EXPECT_EQ(times.p99Ms, 99);
    EXPECT_EQ(times.maxMs, 100);
}

TEST(FrameTimes, areZeroWithoutFrames) {
    const FrameTimes times = frameTimesOf({});
    EXPECT_EQ(times.frames, 0u);
    EXPECT_EQ(times.p50Ms, 0);
    EXPECT_EQ(times.maxMs, 0);
}

TEST(FrameTimeline, isEmptyAtFirst) {
    const FrameTimeline timeline;
    EXPECT_EQ(timeline.extent(), TimeRange());
    EXPECT_TRUE(timeline.frames().empty());
    EXPECT_TRUE(laneOrder(timeline).empty());
    EXPECT_EQ(timeline.frameTimesIn({0, 1'000'000'000}).frames, 0u);
}

TEST(FrameTimeline, aFrameEndsWhereTheRestOrTheNextFrameBegins) {
    FrameTimeline timeline;
    timeline.beginFrame(7, 1000, 0);
    timeline.beginFrame(8, 5000, 3000);
    timeline.beginFrame(9, 9000, 9000);
    ASSERT_EQ(timeline.frames().size(), 2u);
    EXPECT_EQ(timeline.frames()[0].number, 7u);
    EXPECT_EQ(timeline.frames()[0].endNs, 3000);
    EXPECT_EQ(timeline.frames()[1].beginNs, 5000);
    EXPECT_EQ(timeline.frames()[1].endNs, 9000);
}

TEST(FrameTimeline, aPauseOfRecordingIsNoFrame) {
    FrameTimeline timeline;
    timeline.beginFrame(1, 1000, 0);
    timeline.interrupt();
    timeline.add(ChunkChangeKind::Split, planet::ChunkId{});
    timeline.beginFrame(50, 90'000, 2000);
    timeline.beginFrame(51, 91'000, 91'000);
    ASSERT_EQ(timeline.frames().size(), 1u);
    EXPECT_EQ(timeline.frames()[0].number, 50u);
    EXPECT_TRUE(timeline.changes().empty());
}

TEST(FrameTimeline, percentilesAreThoseOfTheFramesThatBeginInTheRange) {
    FrameTimeline timeline;
    addFrames(timeline, {10, 10, 10, 40, 10});  // they begin at 0, 10, 20, 30 and 70 ms
    const FrameTimes all = timeline.frameTimesIn({0, 80'000'000});
    EXPECT_EQ(all.frames, 5u);
    EXPECT_EQ(all.p50Ms, 10);
    EXPECT_EQ(all.maxMs, 40);
    // The long frame begins before this range, so it does not belong to it.
    const FrameTimes late = timeline.frameTimesIn({31'000'000, 80'000'000});
    EXPECT_EQ(late.frames, 1u);
    EXPECT_EQ(late.maxMs, 10);
    EXPECT_EQ(timeline.frameTimesIn({71'000'000, 80'000'000}).frames, 0u);
}

TEST(FrameTimeline, framesInARangeOverlapIt) {
    FrameTimeline timeline;
    addFrames(timeline, {10, 10, 10});
    EXPECT_EQ(timeline.framesIn({12'000'000, 13'000'000}), std::pair(std::size_t{1}, std::size_t{2}));
    EXPECT_EQ(timeline.framesIn({9'000'000, 11'000'000}), std::pair(std::size_t{0}, std::size_t{2}));
    const auto [first, last] = timeline.framesIn({40'000'000, 50'000'000});
    EXPECT_EQ(first, last);
}

TEST(FrameTimeline, changesBelongToTheirFrame) {
    FrameTimeline timeline;
    const planet::ChunkId a{planet::Face::PosY, 4, 6, 13}, b{planet::Face::PosY, 5, 12, 26};
    timeline.beginFrame(1, 0, 0);
    timeline.add(ChunkChangeKind::Came, a, 2.5);
    timeline.beginFrame(2, 10, 10);
    timeline.beginFrame(3, 20, 20);
    timeline.add(ChunkChangeKind::Split, a);
    timeline.add(ChunkChangeKind::Popped, b, 1.5);
    timeline.beginFrame(4, 30, 30);
    EXPECT_EQ(timeline.changesIn(2, 2).first, timeline.changesIn(2, 2).second);
    EXPECT_EQ(timeline.changesIn(1, 1), std::pair(std::size_t{0}, std::size_t{1}));
    EXPECT_EQ(timeline.changesIn(3, 3), std::pair(std::size_t{1}, std::size_t{3}));
    EXPECT_EQ(timeline.changesIn(1, 4), std::pair(std::size_t{0}, std::size_t{3}));
    EXPECT_EQ(timeline.changes()[2].block.parent, b);
    EXPECT_EQ(timeline.changes()[2].value, 1.5f);
}

TEST(FrameTimeline, nestedSpansHaveRowsByDepth) {
    FrameTimeline timeline;
    add(timeline, 2, "main",
        {planet::spanOf("inner", 2, 4, 1), planet::spanOf("inner", 5, 8, 1), planet::spanOf("outer", 1, 9),
         planet::spanOf("outer", 9, 12)});
    const TimelineLane& lane = timeline.lanes().at(2);
    EXPECT_EQ(lane.name, "main");
    EXPECT_TRUE(lane.nests);
    ASSERT_EQ(lane.rows.size(), 2u);
    EXPECT_EQ(lane.rows[0].size(), 2u);
    EXPECT_EQ(lane.rows[1].size(), 2u);
    EXPECT_EQ(lane.rows[1][1].beginNs, 5);
}

TEST(FrameTimeline, spansThatOverlapGoIntoAnotherRowAndLateOnesIntoTheirPlace) {
    FrameTimeline timeline;
    add(timeline, 0, "GPU",
        {planet::spanOf("chunks", 0, 10), planet::spanOf("chunks", 30, 40), planet::spanOf("sky", 10, 12)});
    EXPECT_TRUE(timeline.lanes()[0].nests);
    ASSERT_EQ(timeline.lanes()[0].rows.size(), 1u);
    EXPECT_STREQ(timeline.lanes()[0].rows[0][1].name, "sky");
    add(timeline, 0, "GPU", {planet::spanOf("panels", 35, 45)});
    EXPECT_FALSE(timeline.lanes()[0].nests);
    ASSERT_EQ(timeline.lanes()[0].rows.size(), 2u);
    EXPECT_STREQ(timeline.lanes()[0].rows[1][0].name, "panels");
}

TEST(FrameTimeline, discardsTheOldestSpansOfAllLanesAndCountsThem) {
    FrameTimeline timeline({.spans = 4, .frames = 100, .changes = 100});
    add(timeline, 0, "main",
        {planet::spanOf("a", 0, 10), planet::spanOf("b", 20, 30), planet::spanOf("c", 40, 50)});
    EXPECT_EQ(timeline.discarded(), 0u);
    EXPECT_EQ(timeline.completeFromNs(), 0);
    add(timeline, 1, "loader 1",
        {planet::spanOf("d", 5, 8), planet::spanOf("e", 25, 28), planet::spanOf("f", 45, 48)});
    EXPECT_EQ(timeline.spanCount(), 4u);
    EXPECT_EQ(timeline.discarded(), 2u);
    EXPECT_EQ(timeline.completeFromNs(), 10);
    EXPECT_STREQ(timeline.lanes()[0].rows[0].front().name, "b");
    EXPECT_STREQ(timeline.lanes()[1].rows[0].front().name, "e");
    EXPECT_EQ(timeline.originNs(), 0);
}

TEST(FrameTimeline, discardsTheOldestFramesWithTheirChanges) {
    FrameTimeline timeline({.spans = 100, .frames = 2, .changes = 100});
    for (std::uint64_t number = 1; number <= 5; ++number) {
        const auto atNs = static_cast<std::int64_t>(10 * number);
        timeline.beginFrame(number, atNs, atNs);
        timeline.add(ChunkChangeKind::Split, planet::ChunkId{});
    }
    ASSERT_EQ(timeline.frames().size(), 2u);
    EXPECT_EQ(timeline.frames().front().number, 3u);
    EXPECT_EQ(timeline.changes().front().frame, 3u);
    EXPECT_EQ(timeline.completeFromNs(), 30);
}

TEST(FrameTimeline, countsWhatWasNeverRecorded) {
    FrameTimeline timeline;
    add(timeline, 0, "main", {planet::spanOf("a", 0, 10)}, 5);
    add(timeline, 1, "loader 1", {}, 2);
    EXPECT_EQ(timeline.dropped(), 7u);
}

TEST(FrameTimeline, lanesAreInTheOrderMainGpuLoadersByNumber) {
    FrameTimeline timeline;
    for (const char* name : {"loader 10", "GPU", "loader 2", "main", "loader 2"})
        add(timeline, timeline.lanes().size(), name, {planet::spanOf("a", 0, 10)});
    std::vector<std::string> names;
    for (const std::size_t lane : laneOrder(timeline)) names.push_back(timeline.lanes()[lane].name);
    EXPECT_EQ(names, (std::vector<std::string>{"main", "GPU", "loader 2", "loader 2 (2)", "loader 10"}));
}

}  // namespace
}  // namespace worldy
