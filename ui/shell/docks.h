// The docks around the viewport. Each shows one of its panels, has a tab for each, and can be resized.
#pragma once

#include "ui/model/layout.h"
#include "ui/shell/panels.h"

namespace worldy::ui {

// Shows a panel in front of its dock.
void showPanel(PanelId id, Workspace& workspace);

// Draws a dock with its tabs and its splitter. A right click on a tab moves the panel to another dock or
// hides it.
void drawDock(Dock dock, const Layout& layout, const EditorView& view, PanelStates& panels,
              Workspace& workspace, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
