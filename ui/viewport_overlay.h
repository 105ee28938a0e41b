// What is written over the planet: badges for states that change how the picture must be read, and the keys.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/layout.h"
#include "ui/view_settings.h"

namespace ui {

struct ViewportOverlayInput {
    std::string title;  // the data set
    bool lodFrozen = false;
    bool settled = true;  // nothing is waited for
    const ViewSettings& settings;
};

// Fills the current window with a picture whose row 0 is at the bottom, as an item that takes both buttons.
void viewportPicture(ImTextureID picture, const Rect& viewport);

// Draws into the current window, which fills the viewport.
void viewportOverlay(const ViewportOverlayInput& input, const Rect& viewport);

}  // namespace ui
