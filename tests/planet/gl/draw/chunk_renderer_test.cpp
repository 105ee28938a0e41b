// Pictures of made-up planets, against what geometry says they must show.
#include "planet/gl/draw/chunk_renderer.h"
#include "planet/gl/store/layer_textures.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "planet/gl/draw/captured_draw.h"
#include "planet/surface/star_field.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

constexpr std::array<std::uint8_t, 4> green = {40, 168, 66, 225};

// One matt colour all over, so that brightness tells the light.
RenderSettings mattSettings() {
    RenderSettings settings;
    settings.surface = SurfaceColour::HeightRamp;
    settings.ramp = {{0, {0.4f, 0.5f, 0.4f}}};
    settings.sea = false;
    settings.detail = FeatureUse::Off;
    settings.atmosphere = false;
    return settings;
}

double wavyHills(const glm::dvec3& d) {
    return 3000 * std::sin(40 * d.x + 3 * d.z) * std::cos(37 * d.y) + 1500 * std::sin(90 * d.z + 20 * d.x);
}

// Pixels without a chunk that lie inside the disc of a planet of a radius, well away from its rim.
int holesInDisc(const Picture& picture, const View& view, double discRadiusM) {
    const double distanceM = glm::length(view.eyeM);
    const double rimPx = screenScalePx(view) * std::tan(std::asin(discRadiusM / distanceM));
    int holes = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const double fromMiddle =
                std::hypot(x + 0.5 - picture.width / 2.0, y + 0.5 - picture.height / 2.0);
            holes += fromMiddle < rimPx - 2 && !picture.isGround(x, y);
        }
    }
    return holes;
}

View lookingAtCentre(const glm::dvec3& direction, double altitudeM, int sizePx) {
    const Geographic place = geographicFromDirection(direction);
    return viewFrom({}, glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad), altitudeM, -90, 0,
                    sizePx, sizePx);
}

using ChunkRendererTest = GlTest;

TEST_F(ChunkRendererTest, TheSilhouetteIsRound) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, flat);
    const View view = viewFrom({}, 12, 34, 2 * earthRadiusM, -90, 25, 600, 600);
    const Picture picture = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    const double rimPx = screenScalePx(view) * std::tan(std::asin(1 / 3.0));
    for (int degree = 0; degree < 360; degree += 3) {
        const double angle = glm::radians(static_cast<double>(degree));
        const auto isPlanet = [&](double fromMiddle) {
            return picture.isGround(static_cast<int>(std::floor(300 + fromMiddle * std::cos(angle))),
                                    static_cast<int>(std::floor(300 + fromMiddle * std::sin(angle))));
        };
        EXPECT_TRUE(isPlanet(rimPx - 1)) << degree;
        EXPECT_FALSE(isPlanet(rimPx + 1)) << degree;
    }
}

TEST_F(ChunkRendererTest, NoHoleShowsAtPolesEdgesAndCornersBetweenLevels) {
    TestPlanet planet({}, 6 * 64);
    for (const Face face : allFaces) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            const ChunkId id{face, 2, i % 4, i / 4};
            if ((id.x + id.y) % 2 == 0) {
                planet.add(id, wavyHills, 6000);
                continue;
            }
            for (int quadrant = 0; quadrant < quadrantCount; ++quadrant)
                planet.add(childOf(id, quadrant), wavyHills, 6000);
        }
    }
    for (const double x : {-1.0, 0.0, 1.0}) {
        for (const double y : {-1.0, 0.0, 1.0}) {
            for (const double z : {-1.0, 0.0, 1.0}) {
                if (x == 0 && y == 0 && z == 0) continue;
                const View view = lookingAtCentre({x, y, z}, 4e6, 256);
                const Picture picture = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
                EXPECT_EQ(holesInDisc(picture, view, earthRadiusM - 5000), 0) << x << " " << y << " " << z;
            }
        }
    }
}

TEST_F(ChunkRendererTest, SkirtsFillACrackThatShowsWithoutThem) {
    TestPlanet planet({}, 6 * 16);
    const ChunkId lowered{Face::PosX, 2, 1, 2};
    for (const Face face : allFaces) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            const ChunkId id{face, 2, i % 4, i / 4};
            planet.add(id, id == lowered ? [](const glm::dvec3&) { return -30000.0; } : HeightFunction(flat),
                       40000);
        }
    }
    const View view = lookingAtCentre({1, 0.3, -0.2}, 8e6, 512);
    RenderSettings settings = plainSettings();
    EXPECT_EQ(holesInDisc(drawPicture(planet.renderer(), view, planet.items(), settings), view, earthRadiusM),
              0);
    const std::uint64_t withSkirts = planet.renderer().counters().triangles();
    for (DrawItem& item : planet.items()) item.skirtDepthM = 0;
    EXPECT_GT(holesInDisc(drawPicture(planet.renderer(), view, planet.items(), settings), view, earthRadiusM),
              50);
    EXPECT_EQ(planet.renderer().counters().triangles(), 96u * 2 * 32 * 32);
    EXPECT_EQ(withSkirts, 96u * (2 * 32 * 32 + 2 * 4 * 32));
    EXPECT_EQ(planet.renderer().counters().chunks, 96u);
}

TEST_F(ChunkRendererTest, TheSunLightsTheSideItStandsOver) {
    TestPlanet planet({}, 96);
    planet.addLevel(2, flat);
    RenderSettings settings = mattSettings();
    const View view = viewFrom({}, 0, 0, 2 * earthRadiusM, -90, 0, 401, 401);
    const double sunLatitude = glm::radians(20.0);
    const double sunLongitude = glm::radians(35.0);
    settings.sunDirection = 5.0 * directionFromGeographic({sunLatitude, sunLongitude});
    const Picture picture = drawPicture(planet.renderer(), view, planet.items(), settings);

    const auto planetBrightness = [&](int pixel) {
        const int x = pixel % 401;
        const int y = pixel / 401;
        return picture.isGround(x, y) ? picture.brightness(x, y) : 0;
    };
    int brightest = 0;
    for (int pixel = 0; pixel < 401 * 401; ++pixel) brightest = std::max(brightest, planetBrightness(pixel));
    double x = 0;
    double y = 0;
    int count = 0;
    for (int pixel = 0; pixel < 401 * 401; ++pixel) {
        if (planetBrightness(pixel) < brightest - 2) continue;
        x += pixel % 401;
        y += pixel / 401;
        ++count;
    }
    // Where the point under the sun falls in the picture; east is right and north up.
    const glm::dvec3 under = earthRadiusM * directionFromGeographic({sunLatitude, sunLongitude});
    const double scale = screenScalePx(view) / (3 * earthRadiusM - under.x);
    EXPECT_NEAR(x / count, 200 + under.y * scale, 6);
    EXPECT_NEAR(y / count, 200 - under.z * scale, 6);

    settings.sunDirection = {0, 1, 0};
    const Picture half = drawPicture(planet.renderer(), view, planet.items(), settings);
    EXPECT_GT(half.brightness(260, 200), 8 * half.brightness(140, 200));
}

TEST_F(ChunkRendererTest, theFillLightShowsTheNightSideAndLeavesTheDay) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, wavyHills);
    RenderSettings settings = mattSettings();
    settings.sunDirection = directionFromGeographic({0, 0});
    for (const double altitudeM : {30000.0, 2e7}) {
        const auto brightnessAt = [&](double longitudeDeg, double fill) {
            settings.light.fill = fill;
            const View view = viewFrom({}, 0, longitudeDeg, altitudeM, -90, 0, 32, 32);
            return drawPicture(planet.renderer(), view, planet.items(), settings).brightness(16, 16);
        };
        EXPECT_EQ(brightnessAt(0, 1), brightnessAt(0, 0)) << altitudeM;
        EXPECT_LT(brightnessAt(180, 0), 100) << altitudeM;
        EXPECT_GT(brightnessAt(180, 1), brightnessAt(180, 0) + 150) << altitudeM;
    }
}

TEST_F(ChunkRendererTest, SlopesTowardsTheSunAreBrighter) {
    TestPlanet planet({}, 96);
    // Ridges along meridians: falling eastwards between longitude 0 and 5 degrees,
    // rising from 5 to 10.
    planet.addLevel(2, [](const glm::dvec3& d) {
        const double t = std::atan2(d.y, d.x) / glm::radians(10.0);
        return 8000 + 20000 * std::abs(2 * (t - std::floor(t)) - 1);
    });
    RenderSettings settings = mattSettings();
    settings.sunDirection = {1, 0.7, 0};
    const View view = viewFrom({}, 0, 5, earthRadiusM, -90, 0, 400, 400);
    const Picture picture = drawPicture(planet.renderer(), view, planet.items(), settings);
    const auto at = [&](double longitudeDeg) {
        const double turn = glm::radians(longitudeDeg - 5);
        const double px = screenScalePx(view) * std::sin(turn) / (2 - std::cos(turn));
        return picture.brightness(200 + static_cast<int>(std::lround(px)), 200);
    };
    // The sun stands in the east.
    EXPECT_GT(at(2.5), at(7.5) + 10);
    EXPECT_GT(at(-7.5), at(-2.5) + 10);
}

// The same samples cut into 64 chunks or into 16: light must not show where the cuts are.
TEST_F(ChunkRendererTest, LightKnowsNoBordersBetweenChunksOfALevel) {
    RenderSettings settings;
    settings.atmosphere = false;
    settings.sunDirection = {1, 1.5, 0.3};
    const View view = viewFrom({}, 8, -6, 1e6, -90, 0, 300, 300);
    const auto rough = [](const glm::dvec3& d) {
        return 12000 + 2000 * std::sin(900 * d.y) * std::sin(1100 * d.z) +
               900 * std::sin(3000 * d.y + 2000 * d.z);
    };
    const auto drawCut = [&](int level, int chunkCellsLog2) {
        PlanetShape shape;
        shape.chunkCellsLog2 = chunkCellsLog2;
        TestPlanet planet(shape, 6u << (2 * level));
        planet.addLevel(level, rough);
        return drawPicture(planet.renderer(), view, planet.items(), settings);
    };
    const Picture small = drawCut(3, 4);
    const Picture large = drawCut(2, 5);
    EXPECT_EQ(small.depth, large.depth);
    int different = 0;
    for (std::size_t i = 0; i < small.rgb.size(); ++i) different += std::abs(small.rgb[i] - large.rgb[i]) > 1;
    EXPECT_EQ(different, 0);
}

TEST_F(ChunkRendererTest, WhatIsNearerHidesWhatIsBehindInAnyOrder) {
    TestPlanet planet({}, 96);
    planet.addLevel(
        2, [](const glm::dvec3& d) { return 10 * wavyHills(d); }, 20000);
    const View view = viewFrom({}, 5, 5, 300000, -15, 40, 320, 240);
    const Picture forwards = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    std::reverse(planet.items().begin(), planet.items().end());
    const Picture backwards = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    EXPECT_EQ(forwards.depth, backwards.depth);
    EXPECT_EQ(forwards.rgb, backwards.rgb);
}

TEST_F(ChunkRendererTest, DepthSaysHowFarTheGroundIs) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, flat);
    for (const double altitudeM : {5000.0, 1e6, 1e8}) {
        const View view = viewFrom({}, 0, 0, altitudeM, -90, 0, 101, 101);
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
        EXPECT_EQ(planet.renderer().projection().reversedZ, hasClipControl());
        // The mesh cuts under the sphere by at most the sagitta of its cells, some 30 m.
        EXPECT_NEAR(viewDistanceM(planet.renderer().projection(), picture.depthAt(50, 50)), altitudeM,
                    40 + 1e-6 * altitudeM);
    }
}

TEST_F(ChunkRendererTest, APlainDepthBufferGetsAClassicProjection) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, wavyHills, 6000);
    const View view = viewFrom({}, 10, 20, 1e6, -90, 0, 200, 200);
    const Picture reversed = drawPicture(planet.renderer(), view, planet.items(), plainSettings());

    const Texture colour = makeTexture();
    glBindTexture(GL_TEXTURE_2D, colour.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 200, 200, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    const Renderbuffer depth = makeRenderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, 200, 200);
    const Framebuffer framebuffer = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour.name(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    planet.renderer().draw(view, planet.items(), plainSettings());
    EXPECT_FALSE(planet.renderer().projection().reversedZ);
    EXPECT_GT(planet.renderer().projection().nearM, 1000);
    float middle = 0;
    glReadPixels(100, 100, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &middle);
    EXPECT_NEAR(viewDistanceM(planet.renderer().projection(), static_cast<double>(middle)), 1e6, 6000);

    std::vector<std::uint8_t> rgb(200 * 200 * 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, 200, 200, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    int different = 0;
    for (int i = 0; i < 200 * 200; ++i) {
        const auto flipped = static_cast<std::size_t>((199 - i / 200) * 200 + i % 200) * 3;
        different += rgb[flipped] != reversed.at(i % 200, i / 200).x;
    }
    EXPECT_LT(different, 200 * 200 / 500);
}

TEST_F(ChunkRendererTest, WithoutLightATintIsExactlyItsColour) {
    TestPlanet planet({}, 32);
    planet.addLevel(1, flat);
    const View view = viewFrom({}, 15, 15, 1e5, -90, 0, 32, 32);
    const auto middle = [&](std::span<const ChunkTint> tints) {
        return drawPicture(planet.renderer(), view, planet.items(), plainSettings(), 1, tints).at(16, 16);
    };
    for (const auto& [red, g, blue] : {std::array{255, 0, 0}, {13, 200, 90}, {0, 0, 0}, {255, 255, 255}}) {
        const std::array<std::uint8_t, 4> rgba = {static_cast<std::uint8_t>(red),
                                                  static_cast<std::uint8_t>(g),
                                                  static_cast<std::uint8_t>(blue), 255};
        EXPECT_TRUE(areNear(middle(oneTint(planet.items().size(), rgba)), {red, g, blue}));
    }
    EXPECT_EQ(middle(oneTint(planet.items().size(), {255, 0, 0, 0})), middle({})) << "no strength";
    // Each item has its own: the one that is looked at is z_pos, x_pos or another's; all but it are blue.
    for (std::size_t i = 0; i < planet.items().size(); ++i) {
        std::vector<ChunkTint> tints = oneTint(planet.items().size(), {0, 0, 255, 255});
        tints[i].rgba = {255, 0, 0, 255};
        const ChunkId under = chunkAt(facePointFromDirection(view.eyeM), 1);
        EXPECT_EQ(middle(tints).x > 200, planet.items()[i].id == under);
    }
}

TEST_F(ChunkRendererTest, aTintOfFullStrengthIsItsColourInAnyLightAndAir) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, wavyHills);
    constexpr std::array<std::uint8_t, 4> measured = {247, 212, 38, 255};
    const std::vector<ChunkTint> tints = oneTint(planet.items().size(), measured);
    const auto pixelsOff = [&](const View& view, const RenderSettings& settings) {
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), settings, 1, tints);
        int ground = 0;
        int off = 0;
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                if (!picture.isGround(x, y)) continue;
                ++ground;
                off += !areNear(picture.at(x, y), {measured[0], measured[1], measured[2]});
            }
        }
        EXPECT_GT(ground, 1000);
        return off;
    };
    const View near = viewFrom({}, 10, 10, 20000, -10, 0, 96, 64);
    const View far = viewFrom({}, 10, 10, 2e7, -90, 0, 96, 64);
    for (const View& view : {near, far}) {
        for (const double sunLongitudeDeg : {10.0, 95.0, 190.0}) {
            for (const FeatureUse use : {FeatureUse::Off, FeatureUse::On}) {
                RenderSettings settings;
                settings.sunDirection = directionFromGeographic({0.1, glm::radians(sunLongitudeDeg)});
                settings.light.air.use = use;
                settings.light.sea.use = use;
                settings.light.shadows.use = use;
                settings.layers.use = use;
                EXPECT_EQ(pixelsOff(view, settings), 0)
                    << "sun at " << sunLongitudeDeg << (use == FeatureUse::On ? ", all light" : ", plain");
            }
        }
    }
}

TEST_F(ChunkRendererTest, WireframeDrawsLinesOnTheEdgesOfTriangles) {
    TestPlanet planet({}, 6);
    planet.addLevel(0, flat);
    View view = viewFrom({}, 0, 0, earthRadiusM, -90, 0, 500, 500);
    RenderSettings settings = plainSettings();
    const Picture filled = drawPicture(planet.renderer(), view, planet.items(), settings);
    settings.wireframe = true;
    const Picture wire = drawPicture(planet.renderer(), view, planet.items(), settings);
    EXPECT_EQ(wire.depth, filled.depth);
    int full = 0;
    int lines = 0;
    for (int y = 150; y < 350; ++y) {
        for (int x = 150; x < 350; ++x) {
            full += filled.brightness(x, y) > 0;
            lines += wire.brightness(x, y) > filled.brightness(x, y) * 6 / 10;
        }
    }
    EXPECT_EQ(full, 200 * 200);
    EXPECT_GT(lines, 200 * 200 / 50);
    EXPECT_LT(lines, 200 * 200 / 2);
    // The face's middle is a grid point: lines cross there. Beside it, inside a triangle, is none.
    EXPECT_GT(wire.brightness(250, 250), filled.brightness(250, 250) * 7 / 10);
    const double cellPx = screenScalePx(view) * (2.0 / 32) * std::sqrt(0.5);
    const int inside = static_cast<int>(std::lround(cellPx * 0.66));
    EXPECT_LT(wire.brightness(250 + inside, 250 - inside / 2), filled.brightness(250, 250) / 2);
}

TEST_F(ChunkRendererTest, TheImageLiesWhereItsLongitudesAndLatitudesSay) {
    TestPlanet planet({}, 96);
    planet.addLevel(2, [](const glm::dvec3&) { return 100.0; });
    // Red grows eastwards from 0 to 180 and falls again to the west, without a step anywhere; green grows
    // northwards.
    constexpr int width = 256;
    constexpr int height = 128;
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double fromMiddle = std::abs(x + 0.5 - width / 2) / (width / 2);
            rgb.push_back(static_cast<std::uint8_t>(std::lround(60 + 150 * fromMiddle)));
            rgb.push_back(static_cast<std::uint8_t>(std::lround(220 - 200 * (y + 0.5) / height)));
            rgb.push_back(x < width / 2 ? 30 : 60);  // west, east
        }
    }
    ASSERT_TRUE(planet.renderer().setColourImage(rgb, width, height));
    RenderSettings settings;
    settings.lighting = false;
    settings.atmosphere = false;
    const auto colourAt = [&](double latitudeDeg, double longitudeDeg) {
        const View view = viewFrom({}, latitudeDeg, longitudeDeg, 1e5, -90, 0, 9, 9);
        const glm::ivec3 colour = drawPicture(planet.renderer(), view, planet.items(), settings).at(4, 4);
        return colour;
    };
    // Land is drawn a fifth brighter than the image, in linear light: about 1.09 in sRGB.
    EXPECT_NEAR(colourAt(0, 90).x, 135 * 1.085, 4);
    EXPECT_NEAR(colourAt(45, 20).y, 170 * 1.085, 4);
    EXPECT_NEAR(colourAt(-45, 20).y, 70 * 1.085, 4);
    EXPECT_GT(colourAt(0, 60).z, colourAt(0, -60).z + 20);

    const View seam = viewFrom({}, 30, 180, 3e6, -90, 0, 300, 300);
    const Picture picture = drawPicture(planet.renderer(), seam, planet.items(), settings);
    for (int y = 0; y < 300; ++y) {
        for (int x = 1; x < 300; ++x) {
            if (!picture.isGround(x, y) || !picture.isGround(x - 1, y)) continue;
            ASSERT_LE(std::abs(picture.at(x, y).x - picture.at(x - 1, y).x), 6) << x << " " << y;
        }
    }
}

TEST_F(ChunkRendererTest, AirGlowsOutsideTheLimbByDayAndTheSkyIsBlueFromTheGround) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, flat);
    RenderSettings settings;
    settings.sunDirection = {1, 0, 0};
    const View orbit = viewFrom({}, 0, 0, 1e6, -30, 0, 400, 300);
    const Picture air = drawPicture(planet.renderer(), orbit, planet.items(), settings);
    settings.atmosphere = false;
    const Picture none = drawPicture(planet.renderer(), orbit, planet.items(), settings);
    int column = 200;
    int limb = 0;
    while (limb < 299 && !air.isGround(column, limb + 1)) ++limb;
    ASSERT_GT(limb, 20);
    ASSERT_LT(limb, 280);
    EXPECT_GT(air.brightness(column, limb), none.brightness(column, limb) + 100);
    EXPECT_GT(air.at(column, limb - 3).z, air.at(column, limb - 3).x);
    EXPECT_LT(air.brightness(column, limb - 60), 60);

    settings.atmosphere = true;
    const View ground = viewFrom({}, 0, 0, 2000, 30, 0, 60, 40);
    const glm::ivec3 day = drawPicture(planet.renderer(), ground, planet.items(), settings).at(30, 20);
    EXPECT_GT(day.z, 60);
    EXPECT_GT(day.z, day.x + 20);
    settings.sunDirection = {-1, 0, 0};
    const glm::ivec3 night = drawPicture(planet.renderer(), ground, planet.items(), settings).at(33, 20);
    EXPECT_LT(night.z, 25);
}

TEST_F(ChunkRendererTest, LowLandIsSeaOnlyWhereThereIsSea) {
    TestPlanet planet({}, 24);
    planet.addLevel(1, [](const glm::dvec3&) { return -3000.0; });
    RenderSettings settings;
    settings.surface = SurfaceColour::HeightRamp;
    settings.atmosphere = false;
    settings.lighting = false;
    const View view = viewFrom({}, 0, 0, 1e6, -90, 0, 32, 32);
    const glm::ivec3 sea = drawPicture(planet.renderer(), view, planet.items(), settings).at(10, 10);
    EXPECT_GT(sea.z, 2 * sea.x);
    settings.sea = false;
    const glm::ivec3 land = drawPicture(planet.renderer(), view, planet.items(), settings).at(10, 10);
    EXPECT_GT(land.y, land.z);
}

// Rough enough for the detail to show, smooth across the edges of faces.
double ridges(const glm::dvec3& d) {
    return 9000 + 2500 * std::sin(110 * d.x) + 2500 * std::sin(130 * d.y + 1) + 2500 * std::sin(120 * d.z);
}

std::vector<std::uint8_t> imageOfStripes(int width, int height) {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < width * height; ++i) {
        const double latitude = std::numbers::pi * (i / width + 0.5) / height;
        const auto value = static_cast<std::uint8_t>(std::lround(120 + 60 * std::sin(30 * latitude)));
        rgb.insert(rgb.end(), {value, 110, 90});
    }
    return rgb;
}

int largestDifference(const Picture& a, const Picture& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
    return largest;
}

TEST_F(ChunkRendererTest, DetailShowsNearTheGroundAndMovesNothing) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, ridges, 6000);
    RenderSettings with;
    with.detail = FeatureUse::On;
    with.sunDirection = {1, 0.9, 0.2};
    const View near = viewFrom({}, 10, 10, 60000, -40, 0, 240, 160);
    const View far = viewFrom({}, 10, 10, 2e7, -90, 0, 240, 160);
    const auto drawBoth = [&](const View& view, RenderSettings settings,
                              std::span<const ChunkTint> tints = {}) {
        const Picture on = drawPicture(planet.renderer(), view, planet.items(), settings, 1, tints);
        settings.detail = FeatureUse::Off;
        const Picture off = drawPicture(planet.renderer(), view, planet.items(), settings, 1, tints);
        EXPECT_EQ(on.depth, off.depth);
        return largestDifference(on, off);
    };
    EXPECT_GT(drawBoth(near, with), 15);
    EXPECT_EQ(drawBoth(far, with), 0) << "the samples are finer than pixels";
    EXPECT_EQ(drawBoth(near, with, oneTint(planet.items().size(), green)), 0);
    RenderSettings unlit = with;
    unlit.lighting = false;
    EXPECT_EQ(drawBoth(near, unlit), 0);
}

// Looking down at a face's edge, it runs straight through the picture's middle; at a corner, three do.
TEST_F(ChunkRendererTest, DetailAndImageHaveNoSeamAtTheEdgesOfFaces) {
    TestPlanet planet({}, 384);
    planet.addLevel(3, ridges);
    ASSERT_TRUE(planet.renderer().setColourImage(imageOfStripes(512, 256), 512, 256));
    RenderSettings settings;
    settings.detail = FeatureUse::On;
    settings.sunDirection = {1, 1.2, 0.4};
    const auto stepAcross = [](const Picture& picture, int column) {
        double sum = 0;
        for (int y = 0; y < picture.height; ++y)
            sum += std::abs(picture.brightness(column, y) - picture.brightness(column - 1, y));
        return sum / picture.height;
    };
    for (const double latitudeDeg : {12.0, -20.0, 35.2644}) {
        const View view = viewFrom({}, latitudeDeg, 45, 150000, -90, 0, 201, 200);
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), settings);
        std::vector<double> steps;
        for (int column = 1; column < 201; ++column) steps.push_back(stepAcross(picture, column));
        const double atEdge = *std::max_element(steps.begin() + 98, steps.begin() + 102);
        std::sort(steps.begin(), steps.end());
        EXPECT_GT(steps[100], 0.3) << "there is something to see";
        EXPECT_LE(atEdge, 1.05 * steps[195]) << latitudeDeg;
    }
}

// A coarse mesh is lit by pixel and a fine one by vertex: both look the same.
TEST_F(ChunkRendererTest, LightByVertexLooksLikeLightByPixel) {
    TestPlanet coarse({}, 6);
    coarse.addLevel(0, flat);
    TestPlanet fine({}, 384);
    fine.addLevel(3, flat);
    const View view = viewFrom({}, 0, 0, 1.2e7, -90, 0, 300, 300);
    RenderSettings settings;
    settings.sunDirection = {1, 0.8, 0.3};
    for (const bool atmosphere : {true, false}) {
        settings.atmosphere = atmosphere;
        const Picture byPixel = drawPicture(coarse.renderer(), view, coarse.items(), settings);
        const Picture byVertex = drawPicture(fine.renderer(), view, fine.items(), settings);
        int largest = 0;
        for (int y = 0; y < 300; ++y) {
            for (int x = 0; x < 300; ++x) {
                if (std::hypot(x - 149.5, y - 149.5) > 85) continue;  // the rim is elsewhere on a coarse mesh
                const glm::ivec3 d = glm::abs(byPixel.at(x, y) - byVertex.at(x, y));
                largest = std::max({largest, d.x, d.y, d.z});
            }
        }
        EXPECT_LE(largest, 4) << atmosphere;
        EXPECT_GT(byVertex.brightness(150, 150), 60);
    }
}

TEST_F(ChunkRendererTest, SeveralSamplesSmoothTheRim) {
    TestPlanet planet({}, 24);
    planet.addLevel(1, flat);
    ASSERT_GE(planet.renderer().capabilities().samples, 4);
    const View view = viewFrom({}, 0, 0, 2 * earthRadiusM, -90, 0, 200, 200);
    const auto between = [&](int samples) {
        const Picture picture =
            drawPicture(planet.renderer(), view, planet.items(), plainSettings(), samples);
        const int full = picture.brightness(100, 100);
        int count = 0;
        for (int i = 0; i < 200 * 200; ++i) {
            const int brightness = picture.brightness(i % 200, i / 200);
            count += brightness > full / 8 && brightness < full * 7 / 8;
        }
        return count;
    };
    EXPECT_GT(between(4), between(1) + 100);
}

TEST_F(ChunkRendererTest, NothingToDrawIsASkyAndNoError) {
    TestPlanet planet({}, 1);
    const Picture picture = drawPicture(planet.renderer(), viewFrom({}, 0, 0, 1e6), {}, RenderSettings{});
    EXPECT_EQ(planet.renderer().counters().triangles(), 0u);
    EXPECT_EQ(std::count(picture.depth.begin(), picture.depth.end(), picture.clearDepth),
              std::ssize(picture.depth));
}

TEST_F(ChunkRendererTest, GpuMemoryIsWhatWasAllocated) {
    PlanetShape shape;
    shape.chunkCellsLog2 = 4;
    TestPlanet planet(shape, 100);
    const GpuMemory before = planet.renderer().gpuMemory();
    const std::size_t grid = (17u * 17 + 64) * 4 + (16u * 16 * 6 + 64 * 6) * 2;
    const std::size_t stars = makeStarField().stars.size() * sizeof(Star);
    EXPECT_EQ(before.heightPool, 170u * 170 * 2);  // ten slots of 17 a side, squared
    EXPECT_GE(before.meshes, grid + stars);
    EXPECT_LE(before.meshes, grid + stars + 8192);
    const auto withMipmaps = [](std::size_t side) { return (4 * side * side - 1) / 3; };
    // Noise with mipmaps, and the layers' checker pattern without.
    EXPECT_EQ(before.textures, (64u * 64 * 64 * 8 - 1) / 7 * 4 + 2 * 4 * 64 * 64);
    EXPECT_EQ(before.total(), before.heightPool + before.meshes + before.textures);
    const std::vector<std::uint8_t> rgb(16 * 8 * 3, 128);
    ASSERT_TRUE(planet.renderer().setColourImage(rgb, 16, 8));
    EXPECT_EQ(planet.renderer().gpuMemory().textures - before.textures,
              6u * 4u * (5 * 5 + 2 * 2 + 1));  // six faces
    const std::size_t withImage = planet.renderer().gpuMemory().textures;
    const LayerPicture picture = checkerPicture(128);
    ASSERT_TRUE(planet.renderer().setLayers(std::array{picture, picture}, 128));
    EXPECT_EQ(planet.renderer().gpuMemory().textures, withImage + 2 * 4 * (3 * withMipmaps(128) - 64 * 64));
    ASSERT_TRUE(planet.renderer().setSlotCapacity(25));
    EXPECT_EQ(planet.renderer().gpuMemory().heightPool, 85u * 85 * 2);
}

TEST_F(ChunkRendererTest, TimesArriveSomeFramesLater) {
    TestPlanet planet({}, 24);
    planet.addLevel(1, flat);
    for (int i = 0; i < 6; ++i)
        drawPicture(planet.renderer(), viewFrom({}, 0, 0, 1e7), planet.items(), RenderSettings{});
    EXPECT_GT(planet.renderer().counters().chunksMs, 0);
    EXPECT_GT(planet.renderer().counters().skyMs, 0);
}

TEST_F(ChunkRendererTest, UploadsAreCountedFromDrawToDraw) {
    TestPlanet planet({}, 24);
    planet.addLevel(1, flat);
    const View view = viewFrom({}, 0, 0, 1e7, -90, 0, 16, 16);
    drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    EXPECT_EQ(planet.renderer().counters().uploads, 24u);
    drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    EXPECT_EQ(planet.renderer().counters().uploads, 0u);
}

TEST_F(ChunkRendererTest, AnotherSlotCapacityHoldsTheChunksUploadedAfterwards) {
    TestPlanet planet({}, 6);
    planet.addLevel(0, flat);
    const View view = viewFrom({}, 10, 20, 1e7, -90, 0, 64, 64);
    const Picture before = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
    EXPECT_FALSE(planet.renderer().setSlotCapacity(0));
    EXPECT_FALSE(planet.renderer().setSlotCapacity(4'000'000'000u));
    EXPECT_EQ(drawPicture(planet.renderer(), view, planet.items(), plainSettings()).rgb, before.rgb)
        << "the old pool stays";
    ASSERT_TRUE(planet.renderer().setSlotCapacity(900));
    for (DrawItem& item : planet.items()) {
        item.slot += 890;
        planet.renderer().upload(item.slot, chunkSteps({}, item.id, flat));
    }
    EXPECT_EQ(drawPicture(planet.renderer(), view, planet.items(), plainSettings()).rgb, before.rgb);
}

TEST_F(ChunkRendererTest, AnotherShapeDrawsTheSameStepsAtItsOwnHeights) {
    PlanetShape shape;
    TestPlanet planet(shape, 24);
    planet.addLevel(1, [](const glm::dvec3&) { return 8000.0; });
    const View view = viewFrom({}, 30, 40, 1e6, -90, 0, 33, 33);
    const auto distance = [&] {
        const Picture picture = drawPicture(planet.renderer(), view, planet.items(), plainSettings());
        return viewDistanceM(planet.renderer().projection(), picture.depthAt(16, 16));
    };
    const double once = distance();
    shape.quantumM = 3;
    planet.renderer().setShape(shape);
    EXPECT_NEAR(once - distance(), 16000, 40);
}

// With skirts, light, air and detail.
TEST_F(ChunkRendererTest, aCapturedDrawIsTheSamePictureWithoutTheChunks) {
    TestPlanet planet({}, 24);
    planet.addLevel(
        1, [](const glm::dvec3& d) { return 6000 * std::sin(20 * d.x) * std::sin(15 * d.y); }, 3000);
    for (std::size_t i = 0; i < planet.items().size(); ++i)
        planet.items()[i].morph = i % 2 == 0 ? 0.3f : 0.0f;
    RenderSettings settings;
    settings.surface = SurfaceColour::HeightRamp;
    settings.detail = FeatureUse::On;
    settings.light.shadows.use = FeatureUse::On;
    const View view = viewFrom({}, 20, 20, 8e5, -45, 30, 200, 150);
    const Picture drawn = drawPicture(planet.renderer(), view, planet.items(), settings);
    const RenderTarget target = valueOf(RenderTarget::create(view.widthPx, view.heightPx));
    target.bind();
    planet.renderer().draw(view, planet.items(), settings);
    const CapturedDraw captured = valueOf(planet.renderer().capture(view, planet.items(), settings));
    for (std::uint32_t slot = 0; slot < 24; ++slot)
        planet.renderer().upload(slot, chunkSteps({}, planet.items()[slot].id, flat));
    planet.renderer().draw(view, captured);
    EXPECT_EQ(target.readDepth(), drawn.depth);
    EXPECT_EQ(target.readRgb(), drawn.rgb);
    EXPECT_EQ(captured.indexCount, 24 * 3 * 2 * (32 * 32 + 4 * 32));
}

TEST_F(ChunkRendererTest, StateIsLeftAsANewContextHasIt) {
    TestPlanet planet({}, 6);
    planet.addLevel(0, flat);
    drawPicture(planet.renderer(), viewFrom({}, 0, 0, 1e7), planet.items(), RenderSettings{});
    GLint value = 0;
    glGetIntegerv(GL_DEPTH_FUNC, &value);
    EXPECT_EQ(value, GL_LESS);
    EXPECT_FALSE(glIsEnabled(GL_DEPTH_TEST));
    EXPECT_FALSE(glIsEnabled(GL_CULL_FACE));
    if (hasClipControl()) {
        glGetIntegerv(GL_CLIP_DEPTH_MODE, &value);
        EXPECT_EQ(value, GL_NEGATIVE_ONE_TO_ONE);
    }
    glGetIntegerv(GL_CURRENT_PROGRAM, &value);
    EXPECT_EQ(value, 0);
}

// A copy of the shaders in a folder of its own, to be spoiled.
class ShaderFolder : public GlTest {
protected:
    ShaderFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "shaders-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
        std::filesystem::copy(std::filesystem::path(WORLDY_SOURCE_DIR) / "shaders", folder_);
    }
    ~ShaderFolder() override { std::filesystem::remove_all(folder_); }

    void append(const char* file, const char* text) const {
        std::ofstream(folder_ / file, std::ios::app) << text;
    }
    std::filesystem::path folder_;
};

TEST_F(ShaderFolder, ABrokenReloadKeepsTheLastGoodShaders) {
    ChunkRenderer renderer = valueOf(ChunkRenderer::create({{}, 6, folder_}));
    const PlanetShape shape;
    std::vector<DrawItem> items;
    for (const Face face : allFaces) {
        DrawItem item;
        item.id = {face, 0, 0, 0};
        item.slot = static_cast<std::uint32_t>(face);
        renderer.upload(item.slot, chunkSteps(shape, item.id, wavyHills));
        items.push_back(item);
    }
    const View view = viewFrom({}, 0, 0, 1e7);
    const Picture before = drawPicture(renderer, view, items, RenderSettings{});
    append("chunk.frag", "\nthis is not GLSL\n");
    const Result<void> broken = renderer.reloadShaders();
    ASSERT_FALSE(broken);
    EXPECT_THAT(broken.error().message, testing::HasSubstr((folder_ / "chunk.frag").string()));
    EXPECT_THAT(broken.error().message, testing::HasSubstr("syntax error"));
    forgetReported();  // the driver reports what did not compile, too
    EXPECT_EQ(drawPicture(renderer, view, items, RenderSettings{}).rgb, before.rgb);

    std::filesystem::copy(std::filesystem::path(WORLDY_SOURCE_DIR) / "shaders" / "chunk.frag", folder_,
                          std::filesystem::copy_options::overwrite_existing);
    EXPECT_TRUE(renderer.reloadShaders());
    EXPECT_EQ(drawPicture(renderer, view, items, RenderSettings{}).rgb, before.rgb);
    // And a change of the file is seen.
    append("chunk.frag", "\n#error seen\n");
    EXPECT_FALSE(renderer.reloadShaders());
    forgetReported();
    std::filesystem::remove(folder_ / "sky.frag");
    EXPECT_FALSE(renderer.reloadShaders());
}

TEST_F(ShaderFolder, AMissingFileIsNamedWhenARendererIsMade) {
    std::filesystem::remove(folder_ / "frame.glsl");
    const Result<ChunkRenderer> renderer = ChunkRenderer::create({{}, 6, folder_});
    ASSERT_FALSE(renderer);
    EXPECT_THAT(renderer.error().message, testing::HasSubstr("frame.glsl"));
}

}  // namespace
}  // namespace planet::gl
