// A sweep: the same flight at many settings, and which of them are worth choosing. Plain data.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/flight/measure_flight.h"
#include "app/measure/sweep_points.h"
#include "app/measure/sweep_table.h"

namespace worldy {

// The table, a line a point, the names of its columns first.
std::string sweepCsv(std::span<const SweepPoint> points);
std::string sweepJson(std::span<const SweepPoint> points, const std::string& file, const std::string& flight,
                      SweepCost cost);

// The suggested tau of each metric.
std::string suggestionsJson(std::span<const SweepSuggestion> suggestions, const std::string& file,
                            const std::string& flight);

// "triangles=200000", "frame_ms=20", "memory_mib=64" or "error_px=1".
planet::Result<TauGoal> tauGoalFromText(const std::string& text);

// What the goal's figure is at a tau.
using MeasureTau = std::function<planet::Result<double>(double tauPx)>;
// Halves the range of tau, [0.1, 64], by its logarithm until it is known to 2%: costs fall with tau, errors
// rise.
planet::Result<TauSuggestion> suggestTau(const TauGoal& goal, const MeasureTau& measure);
int mostSuggestFlights();  // that it takes

}  // namespace worldy
