#include "ui/model/time_axis.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/planted_spans.h"

namespace worldy::ui {
namespace {

constexpr std::int64_t oneUs = 1'000, oneMs = 1'000'000, oneS = 1'000'000'000;
constexpr TimeRange keptRange{0, 300 * oneS};

std::vector<std::string> labels(const TimeRange& range, std::int64_t originNs, std::size_t most) {
    std::vector<std::string> texts;
    for (const TimeTick& tick : timeTicks(range, originNs, most)) texts.push_back(tick.label);
    return texts;
}

TEST(TimeAxis, zoomKeepsThePlaceUnderThePointer) {
    const TimeRange range{100 * oneS, 110 * oneS};
    EXPECT_EQ(zoomed(range, 0.3, 0.5, keptRange), (TimeRange{101'500 * oneMs, 106'500 * oneMs}));
    EXPECT_EQ(zoomed(zoomed(range, 0.3, 0.5, keptRange), 0.3, 2, keptRange), range);
}

TEST(TimeAxis, zoomsFromSecondsToOneMicrosecondAndNoFurther) {
    TimeRange range{100 * oneS, 110 * oneS};
    for (int i = 0; i < 200; ++i) range = zoomed(range, 0.5, 0.8, keptRange);
    EXPECT_EQ(range.lengthNs(), 1 * oneUs);
    EXPECT_LE(range.fromNs, 105 * oneS);
    EXPECT_GE(range.toNs, 105 * oneS);
}

TEST(TimeAxis, staysInWhatIsKept) {
    EXPECT_EQ(zoomed({10 * oneS, 20 * oneS}, 0.5, 1000, keptRange), keptRange);
    EXPECT_EQ(moved({10 * oneS, 20 * oneS}, -5, keptRange), (TimeRange{0, 10 * oneS}));
    EXPECT_EQ(moved({10 * oneS, 20 * oneS}, 100, keptRange), (TimeRange{290 * oneS, 300 * oneS}));
    EXPECT_EQ(moved({10 * oneS, 20 * oneS}, 0.1, keptRange), (TimeRange{11 * oneS, 21 * oneS}));
    EXPECT_EQ(within({-5 * oneS, 900 * oneS}, keptRange), keptRange);
    EXPECT_GE(within({0, 0}, {}).lengthNs(), shortestRangeNs);
}

TEST(TimeAxis, ticksAreRoundAndHaveTheUnitOfTheirDistance) {
    EXPECT_EQ(labels({10 * oneS, 20 * oneS}, 10 * oneS, 5),
              (std::vector<std::string>{"0 s", "2 s", "4 s", "6 s", "8 s"}));
    EXPECT_EQ(labels({12 * oneS, 12 * oneS + 25 * oneMs}, 12 * oneS, 5),
              (std::vector<std::string>{"0 ms", "5 ms", "10 ms", "15 ms", "20 ms"}));
    EXPECT_EQ(labels({oneS + 3 * oneUs, oneS + 4 * oneUs}, oneS, 5),
              (std::vector<std::string>{"3.0 µs", "3.2 µs", "3.4 µs", "3.6 µs", "3.8 µs"}));
    EXPECT_EQ(labels({1500 * oneMs, 3500 * oneMs}, 0, 4),
              (std::vector<std::string>{"1.5 s", "2.0 s", "2.5 s", "3.0 s"}));
}

TEST(TimeAxis, ticksFarFromTheBeginAreToldFromTheFirst) {
    EXPECT_EQ(labels({12 * oneS + 1 * oneUs, 12 * oneS + 11 * oneUs}, 0, 5),
              (std::vector<std::string>{"12.000002 s", "+2 µs", "+4 µs", "+6 µs", "+8 µs"}));
}

TEST(TimeAxis, hasNoMoreTicksThanAsked) {
    for (std::int64_t lengthNs = 1000; lengthNs < 400 * oneS; lengthNs = lengthNs * 13 / 10)
        EXPECT_LE(timeTicks({17, 17 + lengthNs}, 0, 7).size(), 8u) << lengthNs;
    EXPECT_TRUE(timeTicks({5, 5}, 0, 7).empty());
}

TEST(TimeAxis, timesHaveThreeDigits) {
    EXPECT_EQ(spanTimeText(0), "0 ns");
    EXPECT_EQ(spanTimeText(250), "250 ns");
    EXPECT_EQ(spanTimeText(12'345), "12.3 µs");
    EXPECT_EQ(spanTimeText(16'700'000), "16.7 ms");
    EXPECT_EQ(spanTimeText(1'250'000'000), "1.25 s");
    EXPECT_EQ(spanTimeText(180 * oneS), "180 s");
}

TEST(SpanBoxes, aWideSpanHasABoxOfItsOwnCutAtTheEdges) {
    const TimelineRow row = {planet::spanOf("a", -50, 20), planet::spanOf("b", 30, 60),
                             planet::spanOf("c", 90, 500), planet::spanOf("d", 500, 600)};
    const std::vector<SpanBox> boxes = boxesOf(row, {0, 100}, 100);
    ASSERT_EQ(boxes.size(), 3u);
    EXPECT_EQ(boxes[0].fromPx, 0);
    EXPECT_EQ(boxes[0].toPx, 20);
    EXPECT_EQ(boxes[0].busyNs, 20);
    EXPECT_STREQ(boxes[1].longest->name, "b");
    EXPECT_EQ(boxes[1].fromPx, 30);
    EXPECT_EQ(boxes[1].toPx, 60);
    EXPECT_EQ(boxes[2].toPx, 100);
}

TEST(SpanBoxes, narrowSpansShareAColumnAndNoneIsLost) {
    TimelineRow row;
    for (std::int64_t i = 0; i < 100'000; ++i) row.push_back(planet::spanOf("a", 10 * i, 10 * i + 5));
    row[55'555].endNs += 2;
    row[55'555].name = "long";
    const std::vector<SpanBox> boxes = boxesOf(row, {0, 1'000'000}, 800);
    EXPECT_LE(boxes.size(), 801u);
    std::size_t spans = 0;
    std::int64_t busyNs = 0;
    bool isFound = false;
    for (const SpanBox& box : boxes) {
        spans += box.spans;
        busyNs += box.busyNs;
        isFound |= std::string(box.longest->name) == "long";
        EXPECT_LE(box.toPx - box.fromPx, 1.001f);
    }
    EXPECT_EQ(spans, 100'000u);
    EXPECT_EQ(busyNs, 500'002);
    EXPECT_TRUE(isFound);
}

TEST(SpanBoxes, thereAreNoneInAnEmptyRange) {
    const TimelineRow row = {planet::spanOf("a", 0, 10)};
    EXPECT_TRUE(boxesOf(row, {10, 20}, 100).empty());
    EXPECT_TRUE(boxesOf(row, {5, 5}, 100).empty());
    EXPECT_TRUE(boxesOf({}, {0, 10}, 100).empty());
}

}  // namespace
}  // namespace worldy::ui
