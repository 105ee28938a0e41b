#include "ui/chunk_link.h"

namespace ui {

void chunkLink(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags) {
    const std::string name = planet::toString(id);
    if (ImGui::Selectable(name.c_str(), view.focus.selected == id,
                          flags | ImGuiSelectableFlags_AllowDoubleClick)) {
        commands.push_back(SelectChunk{id});
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) commands.push_back(LookAtChunk{id});
    }
    if (ImGui::IsItemHovered()) commands.push_back(HoverChunk{id});
    if (ImGui::BeginPopupContextItem()) {
        if (ImGui::MenuItem("Select")) commands.push_back(SelectChunk{id});
        if (ImGui::MenuItem("Look at")) commands.push_back(LookAtChunk{id});
        if (ImGui::MenuItem("Copy name")) commands.push_back(CopyText{name});
        ImGui::EndPopup();
    }
}

void chunkCell(const planet::ChunkId& id, const EditorView& view, Commands& commands,
               ImGuiSelectableFlags flags) {
    ImGui::TableNextColumn();
    chunkLink(id, view, commands, flags);
}

}  // namespace ui
