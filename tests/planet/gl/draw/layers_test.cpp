// Texture layers: the shader's weights against the library's, and what is seen of pictures laid over the
// ground.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planet/surface/layer_place.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"
#include "tests/support/layer_relief.h"

namespace planet::gl {
namespace {

constexpr int texelsASide = 64;  // texels a side

// Steep and gentle ground, from below the sea to some hundred metres.
double layeredHills(const glm::dvec3& d) {
    const double metres = 6.371e6;
    return 350 * std::sin(metres * d.y / 900) * std::cos(metres * d.z / 1300) +
           60 * std::sin(metres * (d.z + d.y) / 260) + 150;
}

PlanetShape fineShape() {
    PlanetShape shape;
    shape.faceCellsLog2 = 18;
    shape.quantumM = 0.05;
    return shape;
}

// Seen from the eye straight at a point, which the middle pixel shows.
View viewAt(const glm::dvec3& eyeM, const glm::dvec3& pointM) {
    View view;
    view.eyeM = eyeM;
    view.back = glm::normalize(eyeM - pointM);
    const glm::dvec3 aside = std::abs(view.back.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    view.right = glm::normalize(glm::cross(aside, view.back));
    view.up = glm::cross(view.back, view.right);
    view.widthPx = view.heightPx = 17;
    view.horizontalFovRad = 0.02;
    return view;
}

LayerPicture plainPicture(const std::array<std::uint8_t, 4>& rgba) {
    LayerPicture picture;
    for (int i = 0; i < texelsASide * texelsASide; ++i) {
        picture.albedo.insert(picture.albedo.end(), rgba.begin(), rgba.end());
        picture.surface.insert(picture.surface.end(), {128, 128, 230, 255});
    }
    return picture;
}

// Red and green say where in the repeat, as waves that meet themselves.
LayerPicture placePicture() {
    LayerPicture picture = plainPicture({0, 0, 40, 128});
    for (int i = 0; i < texelsASide * texelsASide; ++i) {
        const auto wave = [](int texel) {
            return static_cast<std::uint8_t>(
                std::lround(128 + 90 * std::sin(2 * std::numbers::pi * (texel + 0.5) / texelsASide)));
        };
        picture.albedo[static_cast<std::size_t>(4 * i)] = wave(i % texelsASide);
        picture.albedo[static_cast<std::size_t>(4 * i + 1)] = wave(i / texelsASide);
    }
    return picture;
}

class Layers : public GlTest {
protected:
    Layers() : planet_(fineShape(), 32) {
        settings_ = plainSettings();
        settings_.sea = false;
        settings_.ramp = {{0, {0.5f, 0.5f, 0.5f}}};
        settings_.layers.use = FeatureUse::On;
        settings_.layers.colourBelow = 0;
        settings_.layers.set.blend = LayerBlend::Weight;
        settings_.layers.set.layers = {TextureLayer{}};
        settings_.layers.pictures = {0};
    }

    void use(const LayerPicture& picture) {
        ASSERT_TRUE(planet_.renderer().setLayers(std::array{picture}, texelsASide));
    }

    // A chunk around a place, and where its ground is there.
    glm::dvec3 addGround(const glm::dvec3& direction, const HeightFunction& height, int level = 12) {
        const glm::dvec3 unit = glm::normalize(direction);
        const ChunkId id = chunkAt(facePointFromDirection(unit), level);
        planet_.items().clear();
        planet_.add(id, height);
        return (6.371e6 + height(unit)) * unit;
    }

    glm::ivec3 colourAt(const glm::dvec3& eyeM, const glm::dvec3& pointM) {
        return drawPicture(planet_.renderer(), viewAt(eyeM, pointM), planet_.items(), settings_).at(8, 8);
    }

    TestPlanet planet_;
    RenderSettings settings_;
};

LayerSet randomSet(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    LayerSet set;
    for (std::size_t i = 0; i < maxLayers; ++i) {
        TextureLayer layer;
        const double height = -300 + 800 * share(random), slope = 40 * share(random);
        layer.heightM = {height, height + 400 * share(random), 50 + 300 * share(random)};
        layer.slopeDeg = {slope, slope + 40 * share(random), 10 + 20 * share(random)};
        layer.latitudeDeg = {30 * share(random), 40 + 10 * share(random), 5 + 20 * share(random)};
        layer.opacity = 0.4 + 0.6 * share(random);
        layer.noiseAmount = i % 3 == 0 ? 0 : 1.5 * share(random);
        layer.noiseSizeM = i % 2 == 0 ? 150 : 60 + 500 * share(random);
        layer.muted = i == 5;
        set.layers.push_back(layer);
    }
    return set;
}

TEST_F(Layers, WeightsAreThoseOfTheReferenceAtRandomPoints) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0, 1);
    settings_.layers.preview = LayerPreview::Mask;
    int between = 0;
    for (int place = 0; place < 12; ++place) {
        const glm::dvec3 middle(0.8 + 0.4 * share(random), 1.2 * share(random) - 0.6,
                                0.2 + 0.7 * share(random));
        const ChunkId id = chunkAt(facePointFromDirection(middle), 12);
        const std::vector<std::int16_t> steps = chunkSteps(fineShape(), id, layeredHills);
        planet_.items().clear();
        planet_.add(id, layeredHills);
        settings_.layers.set = randomSet(random);
        const FaceSquare square = faceSquareOf(id);
        for (int point = 0; point < 25; ++point) {
            const glm::dvec3 d =
                sphereFromCube(cubePoint(id.face, square.u + square.side * (0.05 + 0.9 * share(random)),
                                         square.v + square.side * (0.05 + 0.9 * share(random))));
            const double groundM = 6.371e6 + layerPlace(fineShape(), id, steps, d, 0, 1).heightM;
            const glm::dvec3 pointM = groundM * d;
            const glm::dvec3 eyeM =
                pointM + 300.0 * d + 60.0 * glm::dvec3(share(random), share(random), share(random));
            const LayerPlace reference = layerPlace(fineShape(), id, steps, pointM, 0, 1);
            const LayerValues weights = layerWeights(settings_.layers.set, reference);
            // Any layer, or the one that has most.
            auto layer = static_cast<std::size_t>(maxLayers * share(random));
            if (point % 2 == 0)
                layer = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) -
                                                 weights.begin());
            settings_.layers.previewed = static_cast<int>(layer);
            const double weight = weights[layer];
            const glm::ivec3 drawn = colourAt(eyeM, pointM);
            EXPECT_NEAR(drawn.x, 255 * weight, 2.0) << reference.heightM << " m, " << reference.slopeDeg
                                                    << " deg, layer " << settings_.layers.previewed;
            EXPECT_EQ(drawn.x, drawn.y);
            if (weight > 0.02 && weight < 0.98) ++between;
        }
    }
    EXPECT_GT(between, 60) << "the points hardly tell anything";
}

TEST_F(Layers, ExaggeratedAndBoostedReliefIsWeighedAsItTrulyIs) {
    PlanetShape tall = fineShape();
    tall.quantumM *= 3;
    TestPlanet exaggerated(tall, 4);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1, 0.21, 0.33));
    const ChunkId id = chunkAt(facePointFromDirection(direction), 12);
    const HeightFunction threefold = [](const glm::dvec3& d) { return 3 * layeredHills(d); };
    exaggerated.add(id, threefold);
    const std::vector<std::int16_t> steps = chunkSteps(tall, id, threefold);
    const LayerPlace place = layerPlace(tall, id, steps, direction, 0, 3);
    EXPECT_NEAR(place.heightM, layeredHills(direction), 1.0);
    ASSERT_GT(place.slopeDeg, 5);
    settings_.layers.preview = LayerPreview::Mask;
    settings_.exaggeration = 3;
    TextureLayer& layer = settings_.layers.set.layers[0];
    layer.slopeDeg = {place.slopeDeg, 90, 8};
    const glm::dvec3 pointM = (6.371e6 + 3 * place.heightM) * direction;
    // From 40 km slopes are lit twice as steep and more.
    for (const double aboveM : {400.0, 40000.0}) {
        const View view = viewAt(pointM + aboveM * direction, pointM);
        const Picture picture = drawPicture(exaggerated.renderer(), view, exaggerated.items(), settings_);
        EXPECT_NEAR(picture.at(8, 8).x, 127.5, aboveM < 1000 ? 3 : 10) << aboveM;
    }
}

TEST_F(Layers, LieFixedOnTheGroundAtTheEarthsRadius) {
    use(placePicture());
    TextureLayer& layer = settings_.layers.set.layers[0];
    layer.scaleM = 4;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> share(-1, 1);
    for (int i = 0; i < 60; ++i) {
        // Where the ground faces x, the texture lies along y and z.
        const glm::dvec3 pointM = addGround({1, 1e-3 * share(random), 1e-3 * share(random)}, flat, 14);
        const glm::dvec3 eyeM = pointM + glm::dvec3(3 + share(random), share(random), share(random));
        const glm::ivec3 drawn = colourAt(eyeM, pointM);
        const auto expected = [&](double metres) {
            return 128 + 90 * std::sin(2 * std::numbers::pi * metres / layer.scaleM);
        };
        // A wrong millimetre is 0.14 steps.
        EXPECT_NEAR(drawn.x, expected(pointM.y), 3);
        EXPECT_NEAR(drawn.y, expected(pointM.z), 3);
        EXPECT_NEAR(drawn.z, 40, 1);
    }
}

TEST_F(Layers, MeetWithoutAStepAcrossTheCubesEdgesAndCorners) {
    use(placePicture());
    settings_.layers.set.layers[0].scaleM = 700;
    const std::array<glm::dvec3, 4> places = {{{1, 1, 0.1}, {1, -0.3, 1}, {-0.2, 1, -1}, {1, 1, 1}}};
    for (const glm::dvec3& place : places) {
        planet_.items().clear();
        const glm::dvec3 unit = glm::normalize(place);
        for (const double u : {-2e-4, 0.0, 2e-4}) {
            for (const double v : {-2e-4, 0.0, 2e-4}) {
                const ChunkId id = chunkAt(
                    facePointFromDirection(unit + u * glm::dvec3(1, -1, 0) + v * glm::dvec3(0.3, 0.3, -1)),
                    11);
                const auto same = [&](const DrawItem& item) { return item.id == id; };
                if (std::none_of(planet_.items().begin(), planet_.items().end(), same)) planet_.add(id, flat);
            }
        }
        ASSERT_GE(planet_.items().size(), 2u);
        View view = viewAt((6.371e6 + 1500) * unit, 6.371e6 * unit);
        view.widthPx = view.heightPx = 200;
        view.horizontalFovRad = 0.6;
        const Picture picture = drawPicture(planet_.renderer(), view, planet_.items(), settings_);
        int largest = 0;
        int least = 255, most = 0;
        for (int y = 0; y < 200; ++y) {
            for (int x = 0; x + 1 < 200; ++x) {
                const glm::ivec3 step = glm::abs(picture.at(x, y) - picture.at(x + 1, y));
                largest = std::max({largest, step.x, step.y, step.z});
                least = std::min(least, picture.at(x, y).x);
                most = std::max(most, picture.at(x, y).x);
            }
        }
        // 4.5 m a pixel are 3.6 steps of the wave; both scales' waves and three planes add up.
        EXPECT_LE(largest, 12) << place.x << ' ' << place.y << ' ' << place.z;
        EXPECT_GT(most - least, 60);
    }
}

TEST_F(Layers, WhatHasNoPictureIsALoudChecker) {
    const auto coloursSeen = [&] {
        const glm::dvec3 pointM = addGround({1, 0.01, 0.01}, flat);
        View view = viewAt(pointM + glm::dvec3(8, 0, 0), pointM);
        view.widthPx = view.heightPx = 100;
        view.horizontalFovRad = 1;
        const Picture picture = drawPicture(planet_.renderer(), view, planet_.items(), settings_);
        int magenta = 0, black = 0;
        for (int y = 0; y < 100; ++y) {
            for (int x = 0; x < 100; ++x) {
                const glm::ivec3 c = picture.at(x, y);
                magenta += c.x > 240 && c.y < 15 && c.z > 240 ? 1 : 0;
                black += c.x < 15 && c.y < 15 && c.z < 15 ? 1 : 0;
            }
        }
        return std::pair(magenta, black);
    };
    settings_.layers.set.layers[0].tint = {0, 1, 0};
    settings_.layers.pictures.clear();
    EXPECT_GT(coloursSeen().first, 2500) << "none was ever given";
    EXPECT_GT(coloursSeen().second, 2500);
    use(plainPicture({200, 100, 50, 128}));
    for (const int picture : {-1, 1, 1000}) {
        settings_.layers.pictures = {picture};
        EXPECT_GT(coloursSeen().first, 2500) << picture;
    }
    settings_.layers.pictures = {0};
    EXPECT_EQ(coloursSeen().first, 0);
    settings_.layers.set.layers[0].heightM = {500, 100, 0};
    EXPECT_GT(coloursSeen().first, 2500) << "a contradictory range";
}

TEST_F(Layers, FadeAwayFromTheEyeIntoWhatLiesBelow) {
    use(plainPicture({255, 255, 255, 128}));
    settings_.layers.beginM = 1000;
    settings_.layers.endM = 3000;
    const glm::dvec3 pointM = addGround({1, 0.01, 0.01}, flat, 9);
    const glm::dvec3 up = glm::normalize(pointM);
    const auto linear = [&](double awayM) {
        return std::pow(colourAt(pointM + awayM * up, pointM).y / 255.0, 2.2);
    };
    EXPECT_NEAR(linear(900), 1, 0.01);
    const double below = linear(3200);
    EXPECT_NEAR(below, std::pow(0.5, 2.2), 0.02);
    EXPECT_NEAR(linear(2000), (1 + below) / 2, 0.02);
    settings_.layers.opacity = 0.5;
    EXPECT_NEAR(linear(900), (1 + below) / 2, 0.02);
}

TEST_F(Layers, TheColourBelowGoesThrough) {
    use(plainPicture({180, 180, 180, 128}));
    settings_.ramp = {{0, {0.2f, 0.6f, 0.3f}}};
    settings_.layers.colourBelow = 1;
    const glm::dvec3 pointM = addGround({1, 0.01, 0.01}, flat, 12);
    const glm::ivec3 drawn = colourAt(pointM + 50.0 * glm::normalize(pointM), pointM);
    EXPECT_NEAR(drawn.x, 51, 2);
    EXPECT_NEAR(drawn.y, 153, 2);
    EXPECT_NEAR(drawn.z, 77, 2);
}

TEST_F(Layers, ABlendByHeightFollowsTheRelief) {
    const std::array<LayerPicture, 2> pictures = {plainPicture({255, 0, 0, 160}),
                                                  plainPicture({0, 0, 255, 90})};
    ASSERT_TRUE(planet_.renderer().setLayers(pictures, texelsASide));
    LayerSet& set = settings_.layers.set;
    set.layers = {TextureLayer{}, TextureLayer{}};
    set.layers[1].opacity = 0.5;
    settings_.layers.pictures = {0, 1};
    const glm::dvec3 pointM = addGround({1, 0.001, 0.001}, flat, 12);
    const auto redShare = [&] {
        return std::pow(colourAt(pointM + glm::dvec3(5, 0, 0), pointM).x / 255.0, 2.2);
    };
    EXPECT_NEAR(redShare(), 0.5, 0.02);
    set.blend = LayerBlend::Height;
    for (const double depth : {1.5, 0.6, 0.1}) {
        set.blendDepth = depth;
        const LayerValues shares =
            weightsByRelief(set, {0.5, 0.5, 0, 0, 0, 0, 0, 0}, {160 / 255.0, 90 / 255.0, 0, 0, 0, 0, 0, 0});
        EXPECT_NEAR(redShare(), shares[0], 0.02) << depth;
    }
}

TEST_F(Layers, AreLeftOffWhereTheyAreNotWanted) {
    use(plainPicture({255, 0, 0, 128}));
    const glm::dvec3 pointM = addGround({1, 0.01, 0.01}, flat, 12);
    const glm::dvec3 eyeM = pointM + 100.0 * glm::normalize(pointM);
    EXPECT_NEAR(colourAt(eyeM, pointM).y, 0, 1);
    settings_.layers.use = FeatureUse::Off;
    EXPECT_NEAR(colourAt(eyeM, pointM).y, 128, 1);
    settings_.layers.use = FeatureUse::Automatic;
    EXPECT_NEAR(colourAt(eyeM, pointM).y, planet_.renderer().capabilities().software ? 128 : 0, 1);
    settings_.layers.use = FeatureUse::On;
    settings_.sea = true;
    settings_.seaLevelM = 500;
    const glm::ivec3 sea = colourAt(eyeM, pointM);
    EXPECT_GT(sea.z, sea.x) << "open sea is not painted";
    settings_.cube = true;
    drawPicture(planet_.renderer(), viewFrom(fineShape(), 0, 0, 1e6), planet_.items(), settings_);
}

TEST_F(Layers, LakesThatTheImageShowsAreNotPainted) {
    use(plainPicture({255, 0, 0, 128}));
    settings_.surface = SurfaceColour::Image;
    settings_.sea = true;
    const glm::dvec3 pointM = addGround(
        {1, 0.01, 0.01}, [](const glm::dvec3&) { return 900.0; }, 12);
    const glm::dvec3 eyeM = pointM + 100.0 * glm::normalize(pointM);
    settings_.sunDirection = pointM;
    const auto setImage = [&](const std::array<std::uint8_t, 3>& rgb) {
        std::vector<std::uint8_t> image;
        for (int i = 0; i < 64 * 32; ++i) image.insert(image.end(), rgb.begin(), rgb.end());
        ASSERT_TRUE(planet_.renderer().setColourImage(image, 64, 32));
    };
    for (const bool lit : {false, true}) {
        settings_.lighting = lit;
        for (const std::array<std::uint8_t, 3>& water :
             {std::array<std::uint8_t, 3>{10, 40, 80}, {0, 3, 12}}) {
            setImage(water);
            const glm::ivec3 lake = colourAt(eyeM, pointM);
            EXPECT_GE(lake.z, lake.x) << lit << ' ' << int{water[2]};
            settings_.layers.use = FeatureUse::Off;
            EXPECT_TRUE(areNear(colourAt(eyeM, pointM), lake)) << lit << ' ' << int{water[2]};
            settings_.layers.use = FeatureUse::On;
        }
        setImage({120, 120, 90});
        const glm::ivec3 land = colourAt(eyeM, pointM);
        EXPECT_GT(land.x, land.z + 100) << lit;
    }
}

TEST_F(Layers, AreLitAndBentByTheirNormals) {
    LayerPicture bent = plainPicture({180, 180, 180, 128});
    for (std::size_t i = 0; i < bent.surface.size(); i += 4)
        bent.surface[i] = 190;  // towards +y where x is up
    settings_.lighting = true;
    settings_.detail = FeatureUse::Off;
    const glm::dvec3 pointM = addGround({1, 0.001, 0.001}, flat, 12);
    const glm::dvec3 eyeM = pointM + glm::dvec3(20, 0, 0);
    const auto brightness = [&](const LayerPicture& picture, const glm::dvec3& sun) {
        use(picture);
        settings_.sunDirection = sun;
        const glm::ivec3 c = colourAt(eyeM, pointM);
        return c.x + c.y + c.z;
    };
    const glm::dvec3 fromY(0.7, 0.7, 0), awayFromY(0.7, -0.7, 0);
    const LayerPicture even = plainPicture({180, 180, 180, 128});
    EXPECT_NEAR(brightness(even, fromY), brightness(even, awayFromY), 3);
    EXPECT_GT(brightness(bent, fromY), brightness(even, fromY) + 20);
    EXPECT_LT(brightness(bent, awayFromY), brightness(even, awayFromY) - 20);
    settings_.atmosphere = true;
    settings_.wireframe = settings_.outlines = true;
    settings_.layers.preview = LayerPreview::Heat;
    brightness(bent, fromY);
}

}  // namespace
}  // namespace planet::gl
