// A sweep: the same flight at many settings, and which of them are worth choosing. Plain data.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/flight_figures.h"

namespace worldy {

struct SweepPoint {
    int chunkSize = 33;  // vertices a side
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 2;
    FlightFigures figures;
    bool onFront = false;
};

// What is paid.
enum class SweepCost : std::uint8_t { Triangles, FrameMs, MemoryMiB };
double costOf(const FlightFigures& figures, SweepCost cost);
const char* costName(SweepCost cost);  // "mean triangles"

// Marks the Pareto front: points that no other beats in the worst measured error without costing more, nor
// in cost without a larger error. Of equal points all are on it.
void markFront(std::vector<SweepPoint>& points, SweepCost cost);

// The table, a line a point, the names of its columns first.
std::string sweepCsv(std::span<const SweepPoint> points);
std::string sweepJson(std::span<const SweepPoint> points, const std::string& file, const std::string& flight,
                      SweepCost cost);

// What tau is wanted for: the smallest that keeps a cost under a limit, or the largest that keeps the worst
// measured error under one.
struct TauGoal {
    bool limitsError = false;
    SweepCost cost = SweepCost::Triangles;  // else
    double limit = 0;                       // triangles, ms, MiB or pixels; > 0
};
// "triangles=200000", "frame_ms=20", "memory_mib=64" or "error_px=1".
planet::Result<TauGoal> tauGoalFromText(const std::string& text);

struct TauSuggestion {
    double tauPx = 0;
    double value = 0;  // of what was limited, there
    bool met = false;  // false: not even the end of the range does it
    int flown = 0;     // flights that were measured
};
// What the goal's figure is at a tau.
using MeasureTau = std::function<planet::Result<double>(double tauPx)>;
// Halves the range of tau, [0.1, 64], by its logarithm until it is known to 2%: costs fall with tau, errors
// rise.
planet::Result<TauSuggestion> suggestTau(const TauGoal& goal, const MeasureTau& measure);

}  // namespace worldy
