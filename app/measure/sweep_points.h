// What a sweep asks for and measures: the same flight at many settings. Plain data and pure functions, any
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/flight/flight_figures.h"
#include "app/settings/view_settings.h"
#include "planet/select/lod_select.h"

namespace worldy {

struct SweepPoint {
    int chunkSize = 33;  // vertices a side
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 2;
    FlightFigures figures{};
    bool onFront = false;

    bool operator==(const SweepPoint&) const = default;
};

// What is paid.
enum class SweepCost : std::uint8_t { Triangles, FrameMs, MemoryMiB };
double costOf(const FlightFigures& figures, SweepCost cost);
const char* costName(SweepCost cost);  // "mean triangles"

// As drawn on logarithmic axes, which have no 0: without any error, as where all leaves are drawn, a point
// stands at a hundredth of a pixel.
double plottedErrorPx(const FlightFigures& figures);
double plottedCost(const FlightFigures& figures, SweepCost cost);

// Marks the Pareto front: points that no other beats in the worst measured error without costing more, nor
// in cost without a larger error. Of equal points all are on it.
void markFront(std::vector<SweepPoint>& points, SweepCost cost);

// What tau is wanted for: the smallest that keeps a cost under a limit, or the largest that keeps the worst
// measured error under one.
struct TauGoal {
    bool limitsError = false;
    SweepCost cost = SweepCost::Triangles;  // else
    double limit = 0;                       // triangles, ms, MiB or pixels; > 0
};

struct TauSuggestion {
    double tauPx = 0;
    double value = 0;  // of what was limited, there
    bool met = false;  // false: not even the end of the range does it
    int flown = 0;     // flights that were measured
};

// "τ 1.83 px keeps the worst measured error at 0.98 px (7 flights flown)." tau: how it is written here.
std::string suggestionText(const TauGoal& goal, const TauSuggestion& found, std::string_view tau);

// Points that a line joins: of one chunk size and metric, by tau.
struct SweepSeries {
    int chunkSize = 33;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    std::vector<std::size_t> points;  // indices, by ascending tau

    std::string name() const;  // "33 additive"
};
// By chunk size, then metric.
std::vector<SweepSeries> seriesOf(std::span<const SweepPoint> points);
// "33 a side, tight, τ 2 px"
std::string settingText(int chunkSize, planet::ErrorMetric metric, double tauPx, std::string_view tau);

// Tolerances as they are typed: numbers with spaces, commas or semicolons between them.
inline constexpr std::size_t mostTaus = 32;
struct TauList {
    std::vector<double> tausPx;  // ascending; empty where there is a problem
    std::string problem;         // what is wrong, and what would be right
};
TauList tausFromText(std::string_view text);

// What is flown over the planet that is shown.
struct SweepRequest {
    std::filesystem::path flight;  // .toml or .flight
    std::vector<double> tausPx;
    std::vector<int> chunkSizes;               // of a goal: none, the planet is swept as it is
    std::vector<planet::ErrorMetric> metrics;  // at least one
    int frames = 12;                           // moments of the flight, >= 1
    int widthPx = 640;                         // of the picture
    int heightPx = 400;
    std::optional<TauGoal> goal;  // a tau is looked for instead
};

}  // namespace worldy
