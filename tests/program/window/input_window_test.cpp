// Keys and clicks that are shorter than a frame, in the window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using InputWindowTest = PlanetWindowFixture;

TEST_F(InputWindowTest, keysTappedWithinAFrameAreSeen) {
    // All that is done while the program stands still comes to it in one frame.
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
at_once() { kill -STOP $worldy; "$@"; kill -CONT $worldy; frames 4; }
tau="lod/Tolerance τ"
point "$tau"; xdotool keydown ctrl; frames; xdotool click 1; frames; xdotool keyup ctrl; frames
number() { xdotool key ctrl+a; xdotool type --delay 1 7.25; xdotool key Return; }
at_once number
# The field is closed, so the keys fly.
start=$(counter camera)
xdotool keydown w; frames 6; xdotool keyup w; frames
[ "$(counter camera)" != "$start" ] || echo "the field has kept the keys"
tap() { xdotool key --clearmodifiers F2; }
at_once tap; expect counts lod_frozen -eq 1
twice() { tap; tap; }
at_once twice; expect counts lod_frozen -eq 1
at_once tap; expect counts lod_frozen -eq 0
start=$(counter camera)
fly() { xdotool key w; }
at_once fly; [ "$(counter camera)" != "$start" ] || echo "a tapped key does not fly"
)sh");
    expectQuiet(ran);
    EXPECT_THAT(settingsOf(folder), testing::HasSubstr("tau_px = 7.25"));
}

}  // namespace
}  // namespace worldy
