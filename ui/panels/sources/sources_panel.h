// The Sources panel: the layers that the planet was baked from, what each covers, and edits of them that can be baked
// and saved.
#pragma once

#include <array>
#include <optional>

#include "ui/model/editor_view.h"

namespace worldy::ui {

struct SourcesPanelState {
    std::size_t chosen = 0;            // of the layers, from the bottom up
    std::array<char, 1024> saveAs{};   // the path of the world file to save
    std::filesystem::path saveAsOf{};  // the source for which that path was proposed
};

// Fills the current window.
void sourcesPanel(const EditorView& view, SourcesPanelState& state, ViewSettings& settings,
                  Commands& commands);

}  // namespace worldy::ui
