#include "ui/kit/columns.h"

#include <imgui.h>

#include <algorithm>

#include "ui/kit/widgets.h"

namespace ui {

namespace {

// Heights of the font from which on columns stand side by side.
constexpr float wideFrom = 42;
// Below this a column would show next to nothing, so the window scrolls instead.
constexpr float leastColumnLines = 5;

void drawSideBySide(std::span<const Column> columns) {
    float shares = 0;
    for (const Column& column : columns) shares += column.share;
    const float gap = ImGui::GetFontSize() * 0.8f;
    const auto count = static_cast<float>(columns.size());
    const float room = ImGui::GetContentRegionAvail().x - gap * (count - 1);
    const float height =
        std::max(ImGui::GetContentRegionAvail().y, leastColumnLines * ImGui::GetTextLineHeightWithSpacing());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i > 0) ImGui::SameLine(0, gap);
        ImGui::BeginChild(columns[i].title, {room * columns[i].share / shares, height});
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
        ImGui::BeginChild(column.title, {0, column.stackedLines * ImGui::GetTextLineHeightWithSpacing()});
        column.draw();
        ImGui::EndChild();
    }
}

}  // namespace

bool hasWideRoom() {
    return ImGui::GetContentRegionAvail().x > wideFrom * ImGui::GetFontSize();
}

void drawColumns(const char* id, std::span<const Column> columns) {
    ImGui::PushID(id);
    if (hasWideRoom()) {
        drawSideBySide(columns);
    } else {
        drawStacked(columns);
    }
    ImGui::PopID();
}

}  // namespace ui
