// Surface: texture layers, height ramp, sea, colour image, sun, vertical exaggeration.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/panels/surface/layers_panel.h"

namespace worldy::ui {

struct SurfacePanelState {
    int selectedStop = -1;  // of the ramp; -1: none
    LayersPanelState layers{};
};

// Fills the current window.
void surfacePanel(const EditorView& view, SurfacePanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace worldy::ui
