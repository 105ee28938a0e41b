// The plot of a sweep: cost against max measured error.
#pragma once

#include <optional>
#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Draws the plot in the remaining room, with a minimum height. It has one line per chunk size and metric, in the colours
// seriesColour() of seriesOf(points), and points labelled with tau. Hovering a point shows its figures. Returns the point
// that is clicked.
std::optional<std::size_t> sweepChart(std::span<const SweepPoint> points, SweepCost cost,
                                      std::optional<std::size_t> selected);

}  // namespace worldy::ui
