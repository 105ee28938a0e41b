// The docks around the viewport, and the panels that float over it. A dock shows one of its panels, has a tab
// for each, and can be resized and maximised. ui/model/docking.h says where panels lie.
#pragma once

#include "ui/model/docking.h"
#include "ui/shell/docks_state.h"
#include "ui/shell/panels.h"

namespace worldy::ui {

// Draws the docks with their tabs and splitters, the floating panels, and the preview of a drag. Moves
// panels in the workspace.
void drawDocks(const Layout& layout, const EditorView& view, PanelStates& panels, DocksState& state,
               Workspace& workspace, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
