// The Overlay panel: chunk tints with their legend and scale, outlines, volumes, labels, and the histogram of
// the screen-space error eps.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the current window.
void overlayPanel(const EditorView& view, ViewSettings& settings);

}  // namespace worldy::ui
