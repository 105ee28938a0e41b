// The keys that do what menus do.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/editor/window.h"
#include "ui/model/editor_view.h"
#include "ui/shell/docks.h"
#include "ui/shell/menu_bar.h"

namespace worldy {

// What a key may change at once; the rest it asks for by commands.
struct ShortcutTargets {
    const ui::EditorView& view;
    ViewSettings& settings;
    Workspace& workspace;
    ui::MenuState& menu;
    ui::Commands& commands;
};

// The names of all keys that obeyShortcuts() obeys, panels' left out: "Ctrl+Shift+Z", "F1".
std::vector<std::string> shortcutNames();

// Nothing while a text field has the keys.
void obeyShortcuts(std::span<const KeyPress> pressed, const ShortcutTargets& targets);

}  // namespace worldy
