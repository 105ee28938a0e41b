// The menu bar: every command by name, with the key that does the same.
#pragma once

#include <vector>

#include "ui/shell/docks.h"

namespace worldy::ui {

float menuBarHeight();

// What the menus open on top of everything.
struct MenuState {
    bool showKeys = false;  // the window that lists keys and mouse
    bool showAbout = false;
};

void menuBar(const EditorView& view, MenuState& state, Workspace& workspace, ViewSettings& settings,
             Commands& commands);

struct KeyHelp {
    const char* keys;  // "Ctrl+Shift+Z, Ctrl+Y"
    const char* meaning;
};
// All that the window of keys lists.
std::vector<KeyHelp> listedKeys();

// The windows that the Help menu opens.
void helpWindows(MenuState& state);

}  // namespace worldy::ui
