// The texture layers in the Surface panel: their list, blending, weights under the pointer, and layer sets.
#pragma once

#include <array>
#include <string>

#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct LayersPanelState {
    std::size_t chosen = 0;          // index of the selected layer; clamped to the last one
    std::string set;                 // name of the set to load
    std::array<char, 61> newName{};  // name of the set to save
    bool saving = false;             // the last frame asked to save newName
};

// Fills sections of the current window.
void layersSections(const EditorView& view, LayersPanelState& state, const SettingControls& control,
                    SurfaceSettings& surface, Commands& commands);

}  // namespace worldy::ui
