// Panels that float over the window: windows of their own that move, resize, close, and dock where they are
// dropped.
#pragma once

#include "ui/shell/docks_state.h"
#include "ui/shell/panels.h"

namespace worldy::ui {

// Draws a panel's content into the current window. Its ids and headings are the same in every window.
void drawPanelContent(PanelId panel, const EditorView& view, PanelStates& panels, DocksState& state,
                      ViewSettings& settings, Commands& commands);

// Draws the menu of a panel's tab or title bar. Call between BeginPopup() and EndPopup().
void panelMenu(PanelId panel, Workspace& workspace);

// Draws a floating panel. Moves and resizes it in the workspace; a drag of its title bar begins state.drag.
void drawFloatingPanel(PanelId panel, const Layout& layout, const EditorView& view, PanelStates& panels,
                       DocksState& state, Workspace& workspace, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
