#include "planet/surface/star_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace planet {
namespace {

glm::dvec3 directionTo(const Star& star) {
    return glm::normalize(glm::dvec3(star.onCube));
}

// Whether the picture shows the star.
bool shows(const View& view, const Star& star) {
    const glm::dvec3 direction = directionTo(star);
    const double ahead = -glm::dot(direction, view.back);
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    return ahead > 0 && std::abs(glm::dot(direction, view.right)) < tanX * ahead &&
           std::abs(glm::dot(direction, view.up)) < tanY * ahead;
}

TEST(StarField, HasOneStarInSevenCellsOfEachFace) {
    const StarField field = makeStarField();
    constexpr double cells = 180.0 * 180;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float along : {-1.0F, 1.0F}) {
            int count = 0;
            for (const Star& star : field.stars) count += star.onCube[axis] == along;
            EXPECT_NEAR(count / cells, 0.14, 0.01) << axis << " " << along;
        }
    }
    for (const Star& star : field.stars) {
        EXPECT_GE(star.light, 0.02F);
        EXPECT_LE(star.light, 0.57F);
    }
}

TEST(StarField, TilesHoldTheStarsBetweenTheirCorners) {
    const StarField field = makeStarField();
    std::uint32_t next = 0;
    for (const StarTile& tile : field.tiles) {
        ASSERT_EQ(tile.first, next);
        next += tile.count;
        for (std::uint32_t i = tile.first; i < next; ++i)
            EXPECT_GE(glm::dot(directionTo(field.stars[i]), tile.middle), tile.reachCos);
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
