// Steering the window by a gamepad, by the wheel and by Alt, and gliding to places.
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using SteeringWindowTest = PlanetWindowFixture;

// A device of the test's own stands in for GLFW's.
TEST_F(SteeringWindowTest, aGamepadThatComesWhileItRunsFliesAndPressesButtons) {
    writeWindowSettings(folder, "[panels]\nright_front = \"camera\"\n");
    const Ran ran = runOnDisplay(
        folder, R"sh(
pad() { echo "$*" > pad.new; mv pad.new pad.txt; frames; }
moved() { [ "$(counter camera)" != "$1" ]; }
)sh"
                "export FAKE_JOYSTICK=pad.txt ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0\n"
                "LD_PRELOAD='" FAKE_JOYSTICK_LIBRARY "' '" WORLDY_BINARY
                "' --item-map items.txt planet.chk &\nworldy=$!\n"
                R"sh(
until_true is_open || echo 'the planet is not open'
xdotool mousemove 600 5; settle
start=$(counter camera)
pad gamepad Test_pad 0.1 -0.1 nan nan -1 -1 0
moved "$start" && echo 'a gamepad at rest moves the camera'
pad gamepad Test_pad 0 -1 0 0 -1 -1 0; expect moved "$start"
pad gamepad Test_pad 0 0 0 0 -1 -1 4; expect counts lod_frozen -eq 1
pad gamepad Test_pad 0 0 0 0 -1 -1 4; expect counts lod_frozen -eq 1
pad gamepad Test_pad 0 0 0 0 -1 -1 0; still=$(counter camera); frames
moved "$still" && echo 'the camera does not stop'
rm pad.txt; frames; pad joystick SpaceNavigator 0 0 1 0 0 0 0; expect moved "$still"
rm pad.txt; frames; still=$(counter camera); frames 6; moved "$still" && echo 'a device that went still steers'
xdotool key --clearmodifiers ctrl+q; wait $worldy
)sh");
    expectQuiet(ran);
}

TEST_F(SteeringWindowTest, theWheelAltAndKeysSteerAndPlacesAreGlidedTo) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
moved() { [ "$(counter camera)" != "$1" ]; }
is_at() { [ "$(counter camera)" = "$1" ]; }
start=$(counter camera)
point viewport/picture; xdotool mousedown 3; frames; xdotool click 4; frames; expect shown confirmation/Text
is_at "$start" || echo 'the wheel zooms while a button is held'
xdotool mouseup 3; frames; before=$(viewport)
xdotool keydown ctrl; frames; xdotool click 4; frames; xdotool keyup ctrl; settle; expect differs "$before"
is_at "$start" || echo 'with Ctrl, the wheel moves the camera'
key ctrl+z; expect same "$before"
point viewport/picture 0.6 0.6; xdotool keydown alt; press; xdotool mousemove_relative -- 40 15; frames; release; xdotool keyup alt; frames
expect moved "$start"; away=$(counter camera)
key F3; frames 2; is_at "$start" && echo 'the camera jumps'
expect is_at "$start"
point viewport/picture 0.7 0.4; key f; expect moved "$start"
key F3; expect is_at "$start"
)sh");
    expectQuiet(ran);
}

}  // namespace
}  // namespace worldy
