#include "ui/panels/surface/ramp_edit.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace worldy::ui {
namespace {

using planet::gl::RampStop;

bool isSorted(const Ramp& ramp) {
    return std::is_sorted(ramp.begin(), ramp.end(),
                          [](const RampStop& a, const RampStop& b) { return a.heightM < b.heightM; });
}

Ramp blackToWhite() {
    return {{0, {0, 0, 0}}, {100, {1, 1, 1}}};
}

TEST(RampEdit, coloursMixBetweenStopsAndStayBeyondThem) {
    const Ramp ramp = blackToWhite();
    EXPECT_EQ(rampColourAt(ramp, 25), glm::vec3(0.25f));
    EXPECT_EQ(rampColourAt(ramp, -5), glm::vec3(0));
    EXPECT_EQ(rampColourAt(ramp, 500), glm::vec3(1));
    EXPECT_EQ(rampColourAt({}, 5), glm::vec3(0));
}

TEST(RampEdit, twoStopsAtOneHeightAreAStep) {
    const Ramp ramp = {{0, {0, 0, 0}}, {10, {0, 0, 0}}, {10, {1, 1, 1}}, {20, {1, 1, 1}}};
    EXPECT_EQ(rampColourAt(ramp, 9.9), glm::vec3(0));
    EXPECT_EQ(rampColourAt(ramp, 10), glm::vec3(1));
}

TEST(RampEdit, anAddedStopChangesNothingInThePicture) {
    Ramp ramp = blackToWhite();
    ASSERT_EQ(addStop(ramp, 30), 1u);
    EXPECT_TRUE(isSorted(ramp));
    for (double h = -10; h <= 110; h += 5)
        EXPECT_NEAR(rampColourAt(ramp, h).r, rampColourAt(blackToWhite(), h).r, 1e-6) << h;
    EXPECT_EQ(addStop(ramp, 200), 3u);
    EXPECT_EQ(ramp.back().colour, glm::vec3(1));
}

TEST(RampEdit, theFirstStopCanBeAdded) {
    Ramp ramp;
    EXPECT_EQ(addStop(ramp, 5), 0u);
    EXPECT_EQ(ramp.size(), 1u);
    EXPECT_DOUBLE_EQ(heightAfter(ramp, 0), 1005);
}

TEST(RampEdit, stopsAreAddedHalfWayOrBeyond) {
    const Ramp ramp = blackToWhite();
    EXPECT_DOUBLE_EQ(heightAfter(ramp, 0), 50);
    EXPECT_DOUBLE_EQ(heightAfter(ramp, 1), 200);
}

TEST(RampEdit, aStopDoesNotPassItsNeighbours) {
    Ramp ramp = {{0, {}}, {50, {}}, {100, {}}};
    moveStop(ramp, 1, 500);
    EXPECT_DOUBLE_EQ(ramp[1].heightM, 100);
    moveStop(ramp, 1, -500);
    EXPECT_DOUBLE_EQ(ramp[1].heightM, 0);
    moveStop(ramp, 0, -500);
    EXPECT_DOUBLE_EQ(ramp[0].heightM, -500);
}

TEST(RampEdit, presetsSpanThePlanetInOrder) {
    struct Range {
        double lowestM;
        double highestM;
    };
    for (const Range range :
         {Range{-10900, 8800}, Range{-9000, -100}, Range{0, 8000}, Range{500, 900}, Range{0, 0}}) {
        for (const Ramp& ramp :
             {greyRamp(range.lowestM, range.highestM), hypsometricRamp(range.lowestM, range.highestM)}) {
            ASSERT_FALSE(ramp.empty());
            EXPECT_LE(ramp.size(), planet::gl::maxRampStops);
            EXPECT_TRUE(isSorted(ramp));
            EXPECT_DOUBLE_EQ(ramp.front().heightM, range.lowestM);
            EXPECT_GE(ramp.back().heightM, range.highestM);
        }
    }
}

TEST(RampEdit, theHypsometricRampHasItsShoreAtZero) {
    const Ramp ramp = hypsometricRamp(-10900, 8800);
    const glm::vec3 below = rampColourAt(ramp, -1);
    const glm::vec3 above = rampColourAt(ramp, 1);
    EXPECT_GT(below.b, below.g);
    EXPECT_GT(above.g, above.b);
}

}  // namespace
}  // namespace worldy::ui
