// The Presets panel: presets are saved, loaded, and compared with the current settings.
#pragma once

#include <array>
#include <string>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct PresetsPanelState {
    std::array<char, 64> name{};
    std::string selected;  // compared with the current settings
};

// Fills the current window.
void presetsPanel(const EditorView& view, PresetsPanelState& state, Commands& commands);

}  // namespace worldy::ui
