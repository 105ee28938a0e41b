// Paused frames, single steps, and the history of frames.
#include "app/editor/frame_controller.h"

#include <gtest/gtest.h>

#include <utility>

namespace worldy {
namespace {

TEST(FrameController, aStepPausesFramesAndGoesOnOnce) {
    FrameController frames;
    EXPECT_TRUE(takeStep(frames, 0.5).goesOn);
    EXPECT_EQ(takeStep(frames, 0.5).seconds, 0.5);
    execute(frames, ui::StepFrame{});
    const FrameStep step = takeStep(frames, 0.5);
    EXPECT_TRUE(step.goesOn);
    EXPECT_EQ(step.elapsedS, 1.0 / 60);
    EXPECT_FALSE(takeStep(frames, 0.5).goesOn);
    execute(frames, ui::PauseFrames{false});
    EXPECT_TRUE(takeStep(frames, 0.5).goesOn);
    EXPECT_FALSE(takeStep(frames, 0.5).elapsedS);
}

TEST(FrameController, tenSecondsOfFramesAreKept) {
    FrameController frames;
    for (int i = 0; i <= 30; ++i) {
        frames.timeS = i;
        finishFrame(frames, {});
    }
    EXPECT_EQ(frames.history.samples.front().timeS, 20);
    EXPECT_EQ(frames.history.samples.size(), 10u) << "the last frame has no time yet";
}

TEST(FrameController, aFramesTimeStandsBesideItsParts) {
    FrameController frames;
    // The second frame takes 50 ms, of which drawing takes 40 ms. Its time is known when the third one begins.
    for (const auto& [frameMs, drawCpuMs] :
         {std::pair(0.0, 2.0), std::pair(16.0, 40.0), std::pair(50.0, 3.0)}) {
        FrameStats stats;
        stats.frameMs = frameMs;
        stats.drawCpuMs = drawCpuMs;
        finishFrame(frames, stats);
    }
    ASSERT_EQ(frames.history.samples.size(), 2u);
    EXPECT_EQ(frames.history.samples[0].stats.frameMs, 16);
    EXPECT_EQ(frames.history.samples[0].stats.drawCpuMs, 2);
    EXPECT_EQ(frames.history.samples[1].stats.frameMs, 50);
    EXPECT_EQ(frames.history.samples[1].stats.drawCpuMs, 40);
}

}  // namespace
}  // namespace worldy
