// The Trace findings panel: the faults and the switches of a trace, and its comparison with another one.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"
#include "ui/panels/trace/trace_compared.h"

namespace worldy::ui {

struct TraceFindingsPanelState {
    int fault = 0;           // 0: all kinds
    int cause = 0;           // 0: all causes
    bool jumpsOnly = false;  // without switches that are morphed
    TextFilter filter{};
    TraceComparedState compared{};
};

void traceFindingsPanel(const EditorView& view, TraceFindingsPanelState& state, Commands& commands);

}  // namespace worldy::ui
