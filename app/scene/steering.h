// Steers the camera by a gamepad or a 3-D mouse: from the state of a device to a motion of the camera. Drivers may report
// any number and any count of axes, so the state is checked where it is made. Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/camera_control.h"

namespace worldy {

enum class SteeringKind : std::uint8_t {
    Gamepad,
    SpaceMouse,
    Other,  // a joystick without a known layout, which does not steer
};

// The buttons of a gamepad in GLFW's order. The names are those of an Xbox controller.
enum class GamepadButton : std::uint8_t {
    A,
    B,
    X,
    Y,
    LeftBumper,
    RightBumper,
    Back,
    Start,
    Guide,
    LeftThumb,
    RightThumb,
    Up,
    Right,
    Down,
    Left
};
inline constexpr std::size_t gamepadButtonCount = 15;

inline constexpr std::size_t steeringAxisCount = 6;

// The state of a device in one frame.
struct SteeringState {
    std::string name;  // as the driver gives it
    SteeringKind kind = SteeringKind::Other;
    // Finite and in [-1, 1]; 0 at rest, also for triggers, whose pressed end is 1. A gamepad has left x, left y, right x,
    // right y, left trigger, right trigger, where y is down. A 3-D mouse has shifts to the right, towards the user and
    // down, then turns about these axes.
    std::array<double, steeringAxisCount> axes{};
    std::array<bool, gamepadButtonCount> buttons{};  // of a gamepad; true: held
};

// Returns true for the names of 3-D mice, in any case of letters.
bool isSpaceMouse(std::string_view name);

// Make a state from what a driver reports, however many axes there are. What is missing or no number is at rest, and what
// is out of range is clamped.
SteeringState gamepadState(std::string name, std::span<const float> axes,
                           std::span<const std::uint8_t> buttons);
SteeringState spaceMouseState(std::string name, std::span<const float> axes);

// Returns what is left of a deflection of length [0, 1] after the dead zone, along the response curve: 0 within the dead
// zone, 1 at 1, fine near the centre.
double steeringResponse(double deflection, double deadZone);

// Returns the motion that a device asks for. The camera has no roll, so rolling a 3-D mouse does nothing.
CameraMotion motionOf(const SteeringState& state, double sensitivity, bool inverted);

// Returns true if the device asks for a motion or holds a button.
bool isUsed(const SteeringState& state);

// Returns the buttons that went down between two frames. A device that has just come presses none.
std::vector<GamepadButton> pressedButtons(std::span<const SteeringState> before,
                                          std::span<const SteeringState> now);

}  // namespace worldy
