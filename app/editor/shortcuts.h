// The keyboard shortcuts of menu commands.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/window/window.h"
#include "ui/model/editor_view.h"
#include "ui/shell/docks.h"
#include "ui/shell/menu_bar.h"

namespace worldy {

// The state that keys change directly; everything else is done by commands.
struct ShortcutTargets {
    const ui::EditorView& view;
    ViewSettings& settings;
    Workspace& workspace;
    ui::MenuState& menu;
    ui::Commands& commands;
};

// Returns the names of all keys that obeyShortcuts() handles, except those of panels: "Ctrl+Shift+Z", "F1".
std::vector<std::string> shortcutNames();

// Executes pressed shortcuts. Does nothing while a text field has focus.
void obeyShortcuts(std::span<const KeyPress> pressed, const ShortcutTargets& targets);

}  // namespace worldy
