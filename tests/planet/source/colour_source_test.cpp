#include "planet/source/colour_source.h"
#include "planet/source/height_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"
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
    EXPECT_NE(colourErrorOf(folder / "five.tif").find("five.tif: has 5 channels"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "signed.tif").find("has colours of type int16"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "square.png").find("twice as wide as high"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "raw").find("raw faces hold heights"), std::string::npos);
    EXPECT_NE(colourErrorOf(folder / "none.png").find("no such file"), std::string::npos);
}

// The colour of a face's sample, row 0 at the top, in a channel's own units.
using FaceColour = std::function<double(Face face, int column, int row, int channel)>;

template <class T>
void writeColourFaces(const std::filesystem::path& stem, const std::string& extension, int size,
                      const FaceColour& colour) {
    for (const Face face : allFaces) {
        test::writeColours<T>(
            stem.string() + "_" + std::string(faceName(face)) + extension, size, size, 3,
            [&](int column, int row, int channel) { return colour(face, column, row, channel); });
    }
}

// Continuous over the cube, in [0, 255].
double smoothColour(Face face, int column, int row, int size) {
    const glm::dvec3 direction =
        sphereFromCube(cubePoint(face, 2.0 * column / (size - 1) - 1, 1 - 2.0 * row / (size - 1)));
    return 127.5 + 127.5 * std::sin(5 * direction.x + 2 * direction.y + 7 * direction.z);
}

std::string noticeOf(const std::filesystem::path& path) {
    const Result<ColourSource> source = openColourSource(path);
    EXPECT_TRUE(source) << source.error().message;
    return source ? source->notice : std::string();
}

TEST(ColourSource, FacesThatDifferVisiblyAlongTheirEdgesGetANotice) {
    const TemporaryFolder folder;
    constexpr int size = 33;
    const auto turned = [](Face face, int column, int row) {
        return face == Face::PosZ ? smoothColour(face, row, size - 1 - column, size)
                                  : smoothColour(face, column, row, size);
    };
    writeColourFaces<std::uint8_t>(folder / "turned", ".png", size, [&](Face face, int column, int row, int) {
        return turned(face, column, row);
    });
    using ::testing::AllOf;
    using ::testing::HasSubstr;
    using ::testing::MatchesRegex;
    const std::string notice = noticeOf(folder / "turned");
    EXPECT_THAT(notice, MatchesRegex("turned: the colours of faces [xy]_(pos|neg) and z_pos differ along "
                                     "their shared edge, the top row of [xy]_(pos|neg) and the .* of z_pos: "
                                     ".*4 of 12 edges differ so and will show a seam.*"));
    EXPECT_THAT(notice, Not(HasSubstr(" m ")));
    // The notice is that of the channel with the most seams. Values above 1 count as 1.
    writeColourFaces<float>(folder / "blue", ".exr", size, [](Face face, int column, int row, int channel) {
        if (channel == 0) return face == Face::PosX && column == 0 ? 1.0 : 0.0;
        if (channel == 1) return face == Face::PosX ? 3.0 : 2.0;
        return face == Face::NegY || face == Face::NegX ? smoothColour(face, column, row, size) / 255 : 0.0;
    });
    EXPECT_THAT(noticeOf(folder / "blue"), AllOf(HasSubstr("_neg"), HasSubstr("6 of 12 edges")));
}

TEST(ColourSource, FacesThatAgreeOrDifferLittleGetNoNotice) {
    const TemporaryFolder folder;
    constexpr int size = 65;
    const auto same = [](Face face, int column, int row, int) {
        return std::round(smoothColour(face, column, row, size));
    };
    writeColourFaces<std::uint8_t>(folder / "same", ".png", size, same);
    EXPECT_EQ(noticeOf(folder / "same"), "");
    writeColourFaces<std::uint8_t>(folder / "lossy", ".jpg", size, same);
    EXPECT_EQ(noticeOf(folder / "lossy"), "");
    // A lossy picture differs like this: all samples a little, and less than a tenth of an edge by much.
    writeColourFaces<std::uint8_t>(
        folder / "near", ".png", size, [&](Face face, int column, int row, int channel) {
            if (face == Face::PosY && column == 0 && row < 6) return 255 - same(face, column, row, channel);
            const int noise = (column * 7 + row * 13 + static_cast<int>(face) * 5) % 11 - 5;
            return std::clamp(same(face, column, row, channel) + noise, 0.0, 255.0);
        });
    EXPECT_EQ(noticeOf(folder / "near"), "");
    test::writeColours<std::uint8_t>(folder / "whole.png", 64, 32, 3, [](int, int, int) { return 9.0; });
    EXPECT_EQ(noticeOf(folder / "whole.png"), "");
}

TEST(ColourSource, HeightsMustStillBeOneChannel) {
    const TemporaryFolder folder;
    test::writeColours<std::uint8_t>(folder / "rgb.png", 64, 32, 3, [](int, int, int) { return 1.0; });
    const auto source = openHeightSource(folder / "rgb.png", {});
    ASSERT_FALSE(source);
    EXPECT_NE(source.error().message.find("expected one grey channel"), std::string::npos);
}

using test::finest;
using test::gridAround;
using test::SampleGrid;
using test::writeRaster;

// The sRGB of a colour at a place on the finest grid, [0, 255].
glm::dvec3 srgbNear(const ColourSource& source, double latitudeDeg, double longitudeDeg) {
    const FacePoint point = facePointFromDirection(
        directionFromGeographic({latitudeDeg * test::radPerDeg, longitudeDeg * test::radPerDeg}));
    const auto at = [](double coordinate) {
        return static_cast<int>(std::lround((coordinate + 1) / 2 * finest));
    };
    std::vector<glm::vec3> out(1);
    EXPECT_TRUE(source.sample({point.face, finest, at(point.u), at(point.v), 1, 1}, out));
    glm::dvec3 srgb;
    for (int channel = 0; channel < 3; ++channel) {
        const auto linear = static_cast<double>(out[0][channel]);
        srgb[channel] =
            255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
    }
    return srgb;
}

void expectNear(const glm::dvec3& colour, const glm::dvec3& expected) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(colour[channel], expected[channel], 0.1) << channel;
}

// Bands of one value each.
std::vector<std::vector<float>> bandsOf(const SampleGrid& grid, const std::vector<float>& values) {
    std::vector<std::vector<float>> bands;
    for (const float value : values)
        bands.emplace_back(static_cast<std::size_t>(grid.width * grid.height), value);
    return bands;
}

TEST(ColourSource, GeoreferencedPicturesAreReadByTheirBandsColours) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(32632, 9, 46, 51, 51, 100);
    writeRaster(folder / "rgb.tif", grid, std::vector<float>(),
                {.type = GDT_Byte, .bands = 3, .bandSamples = bandsOf(grid, {200, 100, 50})});
    writeRaster(folder / "rgba.tif", grid, std::vector<float>(),
                {.type = GDT_Byte,
                 .bands = 4,
                 .bandSamples = bandsOf(grid, {200, 100, 50, 255}),
                 .options = {"PHOTOMETRIC=RGB", "ALPHA=YES"}});
    writeRaster(
        folder / "16.tif", grid, std::vector<float>(),
        {.type = GDT_UInt16, .bands = 3, .bandSamples = bandsOf(grid, {200 * 257, 100 * 257, 50 * 257})});
    writeRaster(folder / "palette.tif", grid, std::vector<float>(51 * 51, 1),
                {.type = GDT_Byte, .palette = {{9, 9, 9, 255}, {200, 100, 50, 255}}});
    for (const char* name : {"rgb.tif", "rgba.tif", "16.tif", "palette.tif"}) {
        SCOPED_TRACE(name);
        const auto source = openColourSource(folder / name);
        ASSERT_TRUE(source) << source.error().message;
        expectNear(srgbNear(*source, 46, 9), {200, 100, 50});
        expectNear(srgbNear(*source, 46.1, 9), {0, 0, 0});
        ASSERT_TRUE(source->finestCells);
        EXPECT_EQ(source->finestCells({Face::NegX, 3, 0, 0}), 1);
    }
    writeRaster(folder / "grey.tif", grid, std::vector<float>(51 * 51, 70), {.type = GDT_Byte});
    const auto grey = openColourSource(folder / "grey.tif");
    ASSERT_TRUE(grey) << grey.error().message;
    expectNear(srgbNear(*grey, 46, 9), {70, 70, 70});
}

TEST(ColourSource, LayersOfColourShowWhatLiesUnderTheirVoids) {
    const TemporaryFolder folder;
    test::writeColours<std::uint8_t>(folder / "base.png", 64, 32, 3,
                                     [](int, int, int channel) { return 30.0 * (channel + 1); });
    const SampleGrid grid = gridAround(4326, 10, 45, 101, 101, 0.01);
    std::vector<std::vector<float>> bands = bandsOf(grid, {0, 250, 0});
    // A pixel is a void if all of its bands have the no-data value, which is also the red of the others.
    for (int row = 40; row <= 60; ++row) {
        for (int column = 40; column <= 60; ++column)
            bands[1][static_cast<std::size_t>(row * 101 + column)] = 0;
    }
    writeRaster(folder / "inset.tif", grid, std::vector<float>(),
                {.type = GDT_Byte, .bands = 3, .noData = 0, .bandSamples = bands});
    writeBytes(folder / "world.toml",
               "[[colour]]\nfiles = \"base.png\"\n[[colour]]\nfiles = \"inset.tif\"\n");
    EXPECT_TRUE(hasColourLayers(folder / "world.toml"));
    const auto source = openColourSource(folder / "world.toml");
    ASSERT_TRUE(source) << source.error().message;
    EXPECT_EQ(source->description, "world.toml, 2 layers");
    expectNear(srgbNear(*source, 45.4, 10), {0, 250, 0});
    expectNear(srgbNear(*source, 45, 10), {30, 60, 90});
    expectNear(srgbNear(*source, -20, 100), {30, 60, 90});
    EXPECT_EQ(source->finestCells({Face::NegZ, 0, 0, 0}), 32) << "those of the base";
    EXPECT_THAT(errorOf(folder / "world.toml"),
                testing::HasSubstr("has no layers of elevation; expected tables [[elevation]]"));
}

TEST(ColourSource, LayersOfColourHaveNoKeysOfHeights) {
    const TemporaryFolder folder;
    writeBytes(folder / "world.toml", "[[colour]]\nfiles = \"base.png\"\nscale = 2\n");
    const auto source = openColourSource(folder / "world.toml");
    ASSERT_FALSE(source);
    EXPECT_THAT(
        source.error().message,
        testing::HasSubstr("scale is no key of a layer of colour; expected one of name, files, feather_m"));
}

}  // namespace
}  // namespace planet
