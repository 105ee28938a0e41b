// Level of detail: tau and its companions, what is drawn by level, and how it changes.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the current window.
void lodPanel(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
