#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::finest;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// A row of 14 tiles on one grid, 0.2 degrees wide each. Tile i has the height 100 + i.
class SkipBroken : public testing::Test {
protected:
    SkipBroken() {
        for (int i = 0; i < 14; ++i) {
            test::writeRaster(tile(i), {4326, 20, 20, 10 + 0.2 * i, 45, 0.01},
                              [i](double, double) { return 100 + i; });
        }
        settings.skipBroken = true;
    }
    std::filesystem::path tile(int i) const { return folder / fmt::format("tile{:02}.tif", i); }
    // Leaves the header of a tile, so that it opens but cannot be read.
    void truncate(int i) const {
        std::filesystem::resize_file(tile(i), std::filesystem::file_size(tile(i)) / 2);
    }
    static float heightOfTile(const HeightSource& source, int i) {
        return sampledNear(source, finest, 44.9, 10.095 + 0.2 * i);
    }

    const TemporaryFolder folder;
    HeightSourceSettings settings;
};

TEST_F(SkipBroken, FilesThatCannotBeOpenedOrReadAreLeftOut) {
    writeBytes(tile(3), "no raster");
    truncate(5);
    const HeightSource source = mustOpen(folder / "*.tif", settings);
    ASSERT_EQ(source.skipped.size(), 2u);
    EXPECT_THAT(source.skipped[0], AllOf(HasSubstr("tile03.tif: is not a readable raster")));
    EXPECT_THAT(source.skipped[1], AllOf(HasSubstr("tile05.tif: the block"), HasSubstr("cannot be read")));
    EXPECT_TRUE(source.description.ends_with(", 2 files skipped")) << source.description;
    EXPECT_EQ(source.sampleCount, 12u * 400);
    for (int i = 0; i < 14; ++i)
        EXPECT_FLOAT_EQ(heightOfTile(source, i), i == 3 || i == 5 ? 0.0f : 100.0f + static_cast<float>(i))
            << i;
}

TEST_F(SkipBroken, BrokenTileGivesNoHeightsToTheRange) {
    // The tile at the end is the highest, and its first block can be read.
    test::writeRaster(tile(13), {4326, 600, 600, 20, 45, 0.01}, [](double, double) { return 5000; },
                      {.options = {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256"}});
    truncate(13);
    const HeightSource source = mustOpen(folder / "*.tif", settings);
    EXPECT_EQ(source.maxM, 112);
    EXPECT_EQ(source.sampleCount, 13u * 400);
}

TEST_F(SkipBroken, UnknownReferenceSystemIsLeftOut) {
    test::writeRaster(tile(3), {4326, 20, 20, 10, 45, 0.01}, [](double, double) { return 1; },
                      {.hasCrs = false});
    const HeightSource source = mustOpen(folder / "*.tif", settings);
    EXPECT_THAT(source.skipped, ElementsAre(HasSubstr("tile03.tif: has no coordinate reference system")));
    EXPECT_TRUE(source.description.ends_with(", 1 file skipped")) << source.description;
}

TEST_F(SkipBroken, WithoutItTheErrorCountsTheBrokenFiles) {
    truncate(5);
    EXPECT_THAT(errorOf(folder / "*.tif"),
                AllOf(HasSubstr("tile05.tif: the block at column 0, row 0 cannot be read"),
                      HasSubstr("1 of 14 files is broken (tile05.tif); --skip-broken leaves it out")));
    writeBytes(tile(8), "no raster");
    EXPECT_THAT(
        errorOf(folder / "*.tif"),
        AllOf(HasSubstr("tile05.tif: the block"),
              HasSubstr("2 of 14 files are broken (tile05.tif, tile08.tif); --skip-broken leaves them out")));
    for (int i = 0; i < 12; ++i) writeBytes(tile(i), "no raster");
    EXPECT_THAT(errorOf(folder / "*.tif"),
                AllOf(HasSubstr("12 of 14 files are broken (tile00.tif, tile01.tif"),
                      HasSubstr("tile09.tif and 2 more)"), Not(HasSubstr("tile10.tif"))));
}

TEST_F(SkipBroken, NothingLeftIsAnError) {
    for (int i = 0; i < 14; ++i) truncate(i);
    EXPECT_THAT(errorOf(folder / "*.tif", settings), HasSubstr("all 14 files are broken"));
}

TEST_F(SkipBroken, LayersOfAWorldAreLeftOutToo) {
    truncate(2);
    writeBytes(folder / "broken.hgt", "no raster");
    writeBytes(folder / "cut.png", "\x89PNG");
    writeBytes(folder / "world.toml",
               "[[elevation]]\nfiles = \"tile*.tif\"\n[[elevation]]\nfiles = \"broken.hgt\"\n"
               "[[elevation]]\nfiles = \"cut.png\"\nplace = {lat = 1, lon = 2, width_m = 100}\n");
    const HeightSource source = mustOpen(folder / "world.toml", settings);
    EXPECT_EQ(source.description, "world.toml, 3 layers, 3 files skipped");
    EXPECT_THAT(source.skipped,
                ElementsAre(HasSubstr("tile02.tif"), HasSubstr("broken.hgt"), HasSubstr("cut.png")));
    EXPECT_FLOAT_EQ(heightOfTile(source, 1), 101);
    EXPECT_FLOAT_EQ(heightOfTile(source, 2), 0);
    EXPECT_THAT(errorOf(folder / "world.toml"),
                AllOf(HasSubstr("1 of 14 files is broken (tile02.tif)"), HasSubstr("layer \"tile*.tif\"")));
}

TEST_F(SkipBroken, DetailTellsWhatItsSourceSkipped) {
    truncate(2);
    const HeightSource source = mustOpen("detail:of=" + (folder / "*.tif").string(), settings);
    EXPECT_THAT(source.skipped, ElementsAre(HasSubstr("tile02.tif")));
}

}  // namespace
}  // namespace planet
