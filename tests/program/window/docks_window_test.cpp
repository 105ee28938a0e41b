// The docks in the window, driven by the mouse: panels are maximised, dragged, floated, docked and reordered, and
// layouts are chosen, saved, replaced and deleted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using testing::HasSubstr;

// Functions for the steps below. Places are those of the item map: x, y, width, height.
constexpr const char* dockFunctions = R"sh(
# drag tab/Chunk viewport/picture 0.5 0.5: holds the button down over the target, in two steps.
drag() {
    point "$1" || return 1
    press; set -- $(at "$2" ${3:-0.5} ${4:-0.5})
    xdotool mousemove $(($1 + 30)) $(($2 + 20)); frames
    xdotool mousemove $1 $2; frames
}
double_click() { point "$1" $2 $3 && xdotool click --repeat 2 --delay 60 1 && frames 4; }
left() { set -- $(place "$1"); echo ${1%.*}; }
top() { set -- $(place "$1"); echo ${2%.*}; }
is_left_of() { [ $(top "$1") -eq $(top "$2") ] && [ $(left "$1") -lt $(left "$2") ]; }
layout() { click menu/View && click menu/Layout && click "layout/$1"; }
)sh";

class DocksWindowTest : public PlanetWindowFixture {
protected:
    // Steps print what is wrong.
    void drive(const std::string& steps, const Screen& screen = {}) {
        const Ran ran = runInWindow(folder, "planet.chk", dockFunctions + steps, screen);
        expectQuiet(ran);
    }
};

TEST_F(DocksWindowTest, aDoubleClickOnATabMaximisesItsDockAndBack) {
    drive(R"sh(
drawn=$(counter drawn); triangles=$(counter triangles); before=$(place viewport/picture)
same_readings() { [ "$(counter drawn)" = $drawn ] && [ "$(counter triangles)" = $triangles ] || echo "$1: other readings"; }
double_click tab/Frame
expect shown tab/Restore; expect shown frame/Pause
hidden viewport/picture || echo "the viewport shows beside a maximised dock"
hidden tab/LOD || echo "the right dock shows beside a maximised one"
set -- $(place tab/Restore); [ $(($1 + $3)) -gt 760 ] || echo "the dock does not fill the window: $*"
settle; same_readings maximised; shot maximised.png
key Escape; expect shown viewport/picture; expect hidden tab/Restore
[ "$(place viewport/picture)" = "$before" ] || echo "the viewport was $before, is $(place viewport/picture)"
settle; same_readings restored

double_click tab/LOD; expect shown tab/Restore; double_click tab/LOD; expect hidden tab/Restore
double_click tab/LOD; click tab/Restore; expect hidden tab/Restore; expect shown viewport/picture
# A panel of another dock comes into sight.
double_click tab/LOD; key ctrl+5; expect shown chunk/Id; expect shown viewport/picture
# Going to a place shows the planet.
double_click tab/Camera; click camera/Andes; expect shown viewport/picture; expect hidden tab/Restore
# It is kept between runs.
double_click tab/Paging
)sh");
    EXPECT_THAT(settingsOf(folder), HasSubstr("maximised = \"bottom\""));
    drive(
        "expect shown tab/Restore; hidden tab/LOD || echo 'the maximised dock was forgotten'\nkey Escape\n");
}

TEST_F(DocksWindowTest, aTabDraggedOutFloatsMovesResizesAndDocksWhereItIsDropped) {
    drive(R"sh(
drag tab/Chunk viewport/picture 0.4 0.4; expect shown drop/Preview; expect shown drop/Float; shot float_preview.png
release; expect shown float/Chunk; expect hidden tab/Chunk; shown chunk/Id || echo "the floating panel is empty"
enter chunk/Id z_pos/1/1/0; is_selected() { [ "$(counter selected)" = z_pos/1/1/0 ]; }; expect is_selected

was=$(place float/Chunk); drag float/Chunk viewport/picture 0.6 0.7; release
[ "$(place float/Chunk)" != "$was" ] || echo "the panel does not move"
hidden drop/Preview || echo "the preview stays"
set -- $(place float/Chunk); width=$3
point "float/Chunk: corner" 0.8 0.8; press; xdotool mousemove_relative -- -60 -40; frames; release
set -- $(place float/Chunk); [ $3 -eq $((width - 60)) ] || echo "it was $width wide, is $3"
shot floating.png

# Onto the tabs of the right dock, between the first two of them.
drag float/Chunk tab/Seams 0.1 0.5; expect shown drop/Mark; expect shown "drop/Right dock, after LOD"; shot dock_preview.png
release; expect hidden float/Chunk; expect shown tab/Chunk
is_left_of tab/LOD tab/Chunk || echo "Chunk lies before LOD"; is_left_of tab/Chunk tab/Seams || echo "Chunk lies after Seams"
shown chunk/Id || echo "the docked panel is not in front"

# Over the panel of another dock: to the end of that dock.
drag tab/Chunk paging/Budget; expect shown "drop/Bottom dock, after Log"; release; is_left_of tab/Log tab/Chunk || echo "Chunk lies not after Log"
# Esc leaves it where it was, and the selection too. Option --clearmodifiers would release the button.
selected=$(counter selected)
drag tab/Chunk viewport/picture; expect shown drop/Preview; xdotool key Escape; frames; expect hidden drop/Preview; release
shown tab/Chunk || echo "Esc lets it float"; hidden float/Chunk || echo "Esc lets it float"
[ "$(counter selected)" = "$selected" ] || echo "Esc clears the selection"
# With Ctrl it floats over a dock.
point tab/Chunk; press; xdotool keydown ctrl; xdotool mousemove $(at lod/Hysteresis 0.5 0.5); frames; frames
expect shown drop/Float; release; xdotool keyup ctrl; frames; expect shown float/Chunk
double_click float/Chunk; expect hidden float/Chunk; expect shown tab/Chunk
drag tab/Chunk viewport/picture 0.5 0.5; release; expect shown float/Chunk
place float/Chunk > float.txt
)sh");
    EXPECT_THAT(settingsOf(folder), HasSubstr("{ panel = \"chunk\", x = "));
    // In a smaller window it lies inside.
    drive(R"sh(
expect shown float/Chunk; set -- $(place float/Chunk)
[ $1 -ge 0 ] && [ $(($1 + $3)) -le 640 ] && [ $2 -ge 0 ] && [ $(($2 + $4)) -le 400 ] || echo "it lies at $*"
)sh",
          {"640x400", 60});
    // The size of the window was kept too.
    runShell(folder,
             "sed -i 's/^width_px = .*/width_px = 800/; s/^height_px = .*/height_px = 500/' "
             "config/worldy/settings.toml");
    drive(
        "expect shown float/Chunk\n[ \"$(place float/Chunk)\" = \"$(cat float.txt)\" ] || "
        "echo \"it lay at $(cat float.txt), lies at $(place float/Chunk)\"\n");
}

TEST_F(DocksWindowTest, tabsAreReorderedByDragAndAnEmptyDockOpensAtItsEdge) {
    drive(R"sh(
drag tab/Overlay tab/LOD 0.1 0.5; expect shown "drop/Right dock, before LOD"; release
is_left_of tab/Overlay tab/LOD || echo "Overlay lies after LOD"
share=0.2
for title in Quadtree Chunk Bake; do
    drag tab/$title viewport/picture 0.5 $share; release; expect shown float/$title; share=$(echo $share | tr 25 58)
done
set -- $(place viewport/picture); [ $1 -eq 0 ] || echo "the empty dock takes room: $*"
drag float/Bake viewport/picture 0.01 0.5; expect shown "drop/Left dock"; shot edge_preview.png
release; expect shown tab/Bake; set -- $(place viewport/picture); [ $1 -gt 100 ] || echo "the left dock is not open"
# The close button hides the panel; its key shows it floating again.
click float/Quadtree 0.97 0.5; expect hidden float/Quadtree; key ctrl+2; expect shown float/Quadtree
point float/Quadtree; xdotool click 3; frames; click "tab menu/Dock"; expect shown tab/Quadtree
point tab/Quadtree; xdotool click 3; frames; click "tab menu/Maximise"; expect shown tab/Restore; key Escape
)sh");
    EXPECT_THAT(settingsOf(folder), HasSubstr("order = [\"overlay\", \"lod\", \"seams\""));
    drive("is_left_of tab/Overlay tab/LOD || echo 'the order was forgotten'\n");
}

TEST_F(DocksWindowTest, layoutsAreChosenSavedReplacedAndDeleted) {
    drive(R"sh(
layout Measuring; expect shown tab/Sweep; expect shown errors/Measure; hidden tab/Paging || echo "Measuring shows Paging"
layout Paging; expect shown paging/Budget; hidden tab/Sweep || echo "Paging shows Sweep"
layout Selection; expect shown quadtree/Net; hidden tab/Paging || echo "Selection shows Paging"
layout Default; expect shown tab/Bake; expect shown tab/Paging

key ctrl+8; key ctrl+8; expect hidden tab/Bake
layout "Save as..."; expect shown layout/Name; xdotool type --delay 20 "mine"; frames; key Return; expect hidden layout/Name
file=config/worldy/layouts/mine.toml
grep -q 'bake_shown = false' $file || echo "the saved layout has no hidden Bake"
cp $file mine.toml
layout Default; expect shown tab/Bake; layout mine; expect hidden tab/Bake

# An existing one is replaced after a question; a built-in one never.
key ctrl+9; key ctrl+9; expect hidden tab/Frame
layout "Save as..."; xdotool type --delay 20 "Paging"; frames; key Return; expect shown layout/Name; key Escape; expect hidden layout/Name
layout "Save as..."; xdotool type --delay 20 "mine"; frames; key Return; expect shown layout/Question; shot replace.png
cmp -s $file mine.toml || echo "it is replaced before the answer"
click layout/Back; expect shown layout/Name; click layout/Save; expect shown layout/Question; click layout/Replace
expect hidden layout/Question; expect grep -q 'frame_shown = false' $file

# The key cycles. Panels that are not saved come back.
key ctrl+l; key ctrl+l; expect hidden tab/Log
key ctrl+shift+l; expect shown tab/Log; expect shown tab/Bake
key ctrl+shift+l; expect shown tab/Sweep
layout "Back to unsaved layout"; expect hidden tab/Log; expect hidden tab/Sweep

layout "Delete mine..."; expect shown layout/Delete; key Escape; [ -e $file ] || echo "it is deleted before the answer"
layout "Delete mine..."; click layout/Delete; expect [ ! -e $file ]
click menu/View && click menu/Layout; expect shown layout/Measuring; hidden layout/mine || echo "mine is still listed"; key Escape; key Escape
)sh");
}

TEST_F(DocksWindowTest, aBrokenLayoutIsGreyAndSaysWhy) {
    const std::filesystem::path layouts = folder.path() / "config" / "worldy" / "layouts";
    std::filesystem::create_directories(layouts);
    std::ofstream(layouts / "broken.toml") << "[panels]\nlod = \"top\"\n";
    drive(R"sh(
expect shown message/Text; key Return; expect hidden message/Text
says 'broken.toml: line 2: panels.lod is' || echo "the log does not name the broken layout"
expect shown status/error
click menu/View && click menu/Layout && point layout/broken; shot broken.png; xdotool click 1; frames
shown layout/broken || echo "a broken layout can be chosen"
key Escape; key Escape
)sh");
    EXPECT_EQ(contentOf(layouts / "broken.toml"), "[panels]\nlod = \"top\"\n");
}

// Both windows are on one screen, beside each other. Places in the second one begin at 16384 in the item map.
TEST_F(DocksWindowTest, aPanelWorksInASecondWindowAndReturns) {
    writeWindowSettings(folder,
                        "[window]\nwidth_px = 800\nheight_px = 500\nsecond_x_px = 810\nsecond_y_px = 20\n"
                        "second_width_px = 380\nsecond_height_px = 420\n");
    drive(R"sh(
place() { awk -F'\t' -v n="$1" '$1 == n {x = $2; y = $3; if (x >= 16384) {x += 810 - 16384; y += 20}; print x, y, $4, $5; exit}' items.txt 2>/dev/null; }
is_second() { [ "$(xdotool search --name 'second window' 2>/dev/null | wc -l)" -eq $1 ]; }
in_second() { [ "$(left "$1")" -ge 810 ]; }
move_out() { point tab/LOD; xdotool click 3; frames 4; click "tab menu/Move to the second window"; expect is_second 1; expect in_second tab/LOD; }
before=$(place viewport/picture)
move_out
in_second tab/Seams && echo "Seams has moved too"
# Sliders, lists and keys work there.
drawn=$(counter triangles); slide "lod/Tolerance τ" 0.15; settle
[ $(counter triangles) -gt $drawn ] || echo "the slider does not work: $(counter triangles) of $drawn triangles"
click "lod/Error metric"; expect in_second "lod/Error metric: tight"; click "lod/Error metric: tight"
key F2; expect counts lod_frozen -eq 1; key F2
# A drag over it shows there where the panel would go. Esc ends the drag.
point tab/Frame; press; xdotool mousemove 760 200; frames; xdotool mousemove 950 250; frames; nap 0.3; shot drag.png
expect in_second drop/Preview; xdotool key Escape; expect hidden drop/Preview; release; in_second tab/Frame && echo "Esc does not end the drag"
blue=$(convert drag.png -crop 1x1+1100+300 +repage txt: | tail -1); convert drag.png -crop 1x1+1100+300 +repage -format '%[fx:u.b>u.r+0.03]' info: | grep -q 1 || echo "no preview is drawn in the second window: $blue"
# A plot is saved from there.
point tab/Seams; xdotool click 3; frames 4; click "tab menu/Move to the second window"; expect in_second tab/Seams
click "seams/level differences menu" && click "seams/Save picture as PNG"; expect says 'level differences.png'
plot=$(find . -name '*level differences.png' | head -1)
[ "$(identify -format '%k' "$plot" 2>/dev/null)" -gt 10 ] || echo "the picture of the plot is empty"
point tab/Seams; xdotool click 3; frames 4; click "tab menu/Move to the left"; frames
in_second tab/Seams && echo "Seams is still in the second window"
# A maximised dock leaves it alone.
double_click tab/Frame; expect shown tab/Restore; in_second tab/LOD || echo "a maximised dock covers the second window"; key Escape
# It is dragged back into the dock that it came from, and the window closes.
drag tab/LOD tab/Seams 0.1 0.5; expect shown drop/Preview; release
expect is_second 0; in_second tab/LOD && echo "LOD is still in the second window"
is_left_of tab/LOD tab/Seams || echo "LOD is not before Seams"
[ "$(place viewport/picture)" = "$before" ] || echo "the viewport was $before, is $(place viewport/picture)"
# Dropped outside of the window, it goes into the second one. Another start opens it again.
point tab/LOD; press; xdotool mousemove 760 200; frames; xdotool mousemove 1000 200; frames; release
expect is_second 1; expect in_second tab/LOD
)sh",
          {"1200x500", 60});
    EXPECT_THAT(settingsOf(folder), HasSubstr("lod = \"second_window\""));
    EXPECT_THAT(settingsOf(folder), HasSubstr("second_x_px = 810"));
}

}  // namespace
}  // namespace worldy
