// Paused frames, single steps, and the history of frames.
#include "app/editor/frame_controller.h"

#include <gtest/gtest.h>

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
    EXPECT_EQ(frames.history.front().timeS, 20);
    EXPECT_EQ(frames.history.size(), 11u);
}

}  // namespace
}  // namespace worldy
