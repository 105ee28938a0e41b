// The chunk inspector: all data of the selected chunk, and why it is drawn or not.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "ui/model/editor_view.h"
#include "ui/panels/lod/chunk_heights.h"

namespace worldy::ui {

struct ChunkPanelState {
    std::array<char, 40> idText{};         // the id being typed
    std::string problem;                   // of the typed id
    std::optional<planet::ChunkId> shown;  // the chunk whose id is in idText
    // The picture is rebuilt only if the chunk's heights have changed.
    planet::SharedHeights pictured;
    ChunkPicture picture;
};

// Fills the current window.
void chunkPanel(const EditorView& view, ChunkPanelState& state, Commands& commands);

}  // namespace worldy::ui
