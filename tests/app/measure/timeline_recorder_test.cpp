#include "app/measure/timeline_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planet/planet_tools.h"
#include "tests/support/planet_fixture.h"

namespace worldy {
namespace {

// A planet that a recorder follows, one step a frame.
class TimelineRecording : public testing::Test {
protected:
    ~TimelineRecording() override { recorder_.turn(false); }

    void frame(double altitudeM, bool settles = false) {
        recorder_.beginFrame(number_++);
        const planet::View view = planet::viewAt(30, 20, altitudeM);
        if (settles)
            planet_->settle(view, settings_, planet::noUpload, planet::timeoutS);
        else
            planet_->step(view, settings_, planet::noUpload);
        timeS_ += 0.02;
        changes_.add(planet_->selection(), timeS_);
        pops_.add(planet_->tree(), planet_->selection(), view, settings_, timeS_);
        recorder_.noteStep(*planet_, changes_, pops_, timeS_);
        recorder_.endFrame();
    }

    std::size_t count(ChunkChangeKind kind) const {
        return static_cast<std::size_t>(
            std::ranges::count(recorder_.timeline().changes(), kind, &ChunkChange::kind));
    }
    std::size_t countIn(std::uint64_t frame, ChunkChangeKind kind) const {
        return static_cast<std::size_t>(std::ranges::count_if(
            recorder_.timeline().changes(),
            [&](const ChunkChange& change) { return change.frame == frame && change.kind == kind; }));
    }
    const TimelineLane* lane(const std::string& name) const {
        const auto& lanes = recorder_.timeline().lanes();
        const auto found = std::ranges::find(lanes, name, &TimelineLane::name);
        return found == lanes.end() ? nullptr : &*found;
    }

    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    planet::LodSettings settings_ = planet::fineSettings();
    planet::LodChanges changes_;
    planet::PopMeter pops_;
    TimelineRecorder recorder_;
    std::uint64_t number_ = 100;
    double timeS_ = 0;
};

TEST_F(TimelineRecording, theStagesOfAStepAreSpansOfTheMainThreadAndLoadsOfTheLoaders) {
    frame(150e3, true);
    frame(150e3);
    const TimelineLane* const main = lane("main");
    ASSERT_TRUE(main);
    for (const char* stage : {"upload", "select", "paging"}) {
        EXPECT_TRUE(std::ranges::any_of(main->rows.at(0), [&](const planet::Span& span) {
            return std::string(span.name) == stage;
        })) << stage;
    }
    const TimelineLane* const loader = lane("loader 1");
    ASSERT_TRUE(loader);
    const planet::Span& load = loader->rows.at(0).front();
    EXPECT_STREQ(load.name, "load");
    EXPECT_TRUE(load.hasBlock);
    ASSERT_EQ(recorder_.timeline().frames().size(), 1u);
    EXPECT_EQ(recorder_.timeline().frames()[0].number, 100u);
}

TEST_F(TimelineRecording, eachLoadedBlockCameInItsFrame) {
    frame(150e3, true);
    const std::uint64_t loaded = planet_->paging()[planet::BlockKind::Heights].loaded;
    ASSERT_GT(loaded, 0u);
    EXPECT_EQ(count(ChunkChangeKind::Came), loaded);
    EXPECT_EQ(countIn(100, ChunkChangeKind::Came), loaded);
    frame(150e3);
    EXPECT_EQ(countIn(101, ChunkChangeKind::Came), 0u);
}

TEST_F(TimelineRecording, splitsAndMergesAndPopsAreThoseOfTheInstruments) {
    frame(8e3, true);
    frame(8e3);
    settings_.tauPx = 30;
    frame(8e3);
    settings_.tauPx = 2;
    frame(8e3, true);
    const auto ofType = [&](planet::LodChangeType type) {
        return static_cast<std::size_t>(
            std::ranges::count(changes_.recent(), type, &planet::LodChange::type));
    };
    ASSERT_GT(ofType(planet::LodChangeType::Split), 0u);
    ASSERT_GT(ofType(planet::LodChangeType::Merge), 0u);
    EXPECT_EQ(count(ChunkChangeKind::Split), ofType(planet::LodChangeType::Split));
    EXPECT_EQ(count(ChunkChangeKind::Merged), ofType(planet::LodChangeType::Merge));
    const auto pops =
        static_cast<std::size_t>(std::ranges::count_if(pops_.events(), [](const planet::PopEvent& event) {
            return planet::counts(event) && event.jump.largestPx >= leastTimelinePopPx;
        }));
    ASSERT_GT(pops, 0u);
    EXPECT_EQ(count(ChunkChangeKind::Popped), pops);
    // A frame in which the camera rests changes nothing.
    const auto [first, last] = recorder_.timeline().changesIn(101, 101);
    EXPECT_EQ(first, last);
}

TEST_F(TimelineRecording, whatHappensWhileItIsOffIsNotRecorded) {
    frame(150e3, true);
    const std::size_t before = recorder_.timeline().changes().size();
    recorder_.turn(false);
    frame(8e3, true);
    recorder_.turn(true);
    frame(8e3);
    EXPECT_EQ(recorder_.timeline().changes().size(), before);
    EXPECT_EQ(recorder_.timeline().changesMissed(), 0u);
    // The frame before the pause has no known end.
    EXPECT_TRUE(recorder_.timeline().frames().empty());
}

TEST_F(TimelineRecording, anotherPlanetBeginsWithItsOwnLoads) {
    frame(150e3, true);
    const std::size_t before = count(ChunkChangeKind::Came);
    const auto first = std::exchange(planet_, planet::openFake());
    frame(150e3, true);
    EXPECT_EQ(count(ChunkChangeKind::Came), before + planet_->paging()[planet::BlockKind::Heights].loaded);
}

}  // namespace
}  // namespace worldy
