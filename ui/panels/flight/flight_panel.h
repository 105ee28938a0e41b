// The Flight panel: recording and replaying flights.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct FlightPanelState {
    std::array<char, 64> name{};  // name of the next recording
    std::string selected;         // name of a recording
    std::string latest;           // the running recording, or the one saved last; selected once
};

void flightPanel(const EditorView& view, FlightPanelState& state, ViewSettings& settings, Commands& commands);

// Returns "Exact so far", "Exact: all 600 frames", or how many frames differ and which is the first.
std::string replayStatus(const ReplayNow& replay);

// Returns the time of the nearest tick, a frame with splits or merges, after or before a time; the same time
// if there is none.
double nextTickS(std::span<const FlightTick> ticks, double timeS, bool forward);

}  // namespace worldy::ui
