#include "app/flight_desk.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "tests/app/session_fixture.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class FlightDeskTest : public test::SessionTest {
protected:
    FlightDeskTest() {
        auto scene =
            openScene({.chunkFile = bakeTo("slope.chk", {.faceSize = 257, .chunkSize = 17})}, settings_);
        if (!scene) throw std::runtime_error(scene.error().message);
        scene_ = std::make_unique<Scene>(std::move(*scene));
        desk_ = openFlightDesk(folder_ / "flights");
    }
    static planet::View viewAt(int frame) {
        return planet::viewFromPose({.longitudeDeg = 0.5 * frame, .altitudeM = 1e6 / (1 + 0.1 * frame)},
                                    6'371'000, 1.0, 320, 240);
    }
    void flyFrames(int from, int to) {
        for (int frame = from; frame < to; ++frame) {
            EXPECT_TRUE(applyLiveSettings(*scene_, settings_));
            desk_.recorder->givenSettings(*scene_->planet, settings_, false);
            stepScene(*scene_, viewAt(frame), settings_);
            constexpr std::array<double, 1> factors = {1};
            desk_.recorder->stepped(*scene_->planet, factors);
        }
    }
    // Forty frames, tau changed after ten.
    std::filesystem::path recordOne(const std::string& name) {
        EXPECT_TRUE(startRecording(desk_, *scene_->planet, name));
        flyFrames(0, 10);
        settings_.lod.tauPx = 5;
        flyFrames(10, 40);
        stopRecording(desk_, scene_->planet.get(), log_);
        settings_.lod.tauPx = 2;
        return desk_.flights.back().file;
    }
    void startReplayOf(const std::filesystem::path& file) {
        BeforeReplay before;
        before.settings = settings_;
        const auto started = startReplay(desk_, file, *scene_, before);
        ASSERT_TRUE(started) << started.error().message;
    }
    // Until the jump that is under way has come to its end.
    void arrive() {
        do advance(0);
        while (desk_.replay->seek);
    }
    void advance(double seconds) {
        EXPECT_TRUE(advanceReplay(*desk_.replay, *scene_, seconds,
                                  {[&](const planet::Selection&) { ++stepped_; },
                                   [&](const ui::ViewSettings& settings, bool) { told_ = settings; }}));
    }
    std::size_t frame() const { return desk_.replay->replay.next(); }

    std::unique_ptr<Scene> scene_;
    FlightDesk desk_;
    int stepped_ = 0;
    ui::ViewSettings told_;
};

TEST_F(FlightDeskTest, WhatIsRecordedIsListedAndDeleted) {
    const std::filesystem::path first = recordOne("");
    EXPECT_EQ(desk_.flights.back().name, "flight 1");
    EXPECT_GT(desk_.flights.back().bytes, 100);
    recordOne("");
    ASSERT_EQ(desk_.flights.size(), 2u);
    EXPECT_EQ(desk_.flights.back().name, "flight 2");
    EXPECT_FALSE(startRecording(desk_, *scene_->planet, "flight 1"));
    EXPECT_FALSE(startRecording(desk_, *scene_->planet, "../flight"));
    EXPECT_FALSE(desk_.recorder);
    EXPECT_TRUE(deleteRecording(desk_, first));
    EXPECT_EQ(desk_.flights.size(), 1u);
}

TEST_F(FlightDeskTest, AReplayPlaysToItsEndAndIsExact) {
    settings_.paging.simulated = true;  // so that blocks come within these frames for sure
    startReplayOf(recordOne("a"));
    EXPECT_EQ(told_.lod.tauPx, 2);
    arrive();
    EXPECT_EQ(frame(), 1u);
    while (desk_.replay->controls.playing) advance(0.05);
    EXPECT_EQ(frame(), 40u);
    EXPECT_EQ(stepped_, 40);
    EXPECT_EQ(told_.lod.tauPx, 5);
    const ui::RecordingView view = recordingViewOf(desk_, settings_);
    EXPECT_EQ(view.replay->framesDifferent, 0u) << view.replay->difference;
    EXPECT_FALSE(view.replay->ticks.empty());
    EXPECT_EQ(stopReplay(desk_, scene_.get()).settings.lod.tauPx, 2);
    EXPECT_FALSE(desk_.replay);
}

TEST_F(FlightDeskTest, AReplayGoesToAnyFrameAndBack) {
    startReplayOf(recordOne("a"));
    ASSERT_TRUE(setReplay(desk_, *scene_, {.playing = false}));
    for (const std::size_t wanted : {30u, 29u, 31u, 1u, 40u, 12u}) {
        moveReplay(desk_, wanted);
        arrive();
        EXPECT_EQ(frame(), wanted);
        EXPECT_EQ(selectionHashOf(*scene_->planet),
                  desk_.replay->replay.record().frames[wanted - 1].selectionHash);
        EXPECT_EQ(desk_.replay->replay.framesDifferent(), 0u);
    }
    moveReplay(desk_, 1000);
    arrive();
    EXPECT_EQ(frame(), 40u);
    moveReplayTo(desk_, desk_.replay->endS[6]);
    arrive();
    EXPECT_EQ(frame(), 7u);
    advance(10);
    EXPECT_EQ(frame(), 7u);  // held
}

TEST_F(FlightDeskTest, AReplayLoops) {
    startReplayOf(recordOne("a"));
    ASSERT_TRUE(setReplay(desk_, *scene_, {.playing = true, .loop = true}));
    for (int i = 0; i < 2000 && stepped_ < 100; ++i) advance(0.05);
    EXPECT_GE(stepped_, 100);
    EXPECT_TRUE(desk_.replay->controls.playing);
    EXPECT_EQ(desk_.replay->replay.framesDifferent(), 0u);
}

TEST_F(FlightDeskTest, SimulatedFlightsAreExactBothWays) {
    settings_.paging.simulated = true;
    settings_.paging.badDisk.latencyMs = 1;
    startReplayOf(recordOne("a"));
    for (const bool simulated : {true, false}) {
        ASSERT_TRUE(setReplay(desk_, *scene_, {.playing = false, .simulated = simulated}));
        moveReplay(desk_, 40);
        arrive();
        EXPECT_EQ(scene_->planet->pagingSettings().time,
                  simulated ? planet::PagingTime::Simulated : planet::PagingTime::Recorded);
        EXPECT_EQ(desk_.replay->replay.framesDifferent(), 0u);
    }
}

TEST_F(FlightDeskTest, AFlightOverAnotherFileIsRefused) {
    const std::filesystem::path file = recordOne("a");
    auto other = openScene({.chunkFile = bakeTo("other.chk", {.faceSize = 129, .chunkSize = 17})}, settings_);
    ASSERT_TRUE(other);
    const auto started = startReplay(desk_, file, *other, {});
    ASSERT_FALSE(started);
    EXPECT_THAT(started.error().message, HasSubstr("was recorded over another file"));
    EXPECT_FALSE(desk_.replay);
}

}  // namespace
}  // namespace worldy
