// Stands in for GLFW's joysticks when it is preloaded: the first one is described by the file that FAKE_JOYSTICK names, read
// each time, as "gamepad Some_name" or "joystick Some_name", six axes and a bit for each button. Without the file, there is
// none.
#include <GLFW/glfw3.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

namespace {

struct FakeJoystick {
    std::string kind, name;
    std::array<float, 6> axes{};
    unsigned buttons = 0;
};

std::optional<FakeJoystick> readFake(int joystick) {
    const char* const file = std::getenv("FAKE_JOYSTICK");
    if (joystick != GLFW_JOYSTICK_1 || !file) return std::nullopt;
    std::ifstream in(file);
    FakeJoystick fake;
    if (!(in >> fake.kind >> fake.name)) return std::nullopt;
    // Numbers that cannot be read are what a broken driver reports.
    std::string text;
    for (float& axis : fake.axes) axis = in >> text ? std::strtof(text.c_str(), nullptr) : 0;
    in >> fake.buttons;
    return fake;
}

}  // namespace

extern "C" {

int glfwJoystickPresent(int joystick) {
    return readFake(joystick).has_value() ? GLFW_TRUE : GLFW_FALSE;
}

const char* glfwGetJoystickName(int joystick) {
    static std::string name;
    name = readFake(joystick).value_or(FakeJoystick{}).name;
    return name.c_str();
}

const char* glfwGetGamepadName(int joystick) {
    return glfwGetJoystickName(joystick);
}

const float* glfwGetJoystickAxes(int joystick, int* count) {
    static std::array<float, 6> axes;
    axes = readFake(joystick).value_or(FakeJoystick{}).axes;
    *count = 6;
    return axes.data();
}

int glfwGetGamepadState(int joystick, GLFWgamepadstate* state) {
    const std::optional<FakeJoystick> fake = readFake(joystick);
    if (!fake || fake->kind != "gamepad") return GLFW_FALSE;
    for (int axis = 0; axis < 6; ++axis) state->axes[axis] = fake->axes[static_cast<std::size_t>(axis)];
    for (unsigned button = 0; button <= GLFW_GAMEPAD_BUTTON_LAST; ++button)
        state->buttons[button] = (fake->buttons >> button & 1u) != 0 ? GLFW_PRESS : GLFW_RELEASE;
    return GLFW_TRUE;
}
}
