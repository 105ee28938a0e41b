#include "ui/kit/item_map.h"

#include <imgui.h>

namespace ui {

namespace {

// Beside ImGui's own state of the frame, and of the same lifetime.
std::vector<ItemPlace>* collected = nullptr;
std::string currentScope;

}  // namespace

void collectItems(std::vector<ItemPlace>* into) {
    collected = into;
}

void setItemScope(std::string_view scope) {
    currentScope = scope;
}

void noteItem(std::string_view label) {
    if (!collected || !ImGui::IsItemVisible()) return;
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 size = ImGui::GetItemRectSize();
    noteRect(label, {min.x, min.y, size.x, size.y});
}

void noteRect(std::string_view label, const Rect& rect) {
    if (collected) collected->push_back({currentScope + "/" + std::string(label), rect});
}

}  // namespace ui
