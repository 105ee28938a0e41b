// The Seams panel: skirts and stitching, which hide cracks between chunks, and edges where levels differ.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the current window.
void seamsPanel(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
