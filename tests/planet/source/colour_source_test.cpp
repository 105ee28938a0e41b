#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/synthetic_colours.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using ::tests::TemporaryFolder;

std::vector<glm::vec3> faceOf(const ColourSource& source, Face face, int cells) {
    std::vector<glm::vec3> out(static_cast<std::size_t>((cells + 1) * (cells + 1)));
    const Result<void> sampled = source.sample({face, cells, 0, 0, cells + 1, cells + 1}, out);
    EXPECT_TRUE(sampled) << sampled.error().message;
    return out;
}

glm::vec3 colourAt(const ColourSource& source, const Geographic& place) {
    constexpr int cells = 64;
    const FacePoint point = facePointFromDirection(directionFromGeographic(place));
    const auto at = [](double coordinate) {
        return static_cast<int>(std::lround((coordinate + 1) / 2 * cells));
    };
    std::vector<glm::vec3> out(1);
    EXPECT_TRUE(source.sample({point.face, cells, at(point.u), at(point.v), 1, 1}, out));
    return out[0];
}

std::string colourErrorOf(const std::filesystem::path& path) {
    const Result<ColourSource> source = openColourSource(path);
    return source ? "opened" : source.error().message;
}

TEST(ColourSource, IntegersAreSrgbAndFloatsAreLinearLight) {
    const TemporaryFolder folder;
    const auto grey = [](double value) { return [value](int, int, int) { return value; }; };
    test::writeColours<std::uint8_t>(folder / "8.png", 64, 32, 3, grey(188));
    test::writeColours<std::uint16_t>(folder / "16.png", 64, 32, 3, grey(188 * 257));
    test::writeColours<float>(folder / "float.exr", 64, 32, 3, grey(0.5));
    for (const char* name : {"8.png", "16.png", "float.exr"}) {
        const auto source = openColourSource(folder / name);
        ASSERT_TRUE(source) << source.error().message;
        for (const glm::vec3& colour : faceOf(*source, Face::PosZ, 16)) {
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(colour[channel], name[0] == 'f' ? 0.5 : 0.50289, 1e-4) << name;
        }
    }
}

TEST(ColourSource, ChannelsAreRedGreenAndBlueWhateverElseThereIs) {
    const TemporaryFolder folder;
    const auto value = [](int, int, int channel) { return channel == 3 ? 128.0 : 40.0 * (channel + 1); };
    test::writeColours<std::uint8_t>(folder / "rgb.png", 64, 32, 3, value);
    test::writeColours<std::uint8_t>(folder / "rgba.png", 64, 32, 4, value);
    test::writeColours<std::uint8_t>(folder / "tiled.tif", 96, 48, 3, value, 32);
    test::writeColours<std::uint8_t>(folder / "grey.png", 64, 32, 1, value);
    const glm::vec3 expected(0.02122f, 0.08022f, 0.18782f);  // sRGB 40, 80, 120
    for (const char* name : {"rgb.png", "rgba.png", "tiled.tif"}) {
        const auto source = openColourSource(folder / name);
        ASSERT_TRUE(source) << source.error().message;
        const glm::vec3 colour = colourAt(*source, {0.3, 1});
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(colour[channel], expected[channel], 1e-4) << name;
    }
    const auto grey = openColourSource(folder / "grey.png");
    ASSERT_TRUE(grey) << grey.error().message;
    EXPECT_EQ(colourAt(*grey, {0, 0}).b, colourAt(*grey, {0, 0}).r);
}

TEST(ColourSource, PlacesAreWhereTheImageHasThem) {
    const TemporaryFolder folder;
    // Red grows to the east, green to the north; blue marks the date line's two sides.
    test::writeColours<float>(folder / "places.exr", 256, 128, 3, [](int column, int row, int channel) {
        if (channel == 0) return (column + 0.5) / 256;
        if (channel == 1) return 1 - (row + 0.5) / 128;
        return column < 16 || column >= 240 ? 1.0 : 0.0;
    });
    const auto source = openColourSource(folder / "places.exr");
    ASSERT_TRUE(source) << source.error().message;
    constexpr double degree = 3.14159265358979 / 180;
    const glm::vec3 east = colourAt(*source, {0, 45 * degree});
    EXPECT_NEAR(east.r, (45 + 180) / 360.0, 0.02);
    EXPECT_NEAR(east.g, 0.5, 0.02);
    EXPECT_NEAR(colourAt(*source, {45 * degree, 0}).g, 135 / 180.0, 0.02);
    EXPECT_EQ(colourAt(*source, {0, 180 * degree}).b, 1);
    EXPECT_EQ(colourAt(*source, {0, -179 * degree}).b, 1);
    EXPECT_EQ(colourAt(*source, {0, 0}).b, 0);
    // A pole is every longitude at once: the mean of the image's row.
    EXPECT_NEAR(colourAt(*source, {90 * degree, 0}).r, 0.5, 0.01);
    EXPECT_NEAR(colourAt(*source, {90 * degree, 0}).b, 32.0 / 256, 0.01);
    EXPECT_NEAR(colourAt(*source, {-90 * degree, 0}).g, 0, 0.01);
}

TEST(ColourSource, WhatCannotBeColoursIsRefusedByName) {
    const TemporaryFolder folder;
    const auto value = [](int, int, int) { return 1.0; };
    test::writeColours<std::uint8_t>(folder / "five.tif", 64, 32, 5, value);
    test::writeColours<std::int16_t>(folder / "signed.tif", 64, 32, 3, value);
    test::writeColours<std::uint8_t>(folder / "square.png", 64, 64, 3, value);
    for (const Face face : allFaces) {
        std::ofstream(folder / ("raw_" + std::string(faceName(face)) + ".raw")) << std::string(9, 'x');
    }
    EXPECT_NE(colourErrorOf(folder / "five.tif").find("five.tif: expected a grey or an RGB image, found 5"),
              std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "signed.tif").find("has colours of type int16"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "square.png").find("twice as wide as high"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "raw").find("raw faces hold heights"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "none.png").find("no such file"), std::string::npos);
}

TEST(ColourSource, HeightsMustStillBeOneChannel) {
    const TemporaryFolder folder;
    test::writeColours<std::uint8_t>(folder / "rgb.png", 64, 32, 3, [](int, int, int) { return 1.0; });
    const auto source = openHeightSource(folder / "rgb.png", {});
    ASSERT_FALSE(source);
    EXPECT_NE(source.error().message.find("expected one grey channel"), std::string::npos);
}

}  // namespace
}  // namespace planet
