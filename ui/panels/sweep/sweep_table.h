// The table of a sweep: one row per setting, sorted by the clicked column.
#pragma once

#include <optional>
#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Fills the remaining room. A click on a row selects its point.
void sweepTable(std::span<const SweepPoint> points, std::optional<std::size_t>& selected);

}  // namespace worldy::ui
