// Which lines of the log are shown, and what is copied of them. Pure functions.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/log_panel.h"

namespace ui {

// Whether a text holds another; the case of ASCII letters does not matter, and nothing is held by all.
bool holds(std::string_view text, std::string_view part);

// The lines of the levels that hold a text, oldest first.
std::vector<std::size_t> filteredLines(const std::deque<LogLine>& lines, std::string_view filter,
                                       std::span<const bool, 4> levels);

// "14:03:22 warning  the text"
std::string lineText(const LogLine& line);
// Those lines, one below the other.
std::string linesText(const std::deque<LogLine>& lines, std::span<const std::size_t> which);

const char* levelName(LogLevel level);

}  // namespace ui
