#include "app/measure/sweep_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "app/settings/settings.h"

namespace worldy {

namespace {

bool isBeaten(const SweepPoint& point, const SweepPoint& by, SweepCost cost) {
    const double costs = costOf(point.figures, cost);
    const double otherCosts = costOf(by.figures, cost);
    const double error = point.figures.worstMeasuredPx;
    const double otherError = by.figures.worstMeasuredPx;
    return otherCosts <= costs && otherError <= error && (otherCosts < costs || otherError < error);
}

const char* limitedName(const TauGoal& goal) {
    if (goal.limitsError) return "max measured error";
    switch (goal.cost) {
        case SweepCost::Triangles:
            return "mean triangles";
        case SweepCost::FrameMs:
            return "median frame time";
        case SweepCost::MemoryMiB:
            return "memory of resident chunks";
    }
    return "";
}

std::string limitedText(const TauGoal& goal, double value) {
    if (goal.limitsError) return fmt::format("{:.3g} px", value);
    switch (goal.cost) {
        case SweepCost::Triangles:
            return axisText(value);
        case SweepCost::FrameMs:
            return millisecondsText(value);
        case SweepCost::MemoryMiB:
            return fmt::format("{:.4g} MiB", value);
    }
    return {};
}

TauList wrongTaus(const std::string& what) {
    return {{},
            fmt::format("{}; expected numbers in [{}, {}], for example \"0.5 1 2 4 8\"", what, smallestTauPx,
                        largestTauPx)};
}

}  // namespace

std::string_view metricName(planet::ErrorMetric metric) {
    return errorMetricNames[static_cast<std::size_t>(metric)];
}

double costOf(const FlightFigures& figures, SweepCost cost) {
    switch (cost) {
        case SweepCost::Triangles:
            return figures.meanTriangles;
        case SweepCost::FrameMs:
            return figures.medianFrameMs;
        case SweepCost::MemoryMiB:
            return figures.mostResidentMiB;
    }
    return 0;
}

const char* costName(SweepCost cost) {
    switch (cost) {
        case SweepCost::Triangles:
            return "mean triangles";
        case SweepCost::FrameMs:
            return "median frame, ms";
        case SweepCost::MemoryMiB:
            return "max resident, MiB";
    }
    return "";
}

double plottedErrorPx(const FlightFigures& figures) {
    return std::max(figures.worstMeasuredPx, 0.01);
}

double plottedCost(const FlightFigures& figures, SweepCost cost) {
    return std::max(costOf(figures, cost), 1e-3);
}

void markFront(std::vector<SweepPoint>& points, SweepCost cost) {
    for (SweepPoint& point : points) {
        point.onFront = std::none_of(points.begin(), points.end(),
                                     [&](const SweepPoint& other) { return isBeaten(point, other, cost); });
    }
}

std::string SweepSeries::name() const {
    return fmt::format("{} {}", chunkSize, metricName(metric));
}

std::vector<SweepSeries> seriesOf(std::span<const SweepPoint> points) {
    std::map<std::pair<int, planet::ErrorMetric>, SweepSeries> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        SweepSeries& series = found[{points[i].chunkSize, points[i].metric}];
        series.chunkSize = points[i].chunkSize;
        series.metric = points[i].metric;
        series.points.push_back(i);
    }
    std::vector<SweepSeries> all;
    for (auto& [key, series] : found) {
        std::sort(series.points.begin(), series.points.end(),
                  [&](std::size_t a, std::size_t b) { return points[a].tauPx < points[b].tauPx; });
        all.push_back(std::move(series));
    }
    return all;
}

std::string settingText(int chunkSize, planet::ErrorMetric metric, double tauPx, std::string_view tau) {
    return fmt::format("chunk size {}, {}, {} {:.3g} px", chunkSize, metricName(metric), tau, tauPx);
}

std::string suggestionText(const TauGoal& goal, const TauSuggestion& found, std::string_view tau) {
    const std::string flown =
        fmt::format("({} {} flown)", found.flown, found.flown == 1 ? "flight" : "flights");
    const std::string value = limitedText(goal, found.value);
    if (found.met)
        return fmt::format("{} = {:.3g} px: {} {}, within the limit {}.", tau, found.tauPx, limitedName(goal),
                           value, flown);
    return fmt::format("No {} in [{}, {}] px meets the limit of {}; at {:.3g} px: {} {} {}.", tau,
                       smallestTauPx, largestTauPx, limitedText(goal, goal.limit), found.tauPx,
                       limitedName(goal), value, flown);
}

TauList tausFromText(std::string_view text) {
    constexpr std::string_view between = " \t,;";
    TauList list;
    std::size_t from = text.find_first_not_of(between);
    while (from != std::string_view::npos) {
        const std::size_t to = std::min(text.find_first_of(between, from), text.size());
        const std::string_view word = text.substr(from, to - from);
        const std::optional<double> tauPx = numberFromText(word);
        if (!tauPx) return wrongTaus(fmt::format("\"{}\" is not a number", word));
        if (*tauPx < smallestTauPx || *tauPx > largestTauPx)
            return wrongTaus(fmt::format("{} is out of range", word));
        if (std::find(list.tausPx.begin(), list.tausPx.end(), *tauPx) != list.tausPx.end())
            return wrongTaus(fmt::format("{} is given twice", word));
        list.tausPx.push_back(*tauPx);
        from = text.find_first_not_of(between, to);
    }
    if (list.tausPx.empty()) return wrongTaus("no tolerance is given");
    if (list.tausPx.size() > mostTaus)
        return wrongTaus(fmt::format("more than {} tolerances are given", mostTaus));
    std::sort(list.tausPx.begin(), list.tausPx.end());
    return list;
}

}  // namespace worldy
