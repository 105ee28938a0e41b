#include "app/data/world_edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using ::testing::HasSubstr;

class WorldEdits : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    static WorldEdit mustEdit(const std::filesystem::path& source) {
        planet::Result<WorldEdit> edit = editOf(source, {});
        if (!edit) throw std::runtime_error(edit.error().message);
        return *edit;
    }
    static std::string textOf(const std::filesystem::path& file) {
        std::ifstream stream(file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    const tests::TemporaryFolder folder;
};

constexpr const char* twoLayers =
    "fill_m = -5\n[[elevation]]\nfiles = \"low.tif\"\n[[elevation]]\nname = \"High\"\nfiles = "
    "\"deep/high.tif\"\n";

TEST_F(WorldEdits, LayerThatIsOffIsSavedAndNotBaked) {
    WorldEdit edit = mustEdit(write("world.toml", twoLayers));
    ASSERT_EQ(edit.layers.size(), 2u);
    EXPECT_EQ(edit.fillM, -5);
    edit.layers[0].on = false;
    const auto forBake = writeForBake(edit, folder / "cache", "world");
    ASSERT_TRUE(forBake) << forBake.error().message;
    const WorldEdit baked = mustEdit(*forBake);
    ASSERT_EQ(baked.layers.size(), 1u);
    EXPECT_EQ(baked.layers[0].name, "High");
    ASSERT_TRUE(saveWorld(edit, folder / "saved.toml"));
    EXPECT_TRUE(sameWorld(edit, mustEdit(folder / "saved.toml")));
    EXPECT_FALSE(mustEdit(folder / "saved.toml").layers[0].on);
    EXPECT_FALSE(sameWorld(edit, mustEdit(folder / "world.toml")));
    edit.layers[1].on = false;
    ASSERT_FALSE(checkEdit(edit));
    EXPECT_THAT(checkEdit(edit).error().message, HasSubstr("no layer is on; expected at least one"));
}

TEST_F(WorldEdits, SourceThatIsNoWorldFileIsOneLayer) {
    const WorldEdit image = mustEdit("/somewhere/image.tif");
    ASSERT_EQ(image.layers.size(), 1u);
    EXPECT_EQ(image.layers[0].name, "image.tif");
    EXPECT_EQ(mustEdit("noise:ridged,seed=7").layers[0].terrain, "noise:ridged,seed=7");
    const WorldEdit detail = mustEdit("detail:strength=0.5,of=/somewhere/image.tif");
    ASSERT_EQ(detail.layers.size(), 2u);
    EXPECT_EQ(detail.layers[0].files[0], "/somewhere/image.tif");
    EXPECT_EQ(detail.layers[1].detail, "detail:seed=1,strength=0.5");
    EXPECT_EQ(mustEdit("detail:of=/somewhere/image.tif").layers[1].detail, "detail:seed=1");
    EXPECT_TRUE(checkEdit(detail));
}

TEST_F(WorldEdits, SourceSettingsCannotBecomeLayers) {
    planet::HeightSourceSettings settings;
    settings.noDataValue = -1;
    const auto edit = editOf("/somewhere/image.tif", settings);
    ASSERT_FALSE(edit);
    EXPECT_THAT(edit.error().message, HasSubstr("/somewhere/image.tif: was opened with units"));
}

TEST_F(WorldEdits, WrongOrderIsSaidWithoutALineOfAFileThatNobodySees) {
    WorldEdit edit = mustEdit("detail:of=/somewhere/image.tif");
    std::swap(edit.layers[0], edit.layers[1]);
    const auto checked = checkEdit(edit);
    ASSERT_FALSE(checked);
    EXPECT_TRUE(checked.error().message.starts_with("detail refines what lies under it; expected"))
        << checked.error().message;
    EXPECT_FALSE(writeForBake(edit, folder / "worlds", "world"));
    EXPECT_FALSE(saveWorld(edit, folder / "new.toml"));
    EXPECT_FALSE(std::filesystem::exists(folder / "new.toml"));
}

TEST_F(WorldEdits, SavedWorldNamesItsFilesFromItsOwnFolder) {
    const WorldEdit edit = mustEdit(write("world.toml", twoLayers));
    std::filesystem::create_directory(folder / "deep");
    ASSERT_TRUE(saveWorld(edit, folder / "deep/new.toml"));
    EXPECT_THAT(textOf(folder / "deep/new.toml"), HasSubstr("files = 'high.tif'"));
    EXPECT_THAT(textOf(folder / "deep/new.toml"), HasSubstr("files = '../low.tif'"));
    EXPECT_TRUE(sameWorld(mustEdit(folder / "deep/new.toml"), edit));
    const auto wrong = saveWorld(edit, folder / "new.tif");
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message,
                HasSubstr("new.tif: is no name of a world file; expected one that ends"));
}

TEST_F(WorldEdits, UnchangedWorldIsWrittenOnceForItsBake) {
    WorldEdit edit = mustEdit(write("world.toml", twoLayers));
    const auto first = writeForBake(edit, folder / "worlds", "world");
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_TRUE(planet::isWorldFile(*first));
    EXPECT_TRUE(sameWorld(mustEdit(*first), edit));
    const auto written = std::filesystem::last_write_time(*first);
    const auto second = writeForBake(edit, folder / "worlds", "world");
    ASSERT_TRUE(second);
    EXPECT_EQ(*second, *first);
    EXPECT_EQ(std::filesystem::last_write_time(*second), written);
    edit.layers[1].featherM = 100;
    EXPECT_NE(*writeForBake(edit, folder / "worlds", "world"), *first);
}

TEST_F(WorldEdits, AddedLayerLiesOnTopAndHasTheDatumOfThePlanet) {
    WorldEdit edit = mustEdit(
        write("world.toml", "datum = \"egm96\"\n[[elevation]]\nfiles = \"a.tif\"\ndatum = \"egm96\"\n"));
    const std::vector<std::filesystem::path> files = {"/x/b.tif", "/x/c.tif"};
    addLayer(edit, files);
    ASSERT_EQ(edit.layers.size(), 2u);
    EXPECT_EQ(edit.layers[1].files, files);
    EXPECT_TRUE(checkEdit(edit)) << checkEdit(edit).error().message;
}

}  // namespace
}  // namespace worldy
