#include "planet/gl/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec4.hpp>

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

}  // namespace
}  // namespace planet::gl
