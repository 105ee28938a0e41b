// The plot of a sweep: cost on the vertical axis, max measured error on the horizontal, both logarithmic.
#pragma once

#include <imgui.h>

#include <optional>
#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Returns the colour of a series of seriesOf(points).
ImVec4 sweepColour(std::size_t series);
// Draws a point's mark: a dot, ringed if it is on the Pareto front.
void sweepMark(ImVec2 middle, const ImVec4& colour, bool onFront);

// Draws the plot in the remaining room, with a minimum height. It has one line per chunk size and metric, and
// points labelled with tau. Hovering a point shows its figures. Returns the point that is clicked.
std::optional<std::size_t> sweepChart(std::span<const SweepPoint> points, SweepCost cost,
                                      std::optional<std::size_t> selected);

}  // namespace worldy::ui
