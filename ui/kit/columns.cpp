#include "ui/kit/columns.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

// The minimum width for columns side by side, in heights of the font.
constexpr float wideFrom = 42;
// The minimum height of a column; if less is left, the window scrolls instead.
constexpr float leastColumnLines = 5;

float gapWidth() {
    return ImGui::GetFontSize() * 0.8f;
}

// Returns the current window's width without the gaps between the columns, pixels.
float roomFor(std::span<const Column> columns) {
    const float gaps = columns.empty() ? 0 : static_cast<float>(columns.size() - 1);
    return ImGui::GetContentRegionAvail().x - gaps * gapWidth();
}

// Returns a width with room for the column's own scrollbar, pixels; 0 if any width is enough.
float withScrollbar(float width) {
    return width > 0 ? std::ceil(width + ImGui::GetStyle().ScrollbarSize) : 0;
}

float neededWidth(const Column& column) {
    return withScrollbar(column.needed);
}

float wantedWidth(const Column& column) {
    return std::max(neededWidth(column), withScrollbar(column.wanted));
}

// Returns the least width of each column: the wanted one if all of them fit, otherwise the needed one.
std::vector<float> leastWidths(std::span<const Column> columns, float width) {
    std::vector<float> wanted, needed;
    for (const Column& column : columns) {
        wanted.push_back(wantedWidth(column));
        needed.push_back(neededWidth(column));
    }
    return std::accumulate(wanted.begin(), wanted.end(), 0.0f) <= width ? wanted : needed;
}

// The columns are windows within the panel's; the flag lets Tab and the arrows go from one to the next.
constexpr ImGuiWindowFlags columnFlags = ImGuiWindowFlags_NavFlattened;

void drawSideBySide(std::span<const Column> columns) {
    const std::vector<float> widths = sideBySideWidths(columns, roomFor(columns));
    const float height =
        std::max(ImGui::GetContentRegionAvail().y, leastColumnLines * ImGui::GetTextLineHeightWithSpacing());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i > 0) ImGui::SameLine(0, gapWidth());
        ImGui::BeginChild(columns[i].title, {widths[i], height}, false, columnFlags);
        columns[i].draw();
        ImGui::EndChild();
    }
}

void drawStacked(std::span<const Column> columns) {
    for (const Column& column : columns) {
        if (!section(column.title)) continue;
        if (column.stackedLines <= 0) {
            column.draw();
            continue;
        }
        ImGui::BeginChild(column.title, {0, column.stackedLines * ImGui::GetTextLineHeightWithSpacing()},
                          false, columnFlags);
        column.draw();
        ImGui::EndChild();
    }
}

}  // namespace

bool hasWideRoom(std::span<const Column> columns) {
    float needed = 0;
    for (const Column& column : columns) needed += neededWidth(column);
    return ImGui::GetContentRegionAvail().x > wideFrom * ImGui::GetFontSize() && roomFor(columns) >= needed;
}

std::vector<float> sideBySideWidths(std::span<const Column> columns, float width) {
    std::vector<float> widths(columns.size(), 0);
    const std::vector<float> least = leastWidths(columns, width);
    // Columns that need more than their share take it from the others, which may make others fall short.
    std::vector<bool> atNeed(columns.size(), false);
    for (bool changed = true; changed;) {
        changed = false;
        float shares = 0, left = width;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (atNeed[i])
                left -= widths[i];
            else
                shares += columns[i].share;
        }
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (atNeed[i]) continue;
            widths[i] = std::max(left, 0.0f) * columns[i].share / shares;
            if (widths[i] >= least[i]) continue;
            widths[i] = least[i];
            atNeed[i] = changed = true;
        }
    }
    return widths;
}

void drawColumns(const char* id, std::span<const Column> columns) {
    ImGui::PushID(id);
    if (hasWideRoom(columns)) {
        drawSideBySide(columns);
    } else {
        drawStacked(columns);
    }
    ImGui::PopID();
}

}  // namespace worldy::ui
