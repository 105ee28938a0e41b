// The log: coloured by level, with a filter.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>

namespace ui {

enum class LogLevel : std::uint8_t { Debug, Info, Warning, Error };

struct LogLine {
    LogLevel level = LogLevel::Info;
    std::string time;  // "14:03:22"
    std::string text;
};

struct LogPanelState {
    std::array<char, 128> filter{};  // shows only lines that hold this; case does not matter
    bool autoScroll = true;
};

// Fills the current window.
void logPanel(const std::deque<LogLine>& lines, LogPanelState& state);

}  // namespace ui
