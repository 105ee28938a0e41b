// Flights recorded in the window and replayed, there and by the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "app/flight/flight_record.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class FlightTest : public PlanetWindowFixture {
protected:
    void SetUp() override {
        PlanetWindowFixture::SetUp();
        if (IsSkipped()) return;
        writeWindowSettings(folder,
                            "[window]\nbottom_height = 400\n[panels]\nflight_shown = true\n"
                            "bottom_front = \"flight\"\n[lod]\ntau_px = 1\n");
    }
    Ran drive(const std::string& steps) {
        Ran ran = runInWindow(folder, "planet.chk", steps);
        expectQuiet(ran);
        return ran;
    }

    // Frame 21 says that it drew something else.
    void changeOneFrame(const std::string& from, const std::string& to) const {
        FlightRecord record = loadFlightRecord(folder / from).value();
        FlightEncoder encoder;
        for (FlightFrame& frame : record.frames) {
            if (&frame == &record.frames[20]) ++frame.selectionHash;
            encoder.add(frame);
        }
        EXPECT_TRUE(encoder.write(folder / to, record.name, record.data));
    }
};

// By the clock, with threads; then by simulated time over a bad disk.
TEST_F(FlightTest, WhatTheWindowRecordsIsReplayedExactlyThereAndByTheCommandLine) {
    drive(R"sh(
record() {
    tab Flight; click flight/Record; expect shown "flight/Stop and save"
    point viewport/picture 0.4 0.3
    for i in 1 2 3 4 5 6 7 8; do xdotool click 4; frames 2; done
    tab Paging; click "paging/Evict all"; tab LOD; slide "lod/Tolerance τ" 0.3; tab Flight
    expect counts recorded -gt 40
    click "flight/Stop and save"; expect hidden "flight/Stop and save"
}
record; expect shown "flight/flight 1"; tau=$(counter triangles)
camera=$(counter camera)
click "flight/flight 1"; click flight/Replay; expect shown "flight/End replay"
expect counts replayed -gt 30
click flight/Play; frames; held=$(counter replayed); frames
counts replayed -eq $held || echo "held at $held, it goes on"
click "flight/Step >"; expect counts replayed -eq $((held + 1))
click "flight/< Step"; expect counts replayed -eq $held
click flight/Timeline 0.02; expect counts replayed -lt $held
click flight/Timeline 0.999; expect counts replayed -gt $held
counts different -eq 0 || echo "$(counter different) frames differ"
click "flight/End replay"; expect hidden "flight/End replay"
[ "$(counter camera)" = "$camera" ] || echo "the camera is not given back"
click "flight/Simulated paging"
tab Paging; slide paging/Latency 0.3; record; expect shown "flight/flight 2"
)sh");
    const std::string one = "replay 'config/worldy/flights/flight 1.flight'",
                      two = "replay 'config/worldy/flights/flight 2.flight'";
    Ran ran = runWorldy(folder, one + " -o report.json");
    EXPECT_EQ(ran.exitCode, 0) << ran.output << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("exact: every frame matches the recording"));
    EXPECT_THAT(contentOf(folder.path() / "report.json"), HasSubstr("\"exact\": true"));
    for (const char* how : {" --simulated", " --as-recorded", " planet.chk --simulated"}) {
        ran = runWorldy(folder, two + how);
        EXPECT_EQ(ran.exitCode, 0) << how << ran.output << ran.errors;
    }
    changeOneFrame("config/worldy/flights/flight 2.flight", "changed.flight");
    ran = runWorldy(folder, "replay changed.flight");
    EXPECT_EQ(ran.exitCode, 1) << ran.output << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("1 frames differ; first: frame 21 at"));
    ran = runWorldy(folder, two + " --set lod.tau_px=20");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("frames differ"));
    ran = runWorldy(folder, two + " hills.pgm");
    EXPECT_EQ(ran.exitCode, 2);
}

// The window moves the tolerance by a budget; the recording holds what it chose, and a replay follows no budget.
TEST_F(FlightTest, WhatABudgetChoseIsRecordedAndReplayedExactly) {
    std::ofstream(folder / "config/worldy/settings.toml", std::ios::app)
        << "[budget]\ntriangles = 20000\nleast_tau_px = 0.2\n";
    drive(R"sh(
settle
tab Flight; click flight/Record; expect shown "flight/Stop and save"
point viewport/picture 0.4 0.3
for i in 1 2 3 4 5 6 7 8; do xdotool click 4; frames 4; done
expect counts recorded -gt 40
click "flight/Stop and save"; expect hidden "flight/Stop and save"
click "flight/flight 1"; click flight/Replay; expect shown "flight/End replay"
expect counts replayed -gt 30
counts different -eq 0 || echo "$(counter different) frames differ"
)sh");
    const FlightRecord record = loadFlightRecord(folder / "config/worldy/flights/flight 1.flight").value();
    std::set<std::string> taus;
    for (const FlightFrame& frame : record.frames) {
        for (const CalledInFlight& call : frame.calls) {
            for (const std::string& setting : call.settings) {
                if (setting.starts_with("lod.tau_px=")) taus.insert(setting);
            }
        }
    }
    EXPECT_GT(taus.size(), 5u);
    const Ran ran = runWorldy(folder, "replay 'config/worldy/flights/flight 1.flight'");
    EXPECT_EQ(ran.exitCode, 0) << ran.output << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("exact: every frame matches the recording"));
    // The user's own tolerance is saved.
    EXPECT_THAT(contentOf(folder / "config/worldy/settings.toml"), HasSubstr("tau_px = 1\n"));
}

}  // namespace
}  // namespace worldy
