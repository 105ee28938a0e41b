// A document shows the frames that a trace has, and what happens over all of them.
#include "app/trace/trace_document.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/trace/traced_reasons.h"
#include "tests/support/small_trace.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using test::smallTraceId;

class TraceDocuments : public testing::Test {
protected:
    // Waits until a condition holds; gives up after a minute.
    template <class Condition>
    static bool wait(const Condition& condition) {
        for (int i = 0; i < 6000; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    std::shared_ptr<const TracedFrame> read(TraceDocument& document, std::uint64_t frame) {
        document.show(frame);
        EXPECT_TRUE(wait([&] { return !document.isBusy(); }));
        return document.frame();
    }
    std::shared_ptr<const TraceHistory> history(TraceDocument& document) {
        EXPECT_TRUE(wait([&] { return document.history() && document.history()->isComplete; }));
        return document.history();
    }

    const tests::TemporaryFolder folder_;
    const fs::path file_ = folder_.path() / "small.lodtrace";
};

TEST_F(TraceDocuments, framesAreReadInAnyOrder) {
    test::writeSmallTrace(file_);
    TraceDocument document(file_, false);
    for (const std::uint64_t frame : {1u, 30u, 31u, 60u, 5u, 41u, 1u}) {
        const auto read = this->read(document, frame);
        ASSERT_TRUE(read);
        EXPECT_EQ(read->frame.number, frame);
        ASSERT_EQ(read->views.size(), 1u);
        EXPECT_EQ(read->views[0].drawn, frame <= 20 ? 1u : frame <= 40 ? 4u : 7u);
        EXPECT_EQ(read->views[0].tauPx, test::smallTraceTauPx);
        EXPECT_EQ(read->counters.at("uploads"), static_cast<double>(frame));
    }
    EXPECT_EQ(document.problem(), "");
    TraceDocument backwards(file_, false);
    for (const std::uint64_t frame : {60u, 40u, 50u, 7u})
        EXPECT_EQ(read(backwards, frame)->frame.number, frame);
}

// It has more nodes than are kept, so that frames between kept ones are decoded again.
TEST_F(TraceDocuments, framesBeforeKeptOnesAreReadAgain) {
    TraceDocument document(fs::path(WORLDY_SOURCE_DIR) / "tests" / "trace" / "cesium" / "cesium.lodtrace",
                           false);
    for (const std::uint64_t frame : {198u, 73u, 145u, 108u, 136u, 40u}) {
        const auto read = this->read(document, frame);
        ASSERT_TRUE(read);
        EXPECT_EQ(read->frame.number, frame);
    }
}

TEST_F(TraceDocuments, numbersBesideTheTraceShowItsNearestFrame) {
    test::writeSmallTrace(file_);
    TraceDocument document(file_, false);
    EXPECT_EQ(read(document, 0)->frame.number, 1u);
    EXPECT_EQ(read(document, 1'000'000)->frame.number, test::smallTraceFrames);
}

TEST_F(TraceDocuments, aDrawnNodeTellsItsCoarserNeighbourAndWhatHidesTheGap) {
    test::writeSmallTrace(file_);
    TraceDocument document(file_, false);
    TracedFrame frame = *read(document, 50);
    const auto told = [&](std::uint64_t id) {
        std::string all;
        for (const std::string& sentence : tracedReasons(frame, frame.views[0], *frame.views[0].find(id)))
            all += sentence + "\n";
        return all;
    };
    const std::uint64_t atTheEdge = smallTraceId(2, 1, 0);
    EXPECT_NE(told(atTheEdge).find(
                  "1 level coarser, so their edges differ. The engine told no setting \"skirts\"."),
              std::string::npos)
        << told(atTheEdge);
    frame.settings["skirts"] = 1.0;
    EXPECT_NE(told(atTheEdge).find("the engine's skirts hide the gap"), std::string::npos);
    frame.settings["skirts"] = 0.0;
    EXPECT_NE(told(atTheEdge).find("the engine draws no skirts"), std::string::npos);
    EXPECT_EQ(told(smallTraceId(2, 0, 0)).find("coarser, so"), std::string::npos)
        << "its neighbours are as fine";
}

TEST_F(TraceDocuments, aFrameKnowsItsQueueItsSwitchesAndTheStateOfItsNodes) {
    test::writeSmallTrace(file_);
    TraceDocument document(file_, false);
    const auto waiting = read(document, 16);
    EXPECT_EQ(waiting->queued, 4u);
    ASSERT_EQ(waiting->queue.size(), 4u);
    EXPECT_TRUE(waiting->queue[0].isStarted);
    EXPECT_EQ(waiting->resident[0], 1u);
    EXPECT_EQ(waiting->views[0].starved, 1u);
    EXPECT_EQ(waiting->views[0].overTau, 1u);
    EXPECT_NEAR(waiting->views[0].worstErrorPx, 800.0 / 300, 1e-9);
    const TracedNode* const root = waiting->views[0].find(smallTraceId(0, 0, 0));
    ASSERT_TRUE(root);
    EXPECT_EQ(root->missingChildren, 4u);
    const TracedNode* const child = waiting->views[0].find(smallTraceId(1, 1, 0));
    ASSERT_TRUE(child);
    EXPECT_EQ(child->place, TracedPlace::Below);
    EXPECT_EQ(child->data.data, planet::TraceData::Started);

    const auto split = read(document, 21);
    EXPECT_EQ(split->queued, 0u);
    ASSERT_EQ(split->views[0].switches.size(), 1u);
    EXPECT_EQ(split->views[0].switches[0].cause, planet::TraceSwitchCause::Arrival);
    EXPECT_TRUE(split->views[0].switches[0].isMorphed);
    EXPECT_EQ(split->frame.paged.size(), 4u);
    EXPECT_EQ(split->views[0].find(smallTraceId(0, 0, 0))->place, TracedPlace::Split);
    EXPECT_TRUE(split->views[0].find(smallTraceId(0, 0, 0))->isSwitched);
    EXPECT_EQ(split->views[0].find(smallTraceId(1, 0, 1))->place, TracedPlace::Drawn);
}

TEST_F(TraceDocuments, reasonsFollowTheNumbers) {
    test::writeSmallTrace(file_);
    TraceDocument document(file_, false);
    const auto first = [&](std::uint64_t frame, std::uint64_t id) {
        const auto shown = read(document, frame);
        return tracedReasons(*shown, shown->views[0], *shown->views[0].find(id)).at(0);
    };
    const auto second = [&](std::uint64_t frame, std::uint64_t id) {
        const auto shown = read(document, frame);
        return tracedReasons(*shown, shown->views[0], *shown->views[0].find(id)).at(1);
    };
    EXPECT_EQ(first(5, smallTraceId(0, 0, 0)),
              "It is fine enough: its error of 1.60 px does not exceed τ = 2.00 px.");
    EXPECT_EQ(first(16, smallTraceId(0, 0, 0)),
              "It is too coarse: its error of 2.67 px exceeds τ = 2.00 px.");
    EXPECT_EQ(second(16, smallTraceId(0, 0, 0)),
              "It waits for data: 4 of its 4 children are not there (4 being loaded).");
    EXPECT_EQ(first(16, smallTraceId(1, 0, 0)), "It is not needed: its parent 0/0/0 is drawn.");
    EXPECT_EQ(first(30, smallTraceId(0, 0, 0)),
              "It is split because its error of 2.67 px exceeds τ = 2.00 px.");
    EXPECT_EQ(second(30, smallTraceId(1, 0, 0)),
              "Its parent 0/0/0 would not do: its error of 2.67 px exceeds τ.");
    EXPECT_EQ(second(50, smallTraceId(1, 1, 1)),
              "The engine described no children of it: it is a leaf, or what is below is not known yet.");
}

TEST_F(TraceDocuments, historyCountsWhatHappens) {
    test::writeSmallTrace(file_);
    TraceDocument document(file_, false);
    const auto history = this->history(document);
    ASSERT_EQ(history->samples.size(), test::smallTraceFrames);
    EXPECT_EQ(history->framesPerSample, 1u);
    EXPECT_EQ(history->samples[15].queued, 4);
    EXPECT_EQ(history->samples[20].arrived, 4);
    EXPECT_EQ(history->samples[29].frame, 30u);
    EXPECT_FLOAT_EQ(history->samples[29].cpuMs, 2);
    EXPECT_TRUE(std::isnan(history->samples[29].gpuMs));
    const std::vector<TracedViewSample>& view = history->views.at(0);
    ASSERT_EQ(view.size(), test::smallTraceFrames);
    EXPECT_EQ(view[20].splits, 1);
    EXPECT_EQ(view[40].splits, 1);
    EXPECT_EQ(view[40].drawn, 7);
    EXPECT_EQ(view[40].triangles, 7 * 128);
    EXPECT_EQ(view[15].starved, 1);
    EXPECT_EQ(history->counters.at("uploads")[9], 10);
    ASSERT_EQ(history->switches.size(), 2u);
    EXPECT_EQ(history->switches[1].frame, 41u);
    EXPECT_EQ(history->switches[1].cause, planet::TraceSwitchCause::Error);
    ASSERT_EQ(history->starvations.size(), 1u);
    EXPECT_EQ(history->starvations[0].firstFrame, 11u);
    EXPECT_EQ(history->starvations[0].lastFrame, 20u);
    EXPECT_TRUE(history->starvations[0].isOver);
    EXPECT_NEAR(history->starvations[0].untilS - history->starvations[0].fromS, 1, 1e-9);
    float latencies = 0;
    for (const float count : history->latencies[0]) latencies += count;
    EXPECT_EQ(latencies, 5);
    EXPECT_EQ(history->report.views[0].splits, 2u);
}

// The same bytes with an end that comes later: an engine that is still writing.
TEST_F(TraceDocuments, growingFileShowsItsNewestFrame) {
    const fs::path whole = folder_.path() / "whole.lodtrace";
    test::writeSmallTrace(whole);
    std::ifstream stream(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    auto index = planet::TraceFile::open(whole);
    ASSERT_GE(index->blocks().size(), 1u);
    // The header of the file alone, then all blocks.
    std::ofstream growing(file_, std::ios::binary);
    growing << bytes.substr(0, planet::traceHeaderBytes) << std::flush;
    TraceDocument document(file_, true);
    document.showNewest();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_FALSE(document.frame());
    growing << bytes.substr(planet::traceHeaderBytes) << std::flush;
    EXPECT_TRUE(
        wait([&] { return document.frame() && document.frame()->frame.number == test::smallTraceFrames; }));
    EXPECT_FALSE(document.history() && document.history()->isComplete);
    document.setGrows(false);
    EXPECT_EQ(history(document)->samples.size(), test::smallTraceFrames);
    EXPECT_EQ(document.problem(), "");
}

TEST_F(TraceDocuments, damagedFileShowsWhatCameBefore) {
    test::writeSmallTrace(file_);
    fs::resize_file(file_, fs::file_size(file_) - 10);
    TraceDocument cut(file_, false);
    EXPECT_TRUE(wait([&] { return !cut.problem().empty(); }));
    EXPECT_NE(cut.problem().find(file_.string()), std::string::npos) << cut.problem();
    // The end of the last frame is missing.
    const auto history = this->history(cut);
    EXPECT_EQ(history->samples.size(), test::smallTraceFrames - 1);
    for (const std::uint64_t frame : {59u, 20u, 60u, 1u, 59u}) {
        cut.show(frame);
        const std::uint64_t shown = std::min<std::uint64_t>(frame, test::smallTraceFrames - 1);
        EXPECT_TRUE(wait([&] { return cut.frame() && cut.frame()->frame.number == shown; })) << frame;
    }
    TraceDocument missing(folder_.path() / "none.lodtrace", false);
    EXPECT_TRUE(wait([&] { return !missing.problem().empty(); }));
    EXPECT_FALSE(missing.isBusy());
    EXPECT_FALSE(missing.frame());
}

TEST_F(TraceDocuments, tracesAreKnownByTheirFirstBytes) {
    test::writeSmallTrace(file_);
    const fs::path renamed = folder_.path() / "renamed.bin", notes = folder_.path() / "notes.lodtrace";
    fs::rename(file_, renamed);
    std::ofstream(notes) << "LODTRAC";
    EXPECT_TRUE(isTraceFile(renamed));
    EXPECT_FALSE(isTraceFile(notes));
    EXPECT_FALSE(isTraceFile(folder_.path()));
    EXPECT_FALSE(isTraceFile(folder_.path() / "none"));
}

TEST(TraceHistorian, clockThatGoesBackOrIsNoNumberKeepsTheLastTime) {
    constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
    constexpr double endless = std::numeric_limits<double>::infinity();
    planet::TraceState state;
    TraceHistorian historian;
    std::uint64_t frame = 0;
    for (const double timeS : {-3.0, notANumber, -2.0, endless, -endless, -2.5, 1.0}) {
        state.add(planet::TraceFrameBegan{++frame, frame, timeS});
        state.add(planet::TraceFrameEnded{frame, 1, -1});
        historian.add(state);
    }
    const auto history = historian.history(state, true);
    std::vector<double> times;
    for (const TracedSample& sample : history->samples) times.push_back(sample.timeS);
    EXPECT_EQ(times, (std::vector<double>{-3, -3, -2, -2, -2, -2, 1}));
    EXPECT_EQ(history->report.durationS, 4);
}

TEST(TraceHistorian, longTracesKeepTheirPeaks) {
    planet::TraceState state;
    TraceHistorian historian;
    const std::uint64_t frames = maxTracedSamples + 10;
    for (std::uint64_t i = 1; i <= frames; ++i) {
        state.add(planet::TraceFrameBegan{i, i, static_cast<double>(i)});
        state.add(planet::TraceFrameEnded{i, i == 12'345 ? 99.0 : 1.0, -1});
        historian.add(state);
    }
    const auto history = historian.history(state, true);
    EXPECT_EQ(history->framesPerSample, 2u);
    EXPECT_EQ(history->samples.size(), maxTracedSamples / 2 + 5);
    EXPECT_EQ(history->samples[6172].frame, 12'345u);
    EXPECT_EQ(history->samples[6172].cpuMs, 99);
    EXPECT_EQ(history->samples[6173].cpuMs, 1);
    EXPECT_EQ(history->samples.back().frame, frames - 1);
}

}  // namespace
}  // namespace worldy
