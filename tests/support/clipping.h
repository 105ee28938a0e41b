// Finds what a panel clips, from the sizes that ImGui has laid out. Texts drawn into draw lists are not found.
#pragma once

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>
#include <vector>

namespace worldy::ui {

// Returns the windows of this frame whose content is wider than they are and cannot be scrolled sideways, and the tables'
// columns whose titles or cells are wider than they are. Call after some equal frames.
inline std::vector<std::string> clippedParts() {
    std::vector<std::string> parts;
    ImGuiContext& context = *ImGui::GetCurrentContext();
    for (const ImGuiWindow* window : context.Windows) {
        constexpr ImGuiWindowFlags excused = ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_Tooltip;
        // A multi-line text field follows its caret.
        constexpr ImGuiWindowFlags textField = ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_NoMove;
        if (!window->Active || (window->Flags & excused) != 0 || (window->Flags & textField) == textField)
            continue;
        const float room = window->InnerRect.GetWidth() - 2 * window->WindowPadding.x;
        if (window->ContentSize.x <= room + 1) continue;
        parts.push_back(
            fmt::format("window {}: content {} of {} px", window->Name, window->ContentSize.x, room));
    }
    for (int t = 0; t < context.Tables.GetMapSize(); ++t) {
        ImGuiTable* const table = context.Tables.TryGetMapData(t);
        if (!table || table->LastFrameActive + 1 < context.FrameCount) continue;
        for (int c = 0; c < table->ColumnsCount; ++c) {
            const ImGuiTableColumn& column = table->Columns[c];
            if (!column.IsEnabled) continue;
            const float title = column.ContentMaxXHeadersIdeal - column.WorkMaxX;
            const float cell =
                std::max(column.ContentMaxXFrozen, column.ContentMaxXUnfrozen) - column.WorkMaxX;
            if (title <= 1 && cell <= 1) continue;
            const char* const name = ImGui::TableGetColumnName(table, c);
            parts.push_back(fmt::format("table in {}: column {} \"{}\": title {} px, cell {} px too wide",
                                        table->OuterWindow->Name, c, name, title, cell));
        }
    }
    return parts;
}

// Returns true if a table of this frame scrolls sideways.
inline bool aTableScrolls() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    for (int t = 0; t < context.Tables.GetMapSize(); ++t) {
        const ImGuiTable* const table = context.Tables.TryGetMapData(t);
        if (table && table->LastFrameActive + 1 >= context.FrameCount && table->InnerWindow->ScrollMax.x > 0)
            return true;
    }
    return false;
}

}  // namespace worldy::ui
