// Tables of chunks, requests, level changes and the like. The header stays in view. Clicking a title sorts by
// that column: ascending, then descending, then unsorted. End a table with endTable() of ui/kit/exports.h, which
// lets the user copy and save it.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "ui/kit/exports.h"
#include "ui/kit/table_window.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

struct TableColumn {
    const char* title;  // "##go": no title, not sortable
    float share = 1;    // of the width left over when every column holds its widest text
    const char* explanation = nullptr;
    const char* widest = nullptr;  // the widest text expected in a cell, if wider than the title
    bool sorts = true;
};

// Returns the width at which every column holds its title and its widest text, pixels.
float tableWidth(std::span<const TableColumn> columns);
// Returns the text that is widest on screen; empty if there are no texts.
std::string widestText(std::span<const std::string> texts);
// Returns the width at which a list table needs no horizontal scrolling, pixels.
float listTableWidth(std::span<const TableColumn> columns);
// Divides a table's width among its columns, pixels: each gets the width it needs and its share of the rest.
std::vector<float> columnWidths(std::span<const TableColumn> columns, float width);

// Begins a table that fills the available space and scrolls horizontally if its columns do not fit. The first
// frozenColumns do not scroll, unless they would take more than half of the width.
bool beginWideTable(const char* id, std::span<const TableColumn> columns, int frozenColumns = 0);
// Begins a table as wide as the panel and as high as its rows, with at most mostLines lines. It scrolls
// horizontally like a wide table.
bool beginListTable(const char* id, std::span<const TableColumn> columns, std::size_t rows,
                    std::size_t mostLines = 12, int frozenColumns = 0);
// Begins a table without a header, whose columns are as wide as their texts. flags are added to Dear ImGui's.
bool beginPlainTable(const char* id, int columns, ImGuiTableFlags flags = 0);
// Begins a table of the given size in pixels. It scrolls horizontally like a wide table.
bool beginSizedTable(const char* id, std::span<const TableColumn> columns, ImVec2 size);

// Returns the column by which the user sorts the begun table; none: unsorted.
std::optional<TableSort> chosenSort();

void cell(const std::string& text);
void cell(const std::string& text, const ImVec4& colour);
void rightCell(const std::string& text, const ImVec4& colour);

namespace detail {

// Calls drawWindow(first, last) for the visible rows.
template <class DrawWindow>
void clipRows(std::size_t count, const DrawWindow& drawWindow) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count));
    while (clipper.Step())
        drawWindow(static_cast<std::size_t>(clipper.DisplayStart),
                   static_cast<std::size_t>(clipper.DisplayEnd));
}

}  // namespace detail

// Begins a row, which has its own ids, and calls draw() for its cells. row: its number in the table's data.
template <class DrawRow>
void tableRow(std::size_t row, const DrawRow& draw) {
    ImGui::PushID(static_cast<int>(row));
    ImGui::TableNextRow();
    detail::beginRow(row);
    draw();
    detail::endRow();
    ImGui::PopID();
}

// Calls draw(row) for the visible rows; each is begun and has its own ids.
template <class Draw>
void tableRows(std::size_t count, const Draw& draw) {
    detail::clipRows(count, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) tableRow(row, [&] { draw(row); });
    });
}

// Draws the visible rows in the order the user chose. key(row, column) returns a cell's SortKey; draw(row) is
// as above.
template <class Key, class Draw>
void tableRows(std::size_t count, const Key& key, const Draw& draw) {
    const std::optional<TableSort> sort = chosenSort();
    if (!sort) return tableRows(count, draw);
    const std::vector<std::size_t> order = tableOrder(count, sort, key);
    detail::clipRows(count, [&](std::size_t first, std::size_t last) {
        for (std::size_t at = first; at < last; ++at) tableRow(order[at], [&] { draw(order[at]); });
    });
    detail::noteOrder(order);
}

// Sorts only the visible items by less, and calls draw(item, row) for them.
template <class T, class Less, class Draw>
void sortedTableRows(std::vector<T>& items, const Less& less, const Draw& draw) {
    detail::clipRows(items.size(), [&](std::size_t first, std::size_t last) {
        sortWindow(items, first, last, less);
        for (std::size_t row = first; row < last; ++row) tableRow(row, [&] { draw(items[row], row); });
    });
}

}  // namespace worldy::ui
