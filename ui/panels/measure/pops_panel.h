// The Pops panel: how far the surface jumps at level changes, when, why, and what it looked like.
#pragma once

#include <optional>
#include <vector>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"
#include "ui/panels/measure/pops_timeline.h"

namespace worldy::ui {

struct PopsPanelState {
    PopTimelineState timeline;
    std::optional<PopKey> selected;
    TextFilter filter{};  // of the list

    // Statistics of all events, updated at intervals.
    struct Sample {
        const planet::PopMeter* meter = nullptr;
        double takenAtS = -1;
        std::uint64_t switches = 0;
        std::vector<float> counts;  // histogram
        std::size_t seen = 0;       // switches in it
        double medianPx = 0;
        double p99Px = 0;
    } sample;
};

void popsPanel(const EditorView& view, PopsPanelState& state, Commands& commands);

}  // namespace worldy::ui
