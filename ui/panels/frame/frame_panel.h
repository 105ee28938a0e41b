// The Frame panel: time per stage, draw and upload counts, memory by kind, pause and single step.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the current window.
void framePanel(const EditorView& view, Commands& commands);

}  // namespace worldy::ui
