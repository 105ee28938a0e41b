#include "ui/shell/gamepad_actions.h"

#include <algorithm>
#include <array>

namespace worldy::ui {

namespace {

constexpr auto buttons = std::to_array<ButtonAction>({
    {GamepadButton::A, "A", "select_middle"},
    {GamepadButton::B, "B", "close"},
    {GamepadButton::X, "X", "freeze_lod"},
    {GamepadButton::Y, "Y", "wireframe"},
    {GamepadButton::LeftBumper, "Left bumper", "slower"},
    {GamepadButton::RightBumper, "Right bumper", "faster"},
    {GamepadButton::Back, "Back", "reset_camera"},
    {GamepadButton::Start, "Start", "pause_frames"},
    {GamepadButton::LeftThumb, "Left stick, pressed", "orbit_point"},
    {GamepadButton::RightThumb, "Right stick, pressed", "look_at_point"},
    {GamepadButton::Up, "D-pad up", "next_tint"},
    {GamepadButton::Right, "D-pad right", "step_frame"},
    {GamepadButton::Down, "D-pad down", "next_observer"},
});

}  // namespace

std::span<const ButtonAction> buttonActions() {
    return buttons;
}

const Action* actionOf(GamepadButton button) {
    const auto found = std::ranges::find(buttons, button, &ButtonAction::button);
    return found == buttons.end() ? nullptr : &actionNamed(found->id);
}

}  // namespace worldy::ui
