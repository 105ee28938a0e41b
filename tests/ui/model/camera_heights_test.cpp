#include "ui/model/camera_heights.h"

#include <gtest/gtest.h>

#include "tests/support/empty_view.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

std::vector<std::string> namesOf(const CameraHeights& heights) {
    std::vector<std::string> names;
    for (const NamedHeight& height : namedHeights(heights)) names.push_back(height.name);
    return names;
}

using Names = std::vector<std::string>;

TEST(CameraHeights, onLandTheyAreAboveGroundAndSeaLevel) {
    EXPECT_EQ(namesOf({800, 800, 1500}), (Names{"above ground", "above sea level"}));
    EXPECT_EQ(namedHeights({800, 800, 1500})[0].heightM, 800);
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

struct Viewed : EmptyView {
    Viewed(const planet::Planet& planet, const planet::CameraPose& pose) {
        view.planet = &planet;
        view.camera.pose = pose;
        view.camera.renderView = planet::viewFromPose(pose, planet.tree().shape.radiusM, 1, 640, 480);
    }
};

TEST(CameraHeights, areOfThePointBelowTheCamera) {
    const auto planet = planet::openFake();
    const planet::CameraPose pose{
        .latitudeDeg = 10, .longitudeDeg = 20, .altitudeM = 0.5 * planet->tree().shape.radiusM};
    Viewed viewed(*planet, pose);
    ViewSettings settings;
    settings.surface.seaLevelM = 100;
    settings.surface.exaggeration = 2;
    const double groundM = planet::sampledHeightM(planet->tree(), viewed.view.camera.renderView.eyeM);
    const CameraHeights heights = cameraHeights(viewed.view, settings);
    EXPECT_DOUBLE_EQ(heights.aboveGroundM, pose.altitudeM - groundM);
    EXPECT_DOUBLE_EQ(heights.aboveDrawnM, pose.altitudeM - groundM);
    EXPECT_DOUBLE_EQ(heights.aboveSeaLevelM, pose.altitudeM - 200);
    viewed.view.camera.seaSurfaceM = groundM + 3000;
    EXPECT_DOUBLE_EQ(cameraHeights(viewed.view, settings).aboveDrawnM, pose.altitudeM - groundM - 3000);
}

// The triangles of a root chunk sag below the sphere by far more than the plain is high.
TEST(CameraHeights, aPlainOfACoarsePlanetIsNoSeaBed) {
    constexpr double plainM = 500;
    planet::PlanetSource source = planet::fakePyramid().source();
    planet::PagingSettings paging;
    paging.paused = true;
    source.shape.radiusM = 6'371'000;
    source.shape.quantumM = 1;
    source.shape.baseHeightM = 0;
    source.minStep = source.maxStep = 500;
    for (planet::ChunkData& root : source.roots) {
        root.heights = std::vector<std::int16_t>(root.heights.size(), 500);
        root.minStep = root.maxStep = 500;
    }
    const auto planet = planet::Planet::open(std::move(source), paging).value();
    for (double latitudeDeg = -80; latitudeDeg < 90; latitudeDeg += 9.7) {
        Viewed viewed(*planet, {.latitudeDeg = latitudeDeg, .longitudeDeg = 13, .altitudeM = 14e6});
        const CameraHeights heights = cameraHeights(viewed.view, {});
        EXPECT_NEAR(heights.aboveGroundM, 14e6 - plainM, 1e-3);
        EXPECT_EQ(namesOf(heights), (Names{"above ground", "above sea level"}));
        viewed.view.camera.seaSurfaceM = 0;
        EXPECT_EQ(namesOf(cameraHeights(viewed.view, {})), (Names{"above ground", "above sea level"}));
    }
}

}  // namespace
}  // namespace worldy::ui
