// Worldy in a window under a display of its own, driven like a user would: shell functions to find controls
// by their names, click, slide, look and count.
#pragma once

#include "tests/program/small_planet.h"

namespace worldy {

inline bool canOpenWindows() {
    return std::system("command -v Xvfb xrdb xdotool import convert compare >/dev/null 2>&1") == 0;
}

// What the steps may use. Names are those of the item map: "tab/LOD", "lod/Tolerance τ", "viewport/picture".
inline constexpr const char* windowFunctions = R"sh(
shot() { import -window root "$1"; }
# Sleeps without starting a program.
mkfifo nap; exec 9<>nap
nap() { read -rt "$1" -u 9; }
# Seconds to wait, far longer than it takes: under a sanitizer all is ten times as slow. After something has not come, the
# steps that rely on it will not come either.
patience=60
until_true() {
    local end=$((SECONDS + patience))
    while [ $SECONDS -lt $end ]; do
        "$@" && return 0
        kill -0 $worldy 2>/dev/null || { echo "worldy has ended: $*"; return 1; }
        nap 0.02
    done
    patience=2
    return 1
}
expect() { until_true "$@" || { echo "not so: $*"; return 1; }; }
says() { grep -q -- "$1" .stderr; }
times_said() { [ "$(grep -c -- "$1" .stderr)" -eq "$2" ]; }
place() { awk -F'\t' -v n="$1" '$1 == n {print $2, $3, $4, $5; exit}' items.txt 2>/dev/null; }
shown() { [ -n "$(place "$1")" ]; }
hidden() { [ -z "$(place "$1")" ]; }
# The counters are the first lines.
counter() {
    local name value
    while IFS=$'\t' read -r name value; do
        case $name in "counter/$1") echo "$value"; return ;; counter/*) ;; *) return ;; esac
    done 2>/dev/null <items.txt
}
# counts drawn -gt 100
counts() { [ "$(counter "$1")" "$2" "$3" ]; }
# Asks for frames and waits until all that was done by now is seen: so many frames that began after it have ended, and no
# key or button waits for its frame. One more frame may have begun before.
frames() {
    local last=$(($(counter frame) + ${1:-3} + 1))
    echo $last >items.txt.ask
    until_true counts frame -ge $last || return 1
    counts queued_input -eq 0 || frames ${1:-3}
}
at() { set -- $(place "$1") $2 $3; awk -v x=$1 -v y=$2 -v w=$3 -v h=$4 -v a=$5 -v b=$6 'BEGIN {printf "%d %d", x + a * w, y + b * h}'; }
# Where it comes to rest: panels may still be making room.
at_rest() { local was="$(place "$1")"; frames 2 && [ "$was" = "$(place "$1")" ]; }
point() {
    until_true shown "$1" || { echo "there is no $1"; [ -z "$KEEP" ] || { shot $KEEP.png; cp items.txt $KEEP.txt; }; return 1; }
    xdotool mousemove $(at "$1" ${2:-0.5} ${3:-0.5})
    at_rest "$1" || { until_true at_rest "$1"; xdotool mousemove $(at "$1" ${2:-0.5} ${3:-0.5}); frames; }
}
press() { xdotool mousedown ${1:-1}; frames; }
release() { xdotool mouseup ${1:-1}; frames; }
# Down and up at once: ImGui takes a frame for each, and what it led to is seen in the next.
click() { point "$1" $2 $3 && xdotool click 1 && frames 4; }
# Sets a slider to a share of its way.
slide() { point "$1" && press && xdotool mousemove $(at "$1" $2 0.5) && frames && release; }
# choose lod/Seams none
choose() { click "$1" && click "$1: $2"; }
# Shows a panel by its tab.
tab() { click "tab/$1"; }
# Turns the wheel over one thing until another is in sight: reach lod/Hysteresis "camera/View"
reach() {
    point "$1" 0.5 0.5 || return 1
    for i in $(seq 60); do
        # Once more than until its first pixels are seen.
        shown "$2" && { xdotool click ${3:-5}; frames; return 0; }
        xdotool click ${3:-5}; frames
    done
    echo "no way to $2"; return 1
}
key() { xdotool key --clearmodifiers "$@"; frames; }
# Types in place of what a field holds, ends with Return.
type_over() { key ctrl+a; xdotool type --delay 20 -- "$1"; frames; key Return; }
enter() { click "$1" && type_over "$2"; }
# A middle part of a picture, without what is written at its borders.
picture() { set -- $(place "$1"); [ $# -eq 4 ] || { echo hidden; return; }; import -window root -crop "$(($3 * 6 / 10))x$(($4 * 4 / 10))+$(($1 + $3 * 2 / 10))+$(($2 + $4 * 3 / 10))" +repage -depth 8 rgb:- | md5sum; }
viewport() { picture viewport/picture; }
differs() { [ "$(viewport)" != "$1" ]; }
same() { [ "$(viewport)" = "$1" ]; }
is_open() { [ -n "$(counter file)" ]; }
loaded() { counts queued -eq 0 && counts loading -eq 0 && counts stand_in -eq 0; }
# The window tells when nothing moves. While it records, for example, the pictures tell it.
still() { counts moving -eq 0 && return; set -- "$(viewport)"; frames 4; [ "$1" = "$(viewport)" ]; }
settled() { loaded && still; }
settle() { frames 4; until_true settled || echo 'the planet does not settle'; }
)sh";

// A monitor. By default a coarse one: text and controls are small on it, so that as much is seen as on 1280 x
// 800 at the usual 96, of two fifths of the pixels, each of which is drawn by the processor.
struct Screen {
    std::string sizePx = "800x500";
    int dotsPerInch = 60;
};
inline const Screen usualScreen{"1280x800", 96};

// Runs a script, which may use the functions above, on a display of its own.
inline Ran runOnDisplay(const TemporaryFolder& folder, const std::string& script, const Screen& screen = {}) {
    std::ofstream(folder.path() / "steps.sh") << windowFunctions << script;
    // The server chooses a free display itself: others may be starting at the same time.
    std::ofstream(folder.path() / "display.sh")
        << "rm -f items.txt display.txt\n"
        << "Xvfb -displayfd 3 -screen 0 " << screen.sizePx
        << "x24 -noreset -nolisten tcp 3>display.txt 2>/dev/null &\nserver=$!\n"
        << "for i in $(seq 200); do [ -s display.txt ] && break; sleep 0.1; done\n"
        << "export DISPLAY=:$(cat display.txt)\n"
        << "echo 'Xft.dpi: " << screen.dotsPerInch << "' | xrdb -nocpp -load\n"
        << "bash steps.sh\ncode=$?\nkill $server\nexit $code\n";
    // Graphics drivers are unloaded before a leak checker looks, so it takes what they keep for leaks of
    // ours.
    return runShell(folder, "ASAN_OPTIONS=detect_leaks=0 bash display.sh");
}

// Starts the window, waits until the planet is there, runs the steps, and quits by Ctrl+Q. Steps print what is wrong.
inline Ran runInWindow(const TemporaryFolder& folder, const std::string& arguments, const std::string& steps,
                       const Screen& screen = {}) {
    return runOnDisplay(folder,
                        "'" WORLDY_BINARY "' --item-map items.txt " + arguments +
                            " &\nworldy=$!\n"
                            "until_true is_open || echo 'the planet is not open'\n"
                            // Off the planet, where it would light a chunk.
                            "xdotool mousemove 600 5\nsettle\n" +
                            steps + "\nxdotool key --clearmodifiers ctrl+q\nwait $worldy\n",
                        screen);
}

inline void writeWindowSettings(const TemporaryFolder& folder, const std::string& text) {
    const std::filesystem::path file = folder.path() / "config" / "worldy" / "settings.toml";
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

inline std::string settingsOf(const TemporaryFolder& folder) {
    return contentOf(folder.path() / "config" / "worldy" / "settings.toml");
}

// The base of tests that open the window.
class WindowFixture : public testing::Test {
protected:
    void SetUp() override {
        if (!canOpenWindows()) GTEST_SKIP() << "needs Xvfb, xdotool and ImageMagick";
    }

    const TemporaryFolder folder;
};

// Has hills.pgm and planet.chk in its folder.
class PlanetWindowFixture : public WindowFixture {
protected:
    void SetUp() override {
        WindowFixture::SetUp();
        if (!IsSkipped()) bakePlanet(folder);
    }
};

}  // namespace worldy
