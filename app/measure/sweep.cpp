#include "app/measure/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "app/base/report.h"
#include "app/base/text.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;

constexpr double knownTo = 1.02;  // relative accuracy of a suggested tau

using Cell = std::variant<double, std::uint64_t, bool, std::string_view>;

constexpr std::array<SweepFigure, 17> columns = {{
    {"metric", [](const SweepPoint& p) -> Cell { return std::string_view(metricName(p.metric)); }},
    {"chunk_size", [](const SweepPoint& p) -> Cell { return static_cast<std::uint64_t>(p.chunkSize); }},
    {"tau_px", [](const SweepPoint& p) -> Cell { return p.tauPx; }},
    {"mean_ground_triangles", [](const SweepPoint& p) -> Cell { return p.figures.meanGroundTriangles; }},
    {"mean_skirt_triangles", [](const SweepPoint& p) -> Cell { return p.figures.meanSkirtTriangles; }},
    {"mean_triangles", [](const SweepPoint& p) -> Cell { return p.figures.meanTriangles; }},
    {"most_triangles",
     [](const SweepPoint& p) -> Cell { return static_cast<std::uint64_t>(p.figures.mostTriangles); }},
    {"mean_drawn_chunks", [](const SweepPoint& p) -> Cell { return p.figures.meanChunks; }},
    {"most_resident_bytes",
     [](const SweepPoint& p) -> Cell {
         return static_cast<std::uint64_t>(std::llround(p.figures.mostResidentMiB * (1 << 20)));
     }},
    {"median_frame_ms", [](const SweepPoint& p) -> Cell { return p.figures.medianFrameMs; }},
    {"worst_eps_px", [](const SweepPoint& p) -> Cell { return p.figures.worstEpsPx; }},
    {"worst_drawn_bound_px", [](const SweepPoint& p) -> Cell { return p.figures.worstDrawnBoundPx; }},
    {"worst_measured_px", [](const SweepPoint& p) -> Cell { return p.figures.worstMeasuredPx; }},
    {"p99_measured_px", [](const SweepPoint& p) -> Cell { return p.figures.p99MeasuredPx; }},
    {"worst_screen_px", [](const SweepPoint& p) -> Cell { return p.figures.worstScreenPx; }},
    {"violations", [](const SweepPoint& p) -> Cell { return p.figures.violations; }},
    {"on_front", [](const SweepPoint& p) -> Cell { return p.onFront; }},
}};

// Returns a limit of triangles as an integer if it is one.
Json limitJson(const TauGoal& goal) {
    const bool whole = !goal.limitsError && goal.cost == SweepCost::Triangles && goal.limit < 1e15 &&
                       goal.limit == std::floor(goal.limit);
    return whole ? Json(static_cast<std::int64_t>(goal.limit)) : Json(goal.limit);
}

}  // namespace

std::span<const SweepFigure> sweepFigures() {
    return columns;
}

std::string sweepCsv(std::span<const SweepPoint> points) {
    std::string text = "schema_version";
    for (const SweepFigure& column : columns) text += fmt::format(",{}", column.name);
    for (const SweepPoint& point : points) {
        text += fmt::format("\n{}", schemaVersion);
        for (const SweepFigure& column : columns)
            text += std::visit([](auto value) { return fmt::format(",{}", value); }, column.of(point));
    }
    return text + "\n";
}

std::string sweepJson(std::span<const SweepPoint> points, const std::string& file, const std::string& flight,
                      SweepCost cost) {
    Json report = {{"file", file}, {"flight", flight}, {"cost", costName(cost)}};
    report["frames"] = points.empty() ? 0 : points.front().figures.frames;
    report["points"] = Json::array();
    for (const SweepPoint& point : points) {
        Json entry = Json::object();
        for (const SweepFigure& column : columns)
            std::visit([&](auto value) { entry[column.name] = value; }, column.of(point));
        report["points"].push_back(std::move(entry));
    }
    return jsonText(report);
}

std::string suggestionsJson(std::span<const SweepSuggestion> suggestions, const std::string& file,
                            const std::string& flight) {
    Json report = {{"file", file}, {"flight", flight}, {"suggestions", Json::array()}};
    for (const SweepSuggestion& one : suggestions) {
        const TauGoal& goal = one.goal;
        report["suggestions"].push_back(
            {{"metric", metricName(one.metric)},
             {"chunk_size", one.chunkSize},
             {"tau_px", one.found.tauPx},
             {"limited", goal.limitsError ? "worst_measured_px" : costName(goal.cost)},
             {"limit", limitJson(goal)},
             {"value", one.found.value},
             {"met", one.found.met},
             {"flights", one.found.flown}});
    }
    return jsonText(report);
}

Result<TauGoal> tauGoalFromText(const std::string& text) {
    const std::string_view name = std::string_view(text).substr(0, text.find('='));
    TauGoal goal;
    constexpr std::array<std::string_view, 4> names = {"triangles", "frame_ms", "memory_mib", "error_px"};
    const auto found = std::find(names.begin(), names.end(), name);
    const std::string_view value = std::string_view(text).substr(std::min(name.size() + 1, text.size()));
    goal.limit = numberFromText(value).value_or(0);
    if (found == names.end() || goal.limit <= 0) {
        return planet::badInput(
            fmt::format("--suggest: {} is unknown; expected triangles=N, frame_ms=N, memory_mib=N or "
                        "error_px=N with N > 0",
                        text));
    }
    goal.limitsError = name == "error_px";
    if (!goal.limitsError) goal.cost = static_cast<SweepCost>(found - names.begin());
    return goal;
}

int mostSuggestFlights() {
    const double range = std::log(largestTauPx / smallestTauPx);
    return 2 + static_cast<int>(std::ceil(std::log2(range / std::log(knownTo))));
}

Result<TauSuggestion> suggestTau(const TauGoal& goal, const MeasureTau& measure) {
    TauSuggestion best;
    // A small tau keeps an error, a large tau keeps a cost.
    double keeps = goal.limitsError ? smallestTauPx : largestTauPx;
    double breaks = goal.limitsError ? largestTauPx : smallestTauPx;
    const auto tryTau = [&](double tauPx) -> Result<bool> {
        const Result<double> value = measure(tauPx);
        if (!value) return tl::unexpected(value.error());
        ++best.flown;
        const bool met = *value <= goal.limit;
        if (met || best.flown == 1) best = {tauPx, *value, met, best.flown};
        return met;
    };
    const Result<bool> possible = tryTau(keeps);
    if (!possible) return tl::unexpected(possible.error());
    if (!*possible) return best;
    const Result<bool> easy = tryTau(breaks);
    if (!easy) return tl::unexpected(easy.error());
    if (*easy) return best;
    while (std::max(keeps / breaks, breaks / keeps) > knownTo) {
        const double middle = std::sqrt(keeps * breaks);
        const Result<bool> met = tryTau(middle);
        if (!met) return tl::unexpected(met.error());
        (*met ? keeps : breaks) = middle;
    }
    return best;
}

}  // namespace worldy
