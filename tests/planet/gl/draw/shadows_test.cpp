#include <gtest/gtest.h>

#include <cmath>

#include "planet/select/shadow_cascades.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {

namespace {

// A wall along the meridian of Greenwich, so wide on each side.
constexpr double wallHeightM = 20000;
constexpr double wallHalfWidthRad = 0.004;

double wallAt(double longitudeRad) {
    return wallHeightM * std::max(0.0, 1 - std::abs(longitudeRad) / wallHalfWidthRad);
}

double wall(const glm::dvec3& d) {
    return 9000 + wallAt(std::atan2(d.y, d.x));
}

class ShadowsTest : public GlTest {
protected:
    ShadowsTest() {
        settings_.atmosphere = false;
        settings_.detail = FeatureUse::Off;
        settings_.surface = SurfaceColour::HeightRamp;
        settings_.light.shadows.use = FeatureUse::On;
        settings_.light.shadows.reachM = 6e5;
        settings_.light.shadows.softness = 0;
    }

    // Of a face's middle, to some 12 degrees from Greenwich.
    static void addMiddle(TestPlanet& planet, const HeightFunction& height) {
        for (std::uint32_t y = 14; y < 18; ++y) {
            for (std::uint32_t x = 11; x < 21; ++x) planet.add({Face::PosX, 5, x, y}, height);
        }
    }

    // The sun over the equator, so high in the east as seen from Greenwich.
    void setSun(double heightDeg) {
        settings_.sunDirection = directionFromGeographic({0, glm::radians(90 - heightDeg)});
    }

    RenderSettings settings_;
};

// How far west of a wall on a sphere its shadow ends.
double shadowEndRad(double heightDeg) {
    const double rise = std::tan(glm::radians(heightDeg));
    double low = 0;
    double high = 0.1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const double topM = (earthRadiusM + 9000) * (std::cos(middle) + std::sin(middle) * rise);
        (topM < earthRadiusM + 9000 + wallHeightM ? low : high) = middle;
    }
    return low;
}

TEST_F(ShadowsTest, AWallsShadowIsAsLongAsItMustBe) {
    TestPlanet planet({}, 64);
    addMiddle(planet, wall);
    const View view = viewFrom(planet.shape(), 0, -1, 500e3, -90, 0, 600, 60);
    const double scale = screenScalePx(view);
    const auto columnOf = [&](double longitudeRad) {
        const double turn = longitudeRad + glm::radians(1.0);
        const double groundM = earthRadiusM + 9000;
        return 300 + scale * groundM * std::sin(turn) / (earthRadiusM + 500e3 - groundM * std::cos(turn));
    };
    for (const double heightDeg : {12.0, 20.0, 30.0}) {
        setSun(heightDeg);
        settings_.light.shadows.use = FeatureUse::Off;
        const Picture lit = drawPicture(planet.renderer(), view, planet.items(), settings_);
        settings_.light.shadows.use = FeatureUse::On;
        const Picture shaded = drawPicture(planet.renderer(), view, planet.items(), settings_);
        int end = 0;
        while (end < 600 && shaded.brightness(end, 30) > 0.6 * lit.brightness(end, 30)) ++end;
        // What keeps ground from shading itself is some texels high, and so much shorter the shadow is.
        const ShadowDrawing& shadows = settings_.light.shadows;
        const double texelM =
            shadowCascades(view, settings_.sunDirection, 460e3, shadows.reachM, shadows.mapSizePx)[2].texelM;
        const double shorterPx = 2.5 * texelM / std::tan(glm::radians(heightDeg)) * scale / 491e3;
        const double expected = columnOf(-shadowEndRad(heightDeg));
        EXPECT_GT(end, expected - 2) << heightDeg;
        EXPECT_LT(end, expected + 2 + shorterPx) << heightDeg;
        EXPECT_LT(shorterPx, 0.15 * (columnOf(0) - expected)) << heightDeg;
        // From there to the wall's foot all is dark, and east of the wall nothing is.
        for (int x = end + 3; x < static_cast<int>(columnOf(-2 * wallHalfWidthRad)); ++x)
            EXPECT_LT(shaded.brightness(x, 30), 0.6 * lit.brightness(x, 30)) << x;
        for (int x = static_cast<int>(columnOf(wallHalfWidthRad)) + 2; x < 600; ++x)
            EXPECT_GE(shaded.brightness(x, 30), lit.brightness(x, 30) - 6) << x;
    }
}

TEST_F(ShadowsTest, ChunksBesideTheViewThrowThemToo) {
    TestPlanet planet({}, 64);
    // All of the wall stands on chunks that begin at Greenwich.
    addMiddle(planet, [](const glm::dvec3& d) { return 9000 + wallAt(std::atan2(d.y, d.x) - 0.006); });
    setSun(12);
    const View view = viewFrom(planet.shape(), 0, -0.3, 50e3, -90, 0, 120, 60);
    const auto isWall = [](const DrawItem& item) { return item.id.x == 16; };
    std::vector<DrawItem> seen = planet.items();
    std::vector<DrawItem> beside;
    std::copy_if(seen.begin(), seen.end(), std::back_inserter(beside), isWall);
    std::erase_if(seen, isWall);
    const auto rgbWith = [&](std::span<const DrawItem> casters) {
        const RenderTarget target = valueOf(RenderTarget::create(view.widthPx, view.heightPx));
        target.bind();
        planet.renderer().draw(view, seen, settings_, {}, casters);
        return target.readRgb();
    };
    const std::vector<std::uint8_t> lit = rgbWith({});
    const std::vector<std::uint8_t> shaded = rgbWith(beside);
    int dark = 0;
    for (std::size_t i = 1; i < lit.size(); i += 3) dark += shaded[i] < 0.7 * lit[i];
    EXPECT_GT(dark, 120 * 60 / 4);
    EXPECT_LT(dark, 120 * 60);
}

// Slopes of 6 degrees at most under a sun of 25: there is no shadow to be seen, nor one of the maps' grain.
TEST_F(ShadowsTest, GentleHillsDoNotShadeThemselves) {
    TestPlanet planet({}, 64);
    addMiddle(planet,
              [](const glm::dvec3& d) { return 9000 + 700 * std::sin(400 * d.y) * std::sin(430 * d.z); });
    setSun(25);
    for (const double pitchDeg : {-90.0, -50.0, -20.0}) {
        const View view = viewFrom(planet.shape(), 0, 0, 150e3, pitchDeg, 40, 300, 200);
        settings_.light.shadows.use = FeatureUse::On;
        const Picture with = drawPicture(planet.renderer(), view, planet.items(), settings_);
        settings_.light.shadows.use = FeatureUse::Off;
        const Picture without = drawPicture(planet.renderer(), view, planet.items(), settings_);
        int different = 0;
        for (std::size_t i = 0; i < with.rgb.size(); ++i)
            different += std::abs(with.rgb[i] - without.rgb[i]) > 3;
        EXPECT_EQ(different, 0) << pitchDeg;
    }
}

TEST_F(ShadowsTest, TheirMapsAreCountedAndGoWhenTheyAreOff) {
    TestPlanet planet({}, 64);
    addMiddle(planet, wall);
    settings_.light.shadows.mapSizePx = 512;
    const View view = viewFrom(planet.shape(), 0, 0, 150e3);
    drawPicture(planet.renderer(), view, planet.items(), settings_);
    EXPECT_EQ(planet.renderer().gpuMemory().shadowMaps, 3u * 512 * 512 * 4);
    EXPECT_TRUE(planet.renderer().drawsShadows(settings_));
    settings_.light.shadows.use = FeatureUse::Off;
    drawPicture(planet.renderer(), view, planet.items(), settings_);
    EXPECT_EQ(planet.renderer().gpuMemory().shadowMaps, 0u);
    EXPECT_FALSE(planet.renderer().drawsShadows(settings_));
}

}  // namespace

}  // namespace planet::gl
