// The Camera panel: camera motion, bookmarks, flights and the observer.
#pragma once

#include <array>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct CameraPanelState {
    std::array<char, 64> bookmarkName{};
    int typedField = -1;    // index of the pose's number being typed; -1: none
    double typedValue = 0;  // what has been typed so far
};

// Fills the current window.
void cameraPanel(const EditorView& view, CameraPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
