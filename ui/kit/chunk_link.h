// A clickable chunk name, used wherever a panel mentions a chunk.
#pragma once

#include <imgui.h>

#include <string>

#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Draws a chunk's name. A click selects the chunk, a double click looks at it, hovering highlights it in the
// viewport, and a right click offers these and copying the name. The name is lit while the chunk is selected.
void chunkLink(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags = 0);
// Draws the name of a colour tile. A click selects the smallest resident chunk that contains the tile; a
// double click looks at the tile's own square.
void colourLink(const planet::ChunkId& tile, const EditorView& view, Commands& commands,
                ImGuiSelectableFlags flags = 0);
// Returns the widest name that a chunk of the planet can have, for column widths.
std::string widestChunkName(const EditorView& view);

// Returns the smallest resident chunk that contains a square of a face.
planet::ChunkId chunkAround(const planet::ChunkTree& tree, planet::ChunkId square);
// Draws a chunk link in the next cell of a table.
void chunkCell(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags = 0);

}  // namespace worldy::ui
