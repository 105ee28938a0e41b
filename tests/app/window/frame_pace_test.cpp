#include "app/window/frame_pace.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

TEST(FramePace, restsLongOnceThePlotsOfStillFramesHaveRunOut) {
    FramePace pace;
    pace.noteInput(100);
    EXPECT_EQ(pace.restS(100), 0);
    EXPECT_EQ(pace.restS(100.4), 0);
    const double slow = pace.restS(100.6);
    EXPECT_GT(slow, 0);
    EXPECT_LT(slow, 0.2);
    EXPECT_EQ(pace.restS(110.5), slow);
    EXPECT_EQ(pace.restS(111.5), longestRestS);
}

TEST(FramePace, restsBetweenTheFramesOfAScriptUnlessThePictureMoves) {
    EXPECT_EQ(scriptedRestS(Activity::Motion), 0);
    EXPECT_GT(scriptedRestS(Activity::None), 0);
    EXPECT_LT(scriptedRestS(Activity::None), 0.2) << "a change without an event is seen soon";
}

TEST(FramePace, inputAfterARestBringsFullSpeed) {
    FramePace pace;
    ASSERT_EQ(pace.restS(1000), longestRestS);
    pace.noteInput(1003);
    EXPECT_EQ(pace.restS(1003), 0);
    EXPECT_EQ(pace.restS(1003.1), 0);
}

TEST(FramePace, motionKeepsFullSpeedWithoutInput) {
    FramePace pace;
    for (double nowS = 0; nowS < 100; nowS += 3) {
        pace.noteFrame(Activity::Motion, nowS);
        EXPECT_EQ(pace.restS(nowS), 0);
    }
}

TEST(FramePace, workInTheBackgroundIsShownAFewTimesASecondAndForAWhileAfterItsEnd) {
    FramePace pace;
    double slow = 0;
    for (double nowS = 20; nowS < 100; nowS += 5) {
        pace.noteFrame(Activity::Background, nowS);
        slow = pace.restS(nowS);
        EXPECT_GT(slow, 0);
        EXPECT_LT(slow, 0.2);
    }
    pace.noteFrame(Activity::None, 101);
    EXPECT_EQ(pace.restS(101), slow);
    EXPECT_EQ(pace.restS(110), longestRestS);
}

// Runs frames that each take a while, and wake up a little late. Returns how many begin in a number of seconds.
int framesIn(double seconds, double frameS, int limit, double lateS = 0) {
    FramePace pace;
    int frames = 0;
    for (double nowS = 50; nowS < 50 + seconds; ++frames) {
        const double waitS = pace.limitS(nowS, limit);
        EXPECT_GE(waitS, 0);
        nowS += waitS + (waitS > 0 ? lateS : 0) + frameS;
    }
    return frames;
}

TEST(FramePace, noMoreFramesBeginInASecondThanTheLimit) {
    EXPECT_NEAR(framesIn(10, 0.001, 30), 300, 1);
    EXPECT_NEAR(framesIn(10, 0.001, 60), 600, 1);
    EXPECT_NEAR(framesIn(10, 0.001, 60, 0.0002), 600, 1);
    EXPECT_NEAR(framesIn(10, 0.001, 0), 10'000, 1);
}

TEST(FramePace, framesSlowerThanTheLimitDoNotWait) {
    FramePace pace;
    double nowS = 7;
    pace.limitS(nowS, 60);
    for (int frame = 0; frame < 10; ++frame) EXPECT_EQ(pace.limitS(nowS += 0.1, 60), 0);
}

TEST(FramePace, theFrameAfterOneThatWasALittleLateIsInTime) {
    FramePace pace;
    EXPECT_EQ(pace.limitS(5, 50), 0);
    EXPECT_EQ(pace.limitS(5.025, 50), 0);
    EXPECT_NEAR(pace.limitS(5.03, 50), 0.01, 1e-9);
}

TEST(FramePace, framesDoNotCatchUpAfterAPause) {
    FramePace pace;
    pace.limitS(10, 50);
    EXPECT_EQ(pace.limitS(20, 50), 0);
    EXPECT_NEAR(pace.limitS(20.001, 50), 0.019, 1e-9);
}

}  // namespace
}  // namespace worldy
