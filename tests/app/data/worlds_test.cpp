#include "app/data/worlds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "app/base/places.h"
#include "app/base/text.h"
#include "app/data/data_set.h"
#include "app/data/recent_files.h"
#include "planet/source/terrain.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::TemporaryFolder;

TEST(Worlds, EachCanBeOpenedAndHasAShape) {
    std::set<std::string> names;
    for (const World& world : worlds()) {
        names.insert(world.name);
        const auto source = planet::openHeightSource(world.request.source, {});
        ASSERT_TRUE(source) << source.error().message;
        EXPECT_LT(source->minM, source->maxM);
        EXPECT_GT(world.request.settings.radiusM, 1e6);
        EXPECT_FALSE(world.about.empty());
        float height = 0;
        EXPECT_TRUE(source->sample({planet::Face::PosZ, 8192, 4096, 4096, 1, 1}, {&height, 1}));
    }
    EXPECT_EQ(names, (std::set<std::string>{"earth", "earth-amplified", "moon", "ridged"}));
}

TEST(Worlds, ANameBringsSourceRadiusAndFaceSizeButNotOverWhatWasAsked) {
    const auto moon = sourceNamed("preset:moon", {});
    ASSERT_TRUE(moon);
    EXPECT_THAT(moon->source.string(), HasSubstr("noise:craters"));
    EXPECT_EQ(moon->settings.radiusM, 1'737'400);
    EXPECT_EQ(moon->settings.faceSize, 2049);
    const auto small = sourceNamed("preset:moon", {.faceSize = 65, .chunkSize = 17, .radiusM = 1000});
    EXPECT_EQ(small->settings.radiusM, 1000);
    EXPECT_EQ(small->settings.faceSize, 65);
    EXPECT_EQ(small->settings.chunkSize, 17);
    EXPECT_EQ(sourceNamed("elevation.tif", {})->source, "elevation.tif");
    const auto wrong = sourceNamed("preset:mooon", {});
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message, HasSubstr("preset:earth, preset:earth-amplified, preset:moon"));
}

TEST(Worlds, ATerrainsBakeHasAPlaceOfItsOwnInTheCache) {
    const auto placeOf = [](const char* text) { return cachedBakeOf(text, {}); };
    EXPECT_EQ(placeOf("noise:fbm,seed=3,gain=0.5"), placeOf("noise:fbm,gain=0.5,seed=3"));
    EXPECT_EQ(placeOf("noise:fbm,seed=1"), placeOf("noise:fbm"));
    EXPECT_NE(placeOf("noise:fbm,seed=3"), placeOf("noise:fbm,seed=4"));
    EXPECT_NE(placeOf("noise:fbm"), placeOf("noise:ridged"));
    EXPECT_NE(placeOf("detail:of=noise:fbm"), placeOf("noise:fbm"));
    EXPECT_TRUE(placeOf("noise:fbm").filename().string().starts_with("fbm-"));
}

TEST(Worlds, ADataSetOfTerrainIsBakedWithWhatItsNameSays) {
    const auto moon = findDataSet("preset:moon", {});
    ASSERT_TRUE(moon) << moon.error().message;
    EXPECT_EQ(moon->settings.radiusM, 1'737'400);
    EXPECT_THAT(moon->source.string(), HasSubstr("noise:craters"));
    EXPECT_TRUE(moon->colourImage.empty());
    const auto earth = findDataSet("preset:earth-amplified", {});
    ASSERT_TRUE(earth);
    EXPECT_EQ(earth->colourImage, earthElevation().parent_path() / "colour.jpg");
    const auto bad = findDataSet("noise:fbm,octaves=0", {});
    ASSERT_FALSE(bad);
    EXPECT_THAT(bad.error().message, HasSubstr("octaves is 0"));
}

TEST(Worlds, AChunkFileTellsWhichTerrainItIsOf) {
    const TemporaryFolder folder;
    const std::string text = "detail:seed=3,of=" + earthElevation().string();
    const auto source = planet::openHeightSource(text, {});
    ASSERT_TRUE(source);
    ASSERT_TRUE(planet::bake(*source, planet::BakeSettings{.faceSize = 33}, folder / "earth.chk"));
    const auto file = planet::ChunkFile::open(folder / "earth.chk");
    ASSERT_TRUE(file);
    EXPECT_EQ(sourceOf(file->info()), text);
    EXPECT_EQ(findDataSet(folder / "earth.chk", {})->colourImage,
              earthElevation().parent_path() / "colour.jpg");
    planet::ChunkFileInfo info = file->info();
    info.source = "detail:of=/nowhere/elevation.tif";
    EXPECT_TRUE(sourceOf(info).empty());
    info.source = "elevation.tif, 4320 x 2160 int16, equirectangular";
    EXPECT_TRUE(sourceOf(info).empty());
}

TEST(Worlds, RecentFilesKeepNamesAsTheyAre) {
    const TemporaryFolder folder;
    std::vector<fs::path> recent;
    addRecentFile(recent, "preset:moon");
    addRecentFile(recent, "noise:fbm,gain=0.5,seed=2");
    addRecentFile(recent, "noise:fbm,seed=2,gain=0.5");
    EXPECT_THAT(recent, ElementsAre("noise:fbm,seed=2,gain=0.5", "preset:moon"));
    recent.push_back("preset:nothing");
    ASSERT_TRUE(saveRecentFiles(recent, folder / "recent.txt"));
    EXPECT_EQ(loadRecentFiles(folder / "recent.txt"), recent);
    EXPECT_THAT(shownRecentFiles(recent), ElementsAre("noise:fbm,seed=2,gain=0.5", "preset:moon"));
}

TEST(Worlds, SourcesHaveShortNames) {
    EXPECT_EQ(sourceName("/data/elevation.tif"), "elevation.tif");
    EXPECT_EQ(sourceName("noise:fbm,seed=2"), "noise:fbm,seed=2");
    EXPECT_EQ(sourceName("detail:seed=2,of=/data/elevation.tif"), "elevation.tif with detail");
    EXPECT_EQ(sourceName("detail:seed=2,of=noise:fbm,seed=2"), "noise:fbm,seed=2 with detail");
}

}  // namespace
}  // namespace worldy
