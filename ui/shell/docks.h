// The docks around the viewport: each shows its panels as tabs, one at a time, and can be dragged wider.
#pragma once

#include "ui/model/layout.h"
#include "ui/shell/panels.h"

namespace worldy::ui {

// Shows a panel, and brings it to the front of its dock.
void showPanel(PanelId id, Workspace& workspace);

// A dock with its tabs and its splitter. A right click on a tab moves the panel to another dock or hides it.
void drawDock(Dock dock, const Layout& layout, const EditorView& view, PanelStates& panels,
              Workspace& workspace, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
