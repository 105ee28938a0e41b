// Bake: the open file's parameters, what a bake with others would cost, and the bake itself.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "ui/editor_view.h"

namespace ui {

struct BakePanelState {
    std::optional<BakeRequest> edited;    // what the user has chosen; none: as the open file
    std::filesystem::path editedOf;       // the chunk file that was open then
    std::array<char, 1024> sourceText{};  // being typed
    bool sourceIsThere = false;           // of sourceText
    std::optional<double> estimateAtS;    // when to ask; none: has been asked
};

// Fills the current window.
void bakePanel(const EditorView& view, BakePanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace ui
