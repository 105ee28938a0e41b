// Chunk inspector: everything about the chunk that is selected, and why it is drawn or not.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "ui/model/editor_view.h"
#include "ui/panels/lod/chunk_heights.h"

namespace worldy::ui {

struct ChunkPanelState {
    std::array<char, 40> idText{};         // being typed
    std::string problem;                   // of what was typed
    std::optional<planet::ChunkId> shown;  // whose id the text is
    // Worked out anew only when the heights are others.
    planet::SharedHeights pictured;
    ChunkPicture picture;
};

// Fills the current window.
void chunkPanel(const EditorView& view, ChunkPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
