// Drags panels between docks: the preview while the button is down, and the drop.
#pragma once

#include "ui/shell/docks_state.h"

namespace worldy::ui {

// Begins to drag a docked panel. tab: the rectangle of its tab.
void beginTabDrag(PanelId panel, const Rect& tab, const Layout& layout, const Workspace& workspace,
                  DocksState& state);

// Call after all docks and floating panels are drawn. Draws where the panel would go, drops it when the
// button is released, and cancels the drag on Esc. With Ctrl the panel floats wherever it is dropped.
void advanceDrag(const Layout& layout, DocksState& state, Workspace& workspace);

}  // namespace worldy::ui
