// The Surface panel's part on texture layers: the list, how they are mixed, their weights under the pointer,
// sets.
#pragma once

#include <array>
#include <string>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct LayersPanelState {
    std::size_t chosen = 0;          // of the layers; the last one where there are fewer
    std::string set;                 // chosen to be loaded, by name
    std::array<char, 61> newName{};  // of a set to be saved
    bool saving = false;             // under that name, in the frame before
};

// Sections of the current window.
void layersSections(const EditorView& view, LayersPanelState& state, SurfaceSettings& surface,
                    Commands& commands);

}  // namespace worldy::ui
