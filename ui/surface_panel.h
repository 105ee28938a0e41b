// Surface: height ramp, sea, colour image, sun, vertical exaggeration.
#pragma once

#include "ui/editor_view.h"

namespace ui {

struct SurfacePanelState {
    int selectedStop = -1;  // of the ramp; -1: none
};

// Fills the current window.
void surfacePanel(const EditorView& view, SurfacePanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace ui
