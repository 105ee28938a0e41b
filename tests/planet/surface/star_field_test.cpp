#include "planet/surface/star_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "planet/sphere/cube_sphere.h"

namespace planet {
namespace {

// Whether the picture shows the star.
bool shows(const View& view, const Star& star) {
    const glm::dvec3 direction = glm::dvec3(star.direction);
    const double ahead = -glm::dot(direction, view.back);
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    return ahead > 0 && std::abs(glm::dot(direction, view.right)) < tanX * ahead &&
           std::abs(glm::dot(direction, view.up)) < tanY * ahead;
}

TEST(StarField, HasOneStarInSevenCellsOfEachFace) {
    const StarField field = makeStarField();
    constexpr double cells = 180.0 * 180;
    for (const Face face : allFaces) {
        const auto isOnFace = [&](const Star& star) {
            return glm::dot(cubeFromSphere(star.direction), faceAxes(face).normal) > 1 - 1e-6;
        };
        const auto count = std::count_if(field.stars.begin(), field.stars.end(), isOnFace);
        EXPECT_NEAR(static_cast<double>(count) / cells, 0.14, 0.01) << faceName(face);
    }
    for (const Star& star : field.stars) {
        EXPECT_GE(star.light, 0.02F);
        EXPECT_LE(star.light, 0.57F);
    }
}

TEST(StarField, IsAsDenseAtTheCornersOfTheCubeAsInTheMiddleOfItsFaces) {
    const StarField field = makeStarField();
    const auto within15Deg = [&](const glm::dvec3& direction) {
        return std::count_if(field.stars.begin(), field.stars.end(), [&](const Star& star) {
            return glm::dot(glm::dvec3(star.direction), direction) > std::cos(glm::radians(15.0));
        });
    };
    const auto middle = static_cast<double>(within15Deg({1, 0, 0}));
    const auto corner = static_cast<double>(within15Deg(glm::normalize(glm::dvec3(1, 1, 1))));
    EXPECT_GT(corner / middle, 0.7);
    EXPECT_LT(corner / middle, 1.5);
}

TEST(StarField, TilesHoldTheStarsBetweenTheirCorners) {
    const StarField field = makeStarField();
    std::uint32_t next = 0;
    for (const StarTile& tile : field.tiles) {
        ASSERT_EQ(tile.first, next);
        next += tile.count;
        for (std::uint32_t i = tile.first; i < next; ++i)
            EXPECT_GE(glm::dot(glm::dvec3(field.stars[i].direction), tile.middle), tile.reachCos);
    }
    EXPECT_EQ(next, field.stars.size());
}

TEST(StarField, RangesHoldEachStarThatAViewShows) {
    const StarField field = makeStarField();
    for (int i = 0; i < 60; ++i) {
        const CameraPose pose{.latitudeDeg = 3.0 * i - 89,
                              .longitudeDeg = 47.0 * i,
                              .altitudeM = 1e6,
                              .headingDeg = 31.0 * i,
                              .pitchDeg = 2.9 * i - 85};
        const View view = viewFromPose(pose, 6.371e6, glm::radians(5.0 + 2.4 * i), 640, 480);
        const std::vector<StarRange> ranges = starsInView(field, view);
        std::vector<bool> drawn(field.stars.size());
        std::uint32_t end = 0;
        for (const StarRange& range : ranges) {
            ASSERT_GT(range.count, 0u);
            ASSERT_TRUE(end == 0 || range.first > end) << "touching ranges are joined";
            end = range.first + range.count;
            for (std::uint32_t star = range.first; star < end; ++star) drawn[star] = true;
        }
        for (std::size_t star = 0; star < drawn.size(); ++star)
            ASSERT_TRUE(drawn[star] || !shows(view, field.stars[star])) << i << " " << star;
    }
}

TEST(StarField, ANarrowViewDrawsFewStars) {
    const StarField field = makeStarField();
    const View view = viewFromPose({.pitchDeg = 20}, 6.371e6, glm::radians(20.0), 640, 480);
    std::uint32_t drawn = 0;
    for (const StarRange& range : starsInView(field, view)) drawn += range.count;
    EXPECT_GT(drawn, 0u);
    EXPECT_LT(drawn, field.stars.size() / 20);
}

}  // namespace
}  // namespace planet
