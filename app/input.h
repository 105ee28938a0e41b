// What the keyboard and the mouse ask for in a frame.
#pragma once

#include <glm/vec2.hpp>

#include <vector>

#include "app/camera_control.h"

namespace worldy {

// Over the planet's picture; nothing while the pointer is on a panel.
struct PointerInput {
    glm::dvec2 positionPx{0, 0};  // from the picture's top left, in its pixels
    glm::dvec2 dragPx{0, 0};      // right, down; left button
    glm::dvec2 lookPx{0, 0};      // right button
    double wheelNotches = 0;      // towards the planet
};

struct KeyInput {
    HeldKeys held;
    int speedSteps = 0;  // + and -
    bool toggleWireframe = false;
    bool toggleFreeze = false;
    bool resetCamera = false;
    bool toggleCube = false;
    bool quit = false;
};

// After ImGui's frame has begun. No keys while a text field has them.
KeyInput readKeys(const std::vector<int>& pressedKeys);

// Call where the picture was just drawn as an ImGui item that takes both buttons.
PointerInput readPointer(float pixelRatio);

}  // namespace worldy
