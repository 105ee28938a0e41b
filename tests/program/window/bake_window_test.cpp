// Files that are baked, opened and dropped while a planet is shown.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

class BakeWindowTest : public WindowFixture {
protected:
    std::vector<std::filesystem::path> bakes() const {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "cache" / "worldy"))
            files.push_back(entry.path());
        return files;
    }
};

TEST_F(BakeWindowTest, ABakeFromThePanelTakesThePlanetsPlaceAndACancelledOneChangesNothing) {
    writeHills(folder);
    // All of the Bake panel is in sight where nothing is below it.
    writeWindowSettings(folder, "[panels]\npaging_shown = false\nframe_shown = false\nlog_shown = false\n");
    const Ran ran = runInWindow(folder, "hills.pgm", R"sh(
start=$(counter camera); tab Camera; click camera/Andes; tab LOD; slide "lod/Tolerance τ" 0.2; settle
first=$(counter file); size=$(counter chunk_size); camera=$(counter camera)
key ctrl+shift+c; expect times_said 'Copied: ' 1
[ "$camera" != "$start" ] || echo "the camera is where it was at first"
[ "$size" != 17 ] || echo "the first bake has the second one's chunk size"

tab Bake; choose "bake/Chunk size" "17 vertices"; click bake/Bake
expect counts chunk_size -eq 17; settle
[ "$(counter camera)" = "$camera" ] || echo "the camera was at $camera, is at $(counter camera)"
key ctrl+shift+c; expect times_said 'Copied: ' 2
second=$(counter file); [ "$second" != "$first" ] || echo "it is the same file"
cp "$second" second.chk

click "bake/Show previous bake"; expect counts chunk_size -eq $size
click "bake/Show previous bake"; expect counts chunk_size -eq 17
click bake/Dismiss; expect hidden "bake/Show previous bake"

# Another size is offered by the LOD panel too.
choose "lod/Chunk size" "65 x 65"; click lod/Bake; expect counts chunk_size -eq 65; settle
third=$(counter file); plain=$(viewport)
click bake/Dismiss; expect hidden bake/Dismiss

# Large enough to be cancelled on its way.
click "bake/Face size"; reach "bake/Face size: 129 samples" "bake/Face size: 8193 samples"
click "bake/Face size: 8193 samples"; click bake/Bake; expect counts baking -eq 1 || grep -a bake/ items.txt
click bake/Cancel; expect counts baking -eq 0; expect says 'The bake was cancelled'
[ "$(counter file)" = "$third" ] || echo "a cancelled bake leaves $(counter file)"
[ "$(counter camera)" = "$camera" ] || echo "a cancelled bake leaves the camera at $(counter camera)"
settle; same "$plain" || echo "a cancelled bake changes the picture"
hidden "bake/Show previous bake" || echo "a cancelled bake is there to compare"

mv hills.pgm gone.pgm; click bake/Bake; expect says 'hills.pgm: no such source'
[ "$(counter file)" = "$third" ] || echo "a bake without a source leaves $(counter file)"
counts drawn -gt 0 || echo "a bake without a source leaves nothing"
)sh");
    expectQuiet(ran);
    // The first at the start and two more: neither the cancelled one nor half a file.
    EXPECT_EQ(bakes().size(), 3u);
    const Ran told = runWorldy(folder, "info second.chk --json");
    ASSERT_EQ(told.exitCode, 0) << told.errors;
    EXPECT_EQ(nlohmann::json::parse(told.output)["chunk_size"], 17);

    const auto cameraAfter = [&](std::size_t from) {
        const std::size_t at = ran.errors.find("--camera=", ran.errors.find("Copied: ", from));
        return ran.errors.substr(at, ran.errors.find(' ', at) - at);
    };
    EXPECT_EQ(cameraAfter(0), cameraAfter(ran.errors.find("Copied: ") + 1));
}

void writeMap(const std::filesystem::path& file, int red) {
    std::ofstream stream(file, std::ios::binary);
    stream << "P6\n64 32\n255\n";
    for (int i = 0; i < 64 * 32; ++i) stream << static_cast<char>(red) << '\x40' << static_cast<char>(i % 64);
}

TEST_F(BakeWindowTest, ColoursAreChosenBakedStreamedAndKeptUntilTheyAreLeftOut) {
    writeHills(folder);
    writeMap(folder.path() / "map.ppm", 200);
    writeMap(folder.path() / "red.ppm", 255);
    std::ofstream(folder.path() / "broken.ppm", std::ios::binary) << "P6\n64 32\n255\ntoo short";
    writeWindowSettings(folder, "[panels]\npaging_shown = false\nframe_shown = false\nlog_shown = false\n");
    const Ran ran = runInWindow(folder, "hills.pgm", R"sh(
counts colour_tiles -eq 0 || echo "there are colours already"
plain=$(viewport); first=$(counter file)
tab Bake; choose bake/Colours "another image"; enter bake/Image map.ppm; choose "bake/Colour face" "513 texels"
click bake/Bake; expect counts colour_tiles -ge 6; settle
differs "$plain" || echo "the colours are not drawn"
coloured=$(counter file); [ "$coloured" != "$first" ] || echo "it is the same file"
cp "$coloured" coloured.chk

# Another chunk size keeps them, in the Bake panel and in the LOD panel.
choose "bake/Chunk size" "17 vertices"; click bake/Bake; expect counts chunk_size -eq 17; settle
counts colour_tiles -ge 6 || echo "a bake of another chunk size has lost the colours"
tab LOD; choose "lod/Chunk size" "65 x 65"; click lod/Bake; expect counts chunk_size -eq 65; settle
counts colour_tiles -ge 6 || echo "a bake from the LOD panel has lost the colours"
tab Bake; kept=$(counter file)

# What cannot be read is named and changes nothing.
enter bake/Image broken.ppm; click bake/Bake; expect says 'error: .*broken.ppm'
[ "$(counter file)" = "$kept" ] || echo "a broken image leaves $(counter file)"
counts colour_tiles -ge 6 || echo "a broken image leaves no colours"

# Large enough to be cancelled among them.
files=$(ls cache/worldy | wc -l)
enter bake/Image red.ppm; click "bake/Colour face"; reach "bake/Colour face: 513 texels" "bake/Colour face: 32769 texels"
click "bake/Colour face: 32769 texels"; click bake/Bake; expect counts baking -eq 1
click bake/Cancel; expect counts baking -eq 0; expect says 'The bake was cancelled'
[ $(ls cache/worldy | wc -l) -eq $files ] || echo "a cancelled bake leaves $(ls cache/worldy)"
[ "$(counter file)" = "$kept" ] || echo "a cancelled bake leaves $(counter file)"

# A file dropped on the controls is the image of colours.
choose "bake/Colour face" natural; enter bake/Image map.ppm; point bake/Image
')sh" DROP_FILE_BINARY R"sh(' Worldy "$PWD/red.ppm" || echo "the window does not take red.ppm"
frames; before=$(viewport); click bake/Bake; expect counts baking -eq 0; expect differs "$before"
counts colour_tiles -eq 6 || echo "$(counter colour_tiles) tiles of the dropped image"
says 'red.ppm: ' && echo "the dropped image was opened as heights"

choose bake/Colours none; click bake/Bake; expect counts colour_tiles -eq 0; settle
)sh",
                                {"800x690"});
    expectQuiet(ran);
    const Ran told = runWorldy(folder, "info coloured.chk --json");
    ASSERT_EQ(told.exitCode, 0) << told.errors;
    EXPECT_NE(told.output.find("map.ppm"), std::string::npos) << told.output;
}

TEST_F(BakeWindowTest, ADroppedFileIsOpenedAndABrokenOneLeavesThePlanet) {
    bakePlanet(folder);
    ASSERT_EQ(runWorldy(folder, "bake hills.pgm -o other.chk --chunk-size 33 --radius 100000").exitCode, 0);
    std::ofstream(folder.path() / "broken.chk") << "this is no chunk file";
    std::ofstream(folder.path() / "broken.png") << "nor is this a picture";
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
plain=$(viewport)
for file in broken.chk broken.png; do
    ')sh" DROP_FILE_BINARY R"sh(' Worldy "$PWD/$file" || echo "the window does not take $file"
    expect says "error: .*$file"
    [ "$(counter file)" = planet.chk ] || echo "$file leaves $(counter file)"
    expect shown message/Text; expect shown status/error
    [ $file = broken.chk ] && { shot message.png; key Escape; } || key Return
    expect hidden message/Text
done
tab Paging; settle
same "$plain" || echo "broken files change the picture"
')sh" DROP_FILE_BINARY R"sh(' Worldy "$PWD/other.chk" || echo "the window does not take other.chk"
expect counts chunk_size -eq 33; [ "$(counter file)" = "$PWD/other.chk" ] || echo "open is $(counter file)"
settle; differs "$plain" || echo "the picture is the old one"
click menu/File && click "menu/Open recent" && click "menu item/$PWD/other.chk"; frames
key ctrl+o; frames; xdotool type --delay 20 "$PWD/planet.chk"; frames; key Return; expect counts chunk_size -eq 17
# Opened again, what is typed takes the place of the last path.
key ctrl+o; frames; xdotool type --delay 20 "$PWD/other.chk"; frames; key Return; expect counts chunk_size -eq 33
key ctrl+o; expect shown open/Path; key Escape; expect hidden open/Path
key F10; expect shown "help/Keys and mouse"; shot keys.png; key Escape; expect hidden "help/Keys and mouse"
)sh");
    expectQuiet(ran);
}

}  // namespace
}  // namespace worldy
