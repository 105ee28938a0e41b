#include "app/flight/flight_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

glm::dvec3 directionOf(const planet::CameraPose& pose) {
    return planet::directionFromGeographic({glm::radians(pose.latitudeDeg), glm::radians(pose.longitudeDeg)});
}

FlightPath acrossThePole() {
    return {"across",
            {{0, {60, 0, 1e6, 350, -90}},
             {10, {80, 0, 1e4, 10, -20}},
             {15, {80, 180, 2e4, 20, -20}},
             {30, {40, 180, 500, 30, 0}}}};
}

TEST(FlightPath, PassesThroughEveryKey) {
    const FlightPath path = acrossThePole();
    for (const FlightKey& key : path.keys) {
        const planet::CameraPose pose = poseAt(path, key.timeS);
        EXPECT_LT(glm::length(directionOf(pose) - directionOf(key.pose)), 1e-9);
        EXPECT_NEAR(pose.altitudeM / key.pose.altitudeM, 1, 1e-9);
        EXPECT_NEAR(pose.headingDeg, key.pose.headingDeg, 1e-9);
        EXPECT_NEAR(pose.pitchDeg, key.pose.pitchDeg, 1e-9);
    }
}

TEST(FlightPath, HasNoJumpsAndNoKinks) {
    const FlightPath path = acrossThePole();
    const double h = 1e-3;
    for (double t = 2 * h; t < 30 - 2 * h; t += 0.01) {
        const glm::dvec3 before = (directionOf(poseAt(path, t)) - directionOf(poseAt(path, t - h))) / h;
        const glm::dvec3 after = (directionOf(poseAt(path, t + h)) - directionOf(poseAt(path, t))) / h;
        EXPECT_LT(glm::length(after - before), 1e-3) << t;
    }
}

TEST(FlightPath, HoldsTheEnds) {
    const FlightPath path = acrossThePole();
    EXPECT_NEAR(poseAt(path, -5).latitudeDeg, 60, 1e-9);
    EXPECT_NEAR(poseAt(path, 99).latitudeDeg, 40, 1e-9);
    EXPECT_EQ(durationS(path), 30);
}

TEST(FlightPath, AltitudeNeverLeavesTheRangeOfItsTwoKeys) {
    const FlightPath path = acrossThePole();
    for (std::size_t i = 0; i + 1 < path.keys.size(); ++i) {
        const auto [low, high] = std::minmax(path.keys[i].pose.altitudeM, path.keys[i + 1].pose.altitudeM);
        for (double t = path.keys[i].timeS; t <= path.keys[i + 1].timeS; t += 0.05) {
            const double altitude = poseAt(path, t).altitudeM;
            EXPECT_GE(altitude, low * (1 - 1e-12));
            EXPECT_LE(altitude, high * (1 + 1e-12));
        }
    }
}

TEST(FlightPath, AltitudeGoesByItsLogarithm) {
    const FlightPath path{"down", {{0, {0, 0, 1e6, 0, 0}}, {10, {0, 0, 1e2, 0, 0}}}};
    EXPECT_NEAR(poseAt(path, 5).altitudeM, 1e4, 1e-6);
}

TEST(FlightPath, HeadingTurnsTheShorterWay) {
    const FlightPath path{"turn", {{0, {0, 0, 100, 350, 0}}, {10, {0, 0, 100, 10, 0}}}};
    EXPECT_NEAR(std::remainder(poseAt(path, 5).headingDeg, 360), 0, 1e-9);
    EXPECT_NEAR(poseAt(path, 2).headingDeg, 350 + 20 * 0.104, 1e-6);
}

TEST(FlightPath, LongStepsFollowTheGreatCircle) {
    const FlightPath path{"far", {{0, {0, 0, 100, 0, 0}}, {10, {0, 160, 100, 0, 0}}}};
    const planet::CameraPose pose = poseAt(path, 5);
    EXPECT_NEAR(pose.latitudeDeg, 0, 1e-9);
    EXPECT_NEAR(pose.longitudeDeg, 80, 1e-9);
}

FlightPath throughAStop() {
    return {"stop",
            {{0, {10, 20, 2e4, 0, -30}},
             {2, {27, 86.4, 2e4, 0, -30}},
             {4, {27, 86.4, 2e4, 0, -30}},
             {5, {27.001, 86.4, 2e4, 0, -30}},
             {8, {40, 90, 2e4, 0, -30}}}};
}

TEST(FlightPath, BetweenTwoKeysAtOnePlaceTheCameraStandsStill) {
    const FlightPath path = throughAStop();
    for (double timeS = 2; timeS <= 4; timeS += 0.01)
        EXPECT_LT(glm::length(directionOf(poseAt(path, timeS)) - directionOf(path.keys[1].pose)), 1e-12)
            << timeS;
}

// The way from the fourth key to the fifth is ten thousand times as long.
TEST(FlightPath, AShortSpanIsNotOvershotForALongOneBesideIt) {
    const FlightPath path = throughAStop();
    double before = 27;
    for (double timeS = 4; timeS <= 5; timeS += 0.01) {
        const double latitudeDeg = poseAt(path, timeS).latitudeDeg;
        EXPECT_GE(latitudeDeg, before - 1e-9) << timeS;
        EXPECT_LE(latitudeDeg, 27.001 + 1e-9) << timeS;
        before = latitudeDeg;
    }
}

TEST(FlightPath, JumpsAreFoundBetweenTwoTimes) {
    FlightPath path;
    path.keys = {{0, {}}, {1, {}}, {2, {}, true}, {3, {}}};
    EXPECT_FALSE(jumpsBetween(path, 0, 1.9));
    EXPECT_TRUE(jumpsBetween(path, 1.9, 2));
    EXPECT_FALSE(jumpsBetween(path, 2, 3));
}

}  // namespace
}  // namespace worldy
