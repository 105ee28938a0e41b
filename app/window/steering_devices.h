// The gamepads and 3-D mice that GLFW finds. They need no window, only GLFW; main thread.
#pragma once

#include <vector>

#include "app/scene/steering.h"

namespace worldy {

// Reads all connected devices, also joysticks that cannot steer, in GLFW's order. Devices may come and go between calls,
// while events are polled.
std::vector<SteeringState> readSteeringDevices();

}  // namespace worldy
