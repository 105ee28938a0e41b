// The window under a virtual display, driven like a user would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/picture.h"
#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::Not;

bool canOpenWindows() {
    return std::system("command -v xvfb-run xdotool import convert >/dev/null 2>&1") == 0;
}

// Starts the window, waits until the middle of the viewport shows something, runs the steps, and quits by
// Esc. The picture the shell function "shot NAME" takes lands in the folder.
Ran runInWindow(const TemporaryFolder& folder, const std::string& arguments, const std::string& steps) {
    std::ofstream(folder.path() / "steps.sh")
        << "'" WORLDY_BINARY "' " << arguments << " &\nworldy=$!\n"
        << "shot() { import -window root \"$1\"; }\n"
           "brightness() { import -window root -crop 160x120+180+140 png:- | convert png:- -format "
           "'%[fx:mean>0.06]' info:; }\n"
           "for i in $(seq 200); do [ \"$(brightness)\" = 1 ] && break; sleep 0.1; done\n"
           "xdotool mousemove 200 200\n"
        << steps << "\nxdotool key Escape\nwait $worldy\n";
    // Graphics drivers are unloaded before a leak checker looks, so it takes what they keep for leaks of
    // ours.
    return runShell(folder,
                    "ASAN_OPTIONS=detect_leaks=0 xvfb-run -a -s '-screen 0 800x600x24' bash steps.sh");
}

void writeSmallWindow(const TemporaryFolder& folder) {
    const std::filesystem::path file = folder.path() / "config" / "worldy" / "settings.toml";
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "[window]\nwidth_px = 800\nheight_px = 600\n";
}

std::string settingsOf(const TemporaryFolder& folder) {
    return contentOf(folder.path() / "config" / "worldy" / "settings.toml");
}

TEST(Window, ShowsThePlanetAndQuitsOnEscape) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs xvfb-run, xdotool and ImageMagick";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeSmallWindow(folder);
    const Ran ran = runInWindow(folder, "planet.chk", "shot window.png");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    const planet::Result<Picture> picture = readPicture(folder.path() / "window.png");
    ASSERT_TRUE(picture) << picture.error().message;
    const std::size_t middle = 3 * (200 * 800 + 250);
    EXPECT_GT(picture->rgb[middle] + picture->rgb[middle + 1] + picture->rgb[middle + 2], 60);
    EXPECT_THAT(ran.errors, HasSubstr("Open: planet.chk"));
    // Nothing was changed, so nothing was written.
    EXPECT_EQ(settingsOf(folder), "[window]\nwidth_px = 800\nheight_px = 600\n");
}

TEST(Window, BakesASourceOnceAndShowsIt) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs xvfb-run, xdotool and ImageMagick";
    const TemporaryFolder folder;
    writeHills(folder);
    writeSmallWindow(folder);
    const Ran first = runInWindow(folder, "hills.pgm", "");
    EXPECT_EQ(first.exitCode, 0) << first.errors;
    EXPECT_THAT(first.errors, HasSubstr("Baked:"));
    const Ran second = runInWindow(folder, "hills.pgm", "");
    EXPECT_EQ(second.exitCode, 0) << second.errors;
    EXPECT_THAT(second.errors, Not(HasSubstr("Baking")));
    EXPECT_THAT(second.errors, HasSubstr("Open:"));
}

TEST(Window, RemembersADraggedSplitter) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs xvfb-run, xdotool and ImageMagick";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeSmallWindow(folder);
    // The LOD panel is 310 units of 15/13 pixels wide; the splitter lies on its left.
    const Ran ran = runInWindow(folder, "planet.chk",
                                "xdotool mousemove 439 300; sleep 1; xdotool mousedown 1; sleep 1;"
                                "xdotool mousemove 500 300; sleep 1; xdotool mouseup 1; sleep 1");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    const std::string settings = settingsOf(folder);
    EXPECT_THAT(settings, HasSubstr("lod_panel_width = 2")) << settings;
}

TEST(Window, KeysChangeWhatIsDrawnAndBack) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs xvfb-run, xdotool and ImageMagick";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeSmallWindow(folder);
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
viewport() { import -window root -crop 420x380+0+0 +repage png:- | convert png:- rgb:- | md5sum; }
becomes() { for i in $(seq 100); do [ "$(viewport)" $1 "$2" ] && return 0; sleep 0.1; done; return 1; }
plain=; while [ "$plain" != "$(viewport)" ]; do plain=$(viewport); sleep 0.5; done
for key in F1 F2 F4; do
    xdotool key $key; becomes != "$plain" || echo "$key changes nothing"
    xdotool key $key; becomes = "$plain" || echo "$key does not change back"
done
)sh");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
}

TEST(Window, ABrokenShaderLeavesTheLastGoodOneAndAMendedOneIsTaken) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs xvfb-run, xdotool and ImageMagick";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeSmallWindow(folder);
    std::filesystem::copy(WORLDY_SOURCE_DIR "/shaders", folder.path() / "glsl");
    const Ran ran = runInWindow(folder, "planet.chk --shaders glsl", R"sh(
says() { for i in $(seq 100); do grep -q "$1" .stderr && return 0; sleep 0.1; done; return 1; }
echo 'this is no GLSL' >> glsl/chunk.frag; says 'error: .*chunk.frag' || echo "nothing is said of the broken shader"
[ "$(brightness)" = 1 ] || echo "the planet is gone"
sed -i '$d' glsl/chunk.frag; says 'Shaders of glsl reloaded' || echo "the mended shader is not taken"
)sh");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "") << ran.errors;
}

TEST(Window, TheWheelComesNearerAndResetGoesBack) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs xvfb-run, xdotool and ImageMagick";
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeSmallWindow(folder);
    // Black corners of space are filled by the planet.
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
corner() { import -window root -crop 40x40+10+250 png:- | convert png:- -format '%[fx:mean>0.06]' info:; }
becomes() { for i in $(seq 100); do [ "$(corner)" = $1 ] && return 0; sleep 0.1; done; return 1; }
becomes 0 || echo "no space to be seen at first"
for i in 1 2 3 4 5 6 7 8 9 10 11 12; do xdotool click 4; done
becomes 1 || echo "the wheel does not come nearer"
xdotool key F3; becomes 0 || echo "F3 does not go back"
)sh");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
}

}  // namespace
}  // namespace worldy
