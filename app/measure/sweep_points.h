// A sweep: the same flight with many settings. Plain data and pure functions, any thread.
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

std::string_view metricName(planet::ErrorMetric metric);  // "additive"

struct SweepPoint {
    int chunkSize = 33;  // vertices per side
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 2;
    FlightFigures figures{};
    bool onFront = false;

    bool operator==(const SweepPoint&) const = default;
};

enum class SweepCost : std::uint8_t { Triangles, FrameMs, MemoryMiB };
double costOf(const FlightFigures& figures, SweepCost cost);
const char* costName(SweepCost cost);  // "mean triangles"

// Return values for logarithmic axes, which have no 0. An error of 0, as when all leaves are drawn, becomes
// 0.01 px.
double plottedErrorPx(const FlightFigures& figures);
double plottedCost(const FlightFigures& figures, SweepCost cost);

// Marks the Pareto front: the points for which no other point has a smaller error at no larger cost, or a
// smaller cost at no larger error. Equal points are all on it.
void markFront(std::vector<SweepPoint>& points, SweepCost cost);

// The goal of a search: the smallest tau that keeps a cost within a limit, or the largest tau that keeps the
// measured error within a limit.
struct TauGoal {
    bool limitsError = false;
    SweepCost cost = SweepCost::Triangles;  // the limited cost if limitsError is false
    double limit = 0;                       // triangles, ms, MiB or pixels; > 0
};

struct TauSuggestion {
    double tauPx = 0;
    double value = 0;  // the limited figure at tauPx
    bool met = false;  // false: no tau in the range meets the limit
    int flown = 0;     // number of measured flights
};

// Returns "τ = 1.83 px: max measured error 0.98 px, within the limit (7 flights flown)." tau is the text for
// τ.
std::string suggestionText(const TauGoal& goal, const TauSuggestion& found, std::string_view tau);

// The points of one chunk size and metric, which a line joins.
struct SweepSeries {
    int chunkSize = 33;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    std::vector<std::size_t> points;  // indices, by ascending tau

    std::string name() const;  // "33 additive"
};
// Returns the series, ordered by chunk size, then metric.
std::vector<SweepSeries> seriesOf(std::span<const SweepPoint> points);
// Returns "chunk size 33, tight, τ 2 px".
std::string settingText(int chunkSize, planet::ErrorMetric metric, double tauPx, std::string_view tau);

inline constexpr std::size_t mostTaus = 32;
struct TauList {
    std::vector<double> tausPx;  // ascending; empty if there is a problem
    std::string problem;         // an error message, or empty
};
// Reads numbers separated by spaces, commas or semicolons.
TauList tausFromText(std::string_view text);

// A sweep over the open planet.
struct SweepRequest {
    std::filesystem::path flight;  // .toml or .flight
    std::vector<double> tausPx;
    std::vector<int> chunkSizes;               // empty for a goal: the planet is swept as it is
    std::vector<planet::ErrorMetric> metrics;  // at least one
    int frames = 12;                           // sample frames of the flight, >= 1
    int widthPx = 640;                         // size of the picture
    int heightPx = 400;
    std::optional<TauGoal> goal;  // if set, a tau is searched instead
};

}  // namespace worldy
