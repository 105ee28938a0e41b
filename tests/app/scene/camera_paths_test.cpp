#include "app/scene/camera_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/app/earth_camera.h"

namespace worldy {
namespace {

double heightM(const Camera& camera) {
    return glm::length(camera.eyeM) - planet::earthRadiusM;
}

Camera glideOverEarth(const Camera& from, const Camera& to, double share) {
    return glideAt(from, to, share, planet::earthRadiusM);
}

double highestM(const Camera& from, const Camera& to) {
    double highest = 0;
    for (int i = 0; i <= 1000; ++i)
        highest = std::max(highest, heightM(glideOverEarth(from, to, i / 1000.0)));
    return highest;
}

double offLevel(const Camera& camera) {
    return std::max({std::abs(glm::dot(camera.right, glm::normalize(camera.eyeM))),
                     std::abs(glm::dot(camera.right, camera.back)), std::abs(glm::length(camera.back) - 1)});
}

TEST(CameraPaths, aGlideBeginsAndEndsToTheBit) {
    const Camera from = cameraAt(27, 86, 50'000, 30, -35);
    const Camera to = cameraAt(-32, -70, 9000, 200, -10);
    for (const auto& [share, camera] : {std::pair(0.0, from), std::pair(1.0, to)}) {
        EXPECT_EQ(glideOverEarth(from, to, share).eyeM, camera.eyeM);
        EXPECT_EQ(glideOverEarth(from, to, share).right, camera.right);
        EXPECT_EQ(glideOverEarth(from, to, share).back, camera.back);
    }
}

TEST(CameraPaths, aGlideMovesWithoutSteps) {
    const std::array starts = {cameraAt(27, 86, 50'000, 30, -35), cameraAt(89.9, 0, 2e7, 0, -90),
                               cameraAt(31.5, 35.4, -400, 0, 0)};
    const Camera to = cameraAt(-27, -94, 2000, 200, 5);  // on the other side of the first
    for (const Camera& from : starts) {
        Camera last = from;
        const double wayM = glm::length(to.eyeM - from.eyeM) + highestM(from, to);
        for (int i = 1; i <= 1000; ++i) {
            const Camera camera = glideOverEarth(from, to, i / 1000.0);
            ASSERT_LT(glm::length(camera.eyeM - last.eyeM), 0.01 * wayM) << i;
            ASSERT_LT(glm::length(camera.back - last.back), 0.05) << i;
            ASSERT_LT(offLevel(camera), 1e-9) << i;
            last = camera;
        }
    }
}

TEST(CameraPaths, aLongGlideRisesToHalfItsWay) {
    const Camera from = cameraAt(0, 0, 1000, 90, -10);
    const Camera to = cameraAt(0, 30, 1000, 90, -10);
    const double wayM = glm::radians(30.0) * planet::earthRadiusM;
    EXPECT_NEAR(highestM(from, to), wayM / 2, 0.01 * wayM);
}

TEST(CameraPaths, aShortGlideAndOneFromHighUpDoNotRise) {
    EXPECT_LE(highestM(cameraAt(0, 0, 5000, 0, -60), cameraAt(0, 0.05, 5000, 0, -60)), 5000.001);
    EXPECT_LE(highestM(cameraAt(0, 0, 1.4e7, 0, -90), cameraAt(20, 60, 1.4e7, 0, -90)), 1.4e7 + 1);
    EXPECT_LE(highestM(cameraAt(0, 0, 1.4e7, 0, -90), cameraAt(1, 1, 200, 0, -10)), 1.4e7 + 1);
}

TEST(CameraPaths, aPointLookedAtLiesInTheMiddle) {
    const Camera camera = cameraAt(27, 86, 50'000, 30, -35);
    const glm::dvec3 pointM = cameraAt(27.3, 85.8, 3000, 0, 0).eyeM;
    const Camera turned = lookingAt(camera, pointM);
    EXPECT_EQ(turned.eyeM, camera.eyeM);
    EXPECT_NEAR(glm::dot(glm::normalize(pointM - turned.eyeM), -turned.back), 1, 1e-12);
    EXPECT_LT(offLevel(turned), 1e-9);
    EXPECT_GT(glm::dot(glm::cross(turned.back, turned.right), glm::normalize(turned.eyeM)), 0);  // upright
}

TEST(CameraPaths, aHeldPointStaysInItsDirection) {
    const Camera camera = cameraAt(27, 86, 50'000, 30, -35);
    const glm::dvec3 pointM = cameraAt(27.2, 86.2, 3000, 0, 0).eyeM;
    const glm::dvec3 direction = directionOf(camera, pointM);
    const Camera moved = cameraAt(27.05, 86.1, 42'000, 55, -50);
    EXPECT_GT(glm::length(directionOf(moved, pointM) - direction), 0.1);
    EXPECT_LT(glm::length(directionOf(holding(moved, pointM, direction), pointM) - direction), 1e-6);
    EXPECT_LT(offLevel(holding(moved, pointM, direction)), 1e-9);
}

}  // namespace
}  // namespace worldy
