// Lines in pictures, against where projection says they must be.
#include "planet/gl/draw/debug_lines.h"

#include <optional>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

constexpr LineColour red = {255, 0, 0, 255};

// Where a point falls in a picture, pixels from the upper left corner; none behind the eye.
std::optional<glm::dvec2> pixelInFront(const View& view, const glm::dvec3& pointM) {
    const glm::dvec3 camera = cameraFromWorldRotation(view) * (pointM - view.eyeM);
    if (camera.z >= 0) return std::nullopt;
    const double scale = screenScalePx(view) / -camera.z;
    return glm::dvec2(view.widthPx / 2.0 + camera.x * scale, view.heightPx / 2.0 - camera.y * scale);
}

// A target with a fixed-point depth buffer, which gets the classic projection.
struct PlainTarget {
    PlainTarget(int width, int height) {
        glBindTexture(GL_TEXTURE_2D, colour.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour.name(), 0);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    }
    Texture colour = makeTexture();
    Renderbuffer depth = makeRenderbuffer();
    Framebuffer framebuffer = makeFramebuffer();
};

class DebugLinesTest : public GlTest {
protected:
    DebugLinesTest() { planet_.addLevel(1, flat); }

    Picture draw(const View& view, std::span<const LineVertex> lines, float widthPx, LineDepth depth,
                 bool plain = false, bool withPlanet = true) {
        const RenderTarget target = valueOf(RenderTarget::create(view.widthPx, view.heightPx));
        const PlainTarget plainTarget(view.widthPx, view.heightPx);
        if (!plain) target.bind();
        RenderSettings settings = plainSettings();
        const std::vector<DrawItem> items = withPlanet ? planet_.items() : std::vector<DrawItem>{};
        planet_.renderer().draw(view, items, settings, oneTint(items.size(), {0, 0, 60, 255}));
        EXPECT_EQ(planet_.renderer().projection().reversedZ, !plain && hasClipControl());
        lines_.draw(view, planet_.renderer().projection(), lines, widthPx, depth);
        Picture picture{view.widthPx, view.heightPx, {}, {}};
        picture.rgb.resize(static_cast<std::size_t>(3 * view.widthPx * view.heightPx));
        std::vector<std::uint8_t> fromBelow(picture.rgb.size());
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, view.widthPx, view.heightPx, GL_RGB, GL_UNSIGNED_BYTE, fromBelow.data());
        const auto row = static_cast<std::size_t>(3 * view.widthPx);
        for (std::size_t y = 0; y < static_cast<std::size_t>(view.heightPx); ++y)
            std::copy_n(fromBelow.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                        picture.rgb.end() - static_cast<std::ptrdiff_t>((y + 1) * row));
        return picture;
    }

    // Stars have none.
    static int redAt(const Picture& picture, const glm::dvec2& pixel) {
        const auto x = static_cast<int>(std::floor(pixel.x));
        const auto y = static_cast<int>(std::floor(pixel.y));
        return picture.at(x, y).x - picture.at(x, y).y;
    }
    static bool isInside(const View& view, const glm::dvec2& pixel) {
        return pixel.x >= 2 && pixel.y >= 2 && pixel.x < view.widthPx - 2 && pixel.y < view.heightPx - 2;
    }

    TestPlanet planet_{{}, 24};
    DebugLines lines_ = valueOf(DebugLines::create());
};

TEST_F(DebugLinesTest, ALinesPixelsAreWhereProjectionSays) {
    const View view = viewFrom({}, 20, 30, 1000, 10, 50, 320, 200);
    for (const bool plain : {false, true}) {
        for (const double metres : {50.0, 5e5}) {
            const auto at = [&](double x, double y, double depth) {
                return view.eyeM + metres * (x * view.right + y * view.up - depth * view.back);
            };
            const Lines lines = {{at(-0.4, -0.1, 1), red}, {at(1.5, 1.2, 4), red}};
            const Picture picture = draw(view, lines, 3, LineDepth::InFront, plain, false);
            const glm::dvec2 start = *pixelInFront(view, lines[0].positionM);
            const glm::dvec2 along = *pixelInFront(view, lines[1].positionM) - start;
            const glm::dvec2 across = glm::normalize(glm::dvec2(-along.y, along.x));
            ASSERT_GT(glm::length(along), 100);
            for (double share = 0.02; share < 1; share += 0.02) {
                const glm::dvec2 middle = start + share * along;
                EXPECT_GT(redAt(picture, middle), 240) << share;
                for (const double side : {-5.0, 5.0}) EXPECT_LT(redAt(picture, middle + side * across), 60);
            }
            for (const double share : {-0.05, 1.05}) EXPECT_LT(redAt(picture, start + share * along), 60);
        }
    }
}

TEST_F(DebugLinesTest, AWidthIsThatManyPixelsOfLight) {
    const View view = viewFrom({}, 0, 0, 1000, 10, 0, 200, 100);
    for (const float widthPx : {1.0f, 2.5f, 7.0f, 16.0f}) {
        const auto at = [&](double x) { return view.eyeM + x * view.right + 0.003 * view.up - view.back; };
        const Lines lines = {{at(-1), red}, {at(1), red}};
        const Picture picture = draw(view, lines, widthPx, LineDepth::InFront, false, false);
        for (const int x : {10, 90, 180}) {
            double light = 0;
            for (int y = 0; y < 100; ++y) light += redAt(picture, {x, y});
            EXPECT_NEAR(light / 255, static_cast<double>(widthPx), 0.15);
        }
    }
}

TEST_F(DebugLinesTest, ALineThatPassesTheEyeIsSeenAsFarAsItLiesBeforeIt) {
    const View view = viewFrom({}, -10, 100, 2000, 20, 200, 320, 200);
    for (const double aside : {-0.3, 0.2, 40.0}) {
        const auto at = [&](double depth) {
            return view.eyeM + aside * view.right - 0.2 * view.up - depth * view.back;
        };
        const Lines forwards = {{at(500), red}, {at(-300), red}};
        const Lines backwards = {{at(-300), red}, {at(500), red}};
        for (const Lines& lines : {forwards, backwards}) {
            const Picture picture = draw(view, lines, 3, LineDepth::InFront, false, false);
            int seen = 0;
            for (double depth = 499; depth > 0.1; depth *= 0.98) {
                const std::optional<glm::dvec2> pixel = pixelInFront(view, at(depth));
                if (!isInside(view, *pixel)) continue;
                EXPECT_GT(redAt(picture, *pixel), 240) << aside << " " << depth;
                ++seen;
            }
            EXPECT_GT(seen, 20);
            // Nothing on the other side of the point where it vanishes.
            const glm::dvec2 far = *pixelInFront(view, at(1e9));
            const glm::dvec2 opposite = 2.0 * far - *pixelInFront(view, at(std::abs(aside) * 2 + 1));
            if (isInside(view, opposite)) {
                EXPECT_LT(redAt(picture, opposite), 100);
            }
        }
    }
}

TEST_F(DebugLinesTest, WhatLiesBehindTheEyeIsNotSeen) {
    const View view = viewFrom({}, 0, 0, 1000, 10, 0, 100, 100);
    const auto at = [&](double x, double depth) { return view.eyeM + x * view.right - depth * view.back; };
    const Lines lines = {{at(-1, -2), red}, {at(1, -0.5), red}, {at(0, -1), red}, {at(0, 0), red}};
    EXPECT_EQ(draw(view, lines, 5, LineDepth::InFront).rgb, draw(view, {}, 5, LineDepth::InFront).rgb);
}

TEST_F(DebugLinesTest, ThePlanetHidesLinesBehindItAsAskedFor) {
    const View view = viewFrom({}, 0, 0, 1e7, -90, 0, 300, 300);
    // Straight through the planet.
    const Lines lines = {{{9e6, -3e6, 1e6}, red}, {{-9e6, 5e6, 1e6}, red}};
    for (const bool plain : {false, true}) {
        const Picture none = draw(view, {}, 3, LineDepth::Hidden, plain);
        const auto atShare = [&](const Picture& picture, double share) {
            const glm::dvec3 pointM = glm::mix(lines[0].positionM, lines[1].positionM, share);
            return redAt(picture, *pixelInFront(view, pointM));
        };
        // Enters the sphere of 6371 km between, comes out between, from the two roots of the quadratic.
        const glm::dvec3 d = lines[1].positionM - lines[0].positionM;
        const double b = glm::dot(lines[0].positionM, d) / glm::dot(d, d);
        const double c =
            (glm::dot(lines[0].positionM, lines[0].positionM) - 6.371e6 * 6.371e6) / glm::dot(d, d);
        const double enters = -b - std::sqrt(b * b - c);
        ASSERT_GT(enters, 0.1);
        const Picture hidden = draw(view, lines, 3, LineDepth::Hidden, plain);
        const Picture faint = draw(view, lines, 3, LineDepth::Faint, plain);
        const Picture inFront = draw(view, lines, 3, LineDepth::InFront, plain);
        for (const double share : {0.3 * enters, 0.9 * enters}) {
            for (const Picture* picture : {&hidden, &faint, &inFront})
                EXPECT_GT(atShare(*picture, share), 240);
        }
        for (const double share : {enters + 0.05, enters + 0.2}) {
            EXPECT_EQ(atShare(hidden, share), atShare(none, share)) << plain;
            EXPECT_NEAR(atShare(faint, share), 255 / 4, 2);
            EXPECT_GT(atShare(inFront, share), 240);
        }
    }
}

TEST_F(DebugLinesTest, ColoursRunAlongALineAndOpacityCounts) {
    const View view = viewFrom({}, 0, 0, 1e7, -90, 0, 200, 100);
    const auto at = [&](double x) { return view.eyeM + x * view.right - view.back; };
    const Lines lines = {{at(-0.5), {255, 0, 0, 255}}, {at(0.5), {0, 0, 255, 255}}};
    const Picture picture = draw(view, lines, 5, LineDepth::InFront);
    EXPECT_GT(picture.at(20, 50).x, picture.at(20, 50).z);
    EXPECT_NEAR(picture.at(100, 50).x, 127, 4);
    EXPECT_GT(picture.at(180, 50).z, picture.at(180, 50).x);
    const Lines half = {{at(-0.5), {255, 0, 0, 128}}, {at(0.5), {255, 0, 0, 128}}};
    EXPECT_NEAR(draw(view, half, 5, LineDepth::InFront).at(100, 50).x, 128, 2);
}

TEST_F(DebugLinesTest, StateIsLeftAsANewContextHasIt) {
    const View view = viewFrom({}, 0, 0, 1e7, -90, 0, 20, 20);
    const Lines lines = {{{9e6, 0, 0}, red}, {{9e6, 1e6, 0}, red}};
    draw(view, lines, 2, LineDepth::Faint);
    EXPECT_EQ(lines_.gpuBytes(), 32u);
    for (const GLenum switched :
         std::to_array<GLenum>({GL_DEPTH_TEST, GL_BLEND, GL_DEPTH_CLAMP, GL_CULL_FACE}))
        EXPECT_FALSE(glIsEnabled(switched));
    GLint value = 0;
    glGetIntegerv(GL_DEPTH_FUNC, &value);
    EXPECT_EQ(value, GL_LESS);
    if (hasClipControl()) {
        glGetIntegerv(GL_CLIP_DEPTH_MODE, &value);
        EXPECT_EQ(value, GL_NEGATIVE_ONE_TO_ONE);
    }
    glGetIntegerv(GL_BLEND_SRC_RGB, &value);
    EXPECT_EQ(value, GL_ONE);
    GLboolean writes = GL_FALSE;
    glGetBooleanv(GL_DEPTH_WRITEMASK, &writes);
    EXPECT_EQ(writes, GL_TRUE);
}

}  // namespace
}  // namespace planet::gl
