#include "ui/kit/tables.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <cmath>

#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

constexpr ImGuiTableFlags listFlags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable |
                                      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp |
                                      ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate;

bool hasTitle(const TableColumn& column) {
    return column.title[0] != '#';
}

// Returns the width at which a column holds its title with the sort arrow and its widest text, pixels.
float neededWidth(const TableColumn& column) {
    const float arrow = 0.65f * ImGui::GetFontSize() + ImGui::GetStyle().FramePadding.x;
    float title = hasTitle(column) ? ImGui::CalcTextSize(inFont(column.title).c_str()).x : 0;
    if (hasTitle(column) && column.sorts) title += arrow;
    const float text = column.widest ? ImGui::CalcTextSize(inFont(column.widest).c_str()).x : 0;
    return std::ceil(std::max(title, text)) + 1;
}

// Returns the width of padding, borders and outer padding, pixels.
float borderWidth(std::size_t columns) {
    const auto count = static_cast<float>(columns);
    return (2 * count + 2) * ImGui::GetStyle().CellPadding.x + count;
}

// Column widths follow the table's width until the user drags one of them.
void setWidths(std::span<const float> widths) {
    ImGuiTable& table = *ImGui::GetCurrentTable();
    bool* dragged = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("dragged"));
    *dragged |= table.ResizedColumn >= 0 || table.LastResizedColumn >= 0;
    if (*dragged) return;
    for (std::size_t i = 0; i < widths.size(); ++i)
        table.Columns[static_cast<int>(i)].StretchWeight = widths[i];
}

void header(std::span<const TableColumn> columns, float width, int frozenColumns) {
    ImGui::TableSetupScrollFreeze(frozenColumns, 1);
    const std::vector<float> widths = columnWidths(columns, width);
    for (std::size_t i = 0; i < columns.size(); ++i)
        ImGui::TableSetupColumn(inFont(columns[i].title).c_str(),
                                hasTitle(columns[i]) && columns[i].sorts ? 0 : ImGuiTableColumnFlags_NoSort,
                                widths[i]);
    setWidths(widths);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (const TableColumn& column : columns) {
        ImGui::TableNextColumn();
        ImGui::TableHeader(inFont(column.title).c_str());
        if (hasTitle(column)) noteItem(fmt::format("Sort by {}", column.title));
        if (column.explanation) tooltip(column.explanation);
    }
}

bool beginTable(const char* id, std::span<const TableColumn> columns, ImVec2 size, int frozenColumns) {
    const float room = size.x > 0 ? size.x : ImGui::GetContentRegionAvail().x;
    const float width = std::max(room - ImGui::GetStyle().ScrollbarSize, tableWidth(columns));
    if (!ImGui::BeginTable(id, static_cast<int>(columns.size()), listFlags, size, width)) return false;
    detail::beginRows();
    const float frozen = tableWidth(columns.first(static_cast<std::size_t>(frozenColumns)));
    header(columns, width, frozen <= room / 2 ? frozenColumns : 0);
    return true;
}

}  // namespace

float tableWidth(std::span<const TableColumn> columns) {
    float width = borderWidth(columns.size());
    for (const TableColumn& column : columns) width += neededWidth(column);
    return width;
}

std::string widestText(std::span<const std::string> texts) {
    const auto width = [](const std::string& text) { return ImGui::CalcTextSize(inFont(text).c_str()).x; };
    const auto widest =
        std::max_element(texts.begin(), texts.end(),
                         [&](const std::string& a, const std::string& b) { return width(a) < width(b); });
    return widest == texts.end() ? std::string() : *widest;
}

float listTableWidth(std::span<const TableColumn> columns) {
    return tableWidth(columns) + ImGui::GetStyle().ScrollbarSize;
}

std::vector<float> columnWidths(std::span<const TableColumn> columns, float width) {
    const float surplus = std::max(width - tableWidth(columns), 0.0f);
    float shares = 0;
    for (const TableColumn& column : columns) shares += column.share;
    std::vector<float> widths;
    for (const TableColumn& column : columns)
        widths.push_back(neededWidth(column) + surplus * column.share / shares);
    return widths;
}

bool beginWideTable(const char* id, std::span<const TableColumn> columns, int frozenColumns) {
    const float height =
        std::max(ImGui::GetContentRegionAvail().y, 5 * ImGui::GetTextLineHeightWithSpacing());
    return beginTable(id, columns, {0, height}, frozenColumns);
}

bool beginListTable(const char* id, std::span<const TableColumn> columns, std::size_t rows,
                    std::size_t mostLines, int frozenColumns) {
    const float lines = static_cast<float>(std::clamp<std::size_t>(rows + 1, 4, mostLines));
    const bool scrolls = listTableWidth(columns) > ImGui::GetContentRegionAvail().x;
    const float height = lines * (ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y) +
                         (scrolls ? ImGui::GetStyle().ScrollbarSize : 0);
    return beginTable(id, columns, {0, height}, frozenColumns);
}

bool beginPlainTable(const char* id, int columns, ImGuiTableFlags flags) {
    if (!ImGui::BeginTable(id, columns, flags | ImGuiTableFlags_SizingFixedFit)) return false;
    detail::beginRows();
    return true;
}

bool beginSizedTable(const char* id, std::span<const TableColumn> columns, ImVec2 size) {
    return beginTable(id, columns, size, 0);
}

std::optional<TableSort> chosenSort() {
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (!specs || specs->SpecsCount == 0) return std::nullopt;
    return TableSort{static_cast<std::size_t>(specs->Specs->ColumnIndex),
                     specs->Specs->SortDirection == ImGuiSortDirection_Descending};
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    highlightHits(text);
    ImGui::TextUnformatted(text.c_str());
}

void cell(const std::string& text, const ImVec4& colour) {
    ImGui::TableNextColumn();
    highlightHits(text);
    ImGui::TextColored(colour, "%s", text.c_str());
}

void rightCell(const std::string& text, const ImVec4& colour) {
    ImGui::TableNextColumn();
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    ImGui::TextColored(colour, "%s", text.c_str());
}

}  // namespace worldy::ui
