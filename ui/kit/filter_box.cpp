#include "ui/kit/filter_box.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <vector>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

struct ShownFilter {
    const ImGuiWindow* root = nullptr;
    ImGuiID id = 0;
    int frame = 0;
};

// Global like ImGui's own state of the frame.
std::vector<ShownFilter> shownFilters;
ImGuiID wantedFilter = 0;
const TextFilter* highlighted = nullptr;

// Removes the filters of earlier frames.
void forgetOld() {
    const int frame = ImGui::GetFrameCount();
    std::erase_if(shownFilters,
                  [&](const ShownFilter& one) { return frame - one.frame > 1 || frame < one.frame; });
}

const ShownFilter* filterIn(const ImGuiWindow* window) {
    if (!window) return nullptr;
    const auto found = std::find_if(shownFilters.begin(), shownFilters.end(),
                                    [&](const ShownFilter& one) { return one.root == window->RootWindow; });
    return found == shownFilters.end() ? nullptr : &*found;
}

void note(ImGuiID id) {
    forgetOld();
    std::erase_if(shownFilters, [&](const ShownFilter& one) { return one.id == id; });
    shownFilters.push_back({ImGui::GetCurrentWindow()->RootWindow, id, ImGui::GetFrameCount()});
}

}  // namespace

void filterBox(TextFilter& filter, const char* what) {
    const bool isSet = !filter.empty();
    const float clearWidth = isSet ? ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x : 0;
    ImGui::SetNextItemWidth(std::min(ImGui::GetFontSize() * 14, ImGui::GetContentRegionAvail().x) -
                            clearWidth);
    const ImGuiID id = ImGui::GetID("##filter");
    if (wantedFilter == id) {
        ImGui::SetKeyboardFocusHere();
        wantedFilter = 0;
    }
    ImGui::InputTextWithHint("##filter", "Filter", filter.text.data(), filter.text.size(),
                             ImGuiInputTextFlags_AutoSelectAll);
    note(id);
    noteItem("Filter");
    // ImGui restores the text at Esc, so it is cleared afterwards.
    const bool left =
        ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    tooltip([&] {
        return fmt::format(
            "Shows only {} that contain each of these words; not case-sensitive. {} "
            "Esc clears the filter.",
            what, withKey("The key goes to the field.", "find"));
    });
    bool cleared = false;
    if (isSet) {
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        cleared = ImGui::Button("x##clear filter", {ImGui::GetFrameHeight(), 0});
        noteItem("Clear filter");
        tooltip("Clears the filter.");
    }
    if (left || cleared) filter = {};
}

bool focusFilter() {
    forgetOld();
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    const ShownFilter* found = g.NavDisableMouseHover ? nullptr : filterIn(g.HoveredWindow);
    if (!found) found = filterIn(g.NavWindow);
    if (!found) found = filterIn(g.HoveredWindow);
    if (!found && !shownFilters.empty()) found = &shownFilters.back();
    wantedFilter = found ? found->id : 0;
    return found != nullptr;
}

bool isFilterShown() {
    forgetOld();
    return !shownFilters.empty();
}

HitHighlight::HitHighlight(const TextFilter& filter) {
    highlighted = &filter;
}

HitHighlight::~HitHighlight() {
    highlighted = nullptr;
}

void highlightHits(const std::string& text) {
    if (!highlighted || highlighted->empty()) return;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight();
    const auto widthOf = [&](std::size_t bytes) {
        return ImGui::CalcTextSize(text.c_str(), text.c_str() + bytes).x;
    };
    for (const TextPart& hit : hitsIn(text, highlighted->view())) {
        const float left = at.x + widthOf(hit.first);
        const float right = at.x + widthOf(hit.first + hit.size);
        ImGui::GetWindowDrawList()->AddRectFilled({left, at.y}, {right, at.y + height},
                                                  packed(palette().warning, 0.35f), 2);
    }
}

}  // namespace worldy::ui
