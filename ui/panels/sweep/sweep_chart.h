// A sweep as a plot: cost upwards, the worst measured error to the right, both logarithmic.
#pragma once

#include <imgui.h>

#include <optional>
#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Of a series of seriesOf(points).
ImVec4 sweepColour(std::size_t series);
// A point's mark with its middle there: a dot, ringed on the Pareto front.
void sweepMark(ImVec2 middle, const ImVec4& colour, bool onFront);

// Fills what room there is, but at least some lines. A line a chunk size and metric, points with their taus;
// the pointer tells a point. Returns the point that is clicked.
std::optional<std::size_t> sweepChart(std::span<const SweepPoint> points, SweepCost cost,
                                      std::optional<std::size_t> selected);

}  // namespace worldy::ui
