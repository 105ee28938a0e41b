#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planet/gl/draw/sea_uniforms.h"
#include "tests/planet/gl/raw_light.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {

namespace {

class SeaTest : public GlTest {
protected:
    SeaTest() {
        settings_.atmosphere = false;
        settings_.detail = FeatureUse::Off;
        settings_.surface = SurfaceColour::HeightRamp;
        settings_.light.sea.use = FeatureUse::On;
        settings_.light.sea.waves = 0;
    }

    // A planet that lies so deep all over.
    static void addDepth(TestPlanet& planet, double depthM) {
        planet.addLevel(1, [=](const glm::dvec3&) { return -depthM; });
    }

    static ChunkRenderer rawRenderer(const PlanetShape& shape, const RawLightShaders& shaders) {
        return valueOf(ChunkRenderer::create({shape, 64, shaders.folder()}));
    }

    RenderSettings settings_;
};

TEST_F(SeaTest, LiesAtItsLevelWhateverTheBedDoes) {
    TestPlanet planet({}, 24);
    addDepth(planet, 4000);
    const View view = viewFrom({}, 0, 0, 20000, -90, 0, 65, 65);
    const auto middleM = [&] {
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), settings_);
        return viewDistanceM(planet.renderer().projection(), static_cast<double>(picture.depthAt(32, 32)));
    };
    // Chunks so coarse sag between their vertices.
    settings_.light.sea.use = FeatureUse::Off;
    const double bedM = middleM();
    settings_.light.sea.use = FeatureUse::On;
    EXPECT_NEAR(bedM - middleM(), 4000, 1);
    settings_.seaLevelM = -1500;
    EXPECT_NEAR(bedM - middleM(), 2500, 1);
    settings_.seaLevelM = -5000;
    EXPECT_NEAR(bedM - middleM(), 0, 1);
    settings_.seaLevelM = 0;
    settings_.sea = false;
    EXPECT_NEAR(bedM - middleM(), 0, 1);
}

TEST_F(SeaTest, aMultisampledHorizonHasNoDarkPixels) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, [](const glm::dvec3&) { return -3000; });
    settings_.atmosphere = true;
    settings_.light.air.use = FeatureUse::On;
    settings_.sunDirection = directionFromGeographic({0.5, 0.3});
    int dark = 0;
    for (int headingDeg = 0; headingDeg < 360; headingDeg += 45) {
        const View view = viewFrom({}, 36.5, -5.2, 3000, -2, headingDeg, 640, 96);
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), settings_, 4);
        for (int x = 0; x < picture.width; ++x) {
            for (int y = 1; y + 1 < picture.height; ++y) {
                const int beside = std::min(picture.brightness(x, y - 1), picture.brightness(x, y + 1));
                dark += picture.brightness(x, y) < beside - 15;
            }
        }
    }
    EXPECT_EQ(dark, 0);
}

// The detail between samples lowers ground in places, in colour alone: what the image shows as water there
// has no depth.
TEST_F(SeaTest, waterAboveTheSeaLevelKeepsTheImagesColour) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, [](const glm::dvec3&) { return 4; });
    std::vector<std::uint8_t> water;
    for (int i = 0; i < 64 * 32; ++i) water.insert(water.end(), {10, 40, 80});
    ASSERT_TRUE(planet.renderer().setColourImage(water, 64, 32));
    settings_.surface = SurfaceColour::Image;
    settings_.detail = FeatureUse::On;
    const View view = viewFrom({}, 10, 10, 3000, -20, 0, 96, 64);
    const Picture with = drawPicture(planet.renderer(), view, planet.items(), settings_);
    settings_.light.sea.use = FeatureUse::Off;
    const Picture without = drawPicture(planet.renderer(), view, planet.items(), settings_);
    int different = 0;
    for (int y = 0; y < with.height; ++y) {
        for (int x = 0; x < with.width; ++x) different += !areNear(with.at(x, y), without.at(x, y));
    }
    EXPECT_EQ(different, 0);
}

class SeaOfAnImage : public SeaTest {
protected:
    SeaOfAnImage() : planet_({}, 24) { settings_.surface = SurfaceColour::Image; }

    // The middle of level ground of one height and one colour, from above.
    glm::ivec3 colourOf(const glm::ivec3& image, double heightM) {
        std::vector<std::uint8_t> rgb;
        for (int i = 0; i < 64 * 32; ++i) {
            for (int channel = 0; channel < 3; ++channel)
                rgb.push_back(static_cast<std::uint8_t>(image[channel]));
        }
        EXPECT_TRUE(planet_.renderer().setColourImage(rgb, 64, 32));
        planet_.items().clear();
        const View view = viewFrom({}, 15, 15, 1e5, -90, 0, 17, 17);
        settings_.sunDirection = directionFromGeographic({0.9, 0.26});
        planet_.add(chunkAt(facePointFromDirection(view.eyeM), 1),
                    [=](const glm::dvec3&) { return heightM; });
        return drawPicture(planet_.renderer(), view, planet_.items(), settings_).at(8, 8);
    }

    TestPlanet planet_;
};

constexpr glm::ivec3 darkWater{1, 5, 12};
constexpr glm::ivec3 blueWater{10, 40, 80};

TEST_F(SeaOfAnImage, landBelowTheSeaLevelStaysDry) {
    for (const double depthM : {50.0, 200.0, 400.0, 700.0})
        EXPECT_TRUE(areNear(colourOf({150, 140, 100}, -depthM), colourOf({150, 140, 100}, 100), 2)) << depthM;
}

TEST_F(SeaOfAnImage, shallowsKeepTheImagesColour) {
    for (const double depthM : {0.5, 2.0, 5.0}) {
        EXPECT_TRUE(areNear(colourOf(darkWater, -depthM), colourOf(darkWater, 4), 12)) << depthM;
        EXPECT_TRUE(areNear(colourOf(blueWater, -depthM), colourOf(blueWater, 4), 12)) << depthM;
    }
}

TEST_F(SeaOfAnImage, nearlyBlackWaterIsSeaAtAnyDepth) {
    for (const double depthM : {100.0, 400.0, 6000.0})
        EXPECT_TRUE(areNear(colourOf(darkWater, -depthM), colourOf(blueWater, -depthM), 2)) << depthM;
}

TEST_F(SeaOfAnImage, aRisenSeaCoversDryLand) {
    settings_.seaLevelM = 1000;
    const glm::ivec3 flooded = colourOf({150, 140, 100}, 500);
    EXPECT_GT(flooded.z, flooded.x + 20);
}

TEST_F(SeaTest, WhatIsMeasuredIsTheBed) {
    TestPlanet planet({}, 24);
    addDepth(planet, 4000);
    const View view = viewFrom({}, 0, 0, 20000);
    const RenderTarget target = valueOf(RenderTarget::create(8, 8));
    target.bind();
    const std::vector<glm::vec3> positions =
        valueOf(planet.renderer().readVertexPositions(view, planet.items(), settings_));
    for (std::size_t i = 0; i < positions.size(); i += 97)
        EXPECT_NEAR(glm::length(glm::dvec3(positions[i]) + view.eyeM), earthRadiusM - 4000, 2);
}

// Straight down, no air, the sun too far aside for a glint: what comes out is the water's own, less the share
// that the surface mirrors.
TEST_F(SeaTest, ItsColourIsThatOfSoMuchWaterOverTheBed) {
    const RawLightShaders shaders;
    settings_.light.sea.clarityM = 15;
    settings_.light.sea.windMps = 0;
    settings_.sunDirection = directionFromGeographic({0, glm::radians(50.0)});
    const glm::dvec3 extinction = waterExtinction(15);
    const glm::dvec3 bed(0.30, 0.27, 0.19);
    const glm::dvec3 deep(0.0022, 0.014, 0.040);
    const glm::dvec3 sun(3.4, 3.3, 3.15);
    for (const double depthM : {3.0, 12.0, 60.0, 3000.0}) {
        TestPlanet made({}, 24);
        addDepth(made, depthM);
        ChunkRenderer renderer = rawRenderer({}, shaders);
        for (const DrawItem& item : made.items())
            renderer.upload(item.slot, chunkSteps({}, item.id, [=](const glm::dvec3&) { return -depthM; }));
        const View view = viewFrom({}, 0, 0, 2000, -90, 0, 9, 9);
        const glm::vec3 seen = drawLight(renderer, view, made.items(), settings_).at(4, 4);
        const glm::dvec3 sky = sun * 0.55 * glm::dvec3(0.0125, 0.013, 0.0145);
        const glm::dvec3 down = sun * std::cos(glm::radians(50.0)) + sky;
        for (int channel = 0; channel < 3; ++channel) {
            const double kept = std::exp(-2 * extinction[channel] * depthM);
            const double expected =
                0.98 * down[channel] * (deep[channel] + kept * (bed[channel] - deep[channel]));
            EXPECT_NEAR(static_cast<double>(seen[channel]), expected, 0.02 * expected)
                << depthM << ' ' << channel;
        }
    }
}

// Brightest where a mirror would show the sun, and as bright as the slopes' distribution says.
TEST_F(SeaTest, TheGlintStandsWhereAMirrorShowsTheSun) {
    const RawLightShaders shaders;
    TestPlanet made({}, 96);
    made.addLevel(2, [](const glm::dvec3&) { return -3000.0; });
    ChunkRenderer renderer = valueOf(ChunkRenderer::create({{}, 96, shaders.folder()}));
    for (const DrawItem& item : made.items())
        renderer.upload(item.slot, chunkSteps({}, item.id, [](const glm::dvec3&) { return -3000.0; }));
    // Eye over longitude 0, sun over 60: near the ground the mirror lies in between at the angle of both.
    settings_.sunDirection = directionFromGeographic({0, glm::radians(30.0)});
    settings_.light.sea.windMps = 2;
    const double altitudeM = 20000;
    const View view = viewFrom({}, 0, 0, altitudeM, -90, 0, 301, 301);
    const LightPicture picture = drawLight(renderer, view, made.items(), settings_);
    int bestX = 0;
    int bestY = 0;
    for (int y = 0; y < 301; ++y) {
        for (int x = 0; x < 301; ++x) {
            if (picture.at(x, y).g > picture.at(bestX, bestY).g) bestX = x, bestY = y;
        }
    }
    // tan 30 of the view's half width, tan 30, is just its edge on flat ground; the sphere's turn is small
    // here.
    const double variance = seaSlopeVariance(2);
    EXPECT_NEAR(bestY, 150, 3);
    EXPECT_GT(bestX, 270);
    const glm::dvec3 toEye = glm::normalize(glm::dvec3(1, -std::tan(glm::radians(28.0)), 0));
    const int column =
        150 + static_cast<int>(std::lround(screenScalePx(view) * std::tan(glm::radians(28.0))));
    const glm::dvec3 middle = glm::normalize(toEye + glm::normalize(settings_.sunDirection));
    const double slope2 = 1 / (middle.x * middle.x) - 1;
    const double aside = 1 - glm::dot(middle, toEye);
    const double expected = 3.3 * (0.02 + 0.98 * std::pow(aside, 5)) * std::exp(-slope2 / variance) /
                            variance / (4 * toEye.x * std::pow(middle.x, 4));
    EXPECT_NEAR(static_cast<double>(picture.at(column, 150).g), expected, 0.12 * expected);
}

TEST_F(SeaTest, LightIsFiniteWhereverItIsLookedAtFrom) {
    const RawLightShaders shaders;
    const auto hills = [](const glm::dvec3& d) {
        return 3000 * std::sin(7 * d.x) * std::sin(9 * d.y + d.z) - 500;
    };
    ChunkRenderer renderer = rawRenderer({}, shaders);
    TestPlanet made({}, 24);
    made.addLevel(1, hills);
    for (const DrawItem& item : made.items()) renderer.upload(item.slot, chunkSteps({}, item.id, hills));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    settings_.light.shadows.use = FeatureUse::On;
    settings_.light.shadows.mapSizePx = 256;
    for (int i = 0; i < 24; ++i) {
        settings_.atmosphere = i % 2 == 0;
        settings_.detail = i % 3 == 0 ? FeatureUse::On : FeatureUse::Off;
        settings_.light.sea.waves = 2 * unit(random);
        settings_.light.sea.windMps = i % 4 == 0 ? 0 : 30 * unit(random);
        settings_.light.sea.clarityM = i % 5 == 0 ? 0.5 : 100 * unit(random);
        settings_.seaLevelM = 2000 * (unit(random) - 0.5);
        settings_.sunDirection = glm::dvec3(unit(random), unit(random), unit(random)) - 0.5;
        const double altitudeM = std::exp(std::log(1.0) + unit(random) * std::log(6e7)) + 3000 * (i % 2);
        const View view = viewFrom({}, 180 * unit(random) - 90, 360 * unit(random), altitudeM,
                                   -90 * unit(random), 360 * unit(random), 48, 32);
        const LightPicture picture = drawLight(renderer, view, made.items(), settings_);
        for (const glm::vec3& light : picture.light) {
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_TRUE(std::isfinite(light[channel])) << i;
                ASSERT_GE(light[channel], 0) << i;
                ASSERT_LT(light[channel], 1e4) << i;
            }
        }
    }
}

}  // namespace

}  // namespace planet::gl
