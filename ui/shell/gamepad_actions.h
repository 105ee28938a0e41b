// The buttons of a gamepad carry out commands of the list in ui/shell/actions.h.
#pragma once

#include <span>

#include "app/scene/steering.h"
#include "ui/shell/actions.h"

namespace worldy::ui {

struct ButtonAction {
    GamepadButton button = GamepadButton::A;
    const char* name = "";  // on the controller: "X", "D-pad up"
    const char* id = "";    // of the action
};

// Returns the buttons that have an action.
std::span<const ButtonAction> buttonActions();
// Returns the action of a button; null if it has none.
const Action* actionOf(GamepadButton button);

}  // namespace worldy::ui
