// The plot of the What if panel: a quantity over the flight, one line for each selection.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace worldy::ui {

struct WhatIfLine {
    std::string name{};
    ImVec4 colour{1, 1, 1, 1};
    std::span<const float> values{};  // one for each point; NaN: unknown, a gap
    bool isThick = false;
};

struct WhatIfPlot {
    std::span<const std::uint64_t> frames{};  // the first frame of each point
    std::span<const float> timesS{};          // never descending
    std::uint64_t framesInPoint = 1;
    std::span<const WhatIfLine> lines{};            // the first one is drawn above the others
    bool isLogarithmic = false;                     // for errors, which reach from 0.01 px to beyond 10^9 px
    std::function<std::string(double)> text{};      // a value with its unit
    std::function<std::string(double)> axisText{};  // a round one
    std::uint64_t shownFrame = 0;                   // is marked; 0: none
};

// Draws the legend, and the plot in the remaining room with a minimum height. Hovering shows the values of a point. Returns the
// frame that is clicked.
std::optional<std::uint64_t> whatIfPlot(const WhatIfPlot& plot);

}  // namespace worldy::ui
