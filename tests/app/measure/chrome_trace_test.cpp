#include "app/measure/chrome_trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/planted_spans.h"

namespace worldy {
namespace {

using Json = nlohmann::json;

// Two frames of 10 and 20 ms from 1 s on, with work of three lanes.
class ChromeTrace : public testing::Test {
protected:
    static constexpr std::int64_t ms = 1'000'000;
    static constexpr std::int64_t startNs = 1000 * ms;

    ChromeTrace() {
        timeline_.beginFrame(41, startNs, 0);
        timeline_.add(ChunkChangeKind::Came, {chunk_, planet::BlockKind::Colours}, 2.5);
        timeline_.beginFrame(42, startNs + 10 * ms, startNs + 10 * ms);
        timeline_.add(ChunkChangeKind::Split, chunk_);
        timeline_.add(ChunkChangeKind::Popped, chunk_, 1.25);
        timeline_.beginFrame(43, startNs + 30 * ms, startNs + 30 * ms);
        planet::Span load = planet::spanOf("load", startNs + ms, startNs + 4 * ms);
        load.block = chunk_;
        load.hasBlock = true;
        const std::vector<planet::Span> main = {
            planet::spanOf("select", startNs + 2 * ms, startNs + 2 * ms + 1500, 1),
            planet::spanOf("planet", startNs + ms, startNs + 5 * ms)};
        const std::vector<planet::Span> gpu = {planet::spanOf("chunks", startNs + 12 * ms, startNs + 16 * ms),
                                               planet::spanOf("sky", startNs + 15 * ms, startNs + 17 * ms)};
        timeline_.add(planet::SpanBatch{0, "main", main, 0});
        timeline_.add(planet::SpanBatch{1, "GPU", gpu, 0});
        timeline_.add(planet::SpanBatch{2, "loader 1", std::span(&load, 1), 3});
    }

    Json trace() const { return traceOf(timeline_.extent()); }
    Json traceOf(const TimeRange& range) const {
        return Json::parse(
            chromeTrace(timeline_, {.range = range, .dataSet = "a \"name\"\n\xff.tif", .gpuErrorNs = 1500}));
    }
    // Returns the events of a name and a phase.
    static std::vector<Json> events(const Json& trace, const std::string& name, const std::string& phase) {
        std::vector<Json> found;
        for (const Json& event : trace.at("traceEvents"))
            if (event.at("name") == name && event.at("ph") == phase) found.push_back(event);
        return found;
    }
    static std::map<std::string, int> threads(const Json& trace) {
        std::map<std::string, int> found;
        for (const Json& event : events(trace, "thread_name", "M"))
            found[event.at("args").at("name")] = event.at("tid");
        return found;
    }

    const planet::ChunkId chunk_{planet::Face::PosY, 4, 6, 13};
    FrameTimeline timeline_;
};

TEST_F(ChromeTrace, spansHaveTheirBeginDurationAndThread) {
    const Json json = trace();
    const std::vector<Json> select = events(json, "select", "X");
    ASSERT_EQ(select.size(), 1u);
    EXPECT_EQ(select[0].at("ts"), 2000.0);
    EXPECT_EQ(select[0].at("dur"), 1.5);
    EXPECT_EQ(select[0].at("tid"), threads(json).at("main"));
    EXPECT_EQ(select[0].at("pid"), 1);
    EXPECT_FALSE(select[0].contains("args"));
    EXPECT_EQ(events(json, "planet", "X").at(0).at("tid"), threads(json).at("main"));
}

TEST_F(ChromeTrace, aSpanNamesItsChunk) {
    const Json load = events(trace(), "load", "X").at(0);
    EXPECT_EQ(load.at("args").at("chunk"), "y_pos/4/6/13");
    EXPECT_EQ(load.at("tid"), threads(trace()).at("loader 1"));
}

TEST_F(ChromeTrace, spansThatOverlapHaveThreadsOfTheirOwn) {
    const Json json = trace();
    const auto all = threads(json);
    EXPECT_EQ(events(json, "chunks", "X").at(0).at("tid"), all.at("GPU"));
    EXPECT_EQ(events(json, "sky", "X").at(0).at("tid"), all.at("GPU, row 2"));
    EXPECT_EQ(events(json, "sky", "X").at(0).at("cat"), "gpu");
    EXPECT_NE(all.at("GPU"), all.at("GPU, row 2"));
    EXPECT_NE(all.at("GPU, row 2"), all.at("loader 1"));
}

TEST_F(ChromeTrace, framesHoldTheirNumbersAndTheChangesOfChunks) {
    const Json json = trace();
    const std::vector<Json> frames = events(json, "frame", "X");
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[1].at("args").at("frame"), 42);
    EXPECT_EQ(frames[1].at("args").at("frame_ms"), 20.0);
    EXPECT_EQ(frames[1].at("dur"), 20'000.0);
    const Json came = events(json, "came", "i").at(0);
    EXPECT_EQ(came.at("args").at("chunk"), "y_pos/4/6/13 (colours)");
    EXPECT_EQ(came.at("args").at("read_ms"), 2.5);
    const Json popped = events(json, "popped", "i").at(0);
    EXPECT_EQ(popped.at("ts"), 10'000.0);
    EXPECT_EQ(popped.at("s"), "t");
    EXPECT_EQ(popped.at("args").at("frame"), 42);
    EXPECT_EQ(popped.at("args").at("largest_px"), 1.25);
}

TEST_F(ChromeTrace, namesTheProcessAndSaysWhatItHolds) {
    const Json json = trace();
    EXPECT_EQ(events(json, "process_name", "M").at(0).at("args").at("name"), "Worldy");
    EXPECT_EQ(json.at("displayTimeUnit"), "ms");
    const Json& about = json.at("otherData");
    EXPECT_EQ(about.at("data_set"), "a \"name\"\n\xEF\xBF\xBD.tif");
    EXPECT_EQ(about.at("gpu_clock_error_us"), 1.5);
    EXPECT_EQ(about.at("spans_dropped"), 3);
    EXPECT_EQ(about.at("to_us"), 30'000.0);
}

TEST_F(ChromeTrace, holdsWhatOverlapsTheRange) {
    const Json json = traceOf({startNs + 13 * ms, startNs + 14 * ms});
    EXPECT_EQ(events(json, "frame", "X").size(), 1u);
    EXPECT_EQ(events(json, "chunks", "X").size(), 1u);
    EXPECT_EQ(events(json, "popped", "i").size(), 1u);
    for (const char* name : {"sky", "select", "load"}) EXPECT_TRUE(events(json, name, "X").empty()) << name;
}

TEST(EmptyChromeTrace, isValid) {
    const Json json = Json::parse(chromeTrace(FrameTimeline(), {}));
    EXPECT_TRUE(std::ranges::all_of(json.at("traceEvents"), [](const Json& e) { return e.at("ph") == "M"; }));
    EXPECT_FALSE(json.at("otherData").contains("gpu_clock_error_us"));
}

}  // namespace
}  // namespace worldy
