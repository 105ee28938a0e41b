// The time of a trace as strips of plots, with the shown frame as a line that can be dragged.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// The part of the trace in view, as shares of its duration.
struct TraceTimelineState {
    double from = 0;      // [0, to)
    double to = 1;        // (from, 1]
    std::string counter;  // that is plotted; empty: none
};

// Draws the strips in the remaining height. Appends ShowTraceFrame while the user drags.
void traceTimeline(const EditorView& view, TraceTimelineState& state, Commands& commands);

}  // namespace worldy::ui
