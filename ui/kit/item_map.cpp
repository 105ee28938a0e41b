#include "ui/kit/item_map.h"

#include <imgui.h>

#include <algorithm>

namespace worldy::ui {

namespace {

// Global like ImGui's own state of the frame.
std::vector<ItemPlace>* collected = nullptr;
std::string currentScope;

}  // namespace

void collectItems(std::vector<ItemPlace>* into) {
    collected = into;
}

bool collectsItems() {
    return collected != nullptr;
}

void setItemScope(std::string_view scope) {
    currentScope = scope;
}

void noteItem(std::string_view label) {
    if (!collected || !ImGui::IsItemVisible()) return;
    // A table row may be wider than the window that scrolls it.
    const float left = std::max(ImGui::GetItemRectMin().x, ImGui::GetWindowPos().x);
    const float right =
        std::min(ImGui::GetItemRectMax().x, ImGui::GetWindowPos().x + ImGui::GetWindowWidth());
    const float top = ImGui::GetItemRectMin().y;
    noteRect(label, {left, top, right - left, ImGui::GetItemRectSize().y});
}

void noteRect(std::string_view label, const Rect& rect) {
    if (collected) collected->push_back({currentScope + "/" + std::string(label), rect});
}

}  // namespace worldy::ui
