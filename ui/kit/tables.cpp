#include "ui/kit/tables.h"

#include <fmt/format.h>

#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace ui {

namespace {

constexpr ImGuiTableFlags listFlags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable |
                                      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp |
                                      ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate;

bool hasTitle(const TableColumn& column) {
    return column.title[0] != '#';
}

// The width at which every column holds its title with the sort arrow and its widest text, pixels.
float neededWidth(std::span<const TableColumn> columns) {
    float shares = 0;
    float perShare = 0;
    for (const TableColumn& column : columns) {
        const float title =
            hasTitle(column) ? ImGui::CalcTextSize(inFont(column.title).c_str()).x + ImGui::GetFontSize() : 0;
        const float text = column.widest ? ImGui::CalcTextSize(column.widest).x : 0;
        const float padding = 2 * ImGui::GetStyle().CellPadding.x + 1;
        perShare = std::max(perShare, (std::max(title, text) + padding) / column.share);
        shares += column.share;
    }
    return shares * perShare;
}

void header(std::span<const TableColumn> columns, int frozenColumns) {
    ImGui::TableSetupScrollFreeze(frozenColumns, 1);
    for (const TableColumn& column : columns)
        ImGui::TableSetupColumn(inFont(column.title).c_str(),
                                hasTitle(column) && column.sorts ? 0 : ImGuiTableColumnFlags_NoSort,
                                column.share);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (const TableColumn& column : columns) {
        ImGui::TableNextColumn();
        ImGui::TableHeader(inFont(column.title).c_str());
        if (hasTitle(column)) noteItem(fmt::format("Sort by {}", column.title));
        if (column.explanation) tooltip(column.explanation);
    }
}

bool beginTable(const char* id, std::span<const TableColumn> columns, float leastWidthPx, ImVec2 size,
                int frozenColumns) {
    const float width = std::max({ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize,
                                  leastWidthPx, neededWidth(columns)});
    if (!ImGui::BeginTable(id, static_cast<int>(columns.size()), listFlags, size, width)) return false;
    header(columns, frozenColumns);
    return true;
}

}  // namespace

bool beginWideTable(const char* id, std::span<const TableColumn> columns, float leastWidth,
                    int frozenColumns) {
    const float height =
        std::max(ImGui::GetContentRegionAvail().y, 5 * ImGui::GetTextLineHeightWithSpacing());
    return beginTable(id, columns, leastWidth * ImGui::GetFontSize(), {0, height}, frozenColumns);
}

bool beginListTable(const char* id, std::span<const TableColumn> columns, std::size_t rows,
                    std::size_t mostLines, int frozenColumns) {
    const float lines = static_cast<float>(std::clamp<std::size_t>(rows + 1, 4, mostLines));
    const bool scrolls = neededWidth(columns) > ImGui::GetContentRegionAvail().x;
    const float height = lines * (ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y) +
                         (scrolls ? ImGui::GetStyle().ScrollbarSize : 0);
    return beginTable(id, columns, 0, {0, height}, frozenColumns);
}

bool beginSizedTable(const char* id, std::span<const TableColumn> columns, ImVec2 size) {
    return beginTable(id, columns, 0, size, 0);
}

std::optional<TableSort> chosenSort() {
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (!specs || specs->SpecsCount == 0) return std::nullopt;
    return TableSort{static_cast<std::size_t>(specs->Specs->ColumnIndex),
                     specs->Specs->SortDirection == ImGuiSortDirection_Descending};
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

void cell(const std::string& text, const ImVec4& colour) {
    ImGui::TableNextColumn();
    ImGui::TextColored(colour, "%s", text.c_str());
}

void rightCell(const std::string& text, const ImVec4& colour) {
    ImGui::TableNextColumn();
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    ImGui::TextColored(colour, "%s", text.c_str());
}

}  // namespace ui
