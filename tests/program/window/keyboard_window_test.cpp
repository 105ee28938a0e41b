// The window without a mouse: the palette, the focus, filters, and changed keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using testing::HasSubstr;

using KeyboardWindowTest = PlanetWindowFixture;

TEST_F(KeyboardWindowTest, thePaletteFindsAndDoes) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
seek() { key ctrl+k; expect shown palette/Query; xdotool type --delay 20 -- "$1"; frames 4; }
seek frl; expect shown "palette/Freeze LOD"; key Return
expect hidden palette/Query; expect counts lod_frozen -eq 1
key F2; expect counts lod_frozen -eq 0
# A setting is edited in the palette; undo reverts it.
seek "tolerance"; key Return; expect shown palette/lod.tau_px
xdotool type --delay 20 7.5; frames; key Return; key Escape; expect shown palette/Query
key Escape; expect hidden palette/Query
seek "hysteresis"; key Return; xdotool type --delay 20 0.3; frames; key Return; key Escape; key Escape
key ctrl+z; frames
# A check box is changed by Space, and the chosen panel comes to the front.
seek "overlay.bounds"; key Return; key space; key Escape; key Escape
seek "precision"; key Return; expect shown tab/Precision
# A place is flown to, a chunk is selected.
start=$(counter camera)
seek "27.99, 86.93"; key Return; settle
[ "$(counter camera)" != "$start" ] || echo 'the camera has not moved'
seek z_pos/1/0/1; key Return; expect hidden palette/Query
# Esc goes from a menu's list to nothing else, and a click elsewhere closes the palette.
seek x; xdotool mousemove $(at viewport/picture 0.5 0.9) click 1; frames 4; expect hidden palette/Query
)sh",
                                usualScreen);
    expectQuiet(ran);
    const std::string settings = settingsOf(folder);
    EXPECT_THAT(settings, HasSubstr("tau_px = 7.5"));
    EXPECT_THAT(settings, HasSubstr("hysteresis = 0.1")) << "the last change is undone";
    EXPECT_THAT(settings, HasSubstr("bounds = true"));
}

TEST_F(KeyboardWindowTest, theFocusReachesPanelsTabsAndFilters) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
# The viewport has the focus at first: arrows and Space do nothing there, the letters fly.
start=$(counter camera)
key Up; key space; key Left; [ "$(counter camera)" = "$start" ] || echo 'the arrows move the camera'
xdotool keydown w; frames 6; xdotool keyup w; frames
[ "$(counter camera)" != "$start" ] || echo 'the keys do not fly'
# The bottom dock lies left of the viewport; its next tabs are Frame and Log.
key ctrl+l; key ctrl+3; key ctrl+shift+Tab; key ctrl+Next; key ctrl+Next
expect shown log/Filter
# The focus is in the dock: Ctrl+F goes to its filter.
key ctrl+f; xdotool type --delay 20 nosuchline; frames 4
hidden "log/line 0" || echo 'the filter shows a line'
key Escape; expect shown "log/line 0"
# A changed slider is reset by the menu of a right click.
seek() { key ctrl+k; expect shown palette/Query; xdotool type --delay 20 -- "$1"; frames 4; }
seek "lod.tau"; key Return; xdotool type --delay 20 9; frames; key Return
key shift+F10; expect shown palette/reset; key Down; key Return; frames; key Escape; key Escape; key Escape
)sh",
                                usualScreen);
    expectQuiet(ran);
    EXPECT_THAT(settingsOf(folder), HasSubstr("tau_px = 2"));
}

TEST_F(KeyboardWindowTest, keysAreChangedByAFile) {
    const std::filesystem::path file = folder.path() / "config" / "worldy" / "keys.toml";
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "freeze_lod = \"Ctrl+E\"\nwirefram = \"F2\"\n";
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
expect shown message/Text; key Return; expect hidden message/Text
says 'keys.toml: line 2: wirefram is not a command; did you mean wireframe?' || echo 'the log does not name it'
key F2; counts lod_frozen -eq 0 || echo 'the old key still works'
key ctrl+e; expect counts lod_frozen -eq 1; key ctrl+e; expect counts lod_frozen -eq 0
# The file is kept when a new one is asked for, and read again.
key F10; click "help/Write key file"; expect shown message/Text; key Return
echo 'freeze_lod = "F2"' > config/worldy/keys.toml
click "help/Reload keys"; key F10; key F2; expect counts lod_frozen -eq 1; key F2
rm config/worldy/keys.toml
key ctrl+k; xdotool type --delay 20 'write key'; frames 4; key Return; frames 4
)sh",
                                usualScreen);
    expectQuiet(ran);
    EXPECT_THAT(contentOf(file), HasSubstr("# freeze_lod = \"F2\"\n"));
}

}  // namespace
}  // namespace worldy
