// The camera's input from keyboard and mouse in a frame.
#pragma once

#include <glm/vec2.hpp>

#include "app/scene/camera_control.h"

namespace worldy {

// Input over the planet's picture; none while the pointer is over a panel.
struct PointerInput {
    bool over = false;            // the pointer is over the picture or dragging it
    glm::dvec2 positionPx{0, 0};  // from the picture's top left, in its pixels
    glm::dvec2 dragPx{0, 0};      // right, down; left button
    bool isPressed = false;       // the left button is held without Alt
    glm::dvec2 lookPx{0, 0};      // right button
    bool grabs = false;           // a button is held with Alt
    glm::dvec2 orbitPx{0, 0};     // left button with Alt
    glm::dvec2 dollyPx{0, 0};     // right button with Alt
    double wheelNotches = 0;      // towards the planet
    double speedNotches = 0;      // of the wheel while a button is held
    double fovNotches = 0;        // of the wheel with Ctrl; towards a narrower field of view
    bool clicked = false;         // pressed and released in one place
};

struct KeyInput {
    CameraMotion held;
    int speedSteps = 0;  // + and -
};

// Call after ImGui's frame has begun. Returns nothing while a text field has focus or Ctrl is held.
KeyInput readKeys();

// Call right after the picture was drawn as an ImGui item that accepts both buttons.
PointerInput readPointer(float pixelRatio);

}  // namespace worldy
