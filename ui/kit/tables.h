// Tables that list many things: chunks, requests, level changes. The header stays in view, and clicking a
// title sorts by that column: ascending, descending, then unsorted again. End a begun table with
// ImGui::EndTable().
#pragma once

#include <imgui.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "ui/kit/table_window.h"
#include "ui/model/table_order.h"

namespace worldy::ui {

struct TableColumn {
    const char* title;  // "##go": no title, not sortable
    float share = 1;    // of the width that is left when every column holds its widest text
    const char* explanation = nullptr;
    const char* widest = nullptr;  // the widest text to expect in a cell, if wider than the title
    bool sorts = true;
};

// Returns the width at which every column holds its title and its widest text, pixels.
float tableWidth(std::span<const TableColumn> columns);
// Returns the text that is widest on screen; empty: there is none.
std::string widestText(std::span<const std::string> texts);
// Returns the width that a list table fills without scrolling sideways, pixels.
float listTableWidth(std::span<const TableColumn> columns);
// Divides a table's width among its columns, pixels: each gets what it needs and its share of the rest.
std::vector<float> columnWidths(std::span<const TableColumn> columns, float width);

// Fills the available space. Scrolls sideways if it is narrower than the titles and the widest texts need.
// The first frozenColumns do not scroll, unless they would take more than half of the width.
bool beginWideTable(const char* id, std::span<const TableColumn> columns, int frozenColumns = 0);
// Is as wide as the panel and as high as its rows, within limits; scrolls sideways like a wide table.
bool beginListTable(const char* id, std::span<const TableColumn> columns, std::size_t rows,
                    std::size_t mostLines = 12, int frozenColumns = 0);
// Has the given size in pixels; scrolls sideways like a wide table.
bool beginSizedTable(const char* id, std::span<const TableColumn> columns, ImVec2 size);

// Returns the column the user sorts the begun table by; none: the given order.
std::optional<TableSort> chosenSort();

void cell(const std::string& text);
void cell(const std::string& text, const ImVec4& colour);
void rightCell(const std::string& text, const ImVec4& colour);

namespace detail {

// drawWindow(first, last): the rows that may be seen.
template <class DrawWindow>
void clipRows(std::size_t count, const DrawWindow& drawWindow) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(count));
    while (clipper.Step())
        drawWindow(static_cast<std::size_t>(clipper.DisplayStart),
                   static_cast<std::size_t>(clipper.DisplayEnd));
}

template <class DrawRow>
void drawRow(std::size_t row, const DrawRow& draw) {
    ImGui::PushID(static_cast<int>(row));
    ImGui::TableNextRow();
    draw();
    ImGui::PopID();
}

}  // namespace detail

// Those rows of count that may be seen: draw(row), with the row begun and ids of its own.
template <class Draw>
void tableRows(std::size_t count, const Draw& draw) {
    detail::clipRows(count, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) detail::drawRow(row, [&] { draw(row); });
    });
}

// Draws the visible rows in the order the user chose: key(row, column) is a cell's SortKey, draw(row) as
// above.
template <class Key, class Draw>
void tableRows(std::size_t count, const Key& key, const Draw& draw) {
    const std::optional<TableSort> sort = chosenSort();
    if (!sort) return tableRows(count, draw);
    const std::vector<std::size_t> order = tableOrder(count, sort, key);
    detail::clipRows(count, [&](std::size_t first, std::size_t last) {
        for (std::size_t at = first; at < last; ++at) detail::drawRow(order[at], [&] { draw(order[at]); });
    });
}

// Sorts items by less, but only the visible rows: draw(item, row).
template <class T, class Less, class Draw>
void sortedTableRows(std::vector<T>& items, const Less& less, const Draw& draw) {
    detail::clipRows(items.size(), [&](std::size_t first, std::size_t last) {
        sortWindow(items, first, last, less);
        for (std::size_t row = first; row < last; ++row) detail::drawRow(row, [&] { draw(items[row], row); });
    });
}

}  // namespace worldy::ui
