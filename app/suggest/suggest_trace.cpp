#include "app/suggest/suggest_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/suggest/suggest_budget.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/trace/trace_what_if.h"

namespace worldy {

namespace {

using planet::Result;

struct TraceRow {
    SuggestLimit limit;
    double engine = 0;
    double suggested = 0;
};
std::vector<TraceRow> traceRows(const SuggestedForTrace& suggested) {
    return {{SuggestLimit::Triangles, static_cast<double>(suggested.engineTriangles),
             static_cast<double>(suggested.found.triangles)},
            {SuggestLimit::ResidentBytes, static_cast<double>(suggested.engineBytes),
             static_cast<double>(suggested.found.bytes)},
            {SuggestLimit::ErrorPx, suggested.engineErrorPx, suggested.found.errorPx}};
}

// Returns nothing for a value that the trace does not tell: a cost of 0, or an error that is NaN.
std::optional<double> toldValue(const TraceRow& row, double value) {
    const bool isUnknown = row.limit == SuggestLimit::ErrorPx ? std::isnan(value) : value == 0;
    return isUnknown ? std::nullopt : std::optional(value);
}

std::string traceValueText(const TraceRow& row, double value) {
    const auto told = toldValue(row, value);
    return told ? limitText(row.limit, *told) : "not told";
}

nlohmann::ordered_json traceValueJson(const TraceRow& row, double value) {
    const auto told = toldValue(row, value);
    return told ? nlohmann::ordered_json(*told) : nlohmann::ordered_json(nullptr);
}

Result<void> checkTold(const std::filesystem::path& file, const SuggestedForTrace& suggested) {
    const SuggestBudget& budget = suggested.budget;
    std::vector<std::string> missing;
    if (budget[SuggestLimit::FrameMs])
        missing.push_back(
            "a budget in ms needs the time of frames with another τ, and a trace has only those of the "
            "engine's own");
    if (budget[SuggestLimit::Triangles] && suggested.engineTriangles == 0)
        missing.push_back(
            "a budget of triangles needs the triangles of nodes, which the trace does not tell");
    if (budget[SuggestLimit::ResidentBytes] && suggested.engineBytes == 0)
        missing.push_back("a budget of memory needs the bytes of nodes, which the trace does not tell");
    if (std::isnan(suggested.engineErrorPx))
        missing.push_back(
            "another τ needs the errors and bounds of nodes and the views, which the trace does not tell");
    if (missing.empty()) return {};
    return planet::badInput(fmt::format("{}: {}; expected a trace that tells them, or no such budget",
                                        file.string(), fmt::join(missing, "; ")));
}

}  // namespace

Result<SuggestedForTrace> suggestForTrace(const std::filesystem::path& file, const SuggestBudget& budget,
                                          const std::function<bool()>& goOn) {
    TRY_ASSIGN(planet::TraceFile trace, planet::TraceFile::open(file));
    TRY_ASSIGN(const planet::TraceWhatIfReport report, planet::whatIfOfTrace(trace, {}, goOn));
    if (report.isDamaged) return planet::badInput(fmt::format("{}: {}", file.string(), *report.problem));
    SuggestedForTrace suggested;
    suggested.budget = budget;
    suggested.frames = report.frames;
    suggested.engineErrorPx = std::numeric_limits<double>::quiet_NaN();
    for (const planet::TraceWhatIfView& view : report.views) {
        suggested.engineTriangles = std::max(suggested.engineTriangles, view.engine.mostTriangles);
        suggested.engineBytes = std::max(suggested.engineBytes, view.engine.mostBytes);
        suggested.engineErrorPx = std::fmax(suggested.engineErrorPx, view.engine.worstErrorPx);
    }
    TRY(checkTold(file, suggested));
    const planet::TraceTauGoal goal{.errorPx = budget[SuggestLimit::ErrorPx],
                                    .bytes = budget[SuggestLimit::ResidentBytes],
                                    .triangles = budget[SuggestLimit::Triangles]};
    TRY_ASSIGN(suggested.found, planet::suggestTraceTau(trace, {}, goal, goOn));
    return suggested;
}

std::string traceVerdictText(const SuggestedForTrace& suggested) {
    std::string text = fmt::format(
        "τ = {:.3g} px {} the budget of {} in every frame, if the engine selects by its own errors.",
        suggested.found.tauPx, suggested.found.isMet ? "meets" : "comes closest to, but does not meet,",
        budgetText(suggested.budget));
    for (const TraceRow& row : traceRows(suggested)) {
        if (useOf(suggested.budget, row.limit, row.suggested) > 1)
            text += fmt::format(" {} would be {} of {}.", textOf(row.limit).name,
                                limitText(row.limit, row.suggested),
                                limitText(row.limit, *suggested.budget[row.limit]));
    }
    if (suggested.found.isBound)
        text += " The engine never described some nodes, so the costs may be larger.";
    return text;
}

std::string traceMarkdown(const SuggestedForTrace& suggested, const std::filesystem::path& file) {
    std::string text = fmt::format("# Suggested settings for {}\n\n{}\n\n", file.filename().string(),
                                   traceVerdictText(suggested));
    text += "| budget | limit | the engine | suggested |\n|---|---|---|---|\n";
    for (const TraceRow& row : traceRows(suggested)) {
        const auto& limit = suggested.budget[row.limit];
        text += fmt::format("| {} | {} | {} | {} |\n", textOf(row.limit).name,
                            limit ? limitText(row.limit, *limit) : "none", traceValueText(row, row.engine),
                            traceValueText(row, row.suggested));
    }
    return text +
           fmt::format(
               "\nThe values are the largest of all {} frames and all views. Nothing was drawn: the trace "
               "was "
               "selected over again with another τ. Only τ was varied, because a trace has the data of no "
               "other setting.\n",
               suggested.frames);
}

nlohmann::ordered_json traceSuggestJson(const SuggestedForTrace& suggested,
                                        const std::filesystem::path& file) {
    nlohmann::ordered_json json = {
        {"file", file.string()},           {"budget", budgetText(suggested.budget)},
        {"met", suggested.found.isMet},    {"verdict", traceVerdictText(suggested)},
        {"tau_px", suggested.found.tauPx}, {"frames", suggested.frames}};
    for (const TraceRow& row : traceRows(suggested)) {
        json["engine"][std::string(textOf(row.limit).key)] = traceValueJson(row, row.engine);
        json["suggested"][std::string(textOf(row.limit).key)] = traceValueJson(row, row.suggested);
    }
    return json;
}

}  // namespace worldy
