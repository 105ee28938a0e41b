// The Trace node panel: why the engine drew the selected node or not, and its numbers.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

void traceNodePanel(const EditorView& view, Commands& commands);

}  // namespace worldy::ui
