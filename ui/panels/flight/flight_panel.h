// Flight: recording and replaying.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct FlightPanelState {
    std::array<char, 64> name{};  // of the next recording
    std::string selected;         // a recording's
    std::string latest;           // the recording that runs, or was saved last; selected once
};

void flightPanel(const EditorView& view, FlightPanelState& state, ViewSettings& settings, Commands& commands);

// "Exact so far", "Exact: all 600 frames", or how many frames differ and which is the first.
std::string replayStatus(const ReplayNow& replay);

// Where to go from a frame to see a split or a merge: the time of the nearest tick after or before a time;
// the same time where there is none.
double nextTickS(std::span<const FlightTick> ticks, double timeS, bool forward);

}  // namespace worldy::ui
