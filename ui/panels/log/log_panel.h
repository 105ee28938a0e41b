// The Log panel: lines are coloured by level and filtered; they link to the chunks and files that they name.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "app/base/log_lines.h"
#include "ui/model/commands.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

struct LogPanelState {
    TextFilter filter{};
    bool autoScroll = true;
    std::array<bool, 4> levels{true, true, true, true};  // which are shown

    // The lines that pass the filters; they are updated when the log or a filter changes.
    struct Shown {
        std::vector<std::size_t> lines;  // indices, oldest first
        TextFilter filter{};
        std::array<bool, 4> levels{};
        std::size_t count = 0;  // number of lines in the log when this was updated
        const LogLine* oldest = nullptr;
        const LogLine* newest = nullptr;
        std::string newestText;
    } shown;
};

// Fills the current window.
void logPanel(const std::deque<LogLine>& lines, LogPanelState& state, Commands& commands);

}  // namespace worldy::ui
