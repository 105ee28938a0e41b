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

}  // namespace
}  // namespace worldy
