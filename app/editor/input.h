// What the keyboard and the mouse ask of the camera in a frame.
#pragma once

#include <glm/vec2.hpp>

#include "app/scene/camera_control.h"

namespace worldy {

// Over the planet's picture; nothing while the pointer is on a panel.
struct PointerInput {
    bool over = false;            // the picture is under the pointer, or held by it
    glm::dvec2 positionPx{0, 0};  // from the picture's top left, in its pixels
    glm::dvec2 dragPx{0, 0};      // right, down; left button
    glm::dvec2 lookPx{0, 0};      // right button
    double wheelNotches = 0;      // towards the planet
    bool clicked = false;         // pressed and let go in one place
    bool doubleClicked = false;
};

struct KeyInput {
    HeldKeys held;
    int speedSteps = 0;  // + and -
};

// After ImGui's frame has begun. Nothing while a text field has the keys, or Ctrl makes them shortcuts.
KeyInput readKeys();

// Call where the picture was just drawn as an ImGui item that takes both buttons.
PointerInput readPointer(float pixelRatio);

}  // namespace worldy
