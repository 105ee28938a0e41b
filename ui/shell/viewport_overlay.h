// What is written over the planet: badges for states that change how the picture must be read, a legend for
// its colours, labels on chunks, and the mouse and keys.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// Fills the current window with a picture whose row 0 is at the bottom, as an item that takes both buttons.
void viewportPicture(ImTextureID picture, const Rect& viewport);

// Draws into the current window, over the picture of view.renderView in a rectangle of it.
void viewportOverlay(const EditorView& view, const ViewSettings& settings, const Rect& viewport);

// The same for the observer's picture beside it or in its place: which view it is, and labels.
void observerOverlay(const EditorView& view, const ViewSettings& settings, const planet::View& observer,
                     const Rect& viewport);

struct ViewportBadge {
    std::string text;
    ImVec4 colour{1, 1, 1, 1};
};
// What there is to say, most important first; the data set's name is not among them.
std::vector<ViewportBadge> viewportBadges(const EditorView& view, const ViewSettings& settings);

}  // namespace worldy::ui
