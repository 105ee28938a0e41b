#include "planet/sphere/view.h"

#include <gtest/gtest.h>

namespace planet {
namespace {

TEST(View, AJumpIsFasterThanAnyFlight) {
    constexpr double radiusM = 6.371e6;
    const auto eyeM = [](double latitudeDeg, double altitudeM) {
        return viewFromPose({latitudeDeg, 20, altitudeM, 0, -30}, radiusM, 1, 640, 400).eyeM;
    };
    constexpr double sixtiethS = 1.0 / 60;
    EXPECT_FALSE(isCameraJump(eyeM(10, 5000), eyeM(10, 5000), radiusM, 0));
    EXPECT_FALSE(isCameraJump(eyeM(10, 5000), eyeM(10.01, 5200), radiusM, sixtiethS));
    EXPECT_TRUE(isCameraJump(eyeM(10, 5000), eyeM(12, 5000), radiusM, sixtiethS));
    // 20 km up, as far as that over the ground: 0.18 degrees.
    EXPECT_FALSE(isCameraJump(eyeM(10, 20'000), eyeM(10.179, 20'000), radiusM, sixtiethS));
    EXPECT_TRUE(isCameraJump(eyeM(10, 20'000), eyeM(10.181, 20'000), radiusM, sixtiethS));
    EXPECT_TRUE(isCameraJump(eyeM(10, 20'000), eyeM(11, 20'000), radiusM, 0.1));
    EXPECT_FALSE(isCameraJump(eyeM(10, 20'000), eyeM(10.35, 20'000), radiusM, 0.2));
    EXPECT_TRUE(isCameraJump(eyeM(10, 20'000), eyeM(10.37, 20'000), radiusM, 0.2));
    // Close to the ground a height counts as 6371 m.
    EXPECT_FALSE(isCameraJump(eyeM(10, 2), eyeM(10.057, 2), radiusM, sixtiethS));
    EXPECT_TRUE(isCameraJump(eyeM(10, 2), eyeM(10.058, 2), radiusM, sixtiethS));
    EXPECT_TRUE(isCameraJump(eyeM(10, 2e7), eyeM(40, 2e7), radiusM, sixtiethS));
    EXPECT_TRUE(isCameraJump(eyeM(10, 2e7), eyeM(10, 1e5), radiusM, sixtiethS));
    EXPECT_FALSE(isCameraJump(eyeM(10, 2e7), eyeM(14, 1.9e7), radiusM, 0.5));
}

}  // namespace
}  // namespace planet
