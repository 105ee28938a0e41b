// The tab "Compared" of the Trace findings panel: the open trace, A, beside a second one of the same flight, B.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

struct TraceComparedState {
    TextFilter filter{};
    int runs = 0;  // whose tab was brought to the front
};

// Draws the button that asks for B.
void traceCompareButton(const EditorView& view, Commands& commands);

// Returns the comparison of the open trace; null: there is none yet.
const TraceCompared* traceComparedOf(const EditorView& view);
// Draws the tab's content.
void traceCompared(const EditorView& view, TraceComparedState& state, Commands& commands);

}  // namespace worldy::ui
