// The Trace panel: opens a trace or attaches to an engine, and moves through its frames.
#pragma once

#include <array>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/panels/trace/trace_timeline.h"

namespace worldy::ui {

struct TracePanelState {
    int port = 9910;
    TraceTimelineState timeline;
};

void tracePanel(const EditorView& view, TracePanelState& state, Commands& commands);

}  // namespace worldy::ui
