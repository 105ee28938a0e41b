// The Trace paging panel: the queue of the shown frame, latencies, and the times in which data was missing.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

struct TracePagingPanelState {
    int kind = 0;  // of the latencies
    TextFilter filter{};
};

void tracePagingPanel(const EditorView& view, TracePagingPanelState& state, Commands& commands);

}  // namespace worldy::ui
