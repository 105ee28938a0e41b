#include "planet/source/source_layers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::radPerDeg;
using test::writeRaster;
using ::testing::HasSubstr;

// A plain at 300 m around 10 E, 45 N, and above it a field of 101 x 101 samples, 0.002 degrees apart, each of which has
// its own height: 1000 + 100 row + column. Ten by ten samples in its middle have none.
class SourceLayersTest : public testing::Test {
protected:
    SourceLayersTest() {
        writeRaster(folder / "plain.tif", test::gridAround(4326, 10, 45, 201, 201, 0.01),
                    [](double, double) { return 300; });
        std::vector<float> samples;
        for (int row = 0; row < 101; ++row) {
            for (int column = 0; column < 101; ++column) {
                const bool isVoid = row >= 45 && row < 55 && column >= 45 && column < 55;
                samples.push_back(isVoid ? -9999 : planted(column, row));
            }
        }
        writeRaster(folder / "field.tif", test::gridAround(4326, 10, 45, 101, 101, 0.002), samples,
                    {.noData = -9999});
    }

    static float planted(int column, int row) { return static_cast<float>(1000 + 100 * row + column); }
    // The place of a sample of the field, in degrees.
    static double longitudeOf(double column) { return 10 + 0.002 * (column - 50); }
    static double latitudeOf(double row) { return 45 - 0.002 * (row - 50); }

    HeightSource worldOf(const std::string& toml, const HeightSourceSettings& settings = {}) {
        writeBytes(folder / "world.toml", toml);
        return mustOpen(folder / "world.toml", settings);
    }
    HeightSource plainAndField(const std::string& keysOfField) {
        return worldOf(
            "fill_m = -7\n[[elevation]]\nfiles = \"plain.tif\"\n[[elevation]]\nfiles = \"field.tif\"\n" +
            keysOfField);
    }

    const tests::TemporaryFolder folder;
};

std::vector<SourceReading> readingsAt(const HeightSource& source, double latitudeDeg, double longitudeDeg) {
    Result<std::vector<SourceReading>> readings =
        source.layers->at({latitudeDeg * radPerDeg, longitudeDeg * radPerDeg});
    if (!readings) throw std::runtime_error(readings.error().message);
    return *readings;
}

// Returns the largest distance of a point of an outline from a rectangle of degrees, and whether the outline reaches
// all four sides.
double offRectangle(const Outline& outline, double west, double south, double east, double north) {
    double worst = 0;
    double reached[4] = {1e9, 1e9, 1e9, 1e9};
    for (const Geographic& point : outline) {
        const double x = point.longitudeRad / radPerDeg;
        const double y = point.latitudeRad / radPerDeg;
        const double sides[4] = {std::abs(x - west), std::abs(x - east), std::abs(y - south),
                                 std::abs(y - north)};
        worst = std::max(worst, *std::min_element(sides, sides + 4));
        for (int i = 0; i < 4; ++i) reached[i] = std::min(reached[i], sides[i]);
    }
    return std::max(worst, *std::max_element(reached, reached + 4));
}

TEST_F(SourceLayersTest, ReadingNamesThePixelThatHoldsTheHeight) {
    const HeightSource source = plainAndField("");
    for (const auto& [column, row] : {std::pair{0, 0}, {100, 0}, {3, 97}, {62, 20}, {44, 50}, {55, 54}}) {
        // Up to half a sample away, the same sample is the nearest one.
        for (const double off : {-0.4, 0.0, 0.4}) {
            const auto readings = readingsAt(source, latitudeOf(row + off), longitudeOf(column - off));
            ASSERT_EQ(readings.size(), 2u);
            const SourceReading& top = readings[0];
            EXPECT_EQ(top.layer, 1u);
            EXPECT_EQ(top.file, folder / "field.tif");
            EXPECT_EQ(top.column, column);
            EXPECT_EQ(top.row, row);
            EXPECT_EQ(top.heightM, static_cast<double>(planted(column, row)));
            EXPECT_FALSE(top.isVoid);
            EXPECT_EQ(top.weight, 1);
            EXPECT_EQ(readings[1].layer, 0u);
            EXPECT_EQ(readings[1].heightM, 300) << "what lies under it";
            EXPECT_EQ(topmost(readings), &readings[0]);
        }
    }
}

TEST_F(SourceLayersTest, VoidFallsToTheLayerBelow) {
    const auto readings = readingsAt(plainAndField(""), latitudeOf(50), longitudeOf(45));
    ASSERT_EQ(readings.size(), 2u);
    EXPECT_FALSE(readings[0].heightM);
    EXPECT_TRUE(readings[0].isVoid);
    EXPECT_EQ(readings[0].column, 45);
    EXPECT_EQ(readings[0].row, 50);
    ASSERT_NE(topmost(readings), nullptr);
    EXPECT_EQ(topmost(readings)->layer, 0u);
    EXPECT_EQ(topmost(readings)->heightM, 300);
}

TEST_F(SourceLayersTest, VoidWithAHeightOfItsOwnHasThatHeight) {
    const auto numbered =
        readingsAt(plainAndField("voids = 42\nscale = 2\noffset_m = 1\n"), latitudeOf(50), longitudeOf(50));
    EXPECT_TRUE(numbered[0].isVoid);
    EXPECT_EQ(numbered[0].heightM, 85);
    const auto filled = readingsAt(plainAndField("voids = \"fill\"\n"), latitudeOf(50), longitudeOf(50));
    EXPECT_TRUE(filled[0].isVoid);
    ASSERT_TRUE(filled[0].heightM);
    EXPECT_NEAR(*filled[0].heightM, planted(50, 50), 200) << "between the heights around the void";
}

TEST_F(SourceLayersTest, HeightsAreThoseAfterScaleAndOffset) {
    const auto readings =
        readingsAt(plainAndField("scale = -0.5\noffset_m = 11\n"), latitudeOf(10), longitudeOf(20));
    EXPECT_EQ(readings[0].heightM, 11 - 0.5 * planted(20, 10));
}

TEST_F(SourceLayersTest, FeatherSaysItsWeight) {
    const HeightSource source = plainAndField("feather_m = 2000\n");
    const auto weightAt = [&](double row) {
        return readingsAt(source, latitudeOf(row), longitudeOf(20))[0].weight;
    };
    // 2000 m are 9 rows of 222 m.
    EXPECT_EQ(weightAt(30), 1);
    EXPECT_LT(weightAt(0), 0.05);
    const double half = weightAt(4.5);
    EXPECT_GT(half, 0.25);
    EXPECT_LT(half, 0.75);
    // The bake blends with the same weight. Its grid point is up to 1e-5 degrees away.
    const double blended =
        static_cast<double>(sampledNear(source, test::finest, latitudeOf(4.5), longitudeOf(20)));
    const double own = 1000 + 100 * 4.5 + 20;
    EXPECT_NEAR(blended, 300 + half * (own - 300), 2);
}

// Returns the height that the readings make with their shares.
double sharedHeightM(const HeightSource& source, const std::vector<SourceReading>& readings) {
    const std::vector<double> shares = sharesOf(*source.layers, readings);
    double heightM = 0, rest = 1;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        heightM += shares[i] * readings[i].heightM.value_or(0);
        if (source.layers->layers[readings[i].layer].join != LayerJoin::Add) rest -= shares[i];
    }
    return heightM + rest * source.layers->fillM;
}

TEST_F(SourceLayersTest, SharesMakeTheHeightThatABakeShows) {
    const HeightSource plain = plainAndField("");
    EXPECT_EQ(sharesOf(*plain.layers, readingsAt(plain, latitudeOf(30), longitudeOf(20))),
              (std::vector<double>{1, 0}))
        << "the layer that is covered shows nothing";
    EXPECT_EQ(sharesOf(*plain.layers, readingsAt(plain, latitudeOf(50), longitudeOf(50))),
              (std::vector<double>{0, 1}))
        << "a void";
    EXPECT_EQ(sharesOf(*plain.layers, readingsAt(plain, -20, 100)), (std::vector<double>{0, 0}));
    for (const char* const keys :
         {"", "feather_m = 2000\n", "feather_m = 2000\njoin = \"max\"\n",
          "feather_m = 2000\njoin = \"add\"\n", "join = \"max\"\noffset_m = -9000\n"}) {
        const HeightSource source = plainAndField(keys);
        for (const double row : {4.5, 30.0, 50.0}) {
            // Its grid point is up to 1e-5 degrees away.
            const double bakedM =
                static_cast<double>(sampledNear(source, test::finest, latitudeOf(row), longitudeOf(20)));
            const auto readings = readingsAt(source, latitudeOf(row), longitudeOf(20));
            EXPECT_NEAR(sharedHeightM(source, readings), bakedM, row == 4.5 ? 60 : 2) << keys << row;
        }
    }
    const HeightSource hidden = plainAndField("join = \"max\"\noffset_m = -9000\n");
    EXPECT_EQ(sharesOf(*hidden.layers, readingsAt(hidden, latitudeOf(30), longitudeOf(20))),
              (std::vector<double>{0, 1}))
        << "the lower one of two layers of which the higher one counts";
}

TEST_F(SourceLayersTest, PlaceBeyondALayerHasNoReadingOfIt) {
    const auto readings = readingsAt(plainAndField(""), 45.5, 10);
    ASSERT_EQ(readings.size(), 2u);
    EXPECT_FALSE(readings[0].heightM);
    EXPECT_TRUE(readings[0].file.empty());
    EXPECT_EQ(readings[1].heightM, 300);
    const HeightSource source = plainAndField("");
    EXPECT_EQ(topmost(readingsAt(source, -20, 100)), nullptr);
    EXPECT_EQ(source.layers->fillM, -7);
}

TEST_F(SourceLayersTest, LayersSayWhatTheyAre) {
    const HeightSource source = worldOf(
        "[[elevation]]\nterrain = \"noise:ridged\"\n[[elevation]]\nname = \"Field\"\nfiles = "
        "\"field.tif\"\njoin = "
        "\"max\"\n[[elevation]]\ndetail = \"\"\n");
    const std::vector<SourceLayer>& layers = source.layers->layers;
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].name, "noise:ridged");
    EXPECT_EQ(layers[0].kind, LayerKind::Terrain);
    EXPECT_TRUE(layers[0].coversPlanet);
    EXPECT_EQ(layers[0].spacingRad, 0);
    EXPECT_EQ(layers[1].name, "Field");
    EXPECT_EQ(layers[1].kind, LayerKind::Rasters);
    EXPECT_EQ(layers[1].join, LayerJoin::Max);
    EXPECT_THAT(layers[1].about, HasSubstr("field.tif, 101 x 101 float"));
    EXPECT_EQ(layers[1].sampleCount, 101u * 101);
    EXPECT_EQ(layers[1].missingCount, 100u);
    EXPECT_FALSE(layers[1].coversPlanet);
    // Along a parallel at 45 degrees, the samples lie closer by the cosine.
    EXPECT_NEAR(layers[1].spacingRad, 0.002 * radPerDeg * std::cos(45 * radPerDeg), 0.002 * radPerDeg * 0.01);
    EXPECT_NEAR(layers[1].middle.latitudeRad / radPerDeg, 45, 0.01);
    EXPECT_NEAR(layers[1].middle.longitudeRad / radPerDeg, 10, 0.01);
    EXPECT_EQ(layers[2].kind, LayerKind::Detail);
    // Detail is on top, and what it refines is under it.
    const auto readings = readingsAt(source, latitudeOf(10), longitudeOf(20));
    ASSERT_EQ(readings.size(), 3u);
    EXPECT_EQ(readings[0].layer, 2u);
    EXPECT_EQ(readings[1].layer, 1u);
    EXPECT_EQ(readings[1].heightM, static_cast<double>(planted(20, 10)));
    EXPECT_EQ(readings[2].layer, 0u);
}

TEST_F(SourceLayersTest, BrokenFilesAreThoseOfTheirLayer) {
    writeBytes(folder / "broken.tif", "no raster");
    HeightSourceSettings tolerant;
    tolerant.skipBroken = true;
    const HeightSource source = worldOf(
        "[[elevation]]\nfiles = \"plain.tif\"\n[[elevation]]\nfiles = [\"field.tif\", \"broken.tif\"]\n",
        tolerant);
    EXPECT_TRUE(source.layers->layers[0].skipped.empty());
    ASSERT_EQ(source.layers->layers[1].skipped.size(), 1u);
    EXPECT_THAT(source.layers->layers[1].skipped[0], HasSubstr("broken.tif: "));
}

TEST_F(SourceLayersTest, SourceThatIsNoWorldFileHasOneLayer) {
    const HeightSource field = mustOpen(folder / "field.tif");
    ASSERT_EQ(field.layers->layers.size(), 1u);
    EXPECT_EQ(field.layers->layers[0].name, "field.tif");
    const auto readings = readingsAt(field, latitudeOf(12), longitudeOf(80));
    ASSERT_EQ(readings.size(), 1u);
    EXPECT_EQ(readings[0].heightM, static_cast<double>(planted(80, 12)));
    EXPECT_EQ(readings[0].column, 80);

    const HeightSource noise = mustOpen("noise:fbm,seed=3");
    const auto noiseReadings = readingsAt(noise, 45, 10);
    ASSERT_EQ(noiseReadings.size(), 1u);
    EXPECT_NEAR(noiseReadings[0].heightM.value(),
                static_cast<double>(sampledNear(noise, noise.naturalFaceSize - 1, 45, 10)), 1e-6);
}

TEST_F(SourceLayersTest, ImageOfThePlanetNamesItsPixel) {
    const Image<float> image(64, 32, [](int column, int row) { return 100 * row + column; });
    writeImage(folder / "planet.tif", image);
    const HeightSource source = mustOpen(folder / "planet.tif");
    ASSERT_TRUE(source.layers);
    EXPECT_EQ(source.layers->layers[0].kind, LayerKind::Image);
    EXPECT_NEAR(source.layers->layers[0].spacingRad, 360.0 / 64 * radPerDeg, 1e-9);
    // Samples lie in the middles of pixels of 5.625 degrees, from longitude -180 and latitude 90.
    for (const auto& [column, row] : {std::pair{0, 0}, {63, 31}, {32, 16}, {10, 3}}) {
        const auto readings = readingsAt(source, 90 - 5.625 * (row + 0.5), -180 + 5.625 * (column + 0.5));
        EXPECT_EQ(readings[0].column, column);
        EXPECT_EQ(readings[0].row, row);
        EXPECT_EQ(readings[0].heightM, 100 * row + column);
    }
}

TEST_F(SourceLayersTest, FaceNamesItsPixel) {
    for (const Face face : allFaces) {
        const int number = static_cast<int>(face);
        const Image<float> image(17, 17, [&](int column, int row) {
            const bool isRim = column == 0 || row == 0 || column == 16 || row == 16;
            return isRim ? 0 : 1000 * number + 20 * row + column;
        });
        writeImage(folder / fmt::format("cube_{}.tif", faceName(face)), image);
    }
    const HeightSource source = mustOpen(folder / "cube");
    EXPECT_EQ(source.layers->layers[0].kind, LayerKind::Faces);
    for (const Face face : allFaces) {
        const glm::dvec3 direction = directionAt(face, 16, 5, 12);
        const Geographic place = geographicFromDirection(direction);
        const auto readings = source.layers->at(place);
        ASSERT_TRUE(readings);
        EXPECT_EQ((*readings)[0].file.filename(), fmt::format("cube_{}.tif", faceName(face)));
        EXPECT_EQ((*readings)[0].column, 5);
        EXPECT_EQ((*readings)[0].row, 4) << "rows go down from v = 1";
        EXPECT_EQ((*readings)[0].heightM, 1000 * static_cast<int>(face) + 20 * 4 + 5);
    }
}

TEST_F(SourceLayersTest, OutlineIsTheRimOfTheTiles) {
    const std::vector<Outline> outlines = mustOpen(folder / "field.tif").layers->layers[0].outlines;
    ASSERT_EQ(outlines.size(), 1u);
    EXPECT_GT(outlines[0].size(), 100u) << "points between the corners";
    EXPECT_LT(offRectangle(outlines[0], 9.899, 44.899, 10.101, 45.101), 1e-9);
    EXPECT_EQ(outlines[0].front().latitudeRad, outlines[0].back().latitudeRad);
}

TEST_F(SourceLayersTest, OutlinesOfTilesThatTouchAreJoined) {
    // A row of three tiles that share their rims, and one apart.
    for (const int i : {0, 1, 2, 5}) {
        writeRaster(folder / fmt::format("row{}.tif", i), {4326, 21, 21, 20 + 0.2 * i, 30, 0.01},
                    [](double, double) { return 1; });
    }
    const std::vector<Outline> outlines = mustOpen(folder / "row*.tif").layers->layers[0].outlines;
    ASSERT_EQ(outlines.size(), 2u);
    EXPECT_LT(offRectangle(outlines[0], 19.995, 29.795, 20.605, 30.005), 1e-9);
    EXPECT_LT(offRectangle(outlines[1], 20.995, 29.795, 21.205, 30.005), 1e-9);
}

TEST_F(SourceLayersTest, OutlineOfManyTilesIsBounded) {
    // Squares that lie apart, each of which has an outline of its own.
    for (int i = 0; i < 200; ++i) {
        writeRaster(folder / fmt::format("apart{:03}.tif", i),
                    {4326, 10, 10, 20 + 0.2 * (i % 20), 30 - 0.2 * (i / 20), 0.01},
                    [](double, double) { return 1; });
    }
    const std::vector<Outline> outlines = mustOpen(folder / "apart*.tif").layers->layers[0].outlines;
    EXPECT_EQ(outlines.size(), 64u);
    std::size_t points = 0;
    for (const Outline& outline : outlines) points += outline.size();
    EXPECT_GT(points, 500u);
    EXPECT_LE(points, 4096u + 64);
}

TEST_F(SourceLayersTest, RasterOfTheWholePlanetHasNoOutline) {
    writeRaster(folder / "all.tif", {4326, 360, 180, -179.5, 89.5, 1}, [](double, double) { return 5; });
    writeRaster(folder / "half.tif", {4326, 360, 90, -179.5, 89.5, 1}, [](double, double) { return 5; });
    const SourceLayer all =
        worldOf("[[elevation]]\nfiles = [\"all.tif\", \"field.tif\"]\n").layers->layers[0];
    EXPECT_TRUE(all.coversPlanet);
    EXPECT_TRUE(all.outlines.empty());
    const SourceLayer half = mustOpen(folder / "half.tif").layers->layers[0];
    EXPECT_FALSE(half.coversPlanet);
    EXPECT_FALSE(half.outlines.empty());
}

TEST_F(SourceLayersTest, TextOfAWorldReadsAsTheSameWorld) {
    std::filesystem::create_directory(folder / "deep");
    const std::string toml =
        "datum = \"egm96\"\nfill_m = -3.5\nradius_m = 1000000\n"
        "[[elevation]]\nfiles = [\"plain.tif\", \"more/*.hgt\"]\ndatum = \"egm2008\"\n"
        "[[elevation]]\nname = \"A \\\"name\\\"\"\nfiles = \"field.tif\"\nvoids = \"fill\"\nfeather_m = "
        "20\nscale = 0.5\n"
        "offset_m = 0\ndatum = \"ellipsoid\"\njoin = \"max\"\n"
        "[[elevation]]\nfiles = \"i.r16\"\nvoids = 7\nplace = {lat = 1, lon = 2, width_m = 3, heading = "
        "4}\nraw_size = "
        "9\nraw_big_endian = true\nraw_signed = true\ndatum = \"egm96\"\n"
        "[[elevation]]\nterrain = \"noise:ridged\"\njoin = \"add\"\n[[elevation]]\ndetail = "
        "\"strength=0.5\"\n";
    writeBytes(folder / "world.toml", toml);
    const Result<WorldFile> world = readWorldFile(folder / "world.toml");
    ASSERT_TRUE(world) << world.error().message;
    const std::string text = worldText(*world, folder / "deep");
    EXPECT_THAT(text, HasSubstr("'../plain.tif'")) << "paths are relative to the new folder";
    const Result<WorldFile> again = worldFromText(text, folder / "deep/world.toml");
    ASSERT_TRUE(again) << again.error().message << "\n" << text;
    ASSERT_EQ(again->layers.size(), 5u);
    EXPECT_EQ(worldText(*again, folder / "deep"), text);
    EXPECT_EQ(again->fillM, -3.5);
    EXPECT_EQ(again->radiusM, 1e6);
    EXPECT_EQ(again->datum, VerticalDatum::Egm96);
    EXPECT_EQ(again->layers[0].files[1].lexically_normal(), folder / "more/*.hgt");
    EXPECT_EQ(again->layers[0].datum, VerticalDatum::Egm2008);
    const WorldLayer& field = again->layers[1];
    EXPECT_EQ(field.name, "A \"name\"");
    EXPECT_EQ(field.voids, LayerVoids::Fill);
    EXPECT_EQ(field.featherM, 20);
    EXPECT_EQ(field.scale, 0.5);
    EXPECT_TRUE(field.hasOffset) << "an offset of 0 takes the place of the grids";
    EXPECT_EQ(field.join, LayerJoin::Max);
    const WorldLayer& placed = again->layers[2];
    EXPECT_EQ(placed.voidM, 7);
    ASSERT_TRUE(placed.place);
    EXPECT_EQ(placed.place->widthM, 3);
    EXPECT_EQ(placed.place->headingDeg, 4);
    EXPECT_EQ(placed.rawSize, 9);
    EXPECT_TRUE(placed.rawBigEndian && placed.rawSigned);
    EXPECT_EQ(again->layers[3].terrain, "noise:ridged");
    EXPECT_EQ(again->layers[3].join, LayerJoin::Add);
    EXPECT_EQ(again->layers[4].detail, "detail:strength=0.5");
    writeBytes(folder / "deep/world.toml", text);
    EXPECT_TRUE(isWorldFile(folder / "deep/world.toml"));
}

}  // namespace
}  // namespace planet
