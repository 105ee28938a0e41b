#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::finest;
using test::gridAround;
using test::SampleGrid;
using test::writeRaster;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A folder with a plain at 300 m around 10 E, 45 N, and a smaller one at 700 m in its middle with a void of 10 x 10
// samples.
class WorldSource : public testing::Test {
protected:
    WorldSource() {
        writeRaster(folder / "plain.tif", gridAround(4326, 10, 45, 201, 201, 0.01),
                    [](double, double) { return 300; });
        std::vector<float> samples(101 * 101, 700);
        for (int row = 45; row < 55; ++row) {
            for (int column = 45; column < 55; ++column)
                samples[static_cast<std::size_t>(row * 101 + column)] = -9999;
        }
        writeRaster(folder / "mesa.tif", gridAround(4326, 10, 45, 101, 101, 0.002), samples,
                    {.noData = -9999});
    }

    std::filesystem::path write(const std::string& toml) {
        writeBytes(folder / "world.toml", toml);
        return folder / "world.toml";
    }
    HeightSource worldOf(const std::string& toml) { return mustOpen(write(toml)); }
    std::string errorOfWorld(const std::string& toml) { return errorOf(write(toml)); }

    const TemporaryFolder folder;
};

constexpr const char* plainAndMesa =
    "[[elevation]]\nfiles = \"plain.tif\"\n[[elevation]]\nfiles = \"mesa.tif\"\n";

TEST_F(WorldSource, UpperLayerReplacesTheLowerOne) {
    const HeightSource world = worldOf(std::string("fill_m = -50\n") + plainAndMesa);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45.05, 10), 700);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45.5, 10), 300);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 47, 10), -50);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 10), 300) << "the void shows what lies under it";
    EXPECT_EQ(world.minM, -50);
    EXPECT_EQ(world.maxM, 700);
    EXPECT_EQ(world.description, "world.toml, 2 layers");
    EXPECT_EQ(world.missingCount, 100u);
}

TEST_F(WorldSource, LayersJoinAsTheySay) {
    const auto at = [&](const std::string& join) {
        return sampledNear(worldOf(plainAndMesa + join), finest, 45.05, 10);
    };
    EXPECT_FLOAT_EQ(at("join = \"max\""), 700);
    EXPECT_FLOAT_EQ(at("join = \"max\"\noffset_m = -500"), 300);
    EXPECT_FLOAT_EQ(at("join = \"add\""), 1000);
    EXPECT_FLOAT_EQ(at("scale = 2\noffset_m = 11"), 1411);
    EXPECT_NEAR(at("join = \"add\"\nscale = -0.5"), -50, 1e-3);
    const HeightSource world = worldOf(std::string(plainAndMesa) + "join = \"add\"\nscale = -0.5");
    EXPECT_LE(world.minM, -50);
    EXPECT_GE(world.maxM, 300);
}

TEST_F(WorldSource, VoidsShowWhatTheirLayerSays) {
    const auto at = [&](const std::string& voids) {
        return sampledNear(worldOf(plainAndMesa + voids), finest, 45, 10);
    };
    EXPECT_FLOAT_EQ(at("voids = \"below\""), 300);
    EXPECT_FLOAT_EQ(at("voids = \"fill\""), 700);
    EXPECT_FLOAT_EQ(at("voids = 12.5"), 12.5);
}

// Samples of the whole planet, 5 degrees apart.
constexpr SampleGrid wholePlanetGrid = {4326, 72, 36, -177.5, 87.5, 5};

// A height in the east, and another one in the west.
std::vector<float> eastAndWest(float east, float west) {
    return test::samplesOf(wholePlanetGrid,
                           [=](double longitude, double) { return longitude > 0 ? east : west; });
}

TEST_F(WorldSource, VoidsOfAnImageOfTheWholePlanetShowWhatTheirLayerSays) {
    writeRaster(folder / "base.tif", wholePlanetGrid, std::vector<float>(72 * 36, -3000));
    writeRaster(folder / "land.tif", wholePlanetGrid, eastAndWest(700, -9999), {.noData = -9999});
    std::vector<std::uint8_t> mask(72 * 36);
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = i % 72 < 36 ? 0 : 255;
    writeRaster(folder / "masked.tif", wholePlanetGrid, eastAndWest(700, 5), {.mask = mask});
    for (const std::string file : {"land.tif", "masked.tif"}) {
        const auto at = [&](double longitude, const std::string& keys) {
            const HeightSource world = worldOf(
                "[[elevation]]\nfiles = \"base.tif\"\n[[elevation]]\nfiles = \"" + file + "\"\n" + keys);
            return sampledNear(world, 64, 10, longitude);
        };
        for (const std::string keys : {"", "voids = \"below\"", "voids = \"fill\"", "voids = 123",
                                       "join = \"max\"", "feather_m = 1000"})
            EXPECT_FLOAT_EQ(at(90, keys), 700) << file << " " << keys;
        for (const std::string keys :
             {"", "voids = \"below\"", "join = \"max\"", "join = \"add\"", "feather_m = 1000"})
            EXPECT_FLOAT_EQ(at(-90, keys), -3000) << file << " " << keys;
        EXPECT_FLOAT_EQ(at(-90, "voids = 123"), 123) << file;
        EXPECT_FLOAT_EQ(at(-90, "voids = \"fill\""), 700) << file;
        EXPECT_FLOAT_EQ(at(90, "join = \"add\""), -2300) << file;
        const float feathered = at(4, "feather_m = 1000000");
        EXPECT_GT(feathered, -2900) << file;
        EXPECT_LT(feathered, 600) << file;
    }
}

TEST_F(WorldSource, ImageWithVoidsAndWithoutAPositionIsRefused) {
    writeImage(folder / "holed.exr", Image<float>(72, 36, [](int x, int) { return x < 36 ? NAN : 700; }));
    EXPECT_THAT(
        errorOfWorld("[[elevation]]\nterrain = \"noise:fbm\"\n[[elevation]]\nfiles = \"holed.exr\"\n"),
        AllOf(HasSubstr("holed.exr: 1296 of its samples are missing, and it has no position"),
              HasSubstr("expected"), HasSubstr("layer \"holed.exr\"")));
    writeImage(folder / "full.exr", Image<float>(72, 36, [](int, int) { return 700; }));
    EXPECT_FLOAT_EQ(
        sampledNear(worldOf("[[elevation]]\nfiles = \"full.exr\"\nfeather_m = 1000\n"), 64, 10, 0), 700);
}

TEST_F(WorldSource, AlphaOfAColourLayerShowsTheColoursUnderIt) {
    const std::vector<float> grey(72 * 36, 40);
    writeRaster(
        folder / "grey.tif", wholePlanetGrid, std::vector<float>(),
        {.type = GDT_Byte, .bands = 3, .bandSamples = {grey, grey, grey}, .options = {"PHOTOMETRIC=RGB"}});
    const std::vector<float> white(72 * 36, 255);
    writeRaster(folder / "east.tif", wholePlanetGrid, std::vector<float>(),
                {.type = GDT_Byte,
                 .bands = 4,
                 .bandSamples = {white, white, white, eastAndWest(255, 0)},
                 .meanings = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand, GCI_AlphaBand},
                 .options = {"PHOTOMETRIC=RGB", "ALPHA=YES"}});
    HeightSourceSettings red;
    red.colourChannel = 0;
    const HeightSource world =
        mustOpen(write("[[colour]]\nfiles = \"grey.tif\"\n[[colour]]\nfiles = \"east.tif\"\n"), red);
    const float shown = sampledNear(mustOpen(folder / "grey.tif", red), 64, 10, 0);
    EXPECT_GT(shown, 0);
    EXPECT_FLOAT_EQ(sampledNear(world, 64, 10, 90), 1);
    EXPECT_FLOAT_EQ(sampledNear(world, 64, 10, -90), shown);
}

TEST_F(WorldSource, DatumThatTheFileContradictsIsRefusedWithoutAnOffset) {
    // WGS 84 with heights of EGM96, of EGM2008 and above the ellipsoid.
    for (const auto& [epsg, datum, other] : {std::tuple(9707, "egm96", "egm2008"),
                                             {9518, "egm2008", "ellipsoid"},
                                             {4979, "ellipsoid", "egm96"}}) {
        SampleGrid grid = gridAround(4326, 10, 45, 40, 40, 0.01);
        grid.epsg = epsg;
        writeRaster(folder / "inset.tif", grid, std::vector<float>(1600, 200));
        grid = wholePlanetGrid;
        grid.epsg = epsg;
        writeRaster(folder / "globe.tif", grid, std::vector<float>(72 * 36, 200));
        for (const std::string file : {"inset.tif", "globe.tif"}) {
            const auto layer = [&](const std::string& layerDatum) {
                return fmt::format("datum = \"{0}\"\n[[elevation]]\nfiles = \"{1}\"\ndatum = \"{0}\"\n",
                                   layerDatum, file);
            };
            EXPECT_FLOAT_EQ(sampledNear(worldOf(layer(datum)), finest, 45, 10), 200) << epsg << file;
            EXPECT_THAT(
                errorOfWorld(layer(other)),
                AllOf(HasSubstr(file + ": says that its heights are "),
                      HasSubstr(fmt::format("but the layer's datum is {}", other)),
                      HasSubstr(fmt::format("expected datum = \"{}\"", datum)), HasSubstr("offset_m")))
                << epsg;
            EXPECT_FLOAT_EQ(sampledNear(worldOf(layer(other) + "offset_m = 7\n"), finest, 45, 10), 207)
                << epsg;
        }
    }
}

TEST_F(WorldSource, FilesThatSayDifferentDatumsAreRefusedWithoutAny) {
    SampleGrid grid = gridAround(4326, 10, 45, 40, 40, 0.01);
    for (const auto& [name, epsg] :
         {std::pair("egm96.tif", 9707), {"ellipsoid.tif", 4979}, {"silent.tif", 4326}}) {
        grid.epsg = epsg;
        writeRaster(folder / name, grid, std::vector<float>(1600, 200));
    }
    const auto layer = [](const std::string& file) {
        return fmt::format("[[elevation]]\nfiles = \"{}\"\n", file);
    };
    const auto isRefused =
        AllOf(HasSubstr("ellipsoid.tif: says that its heights are ellipsoidal height, but "),
              HasSubstr("egm96.tif says EGM96 height; expected "));
    EXPECT_THAT(errorOfWorld(layer("egm96.tif") + layer("silent.tif") + layer("ellipsoid.tif")),
                AllOf(isRefused, HasSubstr("datum at the top of the world file")));
    const auto list =
        openHeightSource((folder / "egm96.tif").string() + "|" + (folder / "ellipsoid.tif").string(), {});
    ASSERT_FALSE(list);
    EXPECT_THAT(list.error().message,
                AllOf(HasSubstr("says that its heights are "), HasSubstr("files of one datum")));
    for (const std::string& text :
         {layer("egm96.tif") + layer("silent.tif"), layer("egm96.tif") + layer("egm96.tif"),
          layer("egm96.tif") + layer("ellipsoid.tif") + "join = \"add\"\n",
          layer("egm96.tif") + layer("ellipsoid.tif") + "offset_m = 0\n"})
        EXPECT_GT(worldOf(text).maxM, 199) << text;
}

TEST_F(WorldSource, LayerWithoutHeightsLeavesTheOthers) {
    writeRaster(folder / "void.tif", gridAround(4326, 10, 45, 40, 40, 0.01), std::vector<float>(1600, -9999),
                {.noData = -9999});
    const std::string plain = "[[elevation]]\nfiles = \"plain.tif\"\n";
    const std::string nothing = "[[elevation]]\nfiles = \"void.tif\"\n";
    for (const std::string& text : {plain + nothing, nothing + plain}) {
        const HeightSource world = worldOf(text);
        EXPECT_EQ(world.minM, 0);
        EXPECT_EQ(world.maxM, 300);
        EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 10), 300);
    }
    // One grid of a layer has no heights.
    const HeightSource world = worldOf("[[elevation]]\nfiles = [\"plain.tif\", \"void.tif\"]\n");
    EXPECT_EQ(world.maxM, 300);
    EXPECT_EQ(worldOf(plain + nothing + "voids = 450\n").maxM, 450);
    EXPECT_THAT(errorOfWorld(nothing), AllOf(HasSubstr("world.toml"), HasSubstr("has no heights")));
}

TEST_F(WorldSource, ErrorsWhileSamplingNameTheLayer) {
    const HeightSource world = worldOf(plainAndMesa);
    // These rasters take its place among the open files.
    std::vector<HeightSource> others;
    for (int i = 0; i < 70; ++i) {
        const auto file = folder / fmt::format("other{}.tif", i);
        writeRaster(file, gridAround(4326, 10, 45, 4, 4, 0.01), std::vector<float>(16, 1));
        others.push_back(mustOpen(file));
    }
    std::filesystem::resize_file(folder / "mesa.tif", 500);
    float height = 0;
    const Result<void> sampled = world.sample(tileNear(finest, 45.05, 10), std::span(&height, 1));
    ASSERT_FALSE(sampled);
    EXPECT_THAT(sampled.error().message, AllOf(HasSubstr("mesa.tif: "), HasSubstr("(layer \"mesa.tif\""),
                                               HasSubstr("world.toml"), HasSubstr("expected")));
}

TEST_F(WorldSource, GapsBetweenTilesOfALayerAreNoVoids) {
    // Two tiles of one grid, 40 degrees apart.
    writeRaster(folder / "west.tif", gridAround(4326, -30, 45, 101, 101, 0.01),
                [](double, double) { return 700; });
    writeRaster(folder / "east.tif", gridAround(4326, 10, 45, 101, 101, 0.01),
                [](double, double) { return 900; });
    for (const std::string voids : {"\"below\"", "\"fill\"", "12.5"}) {
        const HeightSource world = worldOf(
            "fill_m = -50\n[[elevation]]\nfiles = [\"west.tif\", \"east.tif\"]\nvoids = " + voids + "\n");
        EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, -30.4), 700) << voids;
        EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 9.6), 900) << voids;
        EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, -10), -50) << voids;
        EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 9.4), -50) << voids;
        // One piece reaches from one tile over the gap to the other.
        EXPECT_FLOAT_EQ(sampledNear(world, 64, 45, -10), -50) << voids;
    }
}

TEST_F(WorldSource, FilledVoidsContinueASlope) {
    const auto slope = [](double longitude, double latitude) {
        return 1000 + 3000 * (longitude - 10) + 1000 * (latitude - 45);
    };
    const SampleGrid grid = gridAround(4326, 10, 45, 101, 101, 0.002);
    std::vector<float> samples = test::samplesOf(grid, slope);
    for (int row = 40; row < 60; ++row) {
        for (int column = 40; column < 60; ++column)
            samples[static_cast<std::size_t>(row * 101 + column)] = -9999;
    }
    writeRaster(folder / "slope.tif", grid, samples, {.noData = -9999});
    const HeightSource world = worldOf("[[elevation]]\nfiles = \"slope.tif\"\nvoids = \"fill\"\n");
    // The void is 120 m high from west to east. What fills it has no step at its rim and follows the slope.
    for (double east = -0.024; east <= 0.024; east += 0.001) {
        const double longitude = 10 + east;
        EXPECT_NEAR(sampledNear(world, finest, 45.0011, longitude), slope(longitude, 45.0011), 40)
            << longitude;
    }
    EXPECT_NEAR(sampledNear(world, finest, 45, 10 - 0.0195), sampledNear(world, finest, 45, 10 - 0.0215), 20);
}

// The largest step between places a tenth of a sample apart, along a line from the middle of the mesa eastwards over
// its rim.
float largestStep(const HeightSource& world, double fromDeg, double toDeg, double stepDeg) {
    float largest = 0;
    float before = sampledNear(world, finest, 45.05, fromDeg);
    for (double longitude = fromDeg + stepDeg; longitude < toDeg; longitude += stepDeg) {
        const float height = sampledNear(world, finest, 45.05, longitude);
        largest = std::max(largest, std::abs(height - before));
        before = height;
    }
    return largest;
}

TEST_F(WorldSource, FeatherLeavesNoStepAtARim) {
    // The rim lies at 10.101 E, and the feather is 4 km wide: 0.0509 degrees of longitude at this latitude.
    EXPECT_GT(largestStep(worldOf(plainAndMesa), 10.06, 10.12, 0.0002), 399) << "without it there is a step";
    const HeightSource world = worldOf(std::string(plainAndMesa) + "feather_m = 4000\nvoids = \"fill\"\n");
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45.05, 10.045), 700);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45.05, 10.103), 300);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 10.012), 700) << "a void that is filled has no rim";
    // A blend of 400 m by 3 t^2 - 2 t^3 is steepest in its middle, with 1.5 times its mean slope.
    EXPECT_LT(largestStep(world, 10.04, 10.12, 0.0002), 1.2 * 1.5 * 400 * 0.0002 / 0.0509);
    EXPECT_NEAR(sampledNear(world, finest, 45.05, 10.101 - 0.0509 / 2), 500, 30);
}

TEST_F(WorldSource, FeatherOfAVoidLeavesNoStep) {
    const HeightSource world = worldOf(std::string(plainAndMesa) + "feather_m = 1000\n");
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 10), 300);
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45, 10.04), 700);
    float largest = 0;
    for (double longitude = 10; longitude < 10.04; longitude += 0.0002) {
        largest = std::max(largest, std::abs(sampledNear(world, finest, 45, longitude + 0.0002) -
                                             sampledNear(world, finest, 45, longitude)));
    }
    EXPECT_LT(largest, 1.5 * 1.5 * 400 * 0.0002 / 0.0127);
}

TEST_F(WorldSource, TerrainAndDetailAreLayers) {
    const HeightSource world = worldOf(
        "[[elevation]]\nterrain = \"noise:ridged,seed=3\"\n[[elevation]]\nfiles = \"plain.tif\"\n"
        "[[elevation]]\ndetail = \"strength=1,flat_m=0\"\n");
    EXPECT_EQ(world.description, "world.toml, 3 layers");
    EXPECT_NEAR(sampledNear(world, 64, 45, 10), 300, 1) << "detail begins below the resolution of its layers";
    EXPECT_NE(sampledNear(world, 64, -20, 100), 0);
}

TEST_F(WorldSource, HeightsAreTheSameBitsInEveryTile) {
    writeRaster(
        folder / "corner.tif", gridAround(4326, 45, 35.264, 101, 101, 0.2),
        [](double longitude, double latitude) { return 100 * std::sin(longitude * 9) + 50 * latitude; });
    const HeightSource world = worldOf(
        "[[elevation]]\nterrain = \"noise:fbm,seed=3\"\n[[elevation]]\nfiles = \"corner.tif\"\nfeather_m = "
        "300000\n");
    EXPECT_EQ(sharedPoints(world, 128).different, 0);
    expectTilesAgree(world, 128, 6);
}

TEST_F(WorldSource, EarthWithAnInsetOfTheAndes) {
    const std::string data = std::string(WORLDY_SOURCE_DIR) + "/data/";
    const HeightSource world =
        worldOf(fmt::format("[[elevation]]\nfiles = \"{}earth/elevation.tif\"\n[[elevation]]\nfiles = "
                            "\"{}regions/S33W071.tif\"\nfeather_m = 5000\n",
                            data, data));
    const HeightSource earth = mustOpen(data + "earth/elevation.tif");
    const HeightSource andes = mustOpen(data + "regions/S33W071.tif");
    EXPECT_EQ(sampledNear(world, finest, -32.5, -70.5), sampledNear(andes, finest, -32.5, -70.5));
    EXPECT_EQ(sampledNear(world, finest, -34, -70.5), sampledNear(earth, finest, -34, -70.5));
    EXPECT_GT(world.maxM, 6849);
}

TEST_F(WorldSource, MistakesAreNamedWithTheirLineAndWhatIsRight) {
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfile = \"plain.tif\"\n"),
                AllOf(HasSubstr("world.toml: line 2: file is no key of a layer"),
                      HasSubstr("expected one of name, files")));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = \"plain.tif\"\nterrain = \"noise:fbm\"\n"),
                HasSubstr("a layer has 2 of files, terrain and detail; expected exactly one"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nname = \"x\"\n"), HasSubstr("a layer has 0 of files"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = []\n"), HasSubstr("files is empty"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = \"plain.tif\"\njoin = \"min\"\n"),
                AllOf(HasSubstr("line 3: join is 'min'"), HasSubstr("\"replace\", \"max\" or \"add\"")));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = \"plain.tif\"\nvoids = \"none\"\n"),
                HasSubstr("expected \"below\", \"fill\" or a height in metres"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = \"plain.tif\"\nfeather_m = -1\n"),
                HasSubstr("feather_m is -1; expected a number in [0, 1000000] m"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = \"plain.tif\"\nscale = 0\n"), HasSubstr("scale is 0"));
    EXPECT_THAT(errorOfWorld("radius = 5\n[[elevation]]\nfiles = \"plain.tif\"\n"),
                HasSubstr("line 1: radius is no key of a world file"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nterrain = \"noise:fbm\"\nfeather_m = 5\n"),
                HasSubstr("terrain has no rim"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\ndetail = \"strength=1\"\n"),
                HasSubstr("expected a layer under it"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nterrain = \"plain.tif\"\n"),
                HasSubstr("expected procedural terrain"));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nterrain = \"noise:fmb\"\n"),
                HasSubstr("did you mean noise:fbm"));
}

TEST_F(WorldSource, MistakesInALayerNameIt) {
    EXPECT_THAT(
        errorOfWorld("[[elevation]]\nname = \"Alps\"\nfiles = \"alps.tif\"\n"),
        AllOf(HasSubstr("alps.tif: no such file"), HasSubstr("layer \"Alps\" of "), HasSubstr("world.toml")));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nname = \"Alps\"\nfiles = \"alps*.hgt\"\n"),
                AllOf(HasSubstr("no file matches this pattern"), HasSubstr("layer \"Alps\"")));
    EXPECT_THAT(errorOfWorld("[[elevation]]\nfiles = \"world.toml\"\n"),
                HasSubstr("a world file cannot be a layer"));
    HeightSourceSettings settings;
    settings.noDataValue = 5;
    EXPECT_THAT(errorOf(write(plainAndMesa), settings), HasSubstr("is a world file"));
}

TEST_F(WorldSource, FilesOfAWorldAreItselfAndThoseOfItsLayers) {
    const HeightSourceFiles files = heightSourceFiles(write(plainAndMesa));
    EXPECT_EQ(files.stem, "world");
    ASSERT_EQ(files.files.size(), 3u);
    EXPECT_EQ(files.files[0].filename(), "world.toml");
    EXPECT_EQ(files.files[2].filename(), "mesa.tif");
    EXPECT_TRUE(isWorldFile(folder / "world.toml"));
    writeBytes(folder / "settings.toml", "[lod]\ntau_px = 2\n");
    EXPECT_FALSE(isWorldFile(folder / "settings.toml"));
}

}  // namespace
}  // namespace planet
