// Stars in pictures, against where geometry puts them.
#include "planet/gl/draw/sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "planet/surface/star_field.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

constexpr int widthPx = 640;
constexpr int heightPx = 480;

// Returns where a picture shows a direction, pixels; nothing if it is outside or within 4 pixels of the border.
std::optional<glm::dvec2> placeOf(const View& view, const glm::dvec3& direction) {
    const double ahead = -glm::dot(direction, view.back);
    if (ahead <= 0) return std::nullopt;
    const double scale = screenScalePx(view) / ahead;
    const glm::dvec2 place(widthPx / 2.0 + scale * glm::dot(direction, view.right),
                           heightPx / 2.0 - scale * glm::dot(direction, view.up));
    const bool isInside = place.x > 4 && place.x < widthPx - 4 && place.y > 4 && place.y < heightPx - 4;
    return isInside ? std::optional(place) : std::nullopt;
}

// Returns the brightest pixel among those that the place touches.
int brightestNear(const Picture& picture, const glm::dvec2& place) {
    int most = 0;
    for (int i = 0; i < 4; ++i) {
        const int x = static_cast<int>(std::lround(place.x)) - (i & 1);
        const int y = static_cast<int>(std::lround(place.y)) - (i >> 1);
        most = std::max(most, picture.brightness(x, y));
    }
    return most;
}

class Stars : public GlTest {
protected:
    TestPlanet planet_{{}, 384};
    const StarField field_ = makeStarField();
    const View up_ = viewFrom({}, 0, 0, 300'000, 70, 30, widthPx, heightPx);
};

TEST_F(Stars, AreWhereTheirDirectionsAreAndNowhereElse) {
    RenderSettings settings;
    settings.atmosphere = false;
    for (const double pitchDeg : {70.0, 20.0}) {
        const View view = viewFrom({}, 0, 0, 300'000, pitchDeg, 30, widthPx, heightPx);
        const Picture picture = drawPicture(planet_.renderer(), view, {}, settings);
        std::vector<bool> isNearStar(std::size_t{widthPx} * heightPx);
        int bright = 0;
        for (const Star& star : field_.stars) {
            const std::optional<glm::dvec2> place = placeOf(view, star.direction);
            if (!place) continue;
            for (int y = -4; y <= 3; ++y) {
                for (int x = -4; x <= 3; ++x)
                    isNearStar[static_cast<std::size_t>(std::lround(place->y) + y) * widthPx +
                               static_cast<std::size_t>(std::lround(place->x) + x)] = true;
            }
            EXPECT_GT(brightestNear(picture, *place), 3 * 8);
            if (star.light < 0.3F) continue;
            EXPECT_GT(brightestNear(picture, *place), 3 * 60);
            ++bright;
        }
        EXPECT_GT(bright, 20);
        for (int y = 8; y < heightPx - 8; ++y) {
            for (int x = 8; x < widthPx - 8; ++x) {
                const bool isNear =
                    isNearStar[static_cast<std::size_t>(y) * widthPx + static_cast<std::size_t>(x)];
                ASSERT_TRUE(isNear || picture.brightness(x, y) == 0) << x << " " << y;
            }
        }
    }
}

TEST_F(Stars, AreNotSeenThroughABrightSkyOrThePlanet) {
    RenderSettings settings;
    settings.sunDirection = {1, 0, 0};
    settings.light.air.use = FeatureUse::On;
    const View day = viewFrom({}, 0, 0, 2000, 40, 0, widthPx, heightPx);
    const Picture sky = drawPicture(planet_.renderer(), day, {}, settings);
    for (int y = 1; y < heightPx; ++y) {
        for (int x = 1; x < widthPx; ++x)
            ASSERT_LE(std::abs(sky.brightness(x, y) - sky.brightness(x - 1, y)), 6) << x << " " << y;
    }
    settings.atmosphere = false;
    const View down = viewFrom({}, 0, 0, 300'000, -90, 0, widthPx, heightPx);
    const Picture planet = drawPicture(planet_.renderer(), down, {}, settings);
    int most = 0;
    for (int i = 0; i < widthPx * heightPx; ++i)
        most = std::max(most, planet.brightness(i % widthPx, i / widthPx));
    EXPECT_EQ(most, 0);
}

TEST_F(Stars, DoNotBrightenASmallPicture) {
    RenderSettings settings;
    settings.atmosphere = false;
    const auto mean = [&](int side) {
        const View view = viewFrom({}, 0, 0, 300'000, 70, 30, side, side);
        const Picture picture = drawPicture(planet_.renderer(), view, {}, settings);
        double sum = 0;
        for (int i = 0; i < side * side; ++i) sum += picture.brightness(i % side, i / side);
        return sum / (side * side);
    };
    const double large = mean(800);
    EXPECT_GT(large, 0.3);
    EXPECT_LT(mean(80), 3 * large);
    EXPECT_LT(mean(20), 3 * large);
}

TEST_F(Stars, DoNotChangeTheStateOfTheContext) {
    RenderSettings settings;
    drawPicture(planet_.renderer(), up_, {}, settings);
    EXPECT_FALSE(glIsEnabled(GL_BLEND));
    EXPECT_FALSE(glIsEnabled(GL_PROGRAM_POINT_SIZE));
    GLint source = 0;
    GLint destination = 0;
    glGetIntegerv(GL_BLEND_SRC_RGB, &source);
    glGetIntegerv(GL_BLEND_DST_RGB, &destination);
    EXPECT_EQ(source, GL_ONE);
    EXPECT_EQ(destination, GL_ZERO);
}

}  // namespace
}  // namespace planet::gl
