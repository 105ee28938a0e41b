// What the surface settings do to the picture: ramp, sea level, opacity, outlines, the paint of skirts.
#include <gmock/gmock.h>

#include <map>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

constexpr std::array<glm::ivec3, 4> stopColours = {
    {{20, 30, 200}, {200, 60, 40}, {60, 190, 80}, {250, 250, 240}}};

glm::vec3 fromBytes(const glm::ivec3& bytes) {
    return glm::vec3(bytes) / 255.0f;
}

// Level ground of one height, seen from straight above.
class Surface : public GlTest {
protected:
    Surface() : planet_({}, 24) {
        settings_.lighting = false;
        settings_.atmosphere = false;
        settings_.surface = SurfaceColour::HeightRamp;
    }

    glm::ivec3 colourAtHeight(double height, std::span<const ChunkTint> tints = {}) {
        planet_.items().clear();
        const View view = viewFrom({}, 15, 15, 1e5, -90, 0, 17, 17);
        planet_.add(chunkAt(facePointFromDirection(view.eyeM), 1), [&](const glm::dvec3&) { return height; });
        return drawPicture(planet_.renderer(), view, planet_.items(), settings_, 1, tints).at(8, 8);
    }

    Picture drawn(const View& view) {
        return drawPicture(planet_.renderer(), view, planet_.items(), settings_);
    }

    void setGreyImage(std::uint8_t value) {
        const std::vector<std::uint8_t> rgb(16 * 8 * 3, value);
        ASSERT_TRUE(planet_.renderer().setColourImage(rgb, 16, 8));
    }

    TestPlanet planet_;
    RenderSettings settings_;
};

TEST_F(Surface, StopsOfTheRampAreExactlyTheirColours) {
    settings_.sea = false;
    for (std::size_t i = 0; i < 4; ++i) {
        const double height = std::array{-3000.0, 100.0, 900.0, 6000.0}[i];
        settings_.ramp.push_back({height, fromBytes(stopColours[i])});
    }
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_TRUE(areNear(colourAtHeight(settings_.ramp[i].heightM), stopColours[i])) << i;
    EXPECT_TRUE(areNear(colourAtHeight(-9000), stopColours[0])) << "below the first";
    EXPECT_TRUE(areNear(colourAtHeight(9000), stopColours[3])) << "above the last";
    const glm::ivec3 between = colourAtHeight(500);
    EXPECT_TRUE(areNear(between, (stopColours[1] + stopColours[2]) / 2, 6));
}

TEST_F(Surface, TwoStopsAtOneHeightAreASharpStep) {
    settings_.sea = false;
    settings_.ramp = {{0, fromBytes(stopColours[0])},
                      {500, fromBytes(stopColours[0])},
                      {500, fromBytes(stopColours[1])},
                      {900, fromBytes(stopColours[1])}};
    EXPECT_TRUE(areNear(colourAtHeight(499), stopColours[0]));
    EXPECT_TRUE(areNear(colourAtHeight(501), stopColours[1]));
}

TEST_F(Surface, ARampMayHaveAsManyStopsAsThereIsRoomFor) {
    settings_.sea = false;
    for (std::size_t i = 0; i < maxRampStops; ++i)
        settings_.ramp.push_back({100.0 * static_cast<double>(i), fromBytes(stopColours[i % 4])});
    for (const std::size_t i : {0u, 1u, 17u, 30u, 31u})
        EXPECT_TRUE(areNear(colourAtHeight(100.0 * static_cast<double>(i)), stopColours[i % 4])) << i;
}

TEST_F(Surface, TheSeaKeepsItsColoursUnlessAStopLiesBelowIt) {
    const glm::ivec3 builtIn = colourAtHeight(-2000);
    settings_.ramp = {{0, fromBytes(stopColours[1])}, {3000, fromBytes(stopColours[3])}};
    EXPECT_TRUE(areNear(colourAtHeight(-2000), builtIn));
    settings_.ramp.insert(settings_.ramp.begin(), {-2000, fromBytes(stopColours[0])});
    EXPECT_TRUE(areNear(colourAtHeight(-2000), stopColours[0]));
}

TEST_F(Surface, HeightsOfTheRampAndDepthsAreCountedFromTheSeaLevel) {
    const auto isWater = [](const glm::ivec3& colour) { return colour.z > 2 * colour.x; };
    EXPECT_FALSE(isWater(colourAtHeight(800)));
    settings_.seaLevelM = 1000;
    const glm::ivec3 shallow = colourAtHeight(800);
    EXPECT_TRUE(isWater(shallow));
    EXPECT_FALSE(isWater(colourAtHeight(1200)));
    const glm::ivec3 atFiveKm = colourAtHeight(6000);
    settings_.seaLevelM = 0;
    EXPECT_EQ(colourAtHeight(-200), shallow);
    EXPECT_EQ(colourAtHeight(5000), atFiveKm);
    settings_.seaLevelM = -1000;
    EXPECT_FALSE(isWater(colourAtHeight(-500)));
    settings_.seaLevelM = 1000;
    settings_.sea = false;
    EXPECT_FALSE(isWater(colourAtHeight(800)));
}

TEST_F(Surface, ARisenSeaCoversTheImagesLand) {
    settings_.surface = SurfaceColour::Image;
    setGreyImage(150);
    const glm::ivec3 land = colourAtHeight(300);
    EXPECT_TRUE(areNear(colourAtHeight(-300), land)) << "low land that the image knows to be dry";
    settings_.seaLevelM = 1000;
    const glm::ivec3 flooded = colourAtHeight(300);
    EXPECT_GT(flooded.z, flooded.x + 20);
}

TEST_F(Surface, OpacityMixesTheImageOverTheRamp) {
    settings_.sea = false;
    settings_.ramp = {{0, fromBytes(stopColours[1])}};
    const glm::ivec3 ramp = colourAtHeight(1000);
    EXPECT_TRUE(areNear(ramp, stopColours[1]));
    setGreyImage(150);
    settings_.surface = SurfaceColour::Image;
    const glm::ivec3 image = colourAtHeight(1000);
    EXPECT_GT(image.y, 140);
    settings_.imageOpacity = 0;
    EXPECT_TRUE(areNear(colourAtHeight(1000), ramp));
    const auto linear = [](int value) { return std::pow(value / 255.0, 2.2); };
    for (const double opacity : {0.25, 0.5, 0.75}) {
        settings_.imageOpacity = opacity;
        const glm::ivec3 mixed = colourAtHeight(1000);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(linear(mixed[channel]),
                        opacity * linear(image[channel]) + (1 - opacity) * linear(ramp[channel]), 0.02);
        }
    }
}

TEST_F(Surface, OutlinesLieOnTheBordersOfChunksAndAreThinAtAnyDistance) {
    planet_.addLevel(1, flat);
    for (const double altitudeM : {3e5, 3e6}) {
        // Four chunks of face x_pos meet at latitude 0 and longitude 0, in the picture's middle.
        const View view = viewFrom({}, 0, 0, altitudeM, -90, 0, 201, 201);
        settings_.outlines = false;
        const Picture without = drawn(view);
        settings_.outlines = true;
        const Picture with = drawn(view);
        EXPECT_EQ(with.depth, without.depth);
        const auto brighter = [&](int x, int y) { return with.brightness(x, y) - without.brightness(x, y); };
        EXPECT_GT(brighter(100, 30), 150) << "a meridian";
        EXPECT_GT(brighter(170, 100), 150) << "the equator";
        EXPECT_EQ(brighter(60, 60), 0);
        for (const int y : {20, 60, 150}) {
            int wide = 0;
            for (int x = 80; x < 120; ++x) wide += brighter(x, y) > 30;
            EXPECT_GE(wide, 1);
            EXPECT_LE(wide, 3) << "y " << y << " from " << altitudeM;
        }
    }
}

// A chunk that lies far below its neighbours: above it, their skirts show.
class PaintedSkirts : public Surface {
protected:
    PaintedSkirts() {
        settings_.light.sea.use = FeatureUse::Off;  // a GPU would draw it, and it would cover the gap
        for (const Face face : allFaces) {
            for (std::uint32_t i = 0; i < 4; ++i) {
                const ChunkId id{face, 1, i % 2, i / 2};
                const bool lowered = id == ChunkId{Face::PosX, 1, 1, 1};
                planet_.add(
                    id, [&](const glm::dvec3&) { return lowered ? -32000.0 : 0.0; }, 50000);
            }
        }
    }
    int loudPixels() {
        const Picture picture = drawn(view_);
        int loud = 0;
        for (int i = 0; i < 300 * 300; ++i) loud += picture.at(i % 300, i / 300) == glm::ivec3(255, 0, 204);
        return loud;
    }
    std::uint64_t triangles() {
        drawn(view_);
        return planet_.renderer().counters().triangles();
    }
    View view_ = viewFrom({}, 20, 20, 8e5, -45, 30, 300, 300);
};

TEST_F(PaintedSkirts, LoudSkirtsShowWhereSkirtsFillAGap) {
    EXPECT_EQ(loudPixels(), 0);
    const Picture asGround = drawn(view_);
    settings_.skirtPaint = SkirtPaint::Loud;
    const int loud = loudPixels();
    EXPECT_GT(loud, 100);
    EXPECT_LT(loud, 300 * 300 / 4);
    EXPECT_EQ(drawn(view_).depth, asGround.depth);
    settings_.lighting = true;
    EXPECT_EQ(loudPixels(), loud);
}

TEST_F(PaintedSkirts, LoudAloneDrawsTheSkirtsAndNothingElse) {
    settings_.skirtPaint = SkirtPaint::LoudAlone;
    const Picture picture = drawn(view_);
    std::map<bool, int> grounds;
    for (int i = 0; i < 300 * 300; ++i)
        if (picture.isGround(i % 300, i / 300))
            ++grounds[picture.at(i % 300, i / 300) == glm::ivec3(255, 0, 204)];
    EXPECT_GT(grounds[true], 1000);
    EXPECT_EQ(grounds[false], 0);
    EXPECT_EQ(triangles(), 24u * 2 * 4 * 32);
    for (DrawItem& item : planet_.items()) item.skirtDepthM = 0;
    EXPECT_EQ(loudPixels(), 0);
    EXPECT_EQ(triangles(), 0u);
}

TEST_F(PaintedSkirts, AreDrawnForAllChunksOnlyWhereOneHasADepth) {
    const std::uint64_t ground = 24u * 2 * 32 * 32;
    EXPECT_EQ(triangles(), ground + 24u * 2 * 4 * 32);
    for (DrawItem& item : planet_.items()) item.skirtDepthM = 0;
    EXPECT_EQ(triangles(), ground);
    planet_.items()[5].skirtDepthM = 1;
    EXPECT_EQ(triangles(), ground + 24u * 2 * 4 * 32);
}

}  // namespace
}  // namespace planet::gl
