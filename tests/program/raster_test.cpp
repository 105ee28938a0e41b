// Georeferenced rasters, by the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program/run_program.h"

namespace worldy {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string regions = WORLDY_SOURCE_DIR "/data/regions/";

TEST(RasterProgram, BakesTilesOfAPatternAndVerifiesThem) {
    const TemporaryFolder folder;
    const std::string pattern = "'" + regions + "N49W12*.tif'";
    const Ran baked = runWorldy(folder, "bake " + pattern + " --face-size 513 -o coast.chk --json");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    const Ran verified = runWorldy(folder, "verify coast.chk --source " + pattern);
    EXPECT_EQ(verified.exitCode, 0) << verified.output << verified.errors;
    EXPECT_THAT(verified.output, HasSubstr("compared with the source, 0 problems"));
    const Ran info = runWorldy(folder, "info coast.chk --json");
    EXPECT_THAT(nlohmann::json::parse(info.output)["source"].get<std::string>(),
                AllOf(HasSubstr("2 rasters on 1 grid"), HasSubstr("WGS 84")));
}

TEST(RasterProgram, SeveralFilesMakeOnePlanet) {
    const TemporaryFolder folder;
    const std::string files = WORLDY_SOURCE_DIR "/data/earth/elevation.tif " + regions + "S33W071.tif";
    const Ran baked = runWorldy(folder, "bake " + files + " --face-size 513 -o andes.chk");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    const Ran info = runWorldy(folder, "info andes.chk --json");
    EXPECT_THAT(nlohmann::json::parse(info.output)["source"].get<std::string>(),
                HasSubstr("elevation.tif, 2 rasters on 2 grids"));
    const Ran mixed = runWorldy(folder, "bake " + files + " noise:fbm -o mixed.chk");
    EXPECT_EQ(mixed.exitCode, 2);
    EXPECT_THAT(mixed.errors, HasSubstr("noise:fbm: cannot be one of several sources"));
    const Ran gone = runWorldy(folder, "bake " + files + " gone.tif -o gone.chk");
    EXPECT_EQ(gone.exitCode, 2);
    EXPECT_THAT(gone.errors, HasSubstr("gone.tif: no such file"));
}

TEST(RasterProgram, BakesAWorldFileAndVerifiesIt) {
    const TemporaryFolder folder;
    std::ofstream(folder / "world.toml")
        << "[[elevation]]\nfiles = \"" WORLDY_SOURCE_DIR "/data/earth/elevation.tif\"\n"
        << "[[elevation]]\nfiles = \"" << regions << "*.tif\"\nfeather_m = 8000\n"
        << "voids = \"fill\"\n";
    const Ran baked = runWorldy(folder, "bake world.toml --face-size 513 -o world.chk");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    EXPECT_THAT(baked.errors, HasSubstr("samples have no data; its layers say what they show"));
    const Ran verified = runWorldy(folder, "verify world.chk --source world.toml");
    EXPECT_EQ(verified.exitCode, 0) << verified.output << verified.errors;
    const Ran wrong = runWorldy(folder, "bake world.toml --fill 3 -o wrong.chk");
    EXPECT_EQ(wrong.exitCode, 2);
    EXPECT_THAT(wrong.errors, HasSubstr("world.toml: is a world file"));
    const Ran overwriting = runWorldy(folder, "bake world.toml -o world.toml --overwrite");
    EXPECT_EQ(overwriting.exitCode, 2);
}

TEST(RasterProgram, BakesTheColoursOfAWorldFile) {
    const TemporaryFolder folder;
    std::ofstream(folder / "world.toml")
        << "[[elevation]]\nfiles = \"" WORLDY_SOURCE_DIR
           "/data/earth/elevation.tif\"\n"
           "[[colour]]\nfiles = \"" WORLDY_SOURCE_DIR "/data/earth/colour.jpg\"\n";
    const Ran baked =
        runWorldy(folder, "bake world.toml --face-size 129 --colour-face-size 257 -o world.chk --json");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    EXPECT_EQ(nlohmann::json::parse(baked.output)["colour_tiles"], 6);
    const Ran verified = runWorldy(folder, "verify world.chk --source world.toml --colour world.toml");
    EXPECT_EQ(verified.exitCode, 0) << verified.output << verified.errors;
    EXPECT_THAT(verified.output, HasSubstr("6 compared with the image, 0 problems"));
}

TEST(RasterProgram, SkippedFilesAreNamedAndCounted) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(regions + "N49W123.tif", folder.path() / "good.tif");
    std::ofstream(folder / "broken.tif") << "II*\n";
    const Ran refused = runWorldy(folder, "bake '*.tif' --face-size 65 -o a.chk");
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_THAT(refused.errors, AllOf(HasSubstr("broken.tif"), HasSubstr("--skip-broken leaves it out")));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.chk"));
    const Ran baked = runWorldy(folder, "bake '*.tif' --skip-broken --face-size 65 -o a.chk");
    EXPECT_EQ(baked.exitCode, 0) << baked.errors;
    EXPECT_THAT(baked.errors, HasSubstr("worldy: skipped broken.tif"));
    const Ran info = runWorldy(folder, "info a.chk --json");
    EXPECT_THAT(nlohmann::json::parse(info.output)["source"].get<std::string>(), HasSubstr("1 file skipped"));
}

TEST(RasterProgram, PatternWithoutFilesIsRefused) {
    const TemporaryFolder folder;
    const Ran baked = runWorldy(folder, "bake 'none/*.tif' -o none.chk");
    EXPECT_EQ(baked.exitCode, 2);
    EXPECT_THAT(baked.errors, HasSubstr("none/*.tif: no file matches this pattern"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.chk"));
}

TEST(RasterProgram, OutputAmongTheFilesOfAPatternIsRefused) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(regions + "N49W123.tif", folder.path() / "tile.tif");
    const auto bytes = contentOf(folder / "tile.tif");
    const Ran baked = runWorldy(folder, "bake '*.tif' --face-size 65 -o tile.tif --overwrite");
    EXPECT_EQ(baked.exitCode, 2) << baked.errors;
    EXPECT_EQ(contentOf(folder / "tile.tif"), bytes);
}

}  // namespace
}  // namespace worldy
