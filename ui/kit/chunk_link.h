// A chunk's name that can be clicked, wherever a panel mentions one.
#pragma once

#include <imgui.h>

#include <string>

#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Click selects the chunk, a double click looks at it, resting on it lights it up in the viewport, a right
// click offers these and copying its name. Lit while it is selected.
void chunkLink(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags = 0);
// A tile of colour, by its name: a click selects the chunk on whose ground it lies, as small a resident one
// as there is; a double click looks at the tile's own square.
void colourLink(const planet::ChunkId& tile, const EditorView& view, Commands& commands,
                ImGuiSelectableFlags flags = 0);
// Returns the widest name that a chunk of the planet can have: for the width of a column.
std::string widestChunkName(const EditorView& view);

// The resident chunk that holds a square of a face, the smallest.
planet::ChunkId chunkAround(const planet::ChunkTree& tree, planet::ChunkId square);
// The same in the next cell of a table.
void chunkCell(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags = 0);

}  // namespace worldy::ui
