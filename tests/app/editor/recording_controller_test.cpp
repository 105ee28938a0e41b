#include "app/editor/recording_controller.h"

#include <gmock/gmock.h>

#include <epoxy/egl.h>

#include <fstream>
#include <iterator>

#include "app/flight/selection_hash.h"
#include "tests/app/session_fixture.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class RecordingControllerTest : public test::SessionTest {
protected:
    RecordingControllerTest() {
        auto scene =
            openScene({.chunkFile = bakeTo("slope.chk", {.faceSize = 257, .chunkSize = 17})}, settings_);
        if (!scene) throw std::runtime_error(scene.error().message);
        scene_ = std::make_unique<Scene>(std::move(*scene));
        controller_ = openRecordings(folder_ / "flights");
    }
    static planet::View viewAt(int frame) {
        return planet::viewFromPose({.longitudeDeg = 0.5 * frame, .altitudeM = 1e6 / (1 + 0.1 * frame)},
                                    6'371'000, 1.0, 320, 240);
    }
    void flyFrames(int from, int to) {
        for (int frame = from; frame < to; ++frame) {
            EXPECT_TRUE(applyLiveSettings(*scene_, settings_));
            controller_.recorder->givenSettings(*scene_->planet, settings_, false);
            stepScene(*scene_, viewAt(frame), settings_);
            constexpr std::array<double, 1> factors = {1};
            controller_.recorder->stepped(*scene_->planet, factors);
        }
    }
    // Forty frames, tau changed after ten.
    std::filesystem::path recordOne(const std::string& name) {
        EXPECT_TRUE(startRecording(controller_, *scene_->planet, name));
        flyFrames(0, 10);
        settings_.lod.tauPx = 5;
        flyFrames(10, 40);
        stopRecording(controller_, scene_->planet.get(), log_);
        settings_.lod.tauPx = 2;
        return controller_.flights.back().file;
    }
    void startReplayOf(const std::filesystem::path& file) {
        BeforeReplay before;
        before.settings = settings_;
        const auto started = startReplay(controller_, file, *scene_, before);
        ASSERT_TRUE(started) << started.error().message;
    }
    // Until the jump that is under way has come to its end.
    void arrive() {
        do advance(0);
        while (controller_.replay->seek);
    }
    void advance(double seconds) {
        EXPECT_TRUE(advanceReplay(*controller_.replay, *scene_, seconds,
                                  {[&](const planet::Selection&) { ++stepped_; },
                                   [&](const ViewSettings& settings, bool) { told_ = settings; }}));
    }
    std::size_t frame() const { return controller_.replay->replay.next(); }

    std::unique_ptr<Scene> scene_;
    RecordingController controller_;
    int stepped_ = 0;
    ViewSettings told_;
};

TEST_F(RecordingControllerTest, WhatIsRecordedIsListedAndDeleted) {
    const std::filesystem::path first = recordOne("");
    EXPECT_EQ(controller_.flights.back().name, "flight 1");
    EXPECT_GT(controller_.flights.back().bytes, 100);
    recordOne("");
    ASSERT_EQ(controller_.flights.size(), 2u);
    EXPECT_EQ(controller_.flights.back().name, "flight 2");
    EXPECT_FALSE(startRecording(controller_, *scene_->planet, "flight 1"));
    EXPECT_FALSE(startRecording(controller_, *scene_->planet, "../flight"));
    EXPECT_FALSE(controller_.recorder);
    EXPECT_TRUE(deleteRecording(controller_, first));
    EXPECT_EQ(controller_.flights.size(), 1u);
}

// Two windows record at the same time.
TEST_F(RecordingControllerTest, AFileThatHasTakenTheNameMeanwhileStays) {
    for (const std::string name : {"flight 1", "canyon"}) {
        ASSERT_TRUE(startRecording(controller_, *scene_->planet, name));
        flyFrames(0, 3);
        const std::filesystem::path taken = controller_.folder / (name + ".flight");
        std::filesystem::create_directories(controller_.folder);
        std::ofstream(taken) << "another's";
        stopRecording(controller_, scene_->planet.get(), log_);
        std::ifstream stream(taken);
        EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "another's");
        EXPECT_FALSE(controller_.unwritten);
        EXPECT_EQ(recordingViewOf(controller_).saved, name == "canyon" ? "canyon 2" : "flight 2");
    }
    EXPECT_EQ(loadFlightRecord(controller_.folder / "flight 2.flight").value().name, "flight 2");
    EXPECT_EQ(loadFlightRecord(controller_.folder / "canyon 2.flight").value().name, "canyon 2");
}

TEST_F(RecordingControllerTest, WhatCannotBeWrittenIsKeptUntilItCan) {
    std::ofstream(controller_.folder) << "no folder";
    ASSERT_TRUE(startRecording(controller_, *scene_->planet, "a"));
    flyFrames(0, 3);
    stopRecording(controller_, scene_->planet.get(), log_);
    EXPECT_FALSE(controller_.recorder);  // nothing more is recorded
    ASSERT_TRUE(controller_.unwritten);
    EXPECT_EQ(recordingViewOf(controller_).recording->frames, 3u);  // to be stopped again
    const auto other = startRecording(controller_, *scene_->planet, "b");
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().message, HasSubstr("\"a\" is not saved yet"));
    stopRecording(controller_, scene_->planet.get(), log_);
    EXPECT_TRUE(controller_.unwritten);
    EXPECT_NE(controller_.saveProblem, "");
    EXPECT_EQ(controller_.saved, "");

    std::filesystem::remove(controller_.folder);
    stopRecording(controller_, nullptr, log_);
    EXPECT_FALSE(controller_.unwritten);
    EXPECT_EQ(controller_.saveProblem, "");
    EXPECT_EQ(controller_.saved, "a");
    EXPECT_FALSE(recordingViewOf(controller_).recording);
    EXPECT_EQ(loadFlightRecord(controller_.folder / "a.flight").value().frames.size(), 3u);
    EXPECT_EQ(controller_.flights.size(), 1u);
}

TEST_F(RecordingControllerTest, ARecordingOfNothingIsNotKept) {
    ASSERT_TRUE(startRecording(controller_, *scene_->planet, "a"));
    stopRecording(controller_, scene_->planet.get(), log_);
    EXPECT_FALSE(controller_.unwritten);
    EXPECT_TRUE(controller_.flights.empty());
}

TEST_F(RecordingControllerTest, AReplayPlaysToItsEndAndIsExact) {
    settings_.paging.simulated = true;  // so that blocks come within these frames for sure
    startReplayOf(recordOne("a"));
    EXPECT_EQ(told_.lod.tauPx, 2);
    arrive();
    EXPECT_EQ(frame(), 1u);
    while (controller_.replay->controls.playing) advance(0.05);
    EXPECT_EQ(frame(), 40u);
    EXPECT_EQ(stepped_, 40);
    EXPECT_EQ(told_.lod.tauPx, 5);
    const ui::RecordingView view = recordingViewOf(controller_);
    EXPECT_EQ(view.replay->framesDifferent, 0u) << view.replay->difference;
    EXPECT_FALSE(view.replay->ticks.empty());
    EXPECT_EQ(stopReplay(controller_, scene_.get()).settings.lod.tauPx, 2);
    EXPECT_FALSE(controller_.replay);
}

TEST_F(RecordingControllerTest, AReplayGoesToAnyFrameAndBack) {
    startReplayOf(recordOne("a"));
    ASSERT_TRUE(setReplay(controller_, *scene_, {.playing = false}));
    for (const std::size_t wanted : {30u, 29u, 31u, 1u, 40u, 12u}) {
        moveReplay(controller_, wanted);
        arrive();
        EXPECT_EQ(frame(), wanted);
        EXPECT_EQ(selectionHashOf(*scene_->planet),
                  controller_.replay->replay.record().frames[wanted - 1].selectionHash);
        EXPECT_EQ(controller_.replay->replay.framesDifferent(), 0u);
    }
    moveReplay(controller_, 1000);
    arrive();
    EXPECT_EQ(frame(), 40u);
    moveReplayTo(controller_, controller_.replay->endS[6]);
    arrive();
    EXPECT_EQ(frame(), 7u);
    advance(10);
    EXPECT_EQ(frame(), 7u);  // held
}

TEST_F(RecordingControllerTest, AReplayLoops) {
    startReplayOf(recordOne("a"));
    ASSERT_TRUE(setReplay(controller_, *scene_, {.playing = true, .loop = true}));
    for (int i = 0; i < 2000 && stepped_ < 100; ++i) advance(0.05);
    EXPECT_GE(stepped_, 100);
    EXPECT_TRUE(controller_.replay->controls.playing);
    EXPECT_EQ(controller_.replay->replay.framesDifferent(), 0u);
}

TEST_F(RecordingControllerTest, SimulatedFlightsAreExactBothWays) {
    settings_.paging.simulated = true;
    settings_.paging.badDisk.latencyMs = 1;
    startReplayOf(recordOne("a"));
    for (const bool simulated : {true, false}) {
        ASSERT_TRUE(setReplay(controller_, *scene_, {.playing = false, .simulated = simulated}));
        moveReplay(controller_, 40);
        arrive();
        EXPECT_EQ(scene_->planet->pagingSettings().time,
                  simulated ? planet::PagingTime::Simulated : planet::PagingTime::Recorded);
        EXPECT_EQ(controller_.replay->replay.framesDifferent(), 0u);
    }
}

// OpenGL gives no memory where no context is current.
TEST_F(RecordingControllerTest, ThePlanetGoesOnWhereItRefusesAReplaysSettings) {
    auto large =
        openScene({.chunkFile = bakeTo("large.chk", {.faceSize = 1025, .chunkSize = 17})}, settings_);
    ASSERT_TRUE(large) << large.error().message;
    *scene_ = std::move(*large);
    const ViewSettings before = settings_;
    settings_.paging.budgetMB = 16;
    const std::filesystem::path file = recordOne("small budget");
    settings_ = before;
    ASSERT_TRUE(applyLiveSettings(*scene_, settings_));
    ASSERT_TRUE(settleScene(*scene_, viewAt(40), settings_, 60));
    const std::size_t resident = scene_->planet->paging()[planet::BlockKind::Heights].resident;
    ASSERT_GT(resident, 6u);

    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLContext context = eglGetCurrentContext();
    const EGLSurface surface = eglGetCurrentSurface(EGL_DRAW);
    for (int tries = 0; tries < 2; ++tries) {
        ASSERT_TRUE(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
        const auto started = startReplay(controller_, file, *scene_, {});
        ASSERT_TRUE(eglMakeCurrent(display, surface, surface, context));
        EXPECT_FALSE(started);
        EXPECT_FALSE(controller_.replay);
        EXPECT_EQ(scene_->planet->paging()[planet::BlockKind::Heights].resident, resident);
    }
    startReplayOf(file);
    EXPECT_TRUE(controller_.replay);
}

TEST_F(RecordingControllerTest, AFlightOverAnotherFileIsRefused) {
    const std::filesystem::path file = recordOne("a");
    auto other = openScene({.chunkFile = bakeTo("other.chk", {.faceSize = 129, .chunkSize = 17})}, settings_);
    ASSERT_TRUE(other);
    const auto started = startReplay(controller_, file, *other, {});
    ASSERT_FALSE(started);
    EXPECT_THAT(started.error().message, HasSubstr("was recorded with a different file"));
    EXPECT_FALSE(controller_.replay);
}

}  // namespace
}  // namespace worldy
