#include "app/data/data_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "app/base/places.h"
#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

namespace fs = std::filesystem;

void writeFile(const fs::path& file, const char* text) {
    std::ofstream(file) << text;
}

TEST(DataSet, WhatIsNotThereIsAnError) {
    const planet::Result<DataSet> set = findDataSet("/nonexistent/earth.tif", {});
    ASSERT_FALSE(set);
    EXPECT_THAT(set.error().message,
                testing::HasSubstr("/nonexistent/earth.tif: no such file; expected a chunk file"));
}

TEST(DataSet, AChunkFileIsOpenedWhereItLies) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "moon.chk", "x");
    const planet::Result<DataSet> set = findDataSet(folder.path() / "moon.chk", {});
    ASSERT_TRUE(set);
    EXPECT_EQ(set->chunkFile, folder.path() / "moon.chk");
    EXPECT_FALSE(set->needsBake);
    EXPECT_TRUE(set->colourImage.empty());
}

TEST(DataSet, ABakeOfOurOwnEarthKeepsItsColoursWhereverItLies) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "anywhere.chk";
    const auto source = planet::openHeightSource(earthElevation(), {});
    ASSERT_TRUE(source) << source.error().message;
    ASSERT_TRUE(planet::bake(*source, planet::BakeSettings{.faceSize = 65}, file));
    const planet::Result<DataSet> set = findDataSet(file, {});
    ASSERT_TRUE(set);
    EXPECT_EQ(set->colourImage, earthElevation().parent_path() / "colour.jpg");
}

TEST(DataSet, AnImageIsBakedIntoTheCache) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "moon.tif", "x");
    writeFile(folder.path() / "colour.png", "x");
    const planet::Result<DataSet> set = findDataSet(folder.path() / "moon.tif", {});
    ASSERT_TRUE(set);
    EXPECT_TRUE(set->needsBake);
    EXPECT_EQ(set->chunkFile.extension(), ".chk");
    EXPECT_TRUE(set->chunkFile.filename().string().starts_with("moon-"));
    EXPECT_EQ(set->colourImage, folder.path() / "colour.png");
    EXPECT_EQ(set->bakedColour, folder.path() / "colour.png");
}

TEST(DataSet, ColoursHaveABakeOfTheirOwn) {
    const TemporaryFolder folder;
    const fs::path image = folder.path() / "moon.tif";
    const fs::path colour = folder.path() / "colour.png";
    const fs::path other = folder.path() / "other.png";
    for (const fs::path& file : {image, colour, other}) writeFile(file, "x");
    const fs::path without = cachedBakeOf(image, {});
    const fs::path with = cachedBakeOf(image, {}, {}, colour);
    EXPECT_NE(with, without);
    EXPECT_EQ(findDataSet(image, {})->chunkFile, with);
    const auto none = findDataSet(image, {}, {}, fs::path());
    EXPECT_EQ(none->chunkFile, without);
    EXPECT_TRUE(none->bakedColour.empty());
    EXPECT_EQ(none->colourImage, colour);
    EXPECT_EQ(findDataSet(image, {}, {}, other)->chunkFile, cachedBakeOf(image, {}, {}, other));
    EXPECT_NE(cachedBakeOf(image, {}, {}, other), with);
    EXPECT_NE(cachedBakeOf(image, {.colour = {.faceSize = 257}}, {}, colour), with);
    EXPECT_NE(cachedBakeOf(image, {.colour = {.format = planet::ColourFormat::Lossless}}, {}, colour), with);
    EXPECT_EQ(cachedBakeOf(image, {.colour = {.faceSize = 257}}), without);
    writeFile(colour, "changed");
    EXPECT_NE(cachedBakeOf(image, {}, {}, colour), with);
}

TEST(DataSet, AChangedSourceOrSettingIsBakedAgain) {
    const TemporaryFolder folder;
    const fs::path image = folder.path() / "moon.tif";
    writeFile(image, "x");
    const fs::path first = cachedBakeOf(image, {});
    EXPECT_EQ(cachedBakeOf(image, {}), first);
    EXPECT_NE(cachedBakeOf(image, {.chunkSize = 65}), first);
    EXPECT_NE(cachedBakeOf(image, {.radiusM = 1'737'400}), first);
    EXPECT_NE(cachedBakeOf(image, {.compressionLevel = 3}), first);
    planet::HeightSourceSettings source;
    source.cacheBytes = 1 << 20;
    EXPECT_EQ(cachedBakeOf(image, {.threads = 3}, source), first);
    source.metresPerUnit = 10;
    EXPECT_NE(cachedBakeOf(image, {}, source), first);
    // 1 and 0 override what the file says.
    source.metresPerUnit = 1;
    const fs::path inMetres = cachedBakeOf(image, {}, source);
    EXPECT_NE(inMetres, first);
    source = {};
    source.offsetM = 0;
    EXPECT_NE(cachedBakeOf(image, {}, source), first);
    EXPECT_NE(cachedBakeOf(image, {}, source), inMetres);
    source = {};
    source.noDataValue = 0;
    EXPECT_NE(cachedBakeOf(image, {}, source), first);
    fs::last_write_time(image, fs::last_write_time(image) + std::chrono::seconds(2));
    const fs::path touched = cachedBakeOf(image, {});
    EXPECT_NE(touched, first);
    const auto time = fs::last_write_time(image);
    writeFile(image, "xy");
    fs::last_write_time(image, time);
    EXPECT_NE(cachedBakeOf(image, {}), touched);
}

TEST(DataSet, ALongNameStillHasACache) {
    const TemporaryFolder folder;
    std::string name = "a";
    for (int i = 0; i < 100; ++i) name += "\u00e4";
    writeFile(folder.path() / (name + ".tif"), "x");
    const std::string cached = cachedBakeOf(folder.path() / (name + ".tif"), {}).filename().string();
    EXPECT_LT(cached.size(), 110u);
    EXPECT_TRUE(cached.starts_with(name.substr(0, 79) + "-")) << cached;
}

TEST(DataSet, AllSixFacesCountForAStemAndForOneOfThem) {
    const TemporaryFolder folder;
    for (const char* face : {"x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg"}) {
        writeFile(folder.path() / (std::string("moon_") + face + ".png"), "x");
    }
    const fs::path face = folder.path() / "moon_x_pos.png";
    const fs::path stem = folder.path() / "moon";
    EXPECT_TRUE(findDataSet(stem, {}));
    EXPECT_EQ(cachedBakeOf(face, {}), cachedBakeOf(stem, {}));
    const fs::path before = cachedBakeOf(face, {});
    writeFile(folder.path() / "moon_z_neg.png", "longer");
    EXPECT_NE(cachedBakeOf(face, {}), before);
}

}  // namespace
}  // namespace worldy
