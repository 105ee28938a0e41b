// Going to what an instrument has found, in the window: LOD stays as it was measured, and one click leads
// back.
#include <gtest/gtest.h>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

class InspectionWindowTest : public PlanetWindowFixture {
protected:
    void drive(const std::string& steps) {
        const std::string functions = R"sh(
# But for what each frame rounds.
rounded() { echo "$1" | tr , "\n" | xargs printf "%.3f " | sed "s,-\(0\.000\),\1,g"; }
is_at() { [ "$(rounded "$(counter camera)")" = "$(rounded "$1")" ]; }
start=$(counter camera)
# What "Go" has led to: the same chunks from another place.
inspected() {
    expect counts lod_frozen -eq 1; expect shown inspection/Back; settle
    ! is_at "$start" || echo "$1: the camera has not moved"
    counts drawn -eq $drawn || echo "$1: $(counter drawn) chunks are drawn, not the $drawn that were measured"
}
go_back() {
    click inspection/Back; expect hidden inspection/Back; settle
    is_at "$start" || echo "$1: back leads to $(counter camera), not $start"
    counts lod_frozen -eq 0 || echo "$1: LOD stays frozen"
}
)sh";
        const Ran ran = runInWindow(folder, "planet.chk", functions + steps, usualScreen);
        expectQuiet(ran);
    }
};

TEST_F(InspectionWindowTest, goToACrackFreezesLodAndBackUnfreezesIt) {
    drive(R"sh(
slide "lod/Tolerance τ" 0.2; settle; drawn=$(counter drawn)
key ctrl+shift+2; click cracks/Measure; expect shown cracks/Go; click cracks/Go; inspected crack
shot crack.png
# A second one still leads back to where the first one began.
click cracks/Go 0.5 0.5; inspected "second crack"; go_back crack
# Frozen by hand before, LOD stays frozen.
key F2; click cracks/Go; expect shown inspection/Back; click inspection/Back; expect hidden inspection/Back
expect counts lod_frozen -eq 1; key F2; expect counts lod_frozen -eq 0
click cracks/Go; expect shown inspection/Back; click "inspection/Unfreeze here"
expect hidden inspection/Back; expect counts lod_frozen -eq 0; ! is_at "$start" || echo "unfreezing moves the camera"
)sh");
}

TEST_F(InspectionWindowTest, goToTheWorstErrorFreezesLod) {
    drive(R"sh(
slide "lod/Tolerance τ" 0.2; settle; drawn=$(counter drawn)
key ctrl+shift+1; click errors/Measure; reach errors/Measure errors/Go; click errors/Go; inspected error; go_back error
)sh");
}

TEST_F(InspectionWindowTest, goBackToAPopFreezesLodWhereItWasSeen) {
    drive(R"sh(
key ctrl+shift+3; slide "lod/Tolerance τ" 0; settle; drawn=$(counter drawn)
slide "lod/Tolerance τ" 0.3; settle; drawn=$(counter drawn)
point viewport/picture; for i in 1 2 3; do xdotool click 5; done; settle; start=$(counter camera)
expect shown "pops/Row 0"; click "pops/Row 0" 0.03 0.5; click "pops/Go to view"
expect counts lod_frozen -eq 1; expect shown inspection/Back; go_back pop
)sh");
}

}  // namespace
}  // namespace worldy
