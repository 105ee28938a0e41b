#include "ui/model/camera_heights.h"

#include <gtest/gtest.h>

#include "tests/support/planet_fixture.h"

namespace ui {
namespace {

std::vector<std::string> namesOf(const CameraHeights& heights) {
    std::vector<std::string> names;
    for (const NamedHeight& height : namedHeights(heights)) names.push_back(height.name);
    return names;
}

using Names = std::vector<std::string>;

TEST(CameraHeights, onLandThereIsOneHeightAboveGround) {
    EXPECT_EQ(namesOf({800, 800, 1500}), (Names{"above ground"}));
}

TEST(CameraHeights, aDrawnSeaSurfaceIsNamedBesideItsBed) {
    const CameraHeights overSea{1500, 7161, 1500};
    EXPECT_EQ(namesOf(overSea), (Names{"above the sea surface", "above the sea bed"}));
    EXPECT_EQ(namedHeights(overSea)[0].heightM, 1500);
    EXPECT_EQ(namedHeights(overSea)[1].heightM, 7161);
}

TEST(CameraHeights, whereTheBedIsDrawnItIsNotCalledGround) {
    const CameraHeights overBed{7161, 7161, 1500};
    EXPECT_EQ(namesOf(overBed), (Names{"above the sea bed", "above sea level"}));
    EXPECT_EQ(namedHeights(overBed)[1].heightM, 1500);
}

TEST(CameraHeights, areOfThePointBelowTheCamera) {
    const auto planet = planet::openFake();
    const double radiusM = planet->shape().radiusM;
    const planet::CameraPose pose{.latitudeDeg = 10, .longitudeDeg = 20, .altitudeM = 0.5 * radiusM};
    const FrameStats stats;
    const std::deque<FrameSample> history;
    const planet::LodChanges changes;
    const std::deque<LogLine> log;
    EditorView view{.stats = stats, .history = history, .changes = changes, .log = log};
    view.planet = planet.get();
    view.camera.pose = pose;
    view.renderView = planet::viewFromPose(pose, radiusM, 1, 640, 480);
    ViewSettings settings;
    settings.surface.seaLevelM = 100;
    settings.surface.exaggeration = 2;
    const double groundM = planet::residentHeightM(planet->tree(), view.renderView.eyeM);
    view.camera.heightAboveGroundM = pose.altitudeM - groundM;
    const CameraHeights heights = cameraHeights(view, settings);
    EXPECT_DOUBLE_EQ(heights.aboveGroundM, pose.altitudeM - groundM);
    EXPECT_DOUBLE_EQ(heights.aboveDrawnM, pose.altitudeM - groundM);
    EXPECT_DOUBLE_EQ(heights.aboveSeaLevelM, pose.altitudeM - 200);
}

}  // namespace
}  // namespace ui
