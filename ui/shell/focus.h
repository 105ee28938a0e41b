// Moves the keyboard's focus between the menu bar, the docks and the viewport, and shows where it is. Call
// between ImGui's NewFrame and Render.
#pragma once

#include "app/settings/workspace.h"
#include "ui/shell/menu_state.h"

namespace worldy::ui {

// Carries out the requests of the menu state, notes the panel with the focus, and draws a frame around the
// pane that has it while the keyboard is used. Call once a frame, after all windows are drawn.
void followFocus(const Workspace& workspace, MenuState& state);

// Closes the topmost popup or dialog. Returns false if none is open.
bool closePopups();
// Returns true while a message or dialog waits for an answer.
bool isDialogOpen();

}  // namespace worldy::ui
