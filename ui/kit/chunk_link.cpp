#include "ui/kit/chunk_link.h"

#include <fmt/format.h>

#include <string>

#include "ui/kit/filter_box.h"

namespace worldy::ui {

namespace {

// Draws the name of square. A click selects chunk; a double click looks at square.
void link(const planet::ChunkId& chunk, const planet::ChunkId& square, bool lit, Commands& commands,
          ImGuiSelectableFlags flags) {
    const std::string name = planet::toString(square);
    highlightHits(name);
    if (ImGui::Selectable(name.c_str(), lit, flags | ImGuiSelectableFlags_AllowDoubleClick)) {
        commands.push_back(SelectChunk{chunk});
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) commands.push_back(LookAtChunk{square});
    }
    if (ImGui::IsItemHovered()) commands.push_back(HoverChunk{chunk});
    if (ImGui::BeginPopupContextItem()) {
        if (ImGui::MenuItem(chunk == square ? "Select" : "Select chunk here"))
            commands.push_back(SelectChunk{chunk});
        if (ImGui::MenuItem("Look at")) commands.push_back(LookAtChunk{square});
        if (ImGui::MenuItem("Copy id")) commands.push_back(CopyText{name});
        ImGui::EndPopup();
    }
}

}  // namespace

void chunkLink(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags) {
    link(id, id, view.focus.selected == id, commands, flags);
}

// The link is never lit, because only chunks are selected.
void colourLink(const planet::ChunkId& tile, const EditorView& view, Commands& commands,
                ImGuiSelectableFlags flags) {
    link(chunkAround(view.planet->tree(), tile), tile, false, commands, flags);
}

planet::ChunkId chunkAround(const planet::ChunkTree& tree, planet::ChunkId square) {
    while (square.level > 0 && planet::findNode(tree, square) == planet::noNode)
        square = planet::parentOf(square);
    return square;
}

std::string widestChunkName(const EditorView& view) {
    const planet::PlanetShape& shape = view.planet->tree().shape;
    const int level = shape.faceCellsLog2 - shape.chunkCellsLog2;
    const std::uint32_t last = (1u << level) - 1;
    return fmt::format("x_neg/{}/{}/{}", level, last, last);
}

void chunkCell(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags) {
    ImGui::TableNextColumn();
    chunkLink(id, view, commands, flags);
}

}  // namespace worldy::ui
