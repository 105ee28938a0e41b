// The LOD panel: the tolerance tau and related settings, drawn chunks by level, and level changes.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the current window.
void lodPanel(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
