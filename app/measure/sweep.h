// The tables of a sweep, and the search for a suggested tau.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/flight/measure_flight.h"
#include "app/measure/sweep_points.h"
#include "app/measure/sweep_table.h"

namespace worldy {

// A column of the tables of points. Counts are integers and on_front is a boolean.
struct SweepFigure {
    const char* name;  // "tau_px"
    std::variant<double, std::uint64_t, bool, std::string_view> (*of)(const SweepPoint&);
};
std::span<const SweepFigure> sweepFigures();

// Return the table of points; the CSV has a header line and one line per point.
std::string sweepCsv(std::span<const SweepPoint> points);
std::string sweepJson(std::span<const SweepPoint> points, const std::string& file, const std::string& flight,
                      SweepCost cost);

// Returns the report of the suggested tau of each metric.
std::string suggestionsJson(std::span<const SweepSuggestion> suggestions, const std::string& file,
                            const std::string& flight);

// Reads "triangles=200000", "frame_ms=20", "memory_mib=64" or "error_px=1".
planet::Result<TauGoal> tauGoalFromText(const std::string& text);

// Returns the limited figure at a tau.
using MeasureTau = std::function<planet::Result<double>(double tauPx)>;
// Bisects the logarithm of tau, [0.1, 64], to an accuracy of 2 %. Costs fall with tau, errors rise.
planet::Result<TauSuggestion> suggestTau(const TauGoal& goal, const MeasureTau& measure);
int mostSuggestFlights();  // the most flights that suggestTau takes

}  // namespace worldy
