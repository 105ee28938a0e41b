#include "ui/panels/log/log_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace worldy::ui {

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

bool holds(std::string_view text, std::string_view part) {
    const auto same = [](char a, char b) { return lower(a) == lower(b); };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end() ||
           part.empty();
}

std::vector<std::size_t> filteredLines(const std::deque<LogLine>& lines, std::string_view filter,
                                       std::span<const bool, 4> levels) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (levels[static_cast<std::size_t>(lines[i].level)] && holds(lines[i].text, filter))
            shown.push_back(i);
    }
    return shown;
}

std::string lineText(const LogLine& line) {
    return fmt::format("{} {:7}  {}", line.time, levelName(line.level), line.text);
}

std::string linesText(const std::deque<LogLine>& lines, std::span<const std::size_t> which) {
    std::string text;
    for (const std::size_t i : which) text += lineText(lines[i]) + "\n";
    return text;
}

const char* levelName(LogLevel level) {
    constexpr std::array names = {"debug", "info", "warning", "error"};
    return names[static_cast<std::size_t>(level)];
}

}  // namespace worldy::ui
