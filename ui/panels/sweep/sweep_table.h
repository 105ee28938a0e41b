// A sweep as a table: a row a setting, sorted by what column one clicks.
#pragma once

#include <optional>
#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Fills what room there is. A click on a row selects its point.
void sweepTable(std::span<const SweepPoint> points, std::optional<std::size_t>& selected);

}  // namespace worldy::ui
