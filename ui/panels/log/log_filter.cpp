#include "ui/panels/log/log_filter.h"

#include <fmt/format.h>

#include <array>

#include "ui/model/text_filter.h"

namespace worldy::ui {

std::vector<std::size_t> filteredLines(const std::deque<LogLine>& lines, std::string_view filter,
                                       std::span<const bool, 4> levels) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (levels[static_cast<std::size_t>(lines[i].level)] && passes(filter, {lines[i].text}))
            shown.push_back(i);
    }
    return shown;
}

std::string lineText(const LogLine& line) {
    return fmt::format("{} {:7}  {}", line.time, levelName(line.level), line.text);
}

const char* levelName(LogLevel level) {
    constexpr std::array names = {"debug", "info", "warning", "error"};
    return names[static_cast<std::size_t>(level)];
}

}  // namespace worldy::ui
