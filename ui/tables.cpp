#include "ui/tables.h"

#include "ui/widgets.h"

namespace ui {

namespace {

constexpr ImGuiTableFlags listFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp;
constexpr ImGuiTableFlags wideFlags = listFlags | ImGuiTableFlags_ScrollX | ImGuiTableFlags_Resizable;

void header(std::span<const TableColumn> columns, int frozenColumns) {
    ImGui::TableSetupScrollFreeze(frozenColumns, 1);
    for (const TableColumn& column : columns) ImGui::TableSetupColumn(column.title, 0, column.share);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (const TableColumn& column : columns) {
        ImGui::TableNextColumn();
        ImGui::TableHeader(column.title);
        if (column.explanation) tooltip(column.explanation);
    }
}

}  // namespace

bool beginWideTable(const char* id, std::span<const TableColumn> columns, float leastWidth,
                    int frozenColumns) {
    const float width = std::max(ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize,
                                 leastWidth * ImGui::GetFontSize());
    if (!ImGui::BeginTable(id, static_cast<int>(columns.size()), wideFlags, {0, 0}, width)) return false;
    header(columns, frozenColumns);
    return true;
}

bool beginListTable(const char* id, std::span<const TableColumn> columns, std::size_t rows,
                    std::size_t mostLines) {
    const float lines = static_cast<float>(std::clamp<std::size_t>(rows + 1, 4, mostLines));
    const ImVec2 size(0, lines * ImGui::GetTextLineHeightWithSpacing());
    if (!ImGui::BeginTable(id, static_cast<int>(columns.size()), listFlags, size)) return false;
    header(columns, 0);
    return true;
}

void cell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

void cell(const std::string& text, const ImVec4& colour) {
    ImGui::TableNextColumn();
    ImGui::TextColored(colour, "%s", text.c_str());
}

}  // namespace ui
