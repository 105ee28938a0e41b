#include "app/scene/steering.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/text.h"

namespace worldy {

namespace {

constexpr double stickDeadZone = 0.15;
constexpr double triggerDeadZone = 0.05;
constexpr double spaceMouseDeadZone = 0.06;

double checkedAxis(std::span<const float> axes, std::size_t index, double atRest) {
    if (index >= axes.size() || !std::isfinite(axes[index])) return atRest;
    return std::clamp(static_cast<double>(axes[index]), -1.0, 1.0);
}

double responseOf(double axis, double deadZone) {
    return std::copysign(steeringResponse(std::abs(axis), deadZone), axis);
}

// Returns the deflection of a stick. The dead zone and the curve act on its length, so that directions stay.
glm::dvec2 stick(double x, double y) {
    const double length = std::hypot(x, y);
    const double response = steeringResponse(std::min(length, 1.0), stickDeadZone);
    return length > 0 ? response / length * glm::dvec2(x, y) : glm::dvec2(0, 0);
}

CameraMotion gamepadMotion(const SteeringState& state) {
    const glm::dvec2 left = stick(state.axes[0], state.axes[1]);
    const glm::dvec2 right = stick(state.axes[2], state.axes[3]);
    return {.forward = -left.y,
            .right = left.x,
            .up = responseOf(state.axes[5], triggerDeadZone) - responseOf(state.axes[4], triggerDeadZone),
            .lookRight = right.x,
            .lookUp = -right.y};
}

CameraMotion spaceMouseMotion(const SteeringState& state) {
    const auto axis = [&](std::size_t index) { return responseOf(state.axes[index], spaceMouseDeadZone); };
    return {.forward = -axis(1), .right = axis(0), .up = -axis(2), .lookRight = axis(5), .lookUp = axis(3)};
}

CameraMotion plainMotion(const SteeringState& state) {
    switch (state.kind) {
        case SteeringKind::Gamepad:
            return gamepadMotion(state);
        case SteeringKind::SpaceMouse:
            return spaceMouseMotion(state);
        case SteeringKind::Other:
            break;
    }
    return {};
}

}  // namespace

bool isSpaceMouse(std::string_view name) {
    constexpr std::array<std::string_view, 3> known = {"spacenavigator", "spacemouse", "3dconnexion"};
    std::string lowered(name);
    std::ranges::transform(lowered, lowered.begin(), lowerAscii);
    return std::ranges::any_of(
        known, [&](std::string_view part) { return lowered.find(part) != std::string::npos; });
}

SteeringState gamepadState(std::string name, std::span<const float> axes,
                           std::span<const std::uint8_t> buttons) {
    SteeringState state{.name = std::move(name), .kind = SteeringKind::Gamepad};
    for (std::size_t i = 0; i < 4; ++i) state.axes[i] = checkedAxis(axes, i, 0);
    // A trigger goes from -1 to 1.
    for (std::size_t i = 4; i < steeringAxisCount; ++i) state.axes[i] = (checkedAxis(axes, i, -1) + 1) / 2;
    for (std::size_t i = 0; i < std::min(buttons.size(), gamepadButtonCount); ++i)
        state.buttons[i] = buttons[i] != 0;
    return state;
}

SteeringState spaceMouseState(std::string name, std::span<const float> axes) {
    SteeringState state{.name = std::move(name), .kind = SteeringKind::SpaceMouse};
    for (std::size_t i = 0; i < steeringAxisCount; ++i) state.axes[i] = checkedAxis(axes, i, 0);
    return state;
}

double steeringResponse(double deflection, double deadZone) {
    if (!(deflection > deadZone)) return 0;
    const double beyond = (deflection - deadZone) / (1 - deadZone);
    return beyond * beyond;
}

CameraMotion motionOf(const SteeringState& state, double sensitivity, bool inverted) {
    CameraMotion motion = plainMotion(state);
    if (inverted) motion.lookUp = -motion.lookUp;
    return scaled(motion, sensitivity);
}

bool isUsed(const SteeringState& state) {
    return plainMotion(state) != CameraMotion() ||
           std::ranges::find(state.buttons, true) != state.buttons.end();
}

std::vector<GamepadButton> pressedButtons(std::span<const SteeringState> before,
                                          std::span<const SteeringState> now) {
    std::vector<GamepadButton> pressed;
    for (std::size_t device = 0; device < now.size(); ++device) {
        if (device >= before.size() || before[device].name != now[device].name) continue;
        for (std::size_t button = 0; button < gamepadButtonCount; ++button) {
            if (now[device].buttons[button] && !before[device].buttons[button])
                pressed.push_back(static_cast<GamepadButton>(button));
        }
    }
    return pressed;
}

}  // namespace worldy
