// The log: coloured by level, with filters; its lines lead to the chunks and files that they name.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "ui/commands.h"

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
    std::array<bool, 4> levels{true, true, true, true};  // which are shown

    // The lines that the filters let through, found anew when the log or a filter changes.
    struct Shown {
        std::vector<std::size_t> lines;  // indices, oldest first
        std::array<char, 128> filter{};
        std::array<bool, 4> levels{};
        std::size_t count = 0;  // of the log, as it was
        const LogLine* oldest = nullptr;
        const LogLine* newest = nullptr;
        std::string newestText;
    } shown;
};

// Fills the current window.
void logPanel(const std::deque<LogLine>& lines, LogPanelState& state, Commands& commands);

}  // namespace ui
