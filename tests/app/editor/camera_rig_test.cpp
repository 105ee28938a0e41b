#include "app/editor/camera_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/flight/flight_path_file.h"
#include "tests/app/earth_camera.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

// A smooth planet whose ground lies at one height everywhere.
Surroundings smoothPlanet(double heightM = 0) {
    return {[=](const glm::dvec3&) {
                return Ground{planet::earthRadiusM, heightM};
            },
            [=](const glm::dvec3& eyeM, const glm::dvec3& direction) -> std::optional<glm::dvec3> {
                const double ground = planet::earthRadiusM + heightM;
                const double towards = -glm::dot(eyeM, direction);
                const double chord = ground * ground - glm::dot(eyeM, eyeM) + towards * towards;
                if (towards <= 0 || chord < 0) return std::nullopt;
                return eyeM + (towards - std::sqrt(chord)) * direction;
            }};
}

struct Driver {
    CameraRig rig{.camera = cameraAt(27, 86, 50'000, 30, -35)};
    CameraSettings settings;
    Surroundings around = smoothPlanet();

    planet::Result<void> frame(const PointerInput& pointer = {}, const CameraMotion& keys = {},
                               double seconds = 1.0 / 60) {
        const planet::View view = viewOf(rig.camera, glm::radians(60.0), 800, 600);
        return advanceRig(rig, around, view, pointer, keys, seconds, settings);
    }
};

void expectLevel(const Camera& camera) {
    EXPECT_NEAR(glm::dot(camera.right, glm::normalize(camera.eyeM)), 0, 1e-9);
    EXPECT_NEAR(glm::dot(camera.right, camera.back), 0, 1e-9);
    EXPECT_NEAR(glm::length(camera.right), 1, 1e-9);
    EXPECT_NEAR(glm::length(camera.back), 1, 1e-9);
}

void expectSame(const Camera& a, const Camera& b, double toleranceM = 1e-3) {
    EXPECT_NEAR(glm::length(a.eyeM - b.eyeM), 0, toleranceM);
    EXPECT_NEAR(glm::length(a.right - b.right), 0, 1e-9);
    EXPECT_NEAR(glm::length(a.back - b.back), 0, 1e-9);
}

// How far the pivot lies from the middle of the picture, radians.
double offMiddleRad(const CameraRig& rig) {
    const glm::dvec3 towards = glm::normalize(*rig.pivotM - rig.camera.eyeM);
    return std::acos(std::clamp(glm::dot(towards, -rig.camera.back), -1.0, 1.0));
}

bool touchesNothing(const PointerInput& pointer) {
    return !pointer.grabs && pointer.wheelNotches == 0 && pointer.dragPx + pointer.lookPx == glm::dvec2(0, 0);
}

std::filesystem::path writeFlight(const tests::TemporaryFolder& folder, const char* name = "flight.toml") {
    const std::filesystem::path file = folder / name;
    std::ofstream(file) << R"(name = "Test"
[[key]]
time_s = 5
latitude_deg = 10
longitude_deg = 20
altitude_m = 30000
heading_deg = 90
pitch_deg = -20
[[key]]
time_s = 15
latitude_deg = 12
longitude_deg = 25
altitude_m = 20000
heading_deg = 80
pitch_deg = -25
)";
    return file;
}

TEST(CameraRig, changingFromFlyToOrbitAndBackMovesNothing) {
    Driver driver;
    const Camera before = driver.rig.camera;
    driver.settings.mode = CameraMode::Orbit;
    ASSERT_TRUE(driver.frame());
    expectSame(driver.rig.camera, before);
    driver.settings.mode = CameraMode::Fly;
    ASSERT_TRUE(driver.frame());
    expectSame(driver.rig.camera, before);
}

TEST(CameraRig, aStillCameraKeepsEveryBit) {
    const std::array cameras = {cameraAt(20, 10, 14'016'200, 0, -90), cameraAt(27, 86, 50'000, 30, -35),
                                cameraAt(-71, -133.3, 123.4, 211, 12),
                                cameraAt(12.3, 45.6, -5000, 77, -89.9999)};
    for (const CameraMode mode : {CameraMode::Fly, CameraMode::Orbit}) {
        for (const Camera& start : cameras) {
            Driver driver;
            driver.rig.camera = start;
            driver.around = smoothPlanet(1234.5);
            driver.settings.mode = mode;
            ASSERT_TRUE(driver.frame());
            const Camera first = driver.rig.camera;
            for (int frame = 0; frame < 100; ++frame) {
                ASSERT_TRUE(driver.frame());
                ASSERT_EQ(driver.rig.camera.eyeM, first.eyeM) << frame;
                ASSERT_EQ(driver.rig.camera.right, first.right) << frame;
                ASSERT_EQ(driver.rig.camera.back, first.back) << frame;
            }
        }
    }
}

TEST(CameraRig, orbitKeepsThePivotInTheMiddleAndItsDistance) {
    Driver driver;
    driver.settings.mode = CameraMode::Orbit;
    ASSERT_TRUE(driver.frame());
    const glm::dvec3 pivotM = *driver.rig.pivotM;
    EXPECT_NEAR(glm::length(pivotM), planet::earthRadiusM, 1e-3);
    const double distanceM = glm::length(driver.rig.camera.eyeM - pivotM);
    for (int i = 0; i < 200; ++i) {
        ASSERT_TRUE(driver.frame({.dragPx = {7, i < 100 ? 2.0 : -3.0}}));
        ASSERT_LT(offMiddleRad(driver.rig), 1e-6);
        ASSERT_NEAR(glm::length(driver.rig.camera.eyeM - pivotM), distanceM, 0.01);
        expectLevel(driver.rig.camera);
    }
    EXPECT_EQ(*driver.rig.pivotM, pivotM);
}

TEST(CameraRig, orbitStopsAboveThePivotAndAtItsHorizon) {
    Driver driver;
    driver.settings.mode = CameraMode::Orbit;
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(driver.frame({.dragPx = {0, 50}}));
    glm::dvec3 offset = glm::normalize(driver.rig.camera.eyeM - *driver.rig.pivotM);
    EXPECT_NEAR(glm::dot(offset, glm::normalize(*driver.rig.pivotM)), 1, 1e-9);
    const glm::dvec3 rightAbove = driver.rig.camera.right;
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(driver.frame({.dragPx = {0, -50}}));
    offset = glm::normalize(driver.rig.camera.eyeM - *driver.rig.pivotM);
    EXPECT_GT(glm::dot(offset, glm::normalize(*driver.rig.pivotM)), 0);
    EXPECT_LT(glm::dot(offset, glm::normalize(*driver.rig.pivotM)), 0.05);
    // Down on the side it came from.
    EXPECT_NEAR(glm::dot(driver.rig.camera.right, rightAbove), 1, 1e-6);
}

TEST(CameraRig, orbitWheelGoesNearerButNeverThrough) {
    Driver driver;
    driver.settings.mode = CameraMode::Orbit;
    ASSERT_TRUE(driver.frame());
    const double far = glm::length(driver.rig.camera.eyeM - *driver.rig.pivotM);
    ASSERT_TRUE(driver.frame({.wheelNotches = 1}));
    EXPECT_NEAR(glm::length(driver.rig.camera.eyeM - *driver.rig.pivotM), 0.85 * far, 0.01);
    for (int i = 0; i < 200; ++i) ASSERT_TRUE(driver.frame({.wheelNotches = 1}));
    EXPECT_GE(glm::length(driver.rig.camera.eyeM), planet::earthRadiusM + minGroundClearanceM - 1e-6);
    EXPECT_LT(offMiddleRad(driver.rig), 1e-3);
    for (int i = 0; i < 300; ++i) ASSERT_TRUE(driver.frame({.wheelNotches = -1}));
    EXPECT_LE(glm::length(driver.rig.camera.eyeM), (1 + maxAltitudeRadii) * planet::earthRadiusM + 1);
    EXPECT_LT(offMiddleRad(driver.rig), 1e-3);
}

TEST(CameraRig, orbitOfTheSkyTurnsAboutTheGroundBelow) {
    Driver driver;
    driver.rig.camera = cameraAt(10, 20, 3000, 0, 40);
    const Camera before = driver.rig.camera;
    driver.settings.mode = CameraMode::Orbit;
    ASSERT_TRUE(driver.frame());
    expectSame(driver.rig.camera, before);
    EXPECT_NEAR(glm::length(*driver.rig.pivotM - planet::earthRadiusM * glm::normalize(before.eyeM)), 0,
                1e-3);
}

TEST(CameraRig, orbitRightButtonMovesThePivotOverTheGround) {
    Driver driver;
    driver.settings.mode = CameraMode::Orbit;
    ASSERT_TRUE(driver.frame());
    const glm::dvec3 before = *driver.rig.pivotM;
    ASSERT_TRUE(driver.frame({.lookPx = {100, 0}}));
    EXPECT_GT(glm::length(*driver.rig.pivotM - before), 1000);
    EXPECT_NEAR(glm::length(*driver.rig.pivotM), planet::earthRadiusM, 1);
    EXPECT_LT(offMiddleRad(driver.rig), 1e-6);
}

TEST(CameraRig, aFlightIsJoinedWithoutAJumpAndThenFollowed) {
    const tests::TemporaryFolder folder;
    Driver driver;
    const Camera before = driver.rig.camera;
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    EXPECT_EQ(driver.settings.mode, CameraMode::FollowFlight);
    ASSERT_TRUE(driver.frame({}, {}, 1e-6));
    expectSame(driver.rig.camera, before, 1);
    for (int i = 0; i < 120; ++i) {
        const glm::dvec3 last = driver.rig.camera.eyeM;
        ASSERT_TRUE(driver.frame());
        ASSERT_LT(glm::length(driver.rig.camera.eyeM - last), 0.03 * planet::earthRadiusM);
        expectLevel(driver.rig.camera);
    }
    ASSERT_FALSE(driver.rig.flight->from);
    const Camera expected =
        cameraFromPose(poseAt(driver.rig.flight->path, 5 + driver.rig.flight->timeS), planet::earthRadiusM);
    expectSame(driver.rig.camera, expected);
}

TEST(CameraRig, aFlightPausesScrubsAndRestartsAtItsEnd) {
    const tests::TemporaryFolder folder;
    Driver driver;
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    moveFlight(driver.rig, 9.9);
    ASSERT_TRUE(driver.frame({}, {}, 0.05));
    EXPECT_NEAR(driver.rig.flight->timeS, 9.95, 1e-9);
    pauseFlight(driver.rig, true);
    ASSERT_TRUE(driver.frame({}, {}, 0.05));
    EXPECT_NEAR(driver.rig.flight->timeS, 9.95, 1e-9);
    pauseFlight(driver.rig, false);
    ASSERT_TRUE(driver.frame({}, {}, 0.15));
    EXPECT_NEAR(driver.rig.flight->timeS, 0.1, 1e-9);
    moveFlight(driver.rig, 99);
    EXPECT_EQ(driver.rig.flight->timeS, 10);
    moveFlight(driver.rig, -3);
    EXPECT_EQ(driver.rig.flight->timeS, 0);
}

TEST(CameraRig, aFlightThatIsJoinedOrMovedAndAPlacedCameraAreJumps) {
    const tests::TemporaryFolder folder;
    Driver driver;
    ASSERT_TRUE(driver.frame());
    EXPECT_FALSE(takeJump(driver.rig));
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    ASSERT_TRUE(driver.frame());
    EXPECT_TRUE(takeJump(driver.rig));
    while (driver.rig.flight->from) ASSERT_TRUE(driver.frame());
    EXPECT_TRUE(takeJump(driver.rig));
    ASSERT_TRUE(driver.frame());
    EXPECT_FALSE(takeJump(driver.rig));
    moveFlight(driver.rig, 9.9);
    EXPECT_TRUE(takeJump(driver.rig));
    ASSERT_TRUE(driver.frame({}, {}, 0.2));  // over the end, and back to the start
    EXPECT_TRUE(takeJump(driver.rig));
    EXPECT_FALSE(takeJump(driver.rig));
    placeRig(driver.rig, cameraAt(0, 0, 1000, 0, 0), driver.settings);
    EXPECT_TRUE(takeJump(driver.rig));
}

TEST(CameraRig, touchingTheControlsLeavesAFlightWhereItIs) {
    const tests::TemporaryFolder folder;
    Driver driver;
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    moveFlight(driver.rig, 4);
    ASSERT_TRUE(driver.frame());
    const Camera before = driver.rig.camera;
    ASSERT_TRUE(driver.frame({.lookPx = {1, 0}}));
    EXPECT_EQ(driver.settings.mode, CameraMode::Fly);
    EXPECT_NEAR(glm::length(driver.rig.camera.eyeM - before.eyeM), 0, 1e-3);
    EXPECT_FALSE(cameraViewOf(driver.rig, {}, {}, {}).flight);
    // And it goes on where it was left.
    const double leftS = driver.rig.flight->timeS;
    driver.settings.mode = CameraMode::FollowFlight;
    ASSERT_TRUE(driver.frame());
    EXPECT_EQ(driver.rig.flight->timeS, leftS);
    EXPECT_NEAR(glm::length(driver.rig.camera.eyeM - before.eyeM), 0, 100);
}

TEST(CameraRig, aFlightThatCannotBeReadIsAnErrorAndTheCameraFliesOn) {
    Driver driver;
    const Camera before = driver.rig.camera;
    driver.settings.mode = CameraMode::FollowFlight;
    driver.settings.flight = "/nonexistent/flight.toml";
    const planet::Result<void> moved = driver.frame();
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, testing::HasSubstr("/nonexistent/flight.toml"));
    EXPECT_EQ(driver.settings.mode, CameraMode::Fly);
    expectSame(driver.rig.camera, before);
    EXPECT_TRUE(driver.frame());
}

TEST(CameraRig, settingsThatNameAnotherFlightJoinIt) {
    const tests::TemporaryFolder folder;
    Driver driver;
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    ASSERT_TRUE(driver.frame({}, {}, 3));
    driver.settings.flight = writeFlight(folder, "other.toml").string();
    ASSERT_TRUE(driver.frame());
    EXPECT_EQ(driver.rig.flight->file, folder / "other.toml");
    EXPECT_EQ(driver.rig.flight->timeS, 0);
}

TEST(CameraRig, placingLeavesAFlightAndForgetsThePivot) {
    const tests::TemporaryFolder folder;
    Driver driver;
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    ASSERT_TRUE(driver.frame());
    const Camera there = cameraAt(-33, 151, 4000, 10, -10);
    placeRig(driver.rig, there, driver.settings);
    EXPECT_EQ(driver.settings.mode, CameraMode::Fly);
    ASSERT_TRUE(driver.frame());
    expectSame(driver.rig.camera, there);
}

TEST(CameraRig, aGlideTakesASecondAndEndsAtThePlace) {
    for (const CameraMode mode : {CameraMode::Fly, CameraMode::Orbit}) {
        Driver driver;
        driver.settings.mode = mode;
        ASSERT_TRUE(driver.frame());
        const Camera there = cameraAt(-33, 151, 4000, 10, -10);
        glideRig(driver.rig, there, driver.settings);
        ASSERT_TRUE(driver.frame({}, {}, 0.01));
        EXPECT_LT(glm::length(driver.rig.camera.eyeM - cameraAt(27, 86, 50'000, 30, -35).eyeM), 100'000);
        for (int i = 0; i < 98; ++i) ASSERT_TRUE(driver.frame({}, {}, 0.01));
        EXPECT_TRUE(driver.rig.glide);
        for (int i = 0; i < 2; ++i) ASSERT_TRUE(driver.frame({}, {}, 0.01));
        EXPECT_FALSE(driver.rig.glide);
        expectSame(driver.rig.camera, there);
        EXPECT_EQ(driver.settings.mode, mode);
        // Orbiting goes on around the middle of the new picture.
        ASSERT_TRUE(driver.frame());
        if (mode == CameraMode::Orbit) {
            EXPECT_LT(offMiddleRad(driver.rig), 1e-6);
        }
    }
}

TEST(CameraRig, anyInputEndsAGlideWhereItIs) {
    const std::array<PointerInput, 5> pointers = {PointerInput{.dragPx = {1, 0}},
                                                  PointerInput{.lookPx = {0, 1}}, PointerInput{.grabs = true},
                                                  PointerInput{.wheelNotches = 0.1}, PointerInput{}};
    for (const PointerInput& pointer : pointers) {
        Driver driver;
        glideRig(driver.rig, cameraAt(-33, 151, 4000, 10, -10), driver.settings);
        for (int i = 0; i < 30; ++i) ASSERT_TRUE(driver.frame());
        ASSERT_TRUE(driver.rig.glide);
        const Camera before = driver.rig.camera;
        const bool moves = touchesNothing(pointer);
        ASSERT_TRUE(driver.frame(pointer, {.lookUp = moves ? 0.01 : 0.0}));
        EXPECT_FALSE(driver.rig.glide);
        EXPECT_LT(glm::length(driver.rig.camera.eyeM - before.eyeM), 0.05 * glm::length(before.eyeM));
        ASSERT_TRUE(driver.frame());
        EXPECT_FALSE(driver.rig.glide);
    }
}

TEST(CameraRig, aGlideLeavesAFlightAndCountsAsAJump) {
    const tests::TemporaryFolder folder;
    Driver driver;
    ASSERT_TRUE(startFlight(driver.rig, writeFlight(folder), driver.settings));
    ASSERT_TRUE(driver.frame());
    glideRig(driver.rig, cameraAt(-33, 151, 4000, 10, -10), driver.settings);
    takeJump(driver.rig);
    ASSERT_TRUE(driver.frame());
    EXPECT_EQ(driver.settings.mode, CameraMode::Fly);
    EXPECT_TRUE(driver.rig.glide);
    EXPECT_TRUE(takeJump(driver.rig));
    placeRig(driver.rig, cameraAt(0, 0, 4000, 0, 0), driver.settings);
    EXPECT_FALSE(driver.rig.glide);
}

TEST(CameraRig, altDragOrbitsThePointUnderThePointerAndKeepsItThere) {
    Driver driver;
    const planet::View view = viewOf(driver.rig.camera, glm::radians(60.0), 800, 600);
    PointerInput pointer{.positionPx = {550, 400}, .grabs = true};
    ASSERT_TRUE(driver.frame(pointer));
    ASSERT_TRUE(driver.rig.grab);
    const glm::dvec3 pointM = driver.rig.grab->pointM;
    const auto pixel = [&] {
        return *pixelOf(viewOf(driver.rig.camera, glm::radians(60.0), 800, 600), pointM);
    };
    EXPECT_NEAR(glm::length(*pixelOf(view, pointM) - pointer.positionPx), 0, 1e-6);
    const glm::dvec3 eyeM = driver.rig.camera.eyeM;
    const double distanceM = glm::length(eyeM - pointM);
    pointer.orbitPx = {5, 2};
    for (int i = 0; i < 20; ++i) {
        pointer.positionPx += pointer.orbitPx;
        ASSERT_TRUE(driver.frame(pointer));
        ASSERT_NEAR(glm::length(driver.rig.camera.eyeM - pointM), distanceM, 0.01);
        ASSERT_NEAR(glm::length(pixel() - glm::dvec2(550, 400)), 0, 0.01);
        expectLevel(driver.rig.camera);
    }
    EXPECT_GT(glm::length(driver.rig.camera.eyeM - eyeM), 0.3 * distanceM);
    // The other button moves towards the point.
    pointer.orbitPx = {0, 0};
    pointer.dollyPx = {0, -30};
    ASSERT_TRUE(driver.frame(pointer));
    EXPECT_LT(glm::length(driver.rig.camera.eyeM - pointM), 0.9 * distanceM);
    EXPECT_NEAR(glm::length(pixel() - glm::dvec2(550, 400)), 0, 0.01);
    ASSERT_TRUE(driver.frame());
    EXPECT_FALSE(driver.rig.grab);
}

TEST(CameraRig, anOrbitedPointMayBeBesideTheMiddle) {
    Driver driver;
    const Camera before = driver.rig.camera;
    const glm::dvec3 pointM = cameraAt(27.4, 86.3, 0, 0, 0).eyeM;
    orbitPoint(driver.rig, pointM, driver.settings);
    ASSERT_TRUE(driver.frame());
    expectSame(driver.rig.camera, before);
    for (int i = 0; i < 50; ++i) ASSERT_TRUE(driver.frame({}, {.right = 1}));
    EXPECT_EQ(*driver.rig.pivotM, pointM);
    EXPECT_NEAR(glm::length(driver.rig.camera.eyeM - pointM), glm::length(before.eyeM - pointM), 0.01);
}

TEST(CameraRig, aNarrowFieldOfViewTurnsSlower) {
    const auto turnedRad = [](double fovDeg) {
        Driver driver;
        const Camera before = driver.rig.camera;
        const planet::View view = viewOf(before, glm::radians(fovDeg), 800, 600);
        EXPECT_TRUE(advanceRig(driver.rig, driver.around, view, {}, {.lookUp = 1}, 0.1, driver.settings));
        return std::acos(std::min(glm::dot(before.back, driver.rig.camera.back), 1.0));
    };
    EXPECT_NEAR(turnedRad(60), glm::radians(6.0), 1e-6);
    EXPECT_NEAR(turnedRad(90), glm::radians(6.0), 1e-6);
    EXPECT_NEAR(turnedRad(20), glm::radians(2.0), 1e-6);
}

TEST(CameraRig, theGroundLiftsEveryMode) {
    const tests::TemporaryFolder folder;
    for (const CameraMode mode : {CameraMode::Fly, CameraMode::Orbit, CameraMode::FollowFlight}) {
        Driver driver;
        driver.around = smoothPlanet(60'000);
        driver.settings.flight = writeFlight(folder).string();
        driver.settings.mode = mode;
        ASSERT_TRUE(driver.frame());
        EXPECT_GE(glm::length(driver.rig.camera.eyeM),
                  planet::earthRadiusM + 60'000 + minGroundClearanceM - 1e-6);
    }
}

TEST(CameraRig, blendingMeetsBothEndsEvenOnOppositeSidesOfThePlanet) {
    const Camera from = cameraAt(20, 30, 5000, 350, -30);
    for (const Camera& to : {cameraAt(-20, -150, 2e6, 10, -80), cameraAt(20, 30, 9000, 10, 20),
                             cameraAt(85, 100, 9000, 200, 0)}) {
        expectSame(blend(from, to, 0), from);
        expectSame(blend(from, to, 1), to);
        for (double share = 0.1; share < 1; share += 0.1) expectLevel(blend(from, to, share));
    }
}

TEST(CameraRig, shippedFlightsCanAllBeFollowed) {
    const std::vector<std::filesystem::path> flights = availableFlights();
    ASSERT_GE(flights.size(), 2u);
    for (const std::filesystem::path& file : flights) {
        const planet::Result<FlightPath> path = loadFlightPath(file);
        EXPECT_TRUE(path) << path.error().message;
    }
}

}  // namespace
}  // namespace worldy
