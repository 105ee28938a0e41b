#include "ui/panels/log/log_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/panels/log/log_filter.h"
#include "ui/panels/log/log_links.h"

namespace worldy::ui {

namespace {

const ImVec4& colourOf(LogLevel level) {
    switch (level) {
        case LogLevel::Debug:
            return palette().dim;
        case LogLevel::Info:
            return palette().text;
        case LogLevel::Warning:
            return palette().warning;
        case LogLevel::Error:
            return palette().bad;
    }
    return palette().text;
}

void refresh(const std::deque<LogLine>& lines, LogPanelState& state) {
    LogPanelState::Shown& shown = state.shown;
    const LogLine* oldest = lines.empty() ? nullptr : &lines.front();
    const LogLine* newest = lines.empty() ? nullptr : &lines.back();
    if (shown.count == lines.size() && shown.oldest == oldest && shown.newest == newest &&
        (!newest || shown.newestText == newest->text) && shown.levels == state.levels &&
        shown.filter.view() == state.filter.view()) {
        return;
    }
    shown.lines = filteredLines(lines, state.filter.view(), state.levels);
    shown.filter = state.filter;
    shown.levels = state.levels;
    shown.count = lines.size();
    shown.oldest = oldest;
    shown.newest = newest;
    shown.newestText = newest ? newest->text : std::string();
}

void toolbar(LogPanelState& state) {
    filterBox(state.filter, "lines");
    for (std::size_t i = 0; i < state.levels.size(); ++i) {
        const auto level = static_cast<LogLevel>(i);
        sameLineIfRoom(checkboxWidth(levelName(level)));
        ImGui::PushStyleColor(ImGuiCol_Text, colourOf(level));
        ImGui::Checkbox(levelName(level), &state.levels[i]);
        noteItem(levelName(level));
        ImGui::PopStyleColor();
        tooltip("Shows or hides lines of this level.");
    }
    sameLineIfRoom(checkboxWidth("Follow"));
    ImGui::Checkbox("Follow", &state.autoScroll);
    tooltip("Scrolls to new lines. Scrolling up turns this off.");
}

// Selects the chunk that a line names, looks at the tile of colour, or else copies the path of the file.
void follow(const LogLine& line, Commands& commands) {
    if (const auto chunk = chunkNamedIn(line.text)) {
        commands.push_back(SelectChunk{chunk});
    } else if (const auto tile = colourTileNamedIn(line.text)) {
        commands.push_back(LookAtChunk{*tile});
    } else if (const auto file = fileNamedIn(line.text)) {
        commands.push_back(CopyText{file->string()});
    }
}

void lineMenu(const LogLine& line, Commands& commands) {
    if (!ImGui::BeginPopupContextItem()) return;
    if (ImGui::MenuItem("Copy line")) commands.push_back(CopyText{lineText(line)});
    if (const auto chunk = chunkNamedIn(line.text)) {
        const std::string name = planet::toString(*chunk);
        if (ImGui::MenuItem(("Select " + name).c_str())) commands.push_back(SelectChunk{chunk});
        if (ImGui::MenuItem(("Look at " + name).c_str())) commands.push_back(LookAtChunk{*chunk});
    }
    if (const auto tile = colourTileNamedIn(line.text)) {
        if (ImGui::MenuItem(("Look at colour tile " + planet::toString(*tile)).c_str()))
            commands.push_back(LookAtChunk{*tile});
    }
    if (const auto file = fileNamedIn(line.text)) {
        if (ImGui::MenuItem("Copy path")) commands.push_back(CopyText{file->string()});
    }
    ImGui::EndPopup();
}

void lineTooltip(const LogLine& line, Commands& commands) {
    if (!ImGui::IsItemHovered()) return;
    if (const auto chunk = chunkNamedIn(line.text)) {
        commands.push_back(HoverChunk{*chunk});
        tooltip(fmt::format("Click: selects {}.", planet::toString(*chunk)).c_str());
    } else if (const auto tile = colourTileNamedIn(line.text)) {
        tooltip(fmt::format("Click: looks at colour tile {}.", planet::toString(*tile)).c_str());
    } else if (const auto file = fileNamedIn(line.text)) {
        tooltip(fmt::format("Click: copies {}.", file->string()).c_str());
    }
}

void drawLine(const LogLine& line, std::size_t index, Commands& commands) {
    ImGui::TableNextColumn();
    const ImVec2 start = ImGui::GetCursorPos();
    // The whole line takes the click; its words are drawn over it.
    if (ImGui::Selectable("##line", false, ImGuiSelectableFlags_SpanAllColumns)) follow(line, commands);
    noteItem(fmt::format("line {}", index));
    lineTooltip(line, commands);
    lineMenu(line, commands);
    ImGui::SetCursorPos(start);
    ImGui::TextColored(palette().dim, "%s", line.time.c_str());
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, colourOf(line.level));
    highlightHits(line.text);
    ImGui::TextUnformatted(line.text.c_str());
    ImGui::PopStyleColor();
}

void lineTable(const std::deque<LogLine>& lines, LogPanelState& state, Commands& commands) {
    const std::vector<std::size_t>& shown = state.shown.lines;
    if (!beginPlainTable("lines", 1, ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY)) return;
    if (ImGui::IsWindowHovered() && ImGui::GetIO().MouseWheel > 0 && ImGui::GetScrollMaxY() > 0)
        state.autoScroll = false;
    const HitHighlight highlight(state.filter);
    const auto lineOf = [&](std::size_t row) -> const LogLine& { return lines[shown[row]]; };
    tableRows(shown.size(), [&](std::size_t row) { drawLine(lineOf(row), shown[row], commands); });
    constexpr float belowEveryLine = 1e8f;  // pixels
    if (state.autoScroll) ImGui::SetScrollY(belowEveryLine);
    endTable(exportTable<LogLine>("log", shown.size(), lineOf,
                                  {{"time", [](const LogLine& line) { return line.time; }, true},
                                   {"level", [](const LogLine& line) { return levelName(line.level); }, true},
                                   {"text", [](const LogLine& line) { return line.text; }, true}}));
}

}  // namespace

void logPanel(const std::deque<LogLine>& lines, LogPanelState& state, Commands& commands) {
    refresh(lines, state);
    toolbar(state);
    refresh(lines, state);
    if (state.shown.lines.empty())
        emptyState(lines.empty() ? "The log is empty." : "No line matches the filters.");
    else
        lineTable(lines, state, commands);
}

}  // namespace worldy::ui
