// The menu of layouts, and the window in which a layout gets its name.
#pragma once

#include <array>
#include <string>

#include "app/settings/workspace.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct LayoutMenuState {
    bool asksName = false;        // opens the window for a name in the next frame
    bool asksDelete = false;      // opens the window that asks before a layout is deleted
    std::array<char, 64> name{};  // as typed
    std::string replaced{};       // the layout that the user is asked to replace; empty: none
    std::string deleted{};        // the layout that the user is asked to delete
};

// Draws the items of the menu View > Layout.
void layoutItems(const EditorView& view, LayoutMenuState& state, const Workspace& workspace,
                 Commands& commands);

// Call every frame. Draws the windows that ask for a name, and before a layout is replaced or deleted.
void layoutWindows(const EditorView& view, LayoutMenuState& state, Commands& commands);

}  // namespace worldy::ui
