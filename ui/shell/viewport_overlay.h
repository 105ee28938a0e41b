// The overlay of the viewport: badges for states that affect how to read the picture, a legend of its
// colours, chunk labels, and mouse and key hints.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// Fills the current window with a picture whose row 0 is at the bottom, as an item that accepts both buttons.
void viewportPicture(ImTextureID picture, const Rect& viewport);

// Draws into the current window, over the main picture in the viewport rectangle.
void viewportOverlay(const EditorView& view, const ViewSettings& settings, const Rect& viewport);

// Does the same for the observer's picture, beside the main picture or in its place: the view's name, and
// labels.
void observerOverlay(const EditorView& view, const ViewSettings& settings, const planet::View& observer,
                     const Rect& viewport);

struct ViewportBadge {
    std::string text;
    ImVec4 colour{1, 1, 1, 1};
};
// Returns the badges, most important first, without the data set's name.
std::vector<ViewportBadge> viewportBadges(const EditorView& view, const ViewSettings& settings);

}  // namespace worldy::ui
