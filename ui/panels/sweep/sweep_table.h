// The table of a sweep: one row per setting, sorted by the clicked column.
#pragma once

#include <optional>
#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Returns the width at which the table needs no horizontal scrolling, pixels.
float sweepTableWidth();

// Fills the remaining room. A click on a row selects its point.
void sweepTable(std::span<const SweepPoint> points, std::optional<std::size_t>& selected);

}  // namespace worldy::ui
