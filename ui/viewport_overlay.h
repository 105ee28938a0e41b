// What is written over the planet: badges for states that change how the picture must be read, a legend for
// its colours, and the keys.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>

#include "ui/layout.h"
#include "ui/view_settings.h"

namespace ui {

struct ViewportOverlayInput {
    std::string title;  // the data set
    bool lodFrozen = false;
    bool settled = true;             // nothing is waited for
    std::uint32_t deepestLevel = 0;  // of what is drawn
    const ViewSettings& settings;
};

// Fills the current window with a picture whose row 0 is at the bottom, as an item that takes both buttons.
void viewportPicture(ImTextureID picture, const Rect& viewport);

// Draws into the current window, which fills the viewport.
void viewportOverlay(const ViewportOverlayInput& input, const Rect& viewport);

}  // namespace ui
