// The part of the Surface panel on texture layers: their list, blending, weights under the pointer, and sets.
#pragma once

#include <array>
#include <string>

#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct LayersPanelState {
    std::size_t chosen = 0;          // of the layers; the last one where there are fewer
    std::string set;                 // chosen to be loaded, by name
    std::array<char, 61> newName{};  // of a set to be saved
    bool saving = false;             // under that name, in the frame before
};

// Fills sections of the current window.
void layersSections(const EditorView& view, LayersPanelState& state, const SettingControls& control,
                    SurfaceSettings& surface, Commands& commands);

}  // namespace worldy::ui
