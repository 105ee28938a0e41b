// Carries out the commands whose keys or gamepad buttons are pressed.
#pragma once

#include <span>

#include "app/window/window.h"
#include "ui/shell/actions.h"

namespace worldy {

// Call after all panels are drawn. While a text field has the focus, only the keys of commands that work in text
// fields do. If a command is not possible, the menu state says why.
void obeyShortcuts(std::span<const KeyPress> pressed, const ui::ActionContext& context);

// Carries out the commands of gamepad buttons, in the same way.
void obeyButtons(std::span<const GamepadButton> pressed, const ui::ActionContext& context);

}  // namespace worldy
