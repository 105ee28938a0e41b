// Tables that list many things: chunks, requests, switches of level. All have a header that stays in sight;
// end with ImGui::EndTable() where they begin.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "ui/table_window.h"

namespace ui {

struct TableColumn {
    const char* title;  // "##go": none
    float share = 1;    // of the width, relative to the other columns'
    const char* explanation = nullptr;
};

// Fills the room there is, but scrolls sideways rather than squeeze its columns below a width, in heights of
// the font. The first columns so many stay in sight.
bool beginWideTable(const char* id, std::span<const TableColumn> columns, float leastWidth,
                    int frozenColumns = 0);
// As wide as the panel and as high as so many rows, within limits.
bool beginListTable(const char* id, std::span<const TableColumn> columns, std::size_t rows,
                    std::size_t mostLines = 12);

void cell(const std::string& text);
void cell(const std::string& text, const ImVec4& colour);

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

// The same of what is sorted only where it is seen: draw(item, row).
template <class T, class Less, class Draw>
void sortedTableRows(std::vector<T>& items, const Less& less, const Draw& draw) {
    detail::clipRows(items.size(), [&](std::size_t first, std::size_t last) {
        sortWindow(items, first, last, less);
        for (std::size_t row = first; row < last; ++row) detail::drawRow(row, [&] { draw(items[row], row); });
    });
}

}  // namespace ui
