#include "app/cli/trace_what_if_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/cli/trace_text.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::TraceSelectionTotals;
using planet::TraceWhatIfReport;
using planet::TraceWhatIfRow;

constexpr double bytesOfMb = 1e6;
constexpr std::array residencyNames = {"all", "traced", "disk"};
constexpr std::array metricNames = {"bounds", "sphere", "centre"};

void printTotals(const std::string& name, const char* mark, const TraceSelectionTotals& totals,
                 const TraceWhatIfRow* row) {
    const auto count = [](double value) { return value == 0 ? std::string("-") : countText(value); };
    const auto bytes = [](double value) { return value == 0 ? std::string("-") : bytesText(value); };
    fmt::print("{:<14}{:<2}{:>9.1f}{:>9}{:>11}{:>11}{:>11}{:>11}{:>8}{:>8}{:>10}{:>10}{:>9}{:>9}{:>9}{:>9}\n",
               name, mark, totals.meanDrawn, totals.mostDrawn, count(totals.meanTriangles),
               count(static_cast<double>(totals.mostTriangles)), bytes(totals.meanBytes),
               bytes(static_cast<double>(totals.mostBytes)), totals.splits, totals.merges,
               tracedPxText(totals.meanErrorPx), tracedPxText(totals.worstErrorPx), totals.unknown,
               totals.waiting, row ? fmt::format("{}", row->framesThatDiffer) : "-",
               row ? fmt::format("{}", row->nodesThatDiffer) : "-");
}

void printView(const planet::TraceWhatIfView& view) {
    fmt::print("\nview {}: what if; * is on the Pareto front of the largest error and the most bytes\n",
               view.view);
    fmt::print("{:<16}{:>9}{:>9}{:>11}{:>11}{:>11}{:>11}{:>8}{:>8}{:>10}{:>10}{:>9}{:>9}{:>9}{:>9}\n",
               "selection", "drawn", "most", "triangles", "most", "bytes", "most", "splits", "merges",
               "error px", "most", "unknown", "waiting", "frames", "nodes");
    printTotals("the engine", "", view.engine, nullptr);
    if (view.own.totals.frames > 0) printTotals("its settings", "", view.own.totals, &view.own);
    const std::vector<bool> front = planet::traceFront(view.rows, planet::TraceCost::Bytes);
    for (std::size_t i = 0; i < view.rows.size(); ++i)
        printTotals(fmt::format("tau {:g} px", *view.rows[i].settings.tauPx), front[i] ? "*" : "",
                    view.rows[i].totals, &view.rows[i]);
    const bool isBound = std::ranges::any_of(
        view.rows, [](const TraceWhatIfRow& row) { return row.totals.unknownFrames > 0; });
    if (isBound)
        fmt::print(
            "Where nodes are unknown, the engine never described their children or errors: triangles and "
            "bytes can be larger.\n");
    fmt::print("frames, nodes: where other nodes are drawn than the engine drew.\n");
}

// The one that was seen in the most frames first, and fades apart.
std::vector<const planet::TraceDisagreement*> realDisagreements(const TraceWhatIfReport& report) {
    std::vector<const planet::TraceDisagreement*> real;
    for (const planet::TraceDisagreement& each : report.disagreements)
        if (!each.isFade) real.push_back(&each);
    std::ranges::stable_sort(real, std::greater(), &planet::TraceDisagreement::frames);
    return real;
}

void printDisagreements(const TraceWhatIfReport& report, int worst) {
    const auto real = realDisagreements(report);
    const std::size_t fades = report.disagreements.size() - real.size();
    if (const char* const why = planet::whyTraceIsNotJudged(report)) {
        fmt::print("\nThe engine's choice is not judged: {}.\n", why);
        return;
    }
    if (real.empty())
        fmt::print("\nThe engine's choice is what its own numbers say.\n");
    else
        fmt::print("\nThe engine's choice is not what its own numbers say, in {} frames:\n",
                   report.framesThatDisagree);
    const std::size_t listed = std::min(real.size(), static_cast<std::size_t>(worst));
    for (std::size_t i = 0; i < listed; ++i) fmt::print("  view {}: {}\n", real[i]->view, real[i]->sentence);
    if (listed < real.size()) fmt::print("  and {} more\n", real.size() - listed);
    if (fades > 0) fmt::print("{} switches may have waited for a fade, and are not judged.\n", fades);
    if (report.unlistedDisagreements > 0)
        fmt::print("  {} more sightings are beyond the limit of the list\n", report.unlistedDisagreements);
}

void printSuggestion(const planet::TraceTauGoal& goal, const planet::TraceTauSuggestion& found) {
    std::string limits;
    const auto add = [&](const std::string& text) { limits += (limits.empty() ? "" : ", ") + text; };
    if (goal.bytes) add(fmt::format("{:g} MB", *goal.bytes / bytesOfMb));
    if (goal.triangles) add(fmt::format("{:g} triangles", *goal.triangles));
    if (goal.errorPx) add(fmt::format("{:g} px", *goal.errorPx));
    fmt::print("\nsuggested tau for {}: {:.3g} px, with at most {:.2f} px, {:.2f} MB and {} triangles{}{}\n",
               limits, found.tauPx, found.errorPx, static_cast<double>(found.bytes) / bytesOfMb,
               found.triangles, found.isMet ? "" : "; no tau meets all limits",
               found.isBound ? "; a bound, because some nodes are unknown" : "");
}

Json jsonOf(const TraceWhatIfReport& report, const TraceWhatIfRow& row) {
    const planet::TraceSelectorSettings& settings = row.settings;
    Json json = {{"tau_px", settings.tauPx ? Json(*settings.tauPx) : Json(nullptr)},
                 {"hysteresis", settings.hysteresis ? Json(*settings.hysteresis) : Json(nullptr)},
                 {"budget_bytes", settings.budgetBytes ? Json(*settings.budgetBytes) : Json(nullptr)},
                 {"metric", metricNames[static_cast<std::size_t>(settings.metric)]},
                 {"data", residencyNames[static_cast<std::size_t>(settings.residency)]}};
    if (settings.residency == planet::TraceResidency::Disk)
        json["disk"] = {{"latency_ms", 1000 * settings.disk.latencyS},
                        {"mb_per_s", tracedNumberJson(settings.disk.bytesPerS / bytesOfMb)},
                        {"loaders", settings.disk.loaders}};
    json["totals"] = traceTotalsJson(row.totals, report.description);
    json["frames_that_differ"] = row.framesThatDiffer;
    json["nodes_that_differ"] = row.nodesThatDiffer;
    return json;
}

Json jsonOf(const TraceWhatIfReport& report, const planet::TraceDisagreement& each) {
    return {{"kind", each.kind == planet::TraceDisagreementKind::TooCoarse ? "too coarse" : "too fine"},
            {"view", each.view},
            {"node", tracedNodeText(report.description, each.node)},
            {"first_frame", each.firstFrame},
            {"last_frame", each.lastFrame},
            {"frames", each.frames},
            {"error_px", tracedNumberJson(each.errorPx)},
            {"limit_px", each.limitPx},
            {"fade", each.isFade},
            {"sentence", each.sentence}};
}

}  // namespace

planet::Result<planet::TraceTauGoal> traceTauGoalFromText(const std::string& text) {
    planet::TraceTauGoal goal;
    std::string_view left = text;
    while (!left.empty()) {
        const std::string_view part = left.substr(0, left.find(','));
        left.remove_prefix(std::min(part.size() + 1, left.size()));
        const std::string_view name = part.substr(0, part.find('='));
        const double value = numberFromText(part.substr(std::min(name.size() + 1, part.size()))).value_or(0);
        std::optional<double>* limit = nullptr;
        if (name == "error_px") limit = &goal.errorPx;
        if (name == "bytes_mb") limit = &goal.bytes;
        if (name == "triangles") limit = &goal.triangles;
        if (!limit || value <= 0)
            return planet::badInput(
                fmt::format("--suggest: {} is unknown; expected error_px=N, bytes_mb=N or "
                            "triangles=N with N > 0, or several with commas",
                            part));
        *limit = name == "bytes_mb" ? value * bytesOfMb : value;
    }
    if (text.empty())
        return planet::badInput("--suggest is empty; expected such as error_px=1.5,bytes_mb=16");
    return goal;
}

void printWhatIf(const TraceWhatIfFound& found, int worst) {
    for (const planet::TraceWhatIfView& view : found.report.views) printView(view);
    if (found.report.skippedFrames > 0)
        fmt::print("{} frames that lack events were left out.\n", found.report.skippedFrames);
    printDisagreements(found.report, worst);
    if (found.suggestion) printSuggestion(found.goal, *found.suggestion);
}

Json whatIfJson(const TraceWhatIfFound& found) {
    const TraceWhatIfReport& report = found.report;
    Json json = {{"skipped_frames", report.skippedFrames}};
    json["view"] = Json::array();
    for (const planet::TraceWhatIfView& view : report.views) {
        Json& one = json["view"].emplace_back(Json::object());
        one["view"] = view.view;
        one["engine"] = traceTotalsJson(view.engine, report.description);
        one["own_settings"] = view.own.totals.frames > 0 ? jsonOf(report, view.own) : Json(nullptr);
        const std::vector<bool> byBytes = planet::traceFront(view.rows, planet::TraceCost::Bytes);
        const std::vector<bool> byTriangles = planet::traceFront(view.rows, planet::TraceCost::Triangles);
        one["selection"] = Json::array();
        for (std::size_t i = 0; i < view.rows.size(); ++i) {
            Json row = jsonOf(report, view.rows[i]);
            row["on_front_of_bytes"] = static_cast<bool>(byBytes[i]);
            row["on_front_of_triangles"] = static_cast<bool>(byTriangles[i]);
            one["selection"].push_back(std::move(row));
        }
    }
    json["frames_that_disagree"] = report.framesThatDisagree;
    json["disagreement"] = Json::array();
    for (const planet::TraceDisagreement& each : report.disagreements)
        json["disagreement"].push_back(jsonOf(report, each));
    json["unlisted_disagreements"] = report.unlistedDisagreements;
    if (found.suggestion) {
        const planet::TraceTauSuggestion& tau = *found.suggestion;
        json["suggestion"] = {{"tau_px", tau.tauPx},    {"met", tau.isMet},
                              {"bound", tau.isBound},   {"max_error_px", tracedNumberJson(tau.errorPx)},
                              {"max_bytes", tau.bytes}, {"max_triangles", tau.triangles}};
    }
    return json;
}

}  // namespace worldy
