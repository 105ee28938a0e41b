// The Sources panel in the window: layers are switched, moved, baked and saved, rasters are dropped, and places say what
// made their height.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/planet/source/raster_fixture.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using ::testing::HasSubstr;

// A world of hills and of a mesa of 3000 m around 10 E, 20 N, in front of the first camera.
class SourcesProgram : public testing::Test {
protected:
    SourcesProgram() {
        writeHills(folder);
        planet::test::writeRaster(folder.path() / "mesa.tif",
                                  planet::test::gridAround(4326, 10, 20, 101, 101, 0.2),
                                  [](double, double) { return 3000; });
        planet::test::writeRaster(folder.path() / "second.tif",
                                  planet::test::gridAround(4326, 40, 20, 51, 51, 0.2),
                                  [](double, double) { return 2000; });
        std::ofstream(folder.path() / "world.toml")
            << "[[elevation]]\nname = \"Hills\"\nfiles = \"hills.pgm\"\n[[elevation]]\nname = "
               "\"Mesa\"\nfiles = "
               "\"mesa.tif\"\n";
    }
    const TemporaryFolder folder;
};

TEST_F(SourcesProgram, ProbeSaysWhichSampleMadeTheHeight) {
    ASSERT_EQ(runWorldy(folder, "bake world.toml -o world.chk --face-size 257").exitCode, 0);
    // The sample of column 60 and row 40 lies 2 degrees east and north of the middle one.
    const Ran probed = runWorldy(folder, "probe world.chk 22 12 --source world.toml --json");
    ASSERT_EQ(probed.exitCode, 0) << probed.errors;
    const nlohmann::json source = nlohmann::json::parse(probed.output)["source"];
    ASSERT_EQ(source["layers"].size(), 2u);
    EXPECT_EQ(source["layers"][0]["layer"], "Mesa");
    EXPECT_EQ(source["layers"][0]["height_m"], 3000);
    EXPECT_EQ(source["layers"][0]["file"], "mesa.tif");
    EXPECT_EQ(source["layers"][0]["column"], 60);
    EXPECT_EQ(source["layers"][0]["row"], 40);
    EXPECT_EQ(source["layers"][0]["share"], 1);
    EXPECT_EQ(source["layers"][1]["kind"], "image");
    EXPECT_EQ(source["layers"][1]["share"], 0) << "the mesa covers it";
    const Ran text = runWorldy(folder, "probe world.chk 22 12 --source world.toml");
    EXPECT_THAT(text.output, HasSubstr("mesa.tif: 60, 40"));
    EXPECT_FALSE(
        nlohmann::json::parse(runWorldy(folder, "probe world.chk 22 12 --json").output).contains("source"));
    const Ran wrong = runWorldy(folder, "probe world.chk 22 12 --source none.toml");
    EXPECT_NE(wrong.exitCode, 0);
    EXPECT_THAT(wrong.errors, HasSubstr("none.toml"));
}

TEST_F(SourcesProgram, LayersAreSwitchedMovedBakedAndSavedInTheWindow) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs Xvfb, xdotool and ImageMagick";
    const Ran ran = runInWindow(folder, "world.toml", R"sh(
key ctrl+shift+9; expect shown "sources/layer Mesa"
with=$(viewport)
# Off, the layer is not baked.
click "sources/on Mesa"; click sources/Bake; expect says 'Baking .*worlds/'; expect counts baking -eq 0
settle; differs "$with" || echo "the mesa is still there"
click sources/Revert; click "sources/layer Mesa"; click sources/Down; click sources/Bake; expect counts baking -eq 0; settle
# Under the hills, the mesa does not show.
differs "$with" || echo "the mesa is still on top"
reach sources/Up "sources/Save as"; enter sources/File "$PWD/saved.toml"; click "sources/Save as"; expect says 'World file .*saved.toml saved'
)sh",
                                usualScreen);
    expectQuiet(ran);
    const std::string saved = contentOf(folder.path() / "saved.toml");
    EXPECT_THAT(saved, HasSubstr("files = 'hills.pgm'"));
    EXPECT_LT(saved.find("mesa.tif"), saved.find("hills.pgm")) << saved;
}

TEST_F(SourcesProgram, DroppedRastersBecomeALayerOrAPlanet) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs Xvfb, xdotool and ImageMagick";
    const Ran ran = runInWindow(folder, "world.toml", R"sh(
drop() { ')sh" DROP_FILE_BINARY R"sh(' Worldy "$PWD/$1" || echo "the window does not take $1"; }
opened="$(counter file)"
drop second.tif; expect shown "drop/Add as a layer"; key Escape; expect hidden "drop/Add as a layer"
key ctrl+o; enter open/Path "$PWD/second.tif"; expect shown "drop/Add as a layer"; key Escape; expect hidden "drop/Add as a layer"
[ "$(counter file)" = "$opened" ] || echo "the planet is replaced without a question"
drop second.tif; expect shown "drop/Add as a layer"; click "drop/Add as a layer"
expect shown "sources/layer second.tif"
before=$(viewport); click sources/Bake; expect says 'Baking .*worlds/'; expect counts baking -eq 0; settle
differs "$before" || echo "the second raster does not show"
drop second.tif; click "drop/Open as a planet"; expect says 'Baking .*second.tif'; expect counts baking -eq 0
[ "$(counter file)" != "$opened" ] || echo "the planet is still $(counter file)"
)sh",
                                usualScreen);
    expectQuiet(ran);
}

}  // namespace
}  // namespace worldy
