#include "ui/log_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

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

bool holds(std::string_view text, std::string_view part) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

std::vector<const LogLine*> shownLines(const std::deque<LogLine>& lines, std::string_view filter) {
    std::vector<const LogLine*> shown;
    for (const LogLine& line : lines) {
        if (holds(line.text, filter)) shown.push_back(&line);
    }
    return shown;
}

void drawLine(const LogLine& line) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    ImGui::TextUnformatted(line.time.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, colourOf(line.level));
    ImGui::TextUnformatted(line.text.c_str());
    ImGui::PopStyleColor();
}

}  // namespace

void logPanel(const std::deque<LogLine>& lines, LogPanelState& state) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Log");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(std::min(ImGui::GetFontSize() * 16, ImGui::GetContentRegionAvail().x * 0.4f));
    ImGui::InputTextWithHint("##filter", "Filter", state.filter.data(), state.filter.size());
    tooltip("Shows only the lines that hold this text.");
    ImGui::SameLine();
    ImGui::Checkbox("Follow", &state.autoScroll);
    tooltip("Keeps the newest line in view.");

    ImGui::BeginChild("lines", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    const std::vector<const LogLine*> shown = shownLines(lines, state.filter.data());
    if (shown.empty())
        ImGui::TextDisabled(lines.empty() ? "Nothing has happened yet." : "No line holds this text.");
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(shown.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            drawLine(*shown[static_cast<std::size_t>(i)]);
    }
    if (state.autoScroll) ImGui::SetScrollHereY(1);
    ImGui::EndChild();
}

}  // namespace ui
