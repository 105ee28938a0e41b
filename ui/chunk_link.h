// A chunk's name that can be clicked, wherever a panel mentions one.
#pragma once

#include <imgui.h>

#include "planet/chunk_id.h"
#include "ui/editor_view.h"

namespace ui {

// Click selects the chunk, a double click looks at it, resting on it lights it up in the viewport, a right
// click offers these and copying its name. Lit while it is selected.
void chunkLink(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags = 0);
// The same in the next cell of a table.
void chunkCell(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags = 0);

}  // namespace ui
