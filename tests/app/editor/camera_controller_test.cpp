// Inspecting a place, and what is drawn after it.
#include "app/editor/camera_controller.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

struct CameraControllerTest : testing::Test {
    CameraController camera_;
    Settings settings_;
    PopSide side_ = PopSide::Live;
    bool stepOnce_ = false;
    ui::ReplayControls replay_;

    CameraContext context() { return {nullptr, settings_, side_, stepOnce_, nullptr}; }
    CameraContext replaying() { return {nullptr, settings_, side_, stepOnce_, &replay_}; }
    void inspectPop(PopSide side) {
        camera_.rig = CameraRig{};
        inspect(camera_, {}, {}, context());
        side_ = side;
    }
};

TEST_F(CameraControllerTest, TheEndOfAnInspectionDrawsLiveAgain) {
    inspectPop(PopSide::Before);
    endInspection(camera_, context());
    EXPECT_EQ(side_, PopSide::Live);
    EXPECT_FALSE(camera_.lodFrozen);
}

TEST_F(CameraControllerTest, UnfreezingDrawsLiveAgainAndFreezingDoesNot) {
    inspectPop(PopSide::After);
    freezeLod(camera_, true, side_);
    EXPECT_EQ(side_, PopSide::After);
    EXPECT_FALSE(camera_.beforeInspection);
    freezeLod(camera_, false, side_);
    EXPECT_EQ(side_, PopSide::Live);
    EXPECT_FALSE(camera_.lodFrozen);
}

TEST_F(CameraControllerTest, AnotherInspectedPlaceIsDrawnLive) {
    inspectPop(PopSide::Before);
    inspect(camera_, {}, {}, context());
    EXPECT_EQ(side_, PopSide::Live);
}

TEST_F(CameraControllerTest, anInspectionPausesAReplayInsteadOfFreezing) {
    camera_.rig = CameraRig{};
    replay_.playing = true;
    inspect(camera_, {}, {}, replaying());
    EXPECT_FALSE(replay_.playing);
    EXPECT_FALSE(camera_.lodFrozen);
    endInspection(camera_, replaying());
    EXPECT_TRUE(replay_.playing);
}

TEST_F(CameraControllerTest, camerasStayOverAPlanetOfTheSameRadius) {
    meetPlanet(camera_, 6e6);
    camera_.rig = CameraRig{};
    meetPlanet(camera_, 6e6);
    EXPECT_TRUE(camera_.rig);
    meetPlanet(camera_, 2e6);
    EXPECT_FALSE(camera_.rig);
}

}  // namespace
}  // namespace worldy
