// The menu bar: all commands, with their keys.
#pragma once

#include <vector>

#include "ui/shell/docks.h"
#include "ui/shell/layout_menu.h"

namespace worldy::ui {

float menuBarHeight();

// The windows that the menus open.
struct MenuState {
    bool showKeys = false;  // the window of keys and mouse
    bool showAbout = false;
    LayoutMenuState layout{};
};

void menuBar(const EditorView& view, MenuState& state, Workspace& workspace, ViewSettings& settings,
             Commands& commands);

struct KeyHelp {
    const char* keys;  // "Ctrl+Shift+Z, Ctrl+Y"
    const char* meaning;
};
// Returns all rows of the window of keys.
std::vector<KeyHelp> listedKeys();

// Draws the windows that the Help menu opens.
void helpWindows(MenuState& state);

}  // namespace worldy::ui
