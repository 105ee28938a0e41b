#include "app/scene/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/app/earth_camera.h"

namespace worldy {
namespace {

constexpr Ground sea{planet::earthRadiusM, 0};

planet::CameraPose poseOf(const Camera& camera) {
    return planet::poseFromView(viewOf(camera, 1, 100, 100), planet::earthRadiusM);
}

void expectLevelAndOrthonormal(const Camera& camera) {
    EXPECT_NEAR(glm::dot(camera.right, glm::normalize(camera.eyeM)), 0, 1e-12);
    EXPECT_NEAR(glm::dot(camera.right, camera.back), 0, 1e-12);
    EXPECT_NEAR(glm::length(camera.right), 1, 1e-12);
    EXPECT_NEAR(glm::length(camera.back), 1, 1e-12);
}

TEST(CameraControl, NorthIsNoHeadingOf360Degrees) {
    for (const double longitudeDeg : {-170.0, -86.5, 0.0, 10.0, 45.0, 86.5}) {
        for (const double latitudeDeg : {-60.0, 0.0, 20.0, 28.0}) {
            const planet::CameraPose north{
                .latitudeDeg = latitudeDeg, .longitudeDeg = longitudeDeg, .altitudeM = 1e6, .headingDeg = 0};
            const planet::CameraPose back = poseOf(cameraFromPose(north, planet::earthRadiusM));
            EXPECT_GE(back.headingDeg, 0);
            EXPECT_LT(back.headingDeg, 1e-6);
        }
    }
}

TEST(CameraControl, PoseRoundTrips) {
    const planet::CameraPose pose = poseOf(cameraAt(-33, 151, 5000, 300, -20));
    EXPECT_NEAR(pose.latitudeDeg, -33, 1e-9);
    EXPECT_NEAR(pose.longitudeDeg, 151, 1e-9);
    EXPECT_NEAR(pose.altitudeM, 5000, 1e-6);
    EXPECT_NEAR(pose.headingDeg, 300, 1e-9);
    EXPECT_NEAR(pose.pitchDeg, -20, 1e-9);
}

TEST(CameraControl, MovingForwardGoesAlongTheHeadingAtTheSameAltitude) {
    const Camera moved =
        moveOverGround(cameraAt(0, 0, 1000, 90, 0), sea, planet::earthRadiusM * glm::radians(2.0), 0);
    const planet::CameraPose pose = poseOf(moved);
    EXPECT_NEAR(pose.latitudeDeg, 0, 1e-9);
    EXPECT_NEAR(pose.longitudeDeg, 2, 1e-9);
    EXPECT_NEAR(pose.altitudeM, 1000, 1e-6);
    EXPECT_NEAR(pose.headingDeg, 90, 1e-9);
}

TEST(CameraControl, MovingRightOfNorthGoesEast) {
    const planet::CameraPose pose = poseOf(
        moveOverGround(cameraAt(0, 10, 1000, 0, -90), sea, 0, planet::earthRadiusM * glm::radians(3.0)));
    EXPECT_NEAR(pose.longitudeDeg, 13, 1e-9);
}

TEST(CameraControl, FlyingOverThePoleStaysLevelAndGoesOnStraight) {
    Camera camera = cameraAt(89, 30, 10'000, 0, -10);
    for (int step = 0; step < 200; ++step) {
        camera = moveOverGround(camera, sea, planet::earthRadiusM * glm::radians(0.01), 0);
        expectLevelAndOrthonormal(camera);
    }
    const planet::CameraPose pose = poseOf(camera);
    EXPECT_NEAR(pose.latitudeDeg, 89, 1e-6);
    EXPECT_NEAR(std::abs(pose.longitudeDeg), 150, 1e-6);
    EXPECT_NEAR(pose.headingDeg, 180, 1e-6);
    EXPECT_NEAR(pose.pitchDeg, -10, 1e-6);
}

TEST(CameraControl, LookingStopsStraightUpAndDown) {
    EXPECT_NEAR(poseOf(look(cameraAt(10, 20, 1000, 45, -80), 0, -1)).pitchDeg, -90, 1e-5);
    EXPECT_NEAR(poseOf(look(cameraAt(10, 20, 1000, 45, 80), 0, 1)).pitchDeg, 90, 1e-5);
    EXPECT_NEAR(poseOf(look(cameraAt(10, 20, 1000, 45, 80), 0, 1)).headingDeg, 45, 1e-5);
}

TEST(CameraControl, LookingRightTurnsTheHeadingClockwiseAndKeepsThePitch) {
    const planet::CameraPose pose = poseOf(look(cameraAt(40, 20, 1000, 350, -30), glm::radians(20.0), 0));
    EXPECT_NEAR(pose.headingDeg, 10, 1e-9);
    EXPECT_NEAR(pose.pitchDeg, -30, 1e-9);
    EXPECT_NEAR(pose.latitudeDeg, 40, 1e-9);
}

TEST(CameraControl, FlyingLevelKeepsTheAltitude) {
    Camera camera = cameraAt(10, 20, 3000, 45, 0);
    for (int step = 0; step < 1000; ++step) camera = fly(camera, sea, 1000, 0);
    EXPECT_NEAR(poseOf(camera).altitudeM, 3000, 1e-3);
}

TEST(CameraControl, FlyingStraightDownOnlyDescends) {
    const planet::CameraPose pose = poseOf(fly(cameraAt(10, 20, 3000, 45, -90), sea, 1000, 0));
    EXPECT_NEAR(pose.altitudeM, 2000, 1e-6);
    EXPECT_NEAR(pose.latitudeDeg, 10, 1e-9);
}

TEST(CameraControl, DraggingMovesTheGroundInTheMiddleWithThePointer) {
    const Camera camera = cameraAt(0, 0, 100'000, 0, -90);
    const planet::View before = viewOf(camera, glm::radians(60.0), 1000, 800);
    const glm::dvec3 ground = glm::normalize(camera.eyeM) * planet::earthRadiusM;
    const Camera dragged = drag(camera, sea, before, {50, -30});
    const planet::View after = viewOf(dragged, glm::radians(60.0), 1000, 800);
    const glm::dvec3 seen = planet::cameraFromWorldRotation(after) * (ground - after.eyeM);
    const double scale = planet::screenScalePx(after);
    EXPECT_NEAR(seen.x / -seen.z * scale, 50, 0.1);    // right
    EXPECT_NEAR(-seen.y / -seen.z * scale, -30, 0.1);  // down
}

TEST(CameraControl, DraggingWhileLookingAtTheSkyMovesTheCameraByAFewHeightsAtMost) {
    const Camera camera = cameraAt(0, 0, 1000, 0, 0);
    const planet::View view = viewOf(camera, glm::radians(60.0), 1000, 800);
    const Camera dragged = drag(camera, sea, view, {1000, 0});
    const double movedM = glm::length(dragged.eyeM - camera.eyeM);
    EXPECT_GT(movedM, 100);
    EXPECT_LT(movedM, 8000);
}

TEST(CameraControl, ApproachingKeepsThePointUnderThePointer) {
    const Camera camera = cameraAt(30, 60, 20'000, 20, -60);
    const planet::View before = viewOf(camera, glm::radians(60.0), 1000, 800);
    const glm::dvec2 pixel(600, 420);
    const glm::dvec3 ray = rayThrough(before, pixel);
    // Where the ray meets the sea.
    const double b = glm::dot(camera.eyeM, ray);
    const double t = -b - std::sqrt(b * b - glm::dot(camera.eyeM, camera.eyeM) +
                                    planet::earthRadiusM * planet::earthRadiusM);
    const glm::dvec3 place = camera.eyeM + t * ray;
    const Camera nearer = approach(camera, sea, ray, 3);
    EXPECT_LT(poseOf(nearer).altitudeM, 13'000);
    const planet::View after = viewOf(nearer, glm::radians(60.0), 1000, 800);
    const glm::dvec3 seen = planet::cameraFromWorldRotation(after) * (place - after.eyeM);
    EXPECT_NEAR(500 + seen.x / -seen.z * planet::screenScalePx(after), pixel.x, 2);
    EXPECT_NEAR(400 - seen.y / -seen.z * planet::screenScalePx(after), pixel.y, 2);
}

TEST(CameraControl, ApproachingForEverNeverGetsThroughTheGround) {
    const Ground mountain{planet::earthRadiusM, 5000};
    Camera camera = cameraAt(30, 60, 20'000'000, 20, -60);
    for (int notch = 0; notch < 300; ++notch) {
        camera = keepInRange(approach(camera, mountain, -camera.back, 1), mountain);
        ASSERT_GE(glm::length(camera.eyeM), planet::earthRadiusM + 5000 + minGroundClearanceM - 1e-6);
        expectLevelAndOrthonormal(camera);
    }
    EXPECT_LT(heightAboveGroundM(camera, mountain), 3);
}

TEST(CameraControl, GoingAwayForEverStopsAtTheFarthestDistance) {
    Camera camera = cameraAt(30, 60, 20, 20, 10);
    for (int notch = 0; notch < 500; ++notch)
        camera = keepInRange(approach(camera, sea, -camera.back, -1), sea);
    EXPECT_NEAR(glm::length(camera.eyeM), (1 + maxAltitudeRadii) * planet::earthRadiusM, 1);
}

TEST(CameraControl, ACameraBelowGroundIsLiftedAboveIt) {
    const Ground mountain{planet::earthRadiusM, 8000};
    const Camera lifted = keepInRange(cameraAt(28, 87, 100, 0, 0), mountain);
    EXPECT_NEAR(poseOf(lifted).altitudeM, 8000 + minGroundClearanceM, 1e-6);
    EXPECT_NEAR(poseOf(lifted).latitudeDeg, 28, 1e-9);
}

TEST(CameraControl, SpeedGrowsWithHeightAndTheFactorAndHasALimit) {
    const double low = speedMS(cameraAt(0, 0, 100, 0, 0), sea, 1);
    const double high = speedMS(cameraAt(0, 0, 10'000, 0, 0), sea, 1);
    EXPECT_NEAR(high / low, 100, 1e-6);
    EXPECT_NEAR(speedMS(cameraAt(0, 0, 100, 0, 0), sea, 4), 4 * low, 1e-9);
    EXPECT_LE(speedMS(cameraAt(0, 0, 1e8, 0, 0), sea, 1), 1.5 * planet::earthRadiusM);
}

TEST(CameraControl, KeysMoveInStepWithTime) {
    const Camera camera = cameraAt(0, 0, 1000, 0, -90);
    const Camera once = steered(camera, sea, {.lookRight = 1}, 1, 0.5);
    const Camera twice =
        steered(steered(camera, sea, {.lookRight = 1}, 1, 0.25), sea, {.lookRight = 1}, 1, 0.25);
    EXPECT_NEAR(glm::length(once.right - twice.right), 0, 1e-9);
    EXPECT_NEAR(poseOf(once).headingDeg, 30, 1e-6);
    EXPECT_EQ(steered(camera, sea, {}, 1, 0.5).eyeM, camera.eyeM);
}

}  // namespace
}  // namespace worldy
