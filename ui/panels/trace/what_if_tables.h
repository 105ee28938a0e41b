// The tables of the What if panel: the selections beside what the engine did, and where the engine's choice is not what its
// own numbers say.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/trace/trace_what_if_job.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// A selection of a view of the result.
struct WhatIfEntry {
    std::string name{};
    ImVec4 colour{1, 1, 1, 1};
    const planet::TraceSelectionTotals* totals = nullptr;
    const planet::TraceWhatIfRow* row = nullptr;  // null: what the engine drew
    const TracedValues* values = nullptr;         // over the flight
    bool onFront = false;
};

// Returns what the engine drew, the engine's own settings if it told a τ, and the rows; they refer to the result.
// view: index into result.report.views.
std::vector<WhatIfEntry> whatIfEntries(const TraceWhatIfResult& result, std::size_t view,
                                       planet::TraceCost cost);

// Return texts of a selection's values; bounds begin with "≥" or "≤".
std::string whatIfDrawnText(const WhatIfEntry& entry);      // "≥ 17.5", the mean
std::string whatIfTrianglesText(const WhatIfEntry& entry);  // the most
std::string whatIfBytesText(const WhatIfEntry& entry);      // the most
std::string whatIfErrorText(const WhatIfEntry& entry);      // "1.49 px"
// Returns why values are bounds, a sentence; empty: they are none.
std::string whatIfBoundReason(const WhatIfEntry& entry);
// Returns "1.49 px", "-" for an unknown error, "> 10000 px" where the eye is inside a node's bounds or close to it.
std::string whatIfPxText(double px);
// Returns "15.9 MB"; a MB is 10^6 bytes.
std::string megabytesText(double bytes);

// Fills the remaining room. A click on a row selects it, on a frame shows the frame, on a node selects the node.
void whatIfTable(std::span<const WhatIfEntry> entries, const EditorView& view,
                 std::optional<std::size_t>& selected, Commands& commands);

// Draws a sentence that sums the disagreements of a view up, and their table in the remaining room.
// view: index into report.views. showsFades: also those that may be fades.
void disagreementTable(const planet::TraceWhatIfReport& report, std::size_t view, const EditorView& editor,
                       bool& showsFades, Commands& commands);

}  // namespace worldy::ui
