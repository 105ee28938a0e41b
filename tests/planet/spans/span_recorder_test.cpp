#include "planet/spans/span_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace planet {
namespace {

struct Drained {
    std::map<std::string, std::vector<Span>> spans;  // by the lane's name
    std::map<std::string, std::set<std::size_t>> lanes;
    std::map<std::string, std::uint64_t> dropped;
};

void drainInto(Drained& drained) {
    drainSpans([&](const SpanBatch& batch) {
        const std::string name(batch.name);
        std::vector<Span>& spans = drained.spans[name];
        spans.insert(spans.end(), batch.spans.begin(), batch.spans.end());
        drained.lanes[name].insert(batch.lane);
        drained.dropped[name] += batch.dropped;
    });
}

Drained drain() {
    Drained drained;
    drainInto(drained);
    return drained;
}

// The recorder is that of the process, so other tests' spans are drained first.
class SpanRecorder : public testing::Test {
protected:
    SpanRecorder() {
        drain();
        recordSpans(true);
    }
    ~SpanRecorder() override { recordSpans(false); }
};

void spin(std::int64_t ns) {
    const std::int64_t beginNs = spanClockNs();
    while (spanClockNs() - beginNs < ns) continue;
}

TEST_F(SpanRecorder, aSpanHasItsNameItsBlockAndAtLeastTheTimeOfItsWork) {
    const BlockId block({Face::NegY, 4, 6, 13}, BlockKind::Colours);
    std::int64_t beforeNs = 0, afterNs = 0;
    std::thread([&] {
        nameSpanThread("planted", 3);
        beforeNs = spanClockNs();
        {
            const SpanScope span("work", block);
            spin(2'000'000);
        }
        afterNs = spanClockNs();
    }).join();
    const Drained drained = drain();
    ASSERT_EQ(drained.spans.size(), 1u);
    ASSERT_EQ(drained.spans.count("planted 3"), 1u);
    const std::vector<Span>& spans = drained.spans.at("planted 3");
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_STREQ(spans[0].name, "work");
    EXPECT_TRUE(spans[0].hasBlock);
    EXPECT_EQ(spans[0].block, block);
    EXPECT_EQ(spans[0].depth, 0);
    EXPECT_GE(spans[0].beginNs, beforeNs);
    EXPECT_LE(spans[0].endNs, afterNs);
    EXPECT_GE(spans[0].endNs - spans[0].beginNs, 2'000'000);
}

TEST_F(SpanRecorder, aSpanInASpanIsDeeper) {
    std::thread([] {
        nameSpanThread("nested");
        const SpanScope outer("outer");
        { const SpanScope inner("first"); }
        { const SpanScope inner("second"); }
    }).join();
    const std::vector<Span> spans = drain().spans.at("nested");
    ASSERT_EQ(spans.size(), 3u);
    EXPECT_STREQ(spans[0].name, "first");
    EXPECT_STREQ(spans[2].name, "outer");
    EXPECT_EQ(spans[0].depth, 1);
    EXPECT_EQ(spans[1].depth, 1);
    EXPECT_EQ(spans[2].depth, 0);
    EXPECT_FALSE(spans[0].hasBlock);
    EXPECT_LE(spans[2].beginNs, spans[0].beginNs);
    EXPECT_LE(spans[0].endNs, spans[1].beginNs);
    EXPECT_LE(spans[1].endNs, spans[2].endNs);
}

TEST_F(SpanRecorder, nothingIsRecordedWhileItIsOffOrWithoutAName) {
    std::thread([] { const SpanScope span("of a thread without a name"); }).join();
    recordSpans(false);
    std::thread([] {
        nameSpanThread("off");
        const SpanScope span("work");
    }).join();
    EXPECT_TRUE(drain().spans.empty());
}

TEST_F(SpanRecorder, aSpanThatBeginsBeforeItIsTurnedOnIsLeftOut) {
    recordSpans(false);
    std::thread([] {
        nameSpanThread("half");
        const SpanScope span("begins too early");
        recordSpans(true);
        { const SpanScope inner("whole"); }
    }).join();
    const std::vector<Span> spans = drain().spans.at("half");
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_STREQ(spans[0].name, "whole");
    EXPECT_EQ(spans[0].depth, 0);
}

TEST_F(SpanRecorder, aFullRingDropsAndCountsWhatFollowsOnce) {
    constexpr std::size_t more = 100;
    std::thread([] {
        nameSpanThread("full");
        for (std::size_t i = 0; i < spansPerLane + more; ++i) const SpanScope span("work");
    }).join();
    const Drained drained = drain();
    EXPECT_EQ(drained.spans.at("full").size(), spansPerLane);
    EXPECT_EQ(drained.dropped.at("full"), more);
    EXPECT_TRUE(drain().dropped.empty());
}

TEST_F(SpanRecorder, aThreadOfTheSameNameGoesOnWithTheLane) {
    for (int i = 0; i < 3; ++i) {
        std::thread([] {
            nameSpanThread("again");
            const SpanScope span("work");
        }).join();
    }
    const Drained drained = drain();
    EXPECT_EQ(drained.lanes.at("again").size(), 1u);
    EXPECT_EQ(drained.spans.at("again").size(), 3u);
}

TEST_F(SpanRecorder, threadsOfTheSameNameAtTheSameTimeHaveLanesOfTheirOwn) {
    std::atomic<int> begun{0};
    const auto run = [&] {
        nameSpanThread("twin");
        { const SpanScope span("work"); }
        ++begun;
        while (begun < 2) std::this_thread::yield();
    };
    std::thread one(run), other(run);
    one.join();
    other.join();
    EXPECT_EQ(drain().lanes.at("twin").size(), 2u);
}

// Under ThreadSanitizer this also finds races.
TEST_F(SpanRecorder, severalThreadsRecordAtOnceWhileAnotherDrains) {
    constexpr int threads = 4;
    constexpr std::size_t spansPerThread = 20'000;
    std::atomic<int> running{threads};
    std::vector<std::thread> all;
    for (int number = 1; number <= threads; ++number) {
        all.emplace_back([&, number] {
            nameSpanThread("busy", number);
            for (std::uint32_t i = 0; i < spansPerThread; ++i)
                const SpanScope span("work",
                                     BlockId({Face::PosX, 20, i, static_cast<std::uint32_t>(number)}));
            --running;
        });
    }
    Drained drained;
    while (running > 0) drainInto(drained);
    for (std::thread& thread : all) thread.join();
    drainInto(drained);
    for (int number = 1; number <= threads; ++number) {
        const std::string name = "busy " + std::to_string(number);
        const std::vector<Span>& spans = drained.spans[name];
        EXPECT_EQ(spans.size() + drained.dropped[name], spansPerThread) << name;
        for (std::size_t i = 0; i < spans.size(); ++i) {
            ASSERT_EQ(spans[i].block.parent.y, static_cast<std::uint32_t>(number)) << name;
            if (i > 0) {
                ASSERT_LT(spans[i - 1].block.parent.x, spans[i].block.parent.x) << name;
            }
        }
    }
}

TEST_F(SpanRecorder, aLaneOfADeviceTakesSpansThatWereMeasuredElsewhere) {
    SpanLane lane("device");
    Span span;
    span.name = "measured";
    span.beginNs = 5;
    span.endNs = 17;
    lane.record(span);
    const std::vector<Span> spans = drain().spans.at("device");
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_EQ(spans[0].endNs - spans[0].beginNs, 12);
}

}  // namespace
}  // namespace planet
