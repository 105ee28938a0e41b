#include "ui/panels/flight/flight_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {
namespace {

using testing::HasSubstr;

TEST(FlightPanel, StatusSaysHowFarItIsExact) {
    ReplayNow replay;
    replay.frames = 600;
    EXPECT_EQ(replayStatus(replay), "No frame replayed yet");
    replay.frame = 120;
    EXPECT_EQ(replayStatus(replay), "Exact so far: 120 frames match the recording");
    replay.frame = 600;
    EXPECT_EQ(replayStatus(replay), "Exact: all 600 frames match the recording");
}

TEST(FlightPanel, StatusNamesTheFirstFrameThatDiffers) {
    ReplayNow replay;
    replay.frames = 600;
    replay.frame = 200;
    replay.framesDifferent = 3;
    replay.difference = "frame 33 at 0.55 s, in the selection: +x_pos/3/1/1";
    EXPECT_EQ(replayStatus(replay),
              "3 of 200 frames differ from the recording. The first: frame 33 at 0.55 s, "
              "in the selection: +x_pos/3/1/1");
}

TEST(FlightPanel, ChangesAreSteppedThroughOneByOne) {
    const std::array<FlightTick, 3> ticks = {{{0.5, 1, 0}, {1.5, 0, 2}, {2.5, 3, 0}}};
    EXPECT_EQ(nextTickS(ticks, 0, true), 0.5);
    EXPECT_EQ(nextTickS(ticks, 0.5, true), 1.5);
    EXPECT_EQ(nextTickS(ticks, 2.5, true), 2.5);
    EXPECT_EQ(nextTickS(ticks, 2.5, false), 1.5);
    EXPECT_EQ(nextTickS(ticks, 1.0, false), 0.5);
    EXPECT_EQ(nextTickS(ticks, 0.5, false), 0.5);
    EXPECT_EQ(nextTickS({}, 0.7, true), 0.7);
}

TEST(FlightPanel, aRecordingIsSelectedOnceAndAgainUnderTheNameItIsSavedBy) {
    PanelWindow window{{400, 600}};
    FlightPanelState state;
    EmptyView empty;
    EditorView& view = empty.view;
    const auto planet = planet::openFake();
    view.planet = planet.get();
    view.recording.recording = RecordingNow{"flight 7", 1, 60, 1000};
    ViewSettings settings;
    Commands commands;
    const auto draw = [&] { window.frame([&] { flightPanel(view, state, settings, commands); }); };
    state.selected = "an old one";
    draw();
    EXPECT_EQ(state.selected, "flight 7");
    state.selected = "an old one";  // picked while it records
    draw();
    EXPECT_EQ(state.selected, "an old one");
    view.recording.recording.reset();
    view.recording.saved = "flight 8";  // the name was taken
    draw();
    EXPECT_EQ(state.selected, "flight 8");
}

}  // namespace
}  // namespace worldy::ui
