// The What if panel: selects again over the open trace with other tolerances, hysteresis, budgets or disks, shows cost and
// error beside what the engine did, and lists where the engine's choice is not what its own numbers say.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// A quantity over the flight, or a cost against the error.
enum class WhatIfPicture : std::uint8_t {
    ErrorPx,
    Triangles,
    Bytes,
    Drawn,
    Switches,
    Unknown,
    BytesAgainstError,
    TrianglesAgainstError,
};

struct WhatIfPanelState {
    std::array<char, 192> taus{"0.5 1 2 4 8"};
    bool changesHysteresis = false;  // otherwise as the engine told it
    double hysteresis = 0.1;         // [0, 0.9]
    planet::TraceMetric metric = planet::TraceMetric::Bounds;
    bool hasBudget = false;
    double budgetMb = 64;  // > 0, 10^6 bytes
    planet::TraceResidency residency = planet::TraceResidency::AllThere;
    double latencyMs = 10;  // >= 0
    double mbPerS = 100;    // > 0
    int loaders = 1;        // [1, 16]
    bool limitsBytes = true;
    double goalMb = 16;  // > 0
    bool limitsError = true;
    double goalPx = 1.5;  // > 0
    WhatIfPicture picture = WhatIfPicture::ErrorPx;
    planet::TraceCost cost = planet::TraceCost::Bytes;  // of the chart beside the picture, in a wide dock
    bool showsFades = false;
    std::optional<std::size_t> selected{};  // index of a selection in the table
};

void whatIfPanel(const EditorView& view, WhatIfPanelState& state, Commands& commands);

}  // namespace worldy::ui
