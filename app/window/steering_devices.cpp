#include "app/window/steering_devices.h"

#include <GLFW/glfw3.h>

#include <utility>

namespace worldy {

namespace {

// The order of app/scene/steering.h.
static_assert(GLFW_GAMEPAD_BUTTON_A == 0 && GLFW_GAMEPAD_BUTTON_Y == 3 &&
              GLFW_GAMEPAD_BUTTON_LEFT_BUMPER == 4 && GLFW_GAMEPAD_BUTTON_BACK == 6 &&
              GLFW_GAMEPAD_BUTTON_LEFT_THUMB == 9 && GLFW_GAMEPAD_BUTTON_DPAD_UP == 11 &&
              GLFW_GAMEPAD_BUTTON_DPAD_RIGHT == 12 && GLFW_GAMEPAD_BUTTON_DPAD_LEFT == 14 &&
              GLFW_GAMEPAD_BUTTON_LAST == gamepadButtonCount - 1);
static_assert(GLFW_GAMEPAD_AXIS_LEFT_X == 0 && GLFW_GAMEPAD_AXIS_LEFT_Y == 1 &&
              GLFW_GAMEPAD_AXIS_RIGHT_X == 2 && GLFW_GAMEPAD_AXIS_RIGHT_Y == 3 &&
              GLFW_GAMEPAD_AXIS_LEFT_TRIGGER == 4 && GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER == 5 &&
              GLFW_GAMEPAD_AXIS_LAST == steeringAxisCount - 1);

std::string textOf(const char* name) {
    return name ? name : "";
}

SteeringState readJoystick(int joystick) {
    std::string name = textOf(glfwGetJoystickName(joystick));
    if (isSpaceMouse(name)) {
        int count = 0;
        const float* const axes = glfwGetJoystickAxes(joystick, &count);
        return spaceMouseState(std::move(name), {axes, axes ? static_cast<std::size_t>(count) : 0});
    }
    GLFWgamepadstate state{};
    if (glfwGetGamepadState(joystick, &state)) {
        std::string mapped = textOf(glfwGetGamepadName(joystick));
        return gamepadState(std::move(mapped.empty() ? name : mapped), state.axes, state.buttons);
    }
    return {.name = std::move(name)};
}

}  // namespace

std::vector<SteeringState> readSteeringDevices() {
    std::vector<SteeringState> devices;
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick)
        if (glfwJoystickPresent(joystick)) devices.push_back(readJoystick(joystick));
    return devices;
}

}  // namespace worldy
