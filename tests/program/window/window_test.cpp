// The window as a whole under a virtual display, driven like a user would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/base/picture_file.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::Not;

using WindowTest = WindowFixture;

TEST_F(WindowTest, ShowsThePlanetAndQuitsOnCtrlQ) {
    bakePlanet(folder);
    writeWindowSettings(folder, "[window]\nwidth_px = 1000\nheight_px = 700\n");
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
key Escape
counts drawn -gt 0 || echo "nothing is drawn"
place viewport/picture > viewport.txt
shot window.png
)sh",
                                usualScreen);
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
    EXPECT_THAT(ran.errors, HasSubstr("Open: planet.chk"));
    const planet::Result<Picture> picture = readPicture(folder.path() / "window.png");
    ASSERT_TRUE(picture) << picture.error().message;
    std::size_t x = 0, y = 0, width = 0, height = 0;
    std::ifstream(folder.path() / "viewport.txt") >> x >> y >> width >> height;
    ASSERT_GT(width, 300u);
    const std::size_t middle =
        3 * ((y + height / 2) * static_cast<std::size_t>(picture->width) + x + width / 2);
    EXPECT_GT(picture->rgb[middle] + picture->rgb[middle + 1] + picture->rgb[middle + 2], 60);
    // Nothing was changed, so nothing was written.
    EXPECT_EQ(settingsOf(folder), "[window]\nwidth_px = 1000\nheight_px = 700\n");
}

TEST_F(WindowTest, BakesASourceOnceAndShowsIt) {
    writeHills(folder);
    const Ran first = runInWindow(folder, "hills.pgm", "");
    EXPECT_EQ(first.exitCode, 0) << first.errors;
    EXPECT_EQ(first.output, "");
    EXPECT_THAT(first.errors, HasSubstr("Baked:"));
    const Ran second = runInWindow(folder, "hills.pgm", "");
    EXPECT_EQ(second.exitCode, 0) << second.errors;
    EXPECT_EQ(second.output, "");
    EXPECT_THAT(second.errors, Not(HasSubstr("Baking")));
    EXPECT_THAT(second.errors, HasSubstr("Open:"));
}

TEST_F(WindowTest, RemembersSplittersThemeAndTextSize) {
    bakePlanet(folder);
    constexpr const char* bright = R"sh(
bright() { import -window root -crop 300x8+900+785 png:- | convert png:- -format '%[fx:mean>0.5]' info:; }
)sh";
    const Ran first = runInWindow(folder, "planet.chk", std::string(bright) + R"sh(
set -- $(place viewport/picture)
xdotool mousemove $(($1 - 3)) $(($2 + 200)); frames
press; xdotool mousemove $(($1 + 67)) $(($2 + 200)); frames; release
set -- $1 $(place viewport/picture)
[ $2 -eq $(($1 + 70)) ] || echo "the splitter went from $1 to $2"

[ "$(bright)" = 0 ] || echo "the dark theme is bright"
click menu/View && click menu/Theme && click "menu item/Light theme"
[ "$(bright)" = 1 ] || echo "the light theme is dark"

set -- $(place tab/LOD)
key ctrl+shift+equal; key ctrl+shift+equal; frames
set -- $4 $(place tab/LOD)
[ $5 -gt $1 ] || echo "the text is no larger: $1, then $5"
click menu/View && click "menu item/Log"
place viewport/picture > viewport.txt
)sh",
                                  usualScreen);
    EXPECT_EQ(first.exitCode, 0) << first.errors;
    EXPECT_EQ(first.output, "");
    const std::string settings = settingsOf(folder);
    EXPECT_THAT(settings, HasSubstr("left_width = 3"));
    EXPECT_THAT(settings, HasSubstr("theme = \"light\""));
    EXPECT_THAT(settings, HasSubstr("log_shown = false"));

    const Ran second = runInWindow(folder, "planet.chk", std::string(bright) + R"sh(
[ "$(bright)" = 1 ] || echo "the light theme was forgotten"
[ "$(place viewport/picture)" = "$(cat viewport.txt)" ] || echo "viewport: $(place viewport/picture), was $(cat viewport.txt)"
hidden tab/Log || echo "the log is back"
)sh",
                                   usualScreen);
    EXPECT_EQ(second.exitCode, 0) << second.errors;
    EXPECT_EQ(second.output, "");
}

TEST_F(WindowTest, KeysAndWheelChangeWhatIsDrawnAndBack) {
    bakePlanet(folder);
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
plain=$(viewport)
for key in F1 F4; do
    key $key; expect differs "$plain"
    key $key; expect same "$plain"
done
for i in 1 2 3 4 5 6 7; do key F8; done
expect differs "$plain"; key F8; expect same "$plain"

start=$(counter camera)
point viewport/picture
for i in 1 2 3 4 5 6 7 8 9 10; do xdotool click 4; done
settle; differs "$plain" || echo "the wheel does not come nearer"
height() { counter camera | cut -d, -f3 | cut -d. -f1; }
[ "$(height)" -lt 150000 ] || echo "the wheel leads to $(counter camera)"
key F2; near=$(counter drawn)
is_at() { [ "$(counter camera)" = "$1" ]; }
key F3; expect is_at "$start" || echo "F3 leads to $(counter camera)"
[ "$(counter drawn)" = "$near" ] || echo "frozen, but other chunks are drawn"
key F2; expect counts drawn -lt $near
key F7; expect shown observer/picture
key F7; expect hidden viewport/picture
key F7; expect hidden observer/picture
)sh");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
}

TEST_F(WindowTest, ABrokenShaderLeavesTheLastGoodOneAndAMendedOneIsTaken) {
    bakePlanet(folder);
    std::filesystem::copy(WORLDY_SOURCE_DIR "/shaders", folder.path() / "glsl");
    const Ran ran = runInWindow(folder, "planet.chk --shaders glsl", R"sh(
plain=$(viewport)
echo 'this is no GLSL' >> glsl/chunk.frag; expect says 'error: .*chunk.frag'
expect shown message/Text; key Return; expect hidden message/Text
frames; same "$plain" || echo "the picture is another one"
sed -i '$d' glsl/chunk.frag; expect says 'Shaders of glsl reloaded'
)sh");
    expectQuiet(ran);
}

TEST_F(WindowTest, ASmallWindowShowsAllDocksAndAViewport) {
    bakePlanet(folder);
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
for name in menu/Help tab/LOD tab/Camera lod/Hysteresis tab/Quadtree quadtree/Net tab/Paging paging/Budget; do
    set -- $(place "$name")
    [ -n "$1" ] || { echo "there is no $name"; continue; }
    [ $1 -ge 0 ] && [ $2 -ge 0 ] && [ $(($1 + $3)) -le 1024 ] && [ $(($2 + $4)) -le 640 ] || echo "$name lies at $*"
done
set -- $(place viewport/picture)
[ $3 -ge 340 ] && [ $4 -ge 200 ] || echo "the viewport is small: $*"
set -- $* $(place tab/LOD); [ $(($1 + $3)) -le $5 ] || echo "the viewport reaches into the right dock"
key F11; frames; set -- $(place viewport/picture)
[ $3 -eq 1024 ] || echo "without panels the viewport is $*"
)sh",
                                {"1024x640", 96});
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
}

}  // namespace
}  // namespace worldy
