// The windows that the Help menu opens: the list of keys and mouse, and About.
#pragma once

#include <string>
#include <vector>

#include "ui/shell/actions.h"

namespace worldy::ui {

struct KeyHelp {
    std::string keys;  // "Ctrl+Shift+Z, Ctrl+Y"
    std::string meaning;
};

// Returns what the mouse and the keys do that no command has: they cannot be changed.
std::vector<KeyHelp> fixedKeys();
// Returns the keys of the commands, those of panels last. Commands without a key are left out.
std::vector<KeyHelp> commandKeys(const ActionKeys& keys);

// Returns what gamepads and 3-D mice do.
std::vector<KeyHelp> steeringHelp();

// Draws the windows that are shown.
void helpWindows(const ActionContext& context);

}  // namespace worldy::ui
