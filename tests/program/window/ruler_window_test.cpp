// The ruler in the window: two clicks on the ground measure what lies between them.
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using RulerWindowTest = PlanetWindowFixture;

TEST_F(RulerWindowTest, twoClicksMeasureTheGroundAndNoChunkIsSelected) {
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
selected() { [ "$(counter selected)" = "$1" ]; }
key ctrl+shift+r; expect shown "ruler/Click places"
plain=$(viewport)
click "ruler/Click places"
click viewport/picture 0.45 0.55; expect differs "$plain"; hidden ruler/Profile || echo "one end has a profile"
click viewport/picture 0.6 0.4; expect shown ruler/Profile
selected none || echo "a click of the ruler selects $(counter selected)"
measured=$(viewport)
click ruler/Clear; expect hidden ruler/Profile; expect differs "$measured"
click "ruler/Click places"; click viewport/picture 0.5 0.5; ! selected none || echo "a click selects nothing"
)sh",
                                usualScreen);
    expectQuiet(ran);
}

}  // namespace
}  // namespace worldy
