// Pictures made byte by byte, against what their mix and their difference must be.
#include "planet/gl/measure/picture_comparer.h"

#include <random>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

struct Bytes {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  // rows from the bottom, as textures have them

    std::uint8_t& at(int x, int y, int channel) {
        return rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x)) +
                    static_cast<std::size_t>(channel)];
    }
};

Bytes noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Bytes bytes{width, height, {}};
    bytes.rgba.resize(4 * static_cast<std::size_t>(width * height));
    for (std::uint8_t& byte : bytes.rgba) byte = static_cast<std::uint8_t>(random() % 256);
    return bytes;
}

Texture textureOf(const Bytes& bytes) {
    Texture texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, bytes.width, bytes.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 bytes.rgba.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    return texture;
}

class PictureComparerTest : public GlTest {
protected:
    Picture draw(const Bytes& a, const Bytes& b, const PictureMix& mix) {
        const Texture textureA = textureOf(a), textureB = textureOf(b);
        const RenderTarget target = valueOf(RenderTarget::create(a.width, a.height));
        target.bind();
        comparer_.draw(textureA.name(), textureB.name(), a.width, a.height, mix);
        return {a.width, a.height, target.readRgb(), {}};
    }
    PictureDifference count(const Bytes& a, const Bytes& b) {
        const Texture textureA = textureOf(a), textureB = textureOf(b);
        const PictureDifference difference =
            comparer_.count(textureA.name(), textureB.name(), a.width, a.height);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        return difference;
    }
    static glm::ivec3 colour(Bytes& bytes, int x, int yFromTop) {
        const int y = bytes.height - 1 - yFromTop;
        return {bytes.at(x, y, 0), bytes.at(x, y, 1), bytes.at(x, y, 2)};
    }

    PictureComparer comparer_ = valueOf(PictureComparer::create());
};

TEST_F(PictureComparerTest, AWipeShowsExactPixelsOfAOnTheLeftAndOfBOnTheRight) {
    Bytes a = noise(37, 20, 1), b = noise(37, 20, 2);
    for (const double share : {0.0, 0.3, 0.5, 1.0}) {
        const PictureMix mix = wipeMix(37, share);
        const Picture mixed = draw(a, b, mix);
        for (int y = 0; y < 20; ++y) {
            for (int x = 0; x < 37; ++x)
                ASSERT_EQ(mixed.at(x, y), colour(x < mix.border ? a : b, x, y)) << share << ": " << x;
        }
    }
    EXPECT_EQ(wipeMix(37, 0.3).border, 11);
    EXPECT_EQ(wipeMix(37, -1).border, 0);
    EXPECT_EQ(wipeMix(37, 7).border, 37);
}

TEST_F(PictureComparerTest, SideBySideShowsTheMiddleHalfOfEachUnscaled) {
    for (const int width : {36, 37, 38, 39}) {
        Bytes a = noise(width, 5, 3), b = noise(width, 5, 4);
        const PictureMix mix = sideBySideMix(width);
        const Picture mixed = draw(a, b, mix);
        for (int x = 0; x < width; ++x) {
            const int column = static_cast<int>(pictureColumn(mix, x));
            ASSERT_GE(column, 0);
            ASSERT_LT(column, width);
            ASSERT_EQ(mixed.at(x, 2), colour(x < mix.border ? a : b, column, 2)) << x;
        }
        // Both halves begin at the same column.
        EXPECT_EQ(pictureColumn(mix, 0), pictureColumn(mix, mix.border));
    }
}

TEST_F(PictureComparerTest, OnlyOneOfThemIsShownWhole) {
    Bytes a = noise(20, 9, 5), b = noise(20, 9, 6);
    const Picture first = draw(a, b, onlyMix(20, false));
    const Picture second = draw(a, b, onlyMix(20, true));
    for (int x = 0; x < 20; ++x) {
        EXPECT_EQ(first.at(x, 4), colour(a, x, 4));
        EXPECT_EQ(second.at(x, 4), colour(b, x, 4));
    }
}

TEST_F(PictureComparerTest, EqualPicturesDifferNowhere) {
    const Bytes a = noise(50, 33, 7);
    EXPECT_EQ(count(a, a), PictureDifference{});
    for (const std::uint8_t byte : draw(a, a, differenceMix(255)).rgb) ASSERT_EQ(byte, 0);
}

TEST_F(PictureComparerTest, PlantedChangesAreCountedExactly) {
    Bytes a = noise(117, 53, 8);
    for (std::uint8_t& byte : a.rgba) byte = static_cast<std::uint8_t>(byte % 128);
    for (const int steps : {1, 2, 3, 40, 127}) {
        Bytes b = a;
        // Corners and borders of blocks too, one channel each; opacity does not count.
        int planted = 0;
        for (int y = 0; y < 53; y += 4) {
            for (int x = 0; x < 117; x += 4, ++planted) {
                std::uint8_t& byte = b.at(x, y, planted % 3);
                byte = static_cast<std::uint8_t>(byte + steps);
                b.at(x, y, 3) = 0;
            }
        }
        const PictureDifference difference = count(a, b);
        EXPECT_EQ(difference.largestSteps, steps);
        EXPECT_EQ(difference.pixels, steps > 1 ? static_cast<std::uint64_t>(planted) : 0u) << steps;
        EXPECT_EQ(count(b, a), difference);
        const Picture shown = draw(a, b, differenceMix(2));
        EXPECT_EQ(shown.at(0, 52), glm::ivec3(std::min(2 * steps, 255), 0, 0));
        EXPECT_EQ(shown.at(4, 52), glm::ivec3(0, std::min(2 * steps, 255), 0));
        EXPECT_EQ(shown.at(1, 52), glm::ivec3(0, 0, 0));
    }
}

TEST_F(PictureComparerTest, PicturesOfAnotherSizeAreCountedToo) {
    for (const int size : {1, 16, 17, 64, 31}) {
        Bytes a = noise(size, size, 9), b = a;
        b.at(size - 1, 0, 1) = static_cast<std::uint8_t>(b.at(size - 1, 0, 1) ^ 0x80u);
        EXPECT_EQ(count(a, b), (PictureDifference{1, 128})) << size;
    }
}

TEST_F(PictureComparerTest, ThePlanetDrawnTwiceWithEqualSettingsDiffersByNoPixel) {
    TestPlanet planet({}, 24);
    planet.addLevel(1, flat);
    const View view = viewFrom({}, 20, 30, 2e6, -60);
    const auto drawn = [&](const RenderSettings& settings) {
        RenderTarget target = valueOf(RenderTarget::create(view.widthPx, view.heightPx));
        target.bind();
        planet.renderer().draw(view, planet.items(), settings, {});
        target.resolve();
        return target;
    };
    RenderSettings settings;
    const RenderTarget a = drawn(settings), same = drawn(settings);
    settings.wireframe = true;
    const RenderTarget other = drawn(settings);
    const auto differenceTo = [&](const RenderTarget& b) {
        return comparer_.count(a.colourTexture(), b.colourTexture(), view.widthPx, view.heightPx);
    };
    EXPECT_EQ(differenceTo(same), PictureDifference{});
    EXPECT_GT(differenceTo(other).pixels, 100u);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace
}  // namespace planet::gl
