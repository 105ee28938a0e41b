// The Trace findings panel: the faults and the switches of a trace.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

struct TraceFindingsPanelState {
    int fault = 0;           // 0: all kinds
    int cause = 0;           // 0: all causes
    bool jumpsOnly = false;  // without switches that are morphed
    TextFilter filter{};
};

void traceFindingsPanel(const EditorView& view, TraceFindingsPanelState& state, Commands& commands);

}  // namespace worldy::ui
