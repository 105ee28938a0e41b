#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planet/source/world_file.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::finest;
using test::radPerDeg;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int imageSide = 257;

// A plane that tells columns from rows, with values of 16 bits.
double valueAt(double column, double row) {
    return 1000 + 50 * column + 17 * row;
}

struct Place {
    double latitudeDeg = 0;
    double longitudeDeg = 0;
};

// Returns the place on a sphere to which an equal-area projection takes a distance along a bearing from another.
Place placeFrom(const Place& from, double bearing, double distanceM, double radiusM) {
    const double c = 2 * std::asin(distanceM / (2 * radiusM));
    const double latitude = from.latitudeDeg * radPerDeg;
    const double there =
        std::asin(std::sin(latitude) * std::cos(c) + std::cos(latitude) * std::sin(c) * std::cos(bearing));
    const double east = std::atan2(std::sin(bearing) * std::sin(c) * std::cos(latitude),
                                   std::cos(c) - std::sin(latitude) * std::sin(there));
    return {there / radPerDeg, from.longitudeDeg + east / radPerDeg};
}

class PlacedImage : public testing::Test {
protected:
    PlacedImage() {
        writeImage(folder / "map.png", Image<std::uint16_t>(imageSide, imageSide, valueAt));
        for (const bool big : {false, true}) {
            std::string bytes;
            for (int i = 0; i < imageSide * imageSide; ++i) {
                const auto value = static_cast<std::uint16_t>(valueAt(i % imageSide, i / imageSide));
                const char low = static_cast<char>(value & 255);
                const char high = static_cast<char>(value >> 8);
                bytes += big ? std::string{high, low} : std::string{low, high};
            }
            writeBytes(folder / (big ? "big.raw" : "little.raw"), bytes);
        }
    }

    std::filesystem::path write(const std::string& layer, double radiusM = 6371000) {
        writeBytes(folder / "world.toml",
                   fmt::format("radius_m = {}\nfill_m = -7\n[[elevation]]\n{}\n", radiusM, layer));
        return folder / "world.toml";
    }

    // The heights along both diagonals lie where the definition of the place puts them.
    void expectPlaced(const std::string& layer, const Place& middle, double widthM, double headingDeg,
                      double radiusM = 6371000) {
        const HeightSource world = mustOpen(write(layer, radiusM));
        const double stepM = widthM / (imageSide - 1);
        const double cellM = 2 * radiusM / finest;
        for (int i = 3; i < imageSide - 3; i += 10) {
            for (const int row : {i, imageSide - 1 - i}) {
                const double right = (i - (imageSide - 1) / 2.0) * stepM;
                const double up = ((imageSide - 1) / 2.0 - row) * stepM;
                const double bearing = std::atan2(right, up) + headingDeg * radPerDeg;
                const Place there = placeFrom(middle, bearing, std::hypot(right, up), radiusM);
                ASSERT_NEAR(sampledNear(world, finest, there.latitudeDeg, there.longitudeDeg),
                            valueAt(i, row), 67 * cellM / stepM + 0.1)
                    << layer << " column " << i << " row " << row;
            }
        }
    }

    const TemporaryFolder folder;
};

TEST_F(PlacedImage, LiesAroundItsMiddle) {
    expectPlaced("files = \"map.png\"\nplace = {lat = 46.5, lon = 8.0, width_m = 8192}", {46.5, 8}, 8192, 0);
    expectPlaced("files = \"map.png\"\nplace = {lat = -30, lon = 179.99, width_m = 80000}", {-30, 179.99},
                 80000, 0);
    expectPlaced("files = \"map.png\"\nplace = {lat = 89.5, lon = 20, width_m = 300000}", {89.5, 20}, 300000,
                 0);
}

TEST_F(PlacedImage, UpDirectionHasTheHeading) {
    for (const double heading : {30.0, 90.0, -150.0}) {
        expectPlaced(fmt::format("files = \"map.png\"\nplace = {{lat = 46.5, lon = 8, width_m = 8192, "
                                 "heading = {}}}",
                                 heading),
                     {46.5, 8}, 8192, heading);
    }
}

TEST_F(PlacedImage, SmallPlanetHasItsOwnRadius) {
    expectPlaced("files = \"map.png\"\nplace = {lat = 20, lon = -60, width_m = 9000, heading = 10}",
                 {20, -60}, 9000, 10, 10000);
}

TEST_F(PlacedImage, RawFileIsPlacedInOneLine) {
    const std::string place = "\nplace = {lat = 46.5, lon = 8, width_m = 8192}\n";
    expectPlaced("files = \"little.raw\"" + place, {46.5, 8}, 8192, 0);
    expectPlaced("files = \"little.raw\"\nraw_size = 257" + place, {46.5, 8}, 8192, 0);
    expectPlaced("files = \"big.raw\"\nraw_big_endian = true" + place, {46.5, 8}, 8192, 0);
}

TEST_F(PlacedImage, RawFileCanBeARectangle) {
    // 3 rows of 5 samples, 1000 m apart: the middle one is 207, and the one east of it 208.
    std::string bytes;
    for (int i = 0; i < 15; ++i) bytes += {static_cast<char>(200 + i), '\0'};
    writeBytes(folder / "wide.raw", bytes);
    const std::string layer = "files = \"wide.raw\"\nplace = {lat = 0, lon = 8, width_m = 4000}\n";
    const HeightSource source = mustOpen(write(layer + "raw_size = [5, 3]\n"));
    EXPECT_EQ(source.sampleCount, 15u);
    EXPECT_NEAR(sampledNear(source, finest, 0, 8), 207, 0.02);
    EXPECT_NEAR(sampledNear(source, finest, 0, 8 + 1000 / 6'371'000.0 / radPerDeg), 208, 0.02);
    EXPECT_NEAR(sampledNear(source, finest, -1000 / 6'371'000.0 / radPerDeg, 8), 212, 0.02);
    EXPECT_THAT(errorOf(write(layer + "raw_size = [5, 4]\n")),
                HasSubstr("has 30 bytes; expected 40 for raw_size = [5, 4]"));
    EXPECT_THAT(errorOf(write(layer + "raw_size = [5]\n")), HasSubstr("expected [columns, rows]"));
    EXPECT_THAT(errorOf(write(layer)), HasSubstr("or raw_size = [columns, rows]"));
    const WorldFile world = readWorldFile(write(layer + "raw_size = [5, 3]\n")).value();
    EXPECT_EQ(worldFromText(worldText(world, folder.path()), folder / "again.toml")->layers[0].rawRows, 3);
}

TEST_F(PlacedImage, ScaleTurnsValuesIntoMetres) {
    const HeightSource world = mustOpen(
        write("files = \"map.png\"\nplace = {lat = 10, lon = 8, width_m = 8192}\nscale = 0.1\noffset_m = "
              "-100"));
    EXPECT_NEAR(sampledNear(world, finest, 10, 8), 0.1 * valueAt(128, 128) - 100, 1);
    EXPECT_EQ(sampledNear(world, finest, 11, 8), -7);
    EXPECT_NEAR(world.maxM, 0.1 * valueAt(256, 256) - 100, 1e-3);
    EXPECT_NEAR(world.minM, -7, 1e-6);
    EXPECT_EQ(world.sampleCount, static_cast<std::uint64_t>(imageSide * imageSide));
}

TEST_F(PlacedImage, SignedRawGoesBelowZero) {
    writeBytes(folder / "deep.raw", std::string(18, '\xff'));
    const std::string place = "files = \"deep.raw\"\nplace = {lat = 10, lon = 8, width_m = 8192}\n";
    EXPECT_EQ(sampledNear(mustOpen(write(place + "raw_signed = true")), finest, 10, 8), -1);
    EXPECT_EQ(sampledNear(mustOpen(write(place)), finest, 10, 8), 65535);
}

TEST_F(PlacedImage, LargeImageIsReadInBlocks) {
    writeImage(folder / "tiled.tif", Image<float>(imageSide, imageSide, valueAt), {.tile = 64});
    expectPlaced("files = \"tiled.tif\"\nplace = {lat = 46.5, lon = 8, width_m = 8192}", {46.5, 8}, 8192, 0);
    const auto path = write("files = \"map.png\"\nplace = {lat = 46.5, lon = 8, width_m = 8192}");
    HeightSourceSettings small;
    small.cacheBytes = 1000;
    const HeightSource whole = mustOpen(path);
    const HeightSource blocks = mustOpen(path, small);
    EXPECT_EQ(sampledNear(whole, finest, 46.51, 8.01), sampledNear(blocks, finest, 46.51, 8.01));
}

TEST_F(PlacedImage, MistakesOfAPlaceAreNamed) {
    const auto error = [&](const std::string& layer) { return errorOf(write(layer)); };
    const std::string place = "\nplace = {lat = 10, lon = 8, width_m = 8192}";
    EXPECT_THAT(error("files = \"map.png\"\nplace = 5"), HasSubstr("line 5: place is 5; expected place = {"));
    EXPECT_THAT(error("files = \"map.png\"\nplace = {lat = 10, lon = 8}"), HasSubstr("place has no width_m"));
    EXPECT_THAT(error("files = \"map.png\"\nplace = {lat = 10, lon = 8, width = 8}"),
                HasSubstr("width is no key of a place"));
    EXPECT_THAT(error("files = \"map.png\"\nplace = {lat = 100, lon = 8, width_m = 8}"),
                HasSubstr("lat is 100; expected a number in [-90, 90]°"));
    EXPECT_THAT(error("files = \"map.png\"\nplace = {lat = 10, lon = 8, width_m = 2e7}"),
                HasSubstr("map.png: reaches 1.41421e+07 m from its middle with width_m = 20000000"));
    EXPECT_THAT(error("files = [\"map.png\", \"b.png\"]" + place), HasSubstr("place is for one image"));
    EXPECT_THAT(error("files = \"m*.png\"" + place), HasSubstr("place is for one image"));
    EXPECT_THAT(error("files = \"map.png\"\nraw_size = 257" + place), HasSubstr("one .raw or .r16 file"));
    EXPECT_THAT(error("files = \"little.raw\"\nraw_size = 256" + place),
                HasSubstr("little.raw: has 132098 bytes; expected 131072 for raw_size = 256"));
    EXPECT_THAT(error("name = \"Map\"\nfiles = \"none.png\"" + place),
                AllOf(HasSubstr("none.png: no such file"), HasSubstr("layer \"Map\"")));
    writeBytes(folder / "odd.raw", "123456789012");
    EXPECT_THAT(error("files = \"odd.raw\"" + place), HasSubstr("no square of 16-bit samples"));
    EXPECT_THAT(error("terrain = \"noise:fbm\"" + place), HasSubstr("place is for one image"));
}

TEST_F(PlacedImage, ImageWithItsOwnPositionIsRefused) {
    using test::gridAround;
    const std::string place = "\nplace = {lat = 10, lon = 8, width_m = 8192}";
    const auto flat = [](double, double) { return 5; };
    test::writeRaster(folder / "degrees.tif", gridAround(4326, 10, 45, 40, 40, 0.1), flat);
    test::writeRaster(folder / "utm.tif", gridAround(32632, 10, 45, 40, 40, 100), flat);
    test::writeRaster(folder / "grid.asc", gridAround(32632, 10, 45, 40, 40, 100), flat,
                      {.format = "AAIGrid"});
    writeImage(folder / "beside.png", Image<std::uint16_t>(40, 40, valueAt));
    writeBytes(folder / "beside.pgw", "0.1\n0\n0\n-0.1\n10\n45\n");
    for (const char* const name : {"degrees.tif", "utm.tif", "grid.asc", "beside.png"}) {
        EXPECT_THAT(errorOf(write(fmt::format("files = \"{}\"{}", name, place))),
                    AllOf(HasSubstr(fmt::format("{}: has a position of its own", name)),
                          HasSubstr("expected a layer without place"), HasSubstr("layer \"")));
    }
}

}  // namespace
}  // namespace planet
