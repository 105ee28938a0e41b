// Filtering the lines of the log and copying them as text. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/log_lines.h"

namespace worldy::ui {

// Returns the indices of the lines of the chosen levels that contain all words of the filter, oldest first.
std::vector<std::size_t> filteredLines(const std::deque<LogLine>& lines, std::string_view filter,
                                       std::span<const bool, 4> levels);

// Returns "14:03:22 warning  the text".
std::string lineText(const LogLine& line);

const char* levelName(LogLevel level);

}  // namespace worldy::ui
