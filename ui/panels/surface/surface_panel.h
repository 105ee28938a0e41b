// The Surface panel: texture layers, height ramp, colour image and vertical exaggeration.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/panels/surface/layers_panel.h"

namespace worldy::ui {

struct SurfacePanelState {
    int selectedStop = -1;  // index of the ramp's stop; -1: none
    LayersPanelState layers{};
};

// Fills the current window.
void surfacePanel(const EditorView& view, SurfacePanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace worldy::ui
