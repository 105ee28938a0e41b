// Inspecting a place, what is drawn after it, and moving to places.
#include "app/editor/camera_controller.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

struct CameraControllerTest : testing::Test {
    CameraController camera_;
    Settings settings_;
    PopSide side_ = PopSide::Live;
    bool stepOnce_ = false;
    bool paused_ = false;
    ui::ReplayControls replay_;

    CameraContext context() { return {nullptr, settings_, side_, stepOnce_, paused_, nullptr}; }
    CameraContext replaying() { return {nullptr, settings_, side_, stepOnce_, false, &replay_}; }
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

TEST_F(CameraControllerTest, aPlacedLodViewIsAJumpAtBothEndsOfAnInspection) {
    camera_.rig = CameraRig{};
    const Viewport viewport;
    const auto jumps = [&] {
        followCamera(camera_, viewport, settings_.view.camera, 0.02);
        return camera_.jumped;
    };
    jumps();
    EXPECT_FALSE(jumps());
    planet::View seen = camera_.lodView;
    seen.eyeM += glm::dvec3(1000, 0, 0);
    inspect(camera_, {}, seen, context());
    EXPECT_TRUE(jumps());
    EXPECT_FALSE(jumps());
    endInspection(camera_, context());
    EXPECT_TRUE(jumps());
}

TEST_F(CameraControllerTest, aFlightGoesOnAfterAnInspection) {
    camera_.rig = CameraRig{};
    camera_.rig->flight = FollowedFlight{"andes.csv", {}, 12.5, false, std::nullopt, 1};
    settings_.view.camera.mode = camera_.rig->mode = CameraMode::FollowFlight;
    inspect(camera_, {}, {}, context());
    EXPECT_EQ(settings_.view.camera.mode, CameraMode::Fly);
    endInspection(camera_, context());
    EXPECT_EQ(settings_.view.camera.mode, CameraMode::FollowFlight);
    EXPECT_EQ(camera_.rig->mode, CameraMode::FollowFlight) << "a transition would begin";
    EXPECT_EQ(camera_.rig->flight->timeS, 12.5);
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

TEST_F(CameraControllerTest, theCameraGlidesToAPlace) {
    camera_.rig = CameraRig{.camera = {.eyeM = {7e6, 0, 0}}};
    glideCamera(camera_, {.eyeM = {0, 8e6, 0}}, context());
    ASSERT_TRUE(camera_.rig->glide);
    EXPECT_EQ(camera_.rig->glide->to.eyeM, glm::dvec3(0, 8e6, 0));
    EXPECT_EQ(camera_.rig->camera.eyeM, glm::dvec3(7e6, 0, 0));
}

TEST_F(CameraControllerTest, theCameraJumpsIfTheUserPrefersItWhilePausedAndInAReplay) {
    const auto jumps = [&](const CameraContext& context) {
        camera_.rig = CameraRig{.camera = {.eyeM = {7e6, 0, 0}}};
        glideCamera(camera_, {.eyeM = {0, 8e6, 0}}, context);
        return !camera_.rig->glide && camera_.rig->camera.eyeM == glm::dvec3(0, 8e6, 0);
    };
    EXPECT_FALSE(jumps(context()));
    EXPECT_TRUE(jumps(replaying()));
    paused_ = true;
    EXPECT_TRUE(jumps(context()));
    paused_ = false;
    settings_.workspace.preferences.glide = false;
    EXPECT_TRUE(jumps(context()));
}

TEST_F(CameraControllerTest, measuredPlacesAreReachedAtOnce) {
    camera_.rig = CameraRig{.camera = {.eyeM = {7e6, 0, 0}}};
    glideCamera(camera_, {.eyeM = {0, 8e6, 0}}, context());
    inspect(camera_, {.eyeM = {0, 0, 9e6}}, {}, context());
    EXPECT_FALSE(camera_.rig->glide);
    EXPECT_EQ(camera_.rig->camera.eyeM, glm::dvec3(0, 0, 9e6));
    endInspection(camera_, context());
    EXPECT_EQ(camera_.rig->camera.eyeM, glm::dvec3(7e6, 0, 0));
}

}  // namespace
}  // namespace worldy
