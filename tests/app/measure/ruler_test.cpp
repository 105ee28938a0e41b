#include "app/measure/ruler.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "app/scene/camera_control.h"
#include "tests/support/hills_planet.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

class RulerTest : public testing::Test {
protected:
    RulerTest() {
        lod_.tauPx = 60;
        show(20'000);
    }

    void show(double altitudeM) {
        view_ = planet::viewFromPose(
            {.latitudeDeg = 10, .longitudeDeg = 20, .altitudeM = altitudeM, .pitchDeg = -60}, 100'000, 1.1,
            800, 600);
        planet_->settle(view_, lod_, planet::noUpload, 60);
    }

    // Frames half a second apart, until nothing is measured any more.
    void runUntilDone() {
        for (int i = 0; i < 60'000; ++i) {
            advanceRuler(*planet_, timeS_ += 0.5, ruler_);
            if (!ruler_.job) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        FAIL() << "it never ends";
    }

    tests::TemporaryFolder folder_;
    std::unique_ptr<planet::Planet> planet_ = planet::test::openHills(folder_ / "hills.chk");
    planet::LodSettings lod_ = planet::suddenLod();
    planet::View view_;
    Ruler ruler_;
    double timeS_ = 0;
    const glm::dvec3 a_ = 100'000.0 * planet::directionFromGeographic({0.17, 0.34});
    const glm::dvec3 b_ = 100'000.0 * planet::directionFromGeographic({0.19, 0.37});
};

TEST_F(RulerTest, measuresOnceItHasTwoEnds) {
    placeRulerEnd(ruler_, a_);
    runUntilDone();
    EXPECT_FALSE(ruler_.last);
    placeRulerEnd(ruler_, b_);
    runUntilDone();
    ASSERT_TRUE(ruler_.last);
    EXPECT_TRUE(ruler_.current);
    const double angle = std::acos(glm::dot(glm::normalize(a_), glm::normalize(b_)));
    EXPECT_NEAR(ruler_.last->summary.arcM, 100'000 * angle, 1e-3);
    EXPECT_GT(ruler_.last->summary.ascentM, 0);
    EXPECT_GT(ruler_.last->summary.worstErrorM, 0);
}

TEST_F(RulerTest, aThirdClickBeginsAgain) {
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    runUntilDone();
    placeRulerEnd(ruler_, b_);
    EXPECT_EQ(ruler_.ends, std::vector<glm::dvec3>{b_});
    EXPECT_FALSE(ruler_.last);
}

TEST_F(RulerTest, swappedEndsSwapAscentAndDescent) {
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    runUntilDone();
    const planet::ProfileSummary there = ruler_.last->summary;
    swapRulerEnds(ruler_);
    advanceRuler(*planet_, timeS_ += 0.5, ruler_);
    EXPECT_FALSE(ruler_.current);
    runUntilDone();
    const planet::ProfileSummary back = ruler_.last->summary;
    EXPECT_NEAR(back.riseM, -there.riseM, 1e-6);
    EXPECT_NEAR(back.ascentM, there.descentM, 1e-3);
    EXPECT_NEAR(back.descentM, there.ascentM, 1e-3);
}

TEST_F(RulerTest, isMeasuredAgainWhenOtherChunksAreDrawnAndOnlyThen) {
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    runUntilDone();
    const double coarseM = ruler_.last->summary.worstErrorM;
    advanceRuler(*planet_, timeS_ += 10, ruler_);
    EXPECT_FALSE(ruler_.job) << "the same chunks are measured twice";
    lod_.tauPx = 0.01;
    show(20'000);
    runUntilDone();
    EXPECT_LT(ruler_.last->summary.worstErrorM, coarseM);
}

TEST_F(RulerTest, isMeasuredAtMostTwiceASecond) {
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    advanceRuler(*planet_, 10, ruler_);
    ASSERT_TRUE(ruler_.job);
    for (int i = 0; i < 60'000 && ruler_.job; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        advanceRuler(*planet_, 10.1, ruler_);
    }
    lod_.tauPx = 0.01;
    show(20'000);
    advanceRuler(*planet_, 10.2, ruler_);
    EXPECT_FALSE(ruler_.current);
    EXPECT_FALSE(ruler_.job);
    advanceRuler(*planet_, 10.6, ruler_);
    EXPECT_TRUE(ruler_.job);
}

TEST_F(RulerTest, aFileThatCannotBeReadIsReportedOnce) {
    ruler_.heights = std::make_shared<planet::FinestHeights>(
        [](const planet::ChunkId& parent, planet::BlockLocation, planet::StepsView) {
            return planet::Result<planet::SiblingBlock>(
                planet::ioError("hills.chk: reading the block of chunk " + planet::toString(parent)));
        });
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    runUntilDone();
    EXPECT_NE(ruler_.problem.find("hills.chk"), std::string::npos);
    advanceRuler(*planet_, timeS_ += 10, ruler_);
    EXPECT_FALSE(ruler_.job);
    clearRuler(ruler_);
    EXPECT_EQ(ruler_.problem, "");
}

TEST_F(RulerTest, keepsItsEndsOverAnotherPlanet) {
    ruler_.takesClicks = true;
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    runUntilDone();
    forgetGround(ruler_);
    EXPECT_TRUE(ruler_.takesClicks);
    EXPECT_EQ(ruler_.ends.size(), 2u);
    EXPECT_FALSE(ruler_.last);
    runUntilDone();
    EXPECT_TRUE(ruler_.last);
}

TEST_F(RulerTest, itsPlacesAreKeptForTheNextStart) {
    const glm::dvec3 raisedM = 1.01 * b_;
    placeRulerEnd(ruler_, a_);
    EXPECT_EQ(rulerPlaces(ruler_, 100'000).size(), 1u);
    placeRulerEnd(ruler_, raisedM);
    const std::vector<planet::CameraPose> places = rulerPlaces(ruler_, 100'000);
    Ruler next;
    setRulerPlaces(next, places, 100'000);
    ASSERT_EQ(next.ends.size(), 2u);
    EXPECT_LT(glm::distance(next.ends[0], a_), 1e-4);
    EXPECT_LT(glm::distance(next.ends[1], raisedM), 1e-4);
}

TEST_F(RulerTest, crossMarksThePointedPlaceOfTheProfileAlone) {
    placeRulerEnd(ruler_, a_);
    placeRulerEnd(ruler_, b_);
    ruler_.pointed = 256;
    EXPECT_EQ(rulerLines(ruler_, view_, 100'000).size(), 4u) << "a cross without a profile";
    runUntilDone();
    const planet::Lines marked = rulerLines(ruler_, view_, 100'000);
    const glm::dvec3 place = ruler_.last->profile.points[256].direction;
    ruler_.pointed.reset();
    const planet::Lines plain = rulerLines(ruler_, view_, 100'000);
    ASSERT_EQ(marked.size(), plain.size() + 4);
    const planet::Lines cross(marked.end() - 4, marked.end());
    const auto atPx = [&](std::size_t i) { return pixelOf(view_, cross[i].positionM).value(); };
    EXPECT_NEAR(atPx(0).y, atPx(1).y, 1e-3);
    EXPECT_NEAR(atPx(1).x - atPx(0).x, 14, 3);
    EXPECT_NEAR(atPx(2).x, atPx(3).x, 1e-3);
    EXPECT_NEAR(atPx(2).y - atPx(3).y, 14, 3);
    const glm::dvec3 middle = (cross[0].positionM + cross[1].positionM) / 2.0;
    EXPECT_LT(glm::distance(glm::normalize(middle), place), 1e-9);
    ruler_.pointed = 513;
    EXPECT_EQ(rulerLines(ruler_, view_, 100'000).size(), plain.size())
        << "a point that the profile does not have";
}

// A camera at the centre of the world looks along -z; a point 1000 m ahead and 10 m right of the axis.
TEST(RulerEndInPicture, isWhereThePictureShowsIt) {
    planet::View view;
    view.eyeM = {0, 0, 0};
    view.right = {1, 0, 0};
    view.up = {0, 1, 0};
    view.back = {0, 0, 1};
    view.widthPx = 1000;
    view.heightPx = 500;
    view.horizontalFovRad = 2 * std::atan(0.5);  // 1000 px across 1000 m at 1000 m
    const RulerEndInPicture ahead = rulerEndIn(view, {10, -20, -1000});
    ASSERT_TRUE(ahead.atPx);
    EXPECT_NEAR(ahead.atPx->x, 510, 1e-9);
    EXPECT_NEAR(ahead.atPx->y, 270, 1e-9);
    EXPECT_NEAR(ahead.pixelM, 1, 1e-3);
    EXPECT_FALSE(rulerEndIn(view, {0, 0, 5}).atPx);
}

}  // namespace
}  // namespace worldy
