// The physical atmosphere: the shader's light against the library's doubles, everywhere finite, and what is
// seen of it.
#include "planet/gl/store/air_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>

#include "planet/gl/device/shader_inputs.h"
#include "planet/gl/device/shader_source.h"
#include "planet/gl/draw/frame_uniforms.h"
#include "planet/gl/draw/shader_prologue.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

constexpr int directionsASide = 32;  // directions, all around and from below to above

// Each pixel works out one of shaders/air.glsl's functions in a direction of its own.
constexpr const char* probeMain = R"(
uniform int asked;
uniform float distanceM;
out vec4 result;
void main() {
    shading = frame.shading;
    vec2 at = gl_FragCoord.xy / 32.0;
    float height = 2.0 * at.y - 1.0;
    float turn = 6.2831853 * at.x;
    vec3 ray = vec3(sqrt(1.0 - height * height) * vec2(cos(turn), sin(turn)), height);
    bool meetsGround;
    AirLight sky = lightOfSky(ray, meetsGround);
    AirLight before = lightBefore(ray * distanceM, 0.0, 1.0);
    float high = at.x * at.x * 120.0 - 5.0;
    result = vec4(0.0);
    if (asked == 0) result.rgb = sky.scattered;
    if (asked == 1) result.rgb = sky.through;
    if (asked == 2) result.rgb = before.scattered;
    if (asked == 3) result.rgb = before.through;
    if (asked == 4) result.rgb = skyRadianceAlong(ray, air.eyeUp);
    if (asked == 5) result.rgb = skyIrradianceAt(high, height);
    if (asked == 6) result.rgb = sunThroughAir(high, height);
    if (asked == 7) result.rgb = vec3(sunDisk(dot(ray, shading.sun), 0.001));
}
)";
constexpr int askable = 8;

glm::dvec3 directionOf(int pixel) {
    const double height = 2 * ((pixel / directionsASide) + 0.5) / directionsASide - 1;
    const double turn = 2 * std::numbers::pi * ((pixel % directionsASide) + 0.5) / directionsASide;
    const double aside = std::sqrt(1 - height * height);
    return {aside * std::cos(turn), aside * std::sin(turn), height};
}

class Air : public GlTest {
protected:
    Air() : frame_(makeBuffer()), framebuffer_(makeFramebuffer()), colour_(makeRenderbuffer()) {
        constexpr std::array<std::string_view, 2> vertexFiles = {"frame.glsl", "sky.vert"};
        constexpr std::array<std::string_view, 4> fragmentFiles = {"frame.glsl", "smooth_rise.glsl",
                                                                   "atmosphere.glsl", "air.glsl"};
        const ShaderText vertex = valueOf(readShader({}, vertexFiles));
        ShaderText fragment = valueOf(readShader({}, fragmentFiles));
        fragment.text += probeMain;
        program_ = valueOf(linkProgram(vertex, fragment, {.prologue = shaderPrologue(switchPhysicalAir)}));
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glBindRenderbuffer(GL_RENDERBUFFER, colour_.name());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, directionsASide, directionsASide);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
        array_ = makeVertexArray();
    }

    std::vector<glm::vec4> ask(int asked, const glm::dvec3& eyeM, const glm::dvec3& sun, double distanceM) {
        View view;
        view.eyeM = eyeM;
        RenderSettings settings;
        settings.sunDirection = sun;
        const FrameUniforms uniforms =
            frameUniforms(shape_, view, reversedProjection(view, 0.1), settings, {});
        fillUniforms(frame_, uniforms);
        bindUniforms(UniformBlock::Frame, frame_);
        EXPECT_TRUE(textures_.follow(drawing_.settings, false));
        textures_.bind(drawing_, eyeM, shape_.radiusM, glm::normalize(sun));
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glViewport(0, 0, directionsASide, directionsASide);
        glUseProgram(program_.name());
        glUniform1i(glGetUniformLocation(program_.name(), "asked"), asked);
        glUniform1f(glGetUniformLocation(program_.name(), "distanceM"), static_cast<float>(distanceM));
        glBindVertexArray(array_.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<glm::vec4> result(directionsASide * directionsASide);
        glReadPixels(0, 0, directionsASide, directionsASide, GL_RGBA, GL_FLOAT, result.data());
        return result;
    }

    AirRay rayTowards(const glm::dvec3& ray, const glm::dvec3& eyeM, const glm::dvec3& sun) const {
        const glm::dvec3 up = glm::normalize(eyeM);
        return {(glm::length(eyeM) / shape_.radiusM - 1) * airRadiusKm, glm::dot(up, ray), glm::dot(up, sun),
                glm::dot(ray, sun)};
    }

    // Where a ray meets height 0 dark ground is seen.
    glm::dvec3 darkGround(const glm::dvec3& ray, const glm::dvec3& eyeM, const glm::dvec3& sun) const {
        const double along = glm::dot(eyeM, ray);
        const double inside = along * along - glm::dot(eyeM, eyeM) + shape_.radiusM * shape_.radiusM;
        if (along >= 0 || inside < 0) return glm::dvec3(0);
        const double sunRise = glm::dot(glm::normalize(eyeM + (-along - std::sqrt(inside)) * ray), sun);
        return (sunThrough(textures_.tables(), 0, sunRise) * std::max(sunRise, 0.0) +
                skyIrradiance(textures_.tables(), 0, sunRise)) *
               glm::dvec3(0.02, 0.04, 0.07) / std::numbers::pi;
    }

    // Away from the horizon, where floats may tell sky from ground otherwise.
    static bool nearHorizon(const AirRay& ray) {
        const double radius = airRadiusKm + ray.heightKm;
        const double horizon = -std::sqrt(std::max(1 - std::pow(airRadiusKm / radius, 2), 0.0));
        return std::abs(ray.rise - horizon) < 2e-3;
    }

    void expectFinite(const glm::dvec3& eyeM, const glm::dvec3& sun, double distanceM) {
        for (int asked = 0; asked < askable; ++asked) {
            const std::vector<glm::vec4> all = ask(asked, eyeM, sun, distanceM);
            const bool good = std::all_of(all.begin(), all.end(), [](const glm::vec4& light) {
                return light.r >= 0 && light.g >= 0 && light.b >= 0 && light.r + light.g + light.b < 1e5f;
            });
            EXPECT_TRUE(good) << "asked for " << asked << " from " << eyeM.x << " " << eyeM.y << " " << eyeM.z
                              << ", " << glm::length(eyeM) - shape_.radiusM << " m high";
        }
    }

    PlanetShape shape_;
    AirDrawing drawing_;
    AirTextures textures_;
    Buffer frame_;
    Framebuffer framebuffer_;
    Renderbuffer colour_;
    VertexArray array_;
    Program program_;
};

TEST_F(Air, TheShadersLightIsTheLibrarysDoubles) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, 0.6, 0.3));
    drawing_.steps = 32;
    for (const double heightM : {2.0, 20e3, 400e3, 6e7}) {
        const glm::dvec3 eyeM = (shape_.radiusM + heightM) * glm::normalize(glm::dvec3(0.7, 0.3, 0.5));
        const std::vector<glm::vec4> light = ask(0, eyeM, sun, 1), left = ask(1, eyeM, sun, 1);
        const glm::dvec3 whole(airUniforms(textures_.tables(), drawing_, eyeM, shape_.radiusM, sun).light);
        for (int pixel = 0; pixel < directionsASide * directionsASide; ++pixel) {
            const AirRay ray = rayTowards(directionOf(pixel), eyeM, sun);
            if (nearHorizon(ray)) continue;
            AirLight wanted = lightAlong(textures_.tables(), ray, 32);
            wanted.scattered += wanted.through * darkGround(directionOf(pixel), eyeM, sun);
            for (int channel = 0; channel < 3; ++channel) {
                const double scattered = std::numbers::pi * whole[channel] * wanted.scattered[channel];
                EXPECT_NEAR(light[static_cast<std::size_t>(pixel)][channel], scattered,
                            0.02 * scattered + 1e-3)
                    << heightM << " m, rise " << ray.rise;
                EXPECT_NEAR(left[static_cast<std::size_t>(pixel)][channel], wanted.through[channel], 0.01)
                    << heightM << " m, rise " << ray.rise;
            }
        }
    }
}

TEST_F(Air, LightBeforeAPointIsTheLibrarysDoubles) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, 0.6, 0.3));
    const glm::dvec3 eyeM = (shape_.radiusM + 5000) * glm::normalize(glm::dvec3(0.7, 0.3, 0.5));
    const glm::dvec3 whole(airUniforms(textures_.tables(), drawing_, eyeM, shape_.radiusM, sun).light);
    for (const double distanceM : {10.0, 5e3, 2e5}) {
        const std::vector<glm::vec4> light = ask(2, eyeM, sun, distanceM),
                                     left = ask(3, eyeM, sun, distanceM);
        for (int pixel = 0; pixel < directionsASide * directionsASide; ++pixel) {
            AirRay ray = rayTowards(directionOf(pixel), eyeM, sun);
            ray.lengthKm = distanceM / shape_.radiusM * airRadiusKm;
            if (ray.rise < -5000 / distanceM) continue;  // below ground
            const AirLight wanted = lightAlong(textures_.tables(), ray, 256);
            for (int channel = 0; channel < 3; ++channel) {
                const double scattered = std::numbers::pi * whole[channel] * wanted.scattered[channel];
                EXPECT_NEAR(light[static_cast<std::size_t>(pixel)][channel], scattered,
                            0.04 * scattered + 1e-3)
                    << distanceM << " m, rise " << ray.rise;
                EXPECT_NEAR(left[static_cast<std::size_t>(pixel)][channel], wanted.through[channel], 0.02)
                    << distanceM << " m, rise " << ray.rise;
            }
        }
    }
}

TEST_F(Air, IsFiniteFromEverywhereWhereverTheSunIs) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    };
    const std::array<double, 8> heights = {-11e3, -1, 0, 1e-3, 2e3, 1e5, 4e5, 9 * shape_.radiusM};
    for (const double heightM : heights) {
        const glm::dvec3 up = direction();
        const glm::dvec3 eyeM = (shape_.radiusM + heightM) * up;
        for (const glm::dvec3& sun : {up, -up, direction()}) expectFinite(eyeM, sun, std::abs(heightM) + 0.5);
    }
    expectFinite({0, 0, shape_.radiusM}, {0, 0, 1}, 0);  // the pole, the sun in the zenith
    expectFinite({0, 0, -shape_.radiusM}, {1, 0, 0}, 1e12);
    expectFinite({0, 0, 0}, {1, 0, 0}, 1e7);  // the middle of the planet
    expectFinite({2e10, 1, 1}, {1, 0, 0}, 2e10);
}

TEST_F(Air, IsFiniteAtTheEndsOfAllRanges) {
    for (const AirSettings& settings : {AirSettings{0, 0, 0, 0, 0.25}, AirSettings{5, 20, 5, 0.95, 4},
                                        AirSettings{0, 20, 0, 0.95, 0.25}, AirSettings{5, 0, 5, 0, 4}}) {
        drawing_.settings = settings;
        drawing_.steps = settings.haze > 0 ? 64 : 8;
        drawing_.exposure = settings.haze > 0 ? 10 : 0.1;
        for (const double heightM : {0.0, 3e4, 1e6}) {
            const glm::dvec3 eyeM(0, shape_.radiusM + heightM, 0);
            expectFinite(eyeM, glm::normalize(glm::dvec3(1, 0.02, 0)), 5e5);
        }
    }
}

TEST_F(Air, SmallPlanetsLookAsLargeOnes) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, 0.6, 0.3));
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.7, 0.3, 0.5));
    const std::vector<glm::vec4> large = ask(0, 1.01 * shape_.radiusM * up, sun, 1);
    shape_.radiusM /= 40;
    const std::vector<glm::vec4> small = ask(0, 1.01 * shape_.radiusM * up, sun, 1);
    for (std::size_t i = 0; i < large.size(); ++i) {
        if (nearHorizon(rayTowards(directionOf(static_cast<int>(i)), 1.01 * shape_.radiusM * up, sun)))
            continue;
        EXPECT_NEAR(small[i].b, large[i].b, 0.01f * large[i].b + 1e-3f) << i;
    }
}

TEST_F(Air, TheSunsDiskIsAsLargeAsTheSun) {
    const glm::dvec3 eyeM(0, 0, shape_.radiusM);
    const glm::dvec3 ray = directionOf(20 * directionsASide + 7);
    EXPECT_EQ(ask(7, eyeM, -ray, 1)[20 * directionsASide + 7].r, 0);
    EXPECT_GT(ask(7, eyeM, ray, 1)[20 * directionsASide + 7].r, 0.99f);
    const glm::dvec3 aside = glm::normalize(glm::cross(ray, glm::dvec3(0, 0, 1)));
    EXPECT_GT(ask(7, eyeM, glm::normalize(ray + 0.004 * aside), 1)[20 * directionsASide + 7].r, 0.5f);
    EXPECT_EQ(ask(7, eyeM, glm::normalize(ray + 0.0056 * aside), 1)[20 * directionsASide + 7].r, 0);
}

TEST_F(Air, ExposureIsOneNearGroundByDayLessFromSpaceMoreAtDusk) {
    const AirTables tables = makeAirTables(atmosphereOf({}));
    const auto light = [&](double heightM, const glm::dvec3& sun) {
        return airUniforms(tables, drawing_, {0, 0, shape_.radiusM + heightM}, shape_.radiusM, sun).light.g;
    };
    const float noon = light(2, {0, 0, 1});
    EXPECT_EQ(light(2000, glm::normalize(glm::dvec3(1, 0, 0.3))), noon);
    EXPECT_LT(light(4e5, {0, 0, 1}), 0.7f * noon);
    EXPECT_EQ(light(4e5, {1, 0, 0}), light(4e5, {0, 0, 1}));
    EXPECT_GT(light(2, glm::normalize(glm::dvec3(1, 0, -0.1))), 4 * noon);
    drawing_.exposure = 2;
    EXPECT_NEAR(light(2, {0, 0, 1}), 2 * noon, 1e-5f);
}

TEST_F(Air, APlanetThatTakesAnothersPlaceNeedNotWaitForItsTables) {
    const AirSettings hazy{.haze = 3};
    ASSERT_TRUE(textures_.follow(hazy, false));
    AirTextures next;
    ASSERT_TRUE(next.follow(hazy, false));
    EXPECT_EQ(next.figures().tablesMs, textures_.figures().tablesMs);  // not made again
    EXPECT_EQ(next.tables().sky.texels, textures_.tables().sky.texels);
    EXPECT_GT(next.figures().tableBytes, 0u);
    ASSERT_TRUE(next.follow({.haze = 2}, false));
    EXPECT_NE(next.figures().tablesMs, textures_.figures().tablesMs);
    EXPECT_NE(next.tables().sky.texels, textures_.tables().sky.texels);
}

TEST_F(Air, InTheBackgroundTheLastTablesStayUntilNewOnesHaveCome) {
    ASSERT_TRUE(textures_.follow({}, false));
    EXPECT_FALSE(textures_.figures().working);
    EXPECT_GT(textures_.figures().tablesMs, 0);
    EXPECT_GT(textures_.figures().tableBytes, 0u);
    const AirSettings hazy{.haze = 4};
    ASSERT_TRUE(textures_.follow(hazy, true));
    EXPECT_TRUE(textures_.figures().working);
    EXPECT_EQ(textures_.tables().air.hazeScattered, atmosphereOf({}).hazeScattered);
    // Who cannot wait for the next frame gets them at once, whatever was on its way.
    const AirSettings clear{.haze = 0.5};
    ASSERT_TRUE(textures_.follow(clear, false));
    EXPECT_FALSE(textures_.figures().working);
    EXPECT_EQ(textures_.tables().air.hazeScattered, atmosphereOf(clear).hazeScattered);
}

TEST_F(Air, InTheBackgroundTheFirstTablesAreNotWaitedForEither) {
    const AirSettings hazy{.haze = 5.25};  // that no other test has tables of
    ASSERT_TRUE(textures_.follow(hazy, true));
    EXPECT_TRUE(textures_.figures().working);
    EXPECT_FALSE(textures_.exist());
    ASSERT_TRUE(textures_.follow(hazy, false));
    EXPECT_FALSE(textures_.figures().working);
    EXPECT_TRUE(textures_.exist());
    EXPECT_EQ(textures_.tables().air.hazeScattered, atmosphereOf(hazy).hazeScattered);
}

class AirPicture : public GlTest {
protected:
    AirPicture() : planet_({}, 32) {
        planet_.addLevel(1, [](const glm::dvec3&) { return 100.0; });
        settings_.surface = SurfaceColour::HeightRamp;
        settings_.ramp = {{0, {0.5f, 0.5f, 0.5f}}};
        settings_.light.air.use = FeatureUse::On;
        settings_.sunDirection = glm::normalize(glm::dvec3(1, 0.3, 0.2));
    }

    glm::dvec3 mean(const View& view) {
        const Picture picture = drawPicture(planet_.renderer(), view, planet_.items(), settings_);
        glm::dvec3 sum(0);
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) sum += glm::dvec3(picture.at(x, y));
        }
        return sum / static_cast<double>(picture.width * picture.height);
    }

    TestPlanet planet_;
    RenderSettings settings_;
};

TEST_F(AirPicture, GroundByDayIsAboutAsBrightAsInTheThinAir) {
    const View view = viewFrom(planet_.shape(), 10, 10, 3000, -90, 0, 80, 60);
    const glm::dvec3 physical = mean(view);
    settings_.light.air.use = FeatureUse::Off;
    const glm::dvec3 thin = mean(view);
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(physical[channel], thin[channel], 20);
}

TEST_F(AirPicture, AutomaticLeavesItOffWhereTheCpuDraws) {
    const View view = viewFrom(planet_.shape(), 10, 10, 3e6, -90, 0, 80, 60);
    const glm::dvec3 on = mean(view);
    settings_.light.air.use = FeatureUse::Automatic;
    const glm::dvec3 automatic = mean(view);
    settings_.light.air.use = FeatureUse::Off;
    const glm::dvec3 off = mean(view);
    EXPECT_NE(on, off);
    EXPECT_EQ(automatic, planet_.renderer().capabilities().software ? off : on);
}

TEST_F(AirPicture, WithoutAtmosphereThereIsNeither) {
    const View view = viewFrom(planet_.shape(), 10, 10, 3000, 20, 0, 80, 60);
    settings_.atmosphere = false;
    settings_.lighting = false;
    const glm::dvec3 asked = mean(view);
    settings_.light.air.use = FeatureUse::Off;
    EXPECT_EQ(asked, mean(view));
    EXPECT_EQ(planet_.renderer().airFigures().tablesMs, 0);
}

TEST_F(AirPicture, TheSkyIsBlueByDayAndDarkByNight) {
    const glm::dvec3 day = mean(viewFrom(planet_.shape(), 10, 10, 500, 45, 0, 80, 60));
    EXPECT_GT(day.b, day.r + 30);
    EXPECT_GT(day.b, 90);
    const glm::dvec3 night = mean(viewFrom(planet_.shape(), -10, 190, 500, 45, 0, 80, 60));
    EXPECT_LT(night.r + night.g + night.b, 30);
}

TEST_F(AirPicture, FarGroundPalesWithDistance) {
    const View view = viewFrom(planet_.shape(), 10, 10, 2000, -5);
    const Picture picture = drawPicture(planet_.renderer(), view, planet_.items(), settings_);
    // The ground is grey; in the distance the air makes it bluer, more and more.
    int last = -1000;
    for (const int y : {235, 160, 120, 105}) {
        const glm::ivec3 colour = picture.at(160, y);
        EXPECT_GT(colour.b - colour.r, last) << y;
        last = colour.b - colour.r;
    }
}

TEST_F(AirPicture, NoPixelIsBlackByDayWhereverTheEyeIs) {
    TestPlanet rough({}, 32);
    rough.addLevel(1,
                   [](const glm::dvec3& d) { return 9000 * std::sin(40 * d.x) * std::cos(31 * d.y + d.z); });
    struct Place {
        double latitudeDeg, heightM, pitchDeg;
    };
    for (const Place& place : {Place{90, 12e3, -20}, Place{17, 0, 5}, Place{-40, -3000, -30},
                               Place{3, 2, -90}, Place{-90, 2e4, 0}}) {
        const View view =
            viewFrom(rough.shape(), place.latitudeDeg, 20, place.heightM, place.pitchDeg, 30, 80, 60);
        settings_.sunDirection = glm::normalize(view.eyeM) + glm::dvec3(0.1, 0.2, 0);
        for (const bool sea : {true, false}) {
            settings_.sea = sea;
            const Picture picture = drawPicture(rough.renderer(), view, rough.items(), settings_);
            for (int y = 0; y < picture.height; ++y) {
                for (int x = 0; x < picture.width; ++x)
                    ASSERT_GT(picture.brightness(x, y), 15) << place.heightM << " m: " << x << " " << y;
            }
        }
    }
}

// Rays that fall from the eye to a black plateau beyond the horizon rise again before they end, behind some
// 100 km of air: all of it is bright.
TEST_F(AirPicture, AnalyticAirLiesBeforeHighGroundAtTheHorizonToo) {
    TestPlanet plateau({}, 384);
    plateau.addLevel(3, [](const glm::dvec3& d) { return d.y > 0.015 ? 8000.0 : 0.0; });
    settings_.light.air.use = FeatureUse::Off;
    settings_.ramp = {{0, {0.05f, 0.05f, 0.05f}}};
    settings_.detail = FeatureUse::Off;
    settings_.sunDirection = directionFromGeographic({0.5, 0.1});
    View view = viewFrom(plateau.shape(), 0.1, 0, 3000, 0, 90, 160, 240);
    view.horizontalFovRad = 0.17;
    const Picture picture = drawPicture(plateau.renderer(), view, plateau.items(), settings_);
    int aboveTheEye = 0;
    for (int x = 0; x < picture.width; ++x) {
        for (int y = 0; y < picture.height / 2 + 15; ++y) {
            if (!picture.isGround(x, y)) continue;
            aboveTheEye += y < picture.height / 2 ? 1 : 0;
            EXPECT_GT(picture.brightness(x, y), 300) << x << ' ' << y;
        }
    }
    EXPECT_GT(aboveTheEye, 4 * picture.width);
}

// Light and air worked out at the corners of small triangles or at each pixel: the same picture.
TEST_F(AirPicture, ByVertexOrByPixelIsTheSame) {
    TestPlanet fine({}, 400);
    fine.addLevel(2, [](const glm::dvec3&) { return 100.0; });
    const View view = viewFrom(fine.shape(), 10, 40, 2e7, -90, 0, 160, 120);
    // A GPU would draw these, and they ask for light by pixel.
    settings_.light.sea.use = FeatureUse::Off;
    settings_.light.shadows.use = FeatureUse::Off;
    settings_.layers.use = FeatureUse::Off;
    settings_.detail = FeatureUse::Off;
    const Picture byVertex = drawPicture(fine.renderer(), view, fine.items(), settings_);
    settings_.layers.use = FeatureUse::On;
    settings_.layers.set.layers = {TextureLayer{}};
    settings_.layers.pictures = {0};
    settings_.layers.opacity = 1e-9;  // which asks for light by pixel
    settings_.layers.endM = 1e9;
    const Picture byPixel = drawPicture(fine.renderer(), view, fine.items(), settings_);
    int most = 0;
    for (std::size_t i = 0; i < byVertex.rgb.size(); ++i)
        most = std::max(most, std::abs(byVertex.rgb[i] - byPixel.rgb[i]));
    EXPECT_NE(byVertex.rgb, byPixel.rgb);
    EXPECT_LE(most, 12);
}

}  // namespace
}  // namespace planet::gl
