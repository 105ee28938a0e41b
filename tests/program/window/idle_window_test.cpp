// The window draws only while something changes.
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using IdleWindowTest = PlanetWindowFixture;

// The item map would keep frames coming, so these steps read the processor time of the processes, in ticks of 10 ms.
TEST_F(IdleWindowTest, aStillWindowUsesNoProcessorUntilThePointerMovesUnlessThatIsTurnedOff) {
    std::filesystem::create_directories(folder.path() / "config2" / "worldy");
    std::ofstream(folder.path() / "config2" / "worldy" / "settings.toml")
        << "[window]\nidle = false\nframe_limit = 30\n";
    const Ran ran = runOnDisplay(folder, R"sh(
ticks() { awk '{print $14 + $15}' /proc/$1/stat; }
uses() { local before=$(ticks $1); sleep 2; used=$(($(ticks $1) - before)); }
rests() { uses $worldy; [ $used -lt 10 ]; }
screen() { import -window root -depth 8 rgb:- | md5sum; }
changed() { [ "$(screen)" != "$1" ]; }
)sh"
                                         "'" WORLDY_BINARY
                                         "' planet.chk 2>/dev/null &\nworldy=$!\n"
                                         "XDG_CONFIG_HOME=$PWD/config2 '" WORLDY_BINARY
                                         "' planet.chk &\nawake=$!\n"
                                         R"sh(
expect rests
uses $awake; [ $used -ge 20 ] || echo "without idling, it uses $used ticks in two seconds"
kill $awake; wait $awake
expect rests
still=$(screen)
xdotool mousemove 20 8; expect changed "$still"
xdotool click 1; expect rests
xdotool key --clearmodifiers Escape; xdotool key --clearmodifiers ctrl+q; wait $worldy
)sh");
    expectQuiet(ran);
}

}  // namespace
}  // namespace worldy
