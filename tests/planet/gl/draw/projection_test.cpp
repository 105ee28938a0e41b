#include "planet/gl/draw/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>

namespace planet::gl {
namespace {

glm::dvec3 projected(const Projection& projection, const glm::dvec3& camera) {
    const glm::dvec4 clip = projection.clipFromCamera * glm::dvec4(camera, 1);
    return glm::dvec3(clip) / clip.w;
}

TEST(Projection, EdgesOfTheViewAreEdgesOfThePicture) {
    View view;
    view.widthPx = 1000;
    view.heightPx = 500;
    const double tanX = std::tan(view.horizontalFovRad / 2);
    for (const Projection& projection : {reversedProjection(view, 0.1), classicProjection(view, 1, 1e6)}) {
        const glm::dvec3 corner = projected(projection, 700.0 * glm::dvec3(tanX, tanX / 2, -1));
        EXPECT_NEAR(corner.x, 1, 1e-12);
        EXPECT_NEAR(corner.y, 1, 1e-12);
    }
}

TEST(Projection, DepthTurnsBackIntoMetres) {
    const View view;
    const Projection reversed = reversedProjection(view, 0.1);
    const Projection classic = classicProjection(view, 10, 1e7);
    for (const double distanceM : {10.0, 123.0, 4567.0, 1e6}) {
        EXPECT_NEAR(viewDistanceM(reversed, projected(reversed, {0, 0, -distanceM}).z), distanceM,
                    1e-9 * distanceM);
        const double depth = projected(classic, {0, 0, -distanceM}).z / 2 + 0.5;
        EXPECT_NEAR(viewDistanceM(classic, depth), distanceM, 1e-6 * distanceM);
    }
    EXPECT_EQ(viewDistanceM(reversed, 0), std::numeric_limits<double>::infinity());
}

TEST(Projection, AFloatOfReversedDepthTellsMetresApartAtAnyDistance) {
    const Projection reversed = reversedProjection(View{}, 0.1);
    for (double distanceM = 1; distanceM < 1e8; distanceM *= 10) {
        const auto here = static_cast<float>(projected(reversed, {0, 0, -distanceM}).z);
        const auto there = static_cast<float>(projected(reversed, {0, 0, -distanceM * (1 + 3e-7)}).z);
        EXPECT_GT(here, there) << distanceM;
    }
}

TEST(Projection, TheFallbackHoldsAllGroundThatCanBeSeen) {
    View view;
    for (const double altitudeM : {5.0, 2e4, 3e7}) {
        const double topM = 6.38e6;
        view.eyeM = {topM + altitudeM, 0, 0};
        const Projection projection = fallbackProjection(view, 6.371e6, topM);
        EXPECT_FALSE(projection.reversedZ);
        EXPECT_LE(projection.nearM, std::max(altitudeM, 2.0));
        EXPECT_GE(projection.farM, 2 * topM + altitudeM);
    }
}

// So many values as a stretch holds, counted one by one.
TEST(Projection, ADepthStepIsTheWidthOfOneFloatOfDepth) {
    const Projection reversed = reversedProjection(View{}, 0.1);
    const Projection classic = classicProjection(View{}, 10, 1e7);
    for (const Projection& projection : {reversed, classic}) {
        for (const double distanceM : {150.0, 1234.0, 98765.0, 3e6}) {
            const double stepM = depthStepM(projection, distanceM);
            ASSERT_GT(stepM, 0);
            const int values = std::min(500, static_cast<int>(0.01 * distanceM / stepM));
            if (values < 20) continue;
            const auto depthAt = [&](double atM) {
                const double depth = projected(projection, {0, 0, -atM}).z;
                return static_cast<float>(projection.reversedZ ? depth : depth / 2 + 0.5);
            };
            int changes = 0;
            for (int i = 0; i < 8 * values; ++i) {
                const double atM = distanceM + i * stepM / 8;
                changes += depthAt(atM) != depthAt(atM + stepM / 8) ? 1 : 0;
            }
            EXPECT_NEAR(changes, values, 0.02 * values + 1) << distanceM;
        }
    }
    // Of a 24-bit mantissa, whose last bit is worth 2^-24 to 2^-23 of the number.
    for (const double distanceM : {1.0, 1e3, 1e6, 1e8}) {
        EXPECT_GT(depthStepM(reversed, distanceM), 0.99 * distanceM / (1 << 24));
        EXPECT_LT(depthStepM(reversed, distanceM), 1.01 * distanceM / (1 << 23));
    }
    EXPECT_NEAR(depthStepM(classic, 1e6), 1e6 * 1e6 / 10 / (1 << 24), 0.01 * 1e6 * 1e6 / 10 / (1 << 24));
    EXPECT_EQ(depthStepM(classic, 1e7), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace planet::gl
