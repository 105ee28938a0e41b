#include "app/cli/trace_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/base/interrupt.h"
#include "app/base/message.h"
#include "app/base/text.h"
#include "app/cli/trace_compare_text.h"
#include "app/cli/trace_text.h"
#include "app/cli/trace_what_if_text.h"
#include "app/trace/trace_compare_job.h"

namespace worldy {

namespace {

using Json = nlohmann::ordered_json;
using planet::Result;
using planet::TraceReport;

constexpr std::array faultKinds = {planet::TraceFaultKind::DrawnTwice, planet::TraceFaultKind::Hole,
                                   planet::TraceFaultKind::Thrash,     planet::TraceFaultKind::LatePage,
                                   planet::TraceFaultKind::Starvation, planet::TraceFaultKind::LevelStep,
                                   planet::TraceFaultKind::TooCoarse,  planet::TraceFaultKind::TooFine};

// Returns the faults of a kind.
std::size_t countOf(const TraceReport& report, planet::TraceFaultKind kind) {
    return static_cast<std::size_t>(std::ranges::count(report.faults, kind, &planet::TraceFault::kind));
}

// The one that was seen in the most frames first.
std::vector<const planet::TraceFault*> worstFirst(const TraceReport& report) {
    std::vector<const planet::TraceFault*> faults;
    for (const planet::TraceFault& fault : report.faults) faults.push_back(&fault);
    std::ranges::stable_sort(faults, std::greater(), &planet::TraceFault::frames);
    return faults;
}

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

// Return NaN if no value is known.
double worstErrorPx(const TraceReport& report) {
    double worst = std::numeric_limits<double>::quiet_NaN();
    for (const planet::TraceViewReport& view : report.views) worst = std::fmax(worst, view.worstErrorPx);
    return worst;
}

double worstLatencyMs(const TraceReport& report) {
    double worst = std::numeric_limits<double>::quiet_NaN();
    for (const planet::TraceKindReport& kind : report.kinds)
        worst = std::fmax(worst, 1000 * kind.latencyS.p99);
    return worst;
}

std::uint64_t thrashesOf(const TraceReport& report) {
    std::uint64_t thrashes = 0;
    for (const planet::TraceViewReport& view : report.views) thrashes += view.thrashes;
    return thrashes;
}

void printSpread(const char* name, const planet::TraceSpread& ms) {
    if (ms.count == 0) return;
    fmt::print("{:<18}median {}, 99 % at most {}, largest {}\n", name, millisecondsText(ms.median),
               millisecondsText(ms.p99), millisecondsText(ms.most));
}

void printViews(const TraceReport& report) {
    if (report.views.empty()) return;
    fmt::print("\n{:>5}{:>9}{:>9}{:>9}{:>12}{:>9}{:>9}{:>9}{:>10}{:>8}{:>10}  {}\n", "view", "frames",
               "drawn", "most", "triangles", "splits", "merges", "thrash", "error px", "tau", "over tau",
               "worst at");
    for (const planet::TraceViewReport& view : report.views) {
        const bool hasError = std::isfinite(view.worstErrorPx);
        fmt::print("{:>5}{:>9}{:>9.1f}{:>9}{:>12}{:>9}{:>9}{:>9}{:>10}{:>8}{:>10}  {}\n", view.view,
                   view.frames, view.meanDrawn, view.mostDrawn,
                   view.mostTriangles == 0 ? "-" : countText(static_cast<double>(view.mostTriangles)),
                   view.splits, view.merges, view.thrashes,
                   hasError ? fmt::format("{:.2f}", view.worstErrorPx) : "-",
                   view.tauPx ? fmt::format("{:g}", *view.tauPx) : "-",
                   view.tauPx ? fmt::format("{}", view.framesOverTau) : "-",
                   hasError ? fmt::format("frame {}, {}", view.worstFrame,
                                          tracedNodeText(report.description, view.worstNode))
                            : "");
    }
}

void printPaging(const TraceReport& report) {
    if (report.kinds.empty()) return;
    fmt::print("\n{:<12}{:>10}{:>10}{:>10}{:>8}{:>9}{:>12}{:>12}{:>12}{:>12}\n", "paged", "requested",
               "arrived", "cancelled", "failed", "evicted", "bytes", "wait", "latency", "99 %");
    for (const planet::TraceKindReport& kind : report.kinds) {
        const auto text = [](double seconds) {
            return std::isnan(seconds) ? std::string("-") : millisecondsText(1000 * seconds);
        };
        fmt::print("{:<12}{:>10}{:>10}{:>10}{:>8}{:>9}{:>12}{:>12}{:>12}{:>12}\n",
                   kind.name.empty() ? fmt::format("kind {}", kind.kind) : kind.name, kind.requested,
                   kind.arrived, kind.cancelled, kind.failed, kind.evicted,
                   kind.arrivedBytes == 0 ? "-" : bytesText(static_cast<double>(kind.arrivedBytes)),
                   text(kind.waitS.median), text(kind.latencyS.median), text(kind.latencyS.p99));
    }
}

void printFaults(const TraceReport& report, int worst) {
    if (report.faults.empty()) {
        fmt::print("\nno faults found\n");
        return;
    }
    fmt::print("\n{} fault{}:", report.faults.size(), report.faults.size() == 1 ? "" : "s");
    const char* separator = " ";
    for (const planet::TraceFaultKind kind : faultKinds) {
        if (const std::size_t count = countOf(report, kind); count > 0)
            fmt::print("{}{} {}", std::exchange(separator, ", "), count, planet::traceFaultName(kind));
    }
    fmt::print("\n");
    const std::vector<const planet::TraceFault*> faults = worstFirst(report);
    const std::size_t listed = std::min(faults.size(), static_cast<std::size_t>(worst));
    for (std::size_t i = 0; i < listed; ++i) {
        const planet::TraceFault& fault = *faults[i];
        fmt::print("  {:<12}{}{}\n", planet::traceFaultName(fault.kind),
                   fault.view < 0 ? "" : fmt::format("view {}: ", fault.view), fault.sentence);
    }
    if (listed < faults.size()) fmt::print("  and {} more\n", faults.size() - listed);
    if (report.unlistedFaults > 0)
        fmt::print("  {} more sightings are beyond the limit of the list\n", report.unlistedFaults);
}

Json jsonOf(const planet::TraceSpread& spread, double factor) {
    return {{"count", spread.count},
            {"median", tracedNumberJson(factor * spread.median)},
            {"p99", tracedNumberJson(factor * spread.p99)},
            {"max", tracedNumberJson(factor * spread.most)}};
}

Json jsonOf(const TraceReport& report, const planet::TraceViewReport& view) {
    Json json = {{"view", view.view},
                 {"frames", view.frames},
                 {"mean_drawn", view.meanDrawn},
                 {"max_drawn", view.mostDrawn},
                 {"max_triangles", view.mostTriangles},
                 {"splits", view.splits},
                 {"merges", view.merges},
                 {"thrashes", view.thrashes},
                 {"max_error_px", tracedNumberJson(view.worstErrorPx)}};
    if (std::isfinite(view.worstErrorPx)) {
        json["max_error_frame"] = view.worstFrame;
        json["max_error_node"] = tracedNodeText(report.description, view.worstNode);
    }
    json["tau_px"] = view.tauPx ? Json(*view.tauPx) : Json(nullptr);
    json["frames_over_tau"] = view.tauPx ? Json(view.framesOverTau) : Json(nullptr);
    return json;
}

Json jsonOf(const planet::TraceKindReport& kind) {
    return {{"kind", kind.kind},
            {"name", kind.name},
            {"requested", kind.requested},
            {"arrived", kind.arrived},
            {"cancelled", kind.cancelled},
            {"failed", kind.failed},
            {"evicted", kind.evicted},
            {"arrived_bytes", kind.arrivedBytes},
            {"wait_ms", jsonOf(kind.waitS, 1000)},
            {"latency_ms", jsonOf(kind.latencyS, 1000)}};
}

Json jsonOf(const TraceReport& report, const planet::TraceFault& fault) {
    Json json = {{"kind", planet::traceFaultName(fault.kind)},
                 {"first_frame", fault.firstFrame},
                 {"last_frame", fault.lastFrame},
                 {"frames", fault.frames}};
    if (fault.view >= 0) json["view"] = fault.view;
    json["node"] = tracedNodeText(report.description, fault.node);
    if (fault.hasOther) json["other"] = tracedNodeText(report.description, fault.other);
    json["value"] = tracedNumberJson(fault.value);
    json["limit"] = tracedNumberJson(fault.limit);
    json["sentence"] = fault.sentence;
    return json;
}

}  // namespace

std::vector<std::string> brokenLimits(const TraceLimits& limits, const TraceReport& report) {
    std::vector<std::string> broken;
    // missing: why the value is not known; nullptr: it is.
    const auto check = [&](const auto& limit, double value, const char* what, const char* missing) {
        if (!limit) return;
        if (report.frames == 0) missing = "the trace has no frame";
        if (missing)
            broken.push_back(fmt::format("{} cannot be checked: {}", what, missing));
        else if (value > static_cast<double>(*limit))
            broken.push_back(
                fmt::format("{} is {:g}; expected at most {:g}", what, value, static_cast<double>(*limit)));
    };
    const double errorPx = worstErrorPx(report), latencyMs = worstLatencyMs(report);
    const bool hasTimes = report.cpuMs.count + report.gpuMs.count > 0;
    check(limits.faults, static_cast<double>(report.faults.size()), "the number of faults", nullptr);
    check(limits.errorPx, errorPx, "the largest error of a drawn node, in pixels,",
          std::isnan(errorPx) ? "no error of a drawn node is known" : nullptr);
    check(limits.latencyMs, latencyMs, "the 99th percentile of the latency, in ms,",
          std::isnan(latencyMs) ? "no request arrived" : nullptr);
    check(limits.thrashes, static_cast<double>(thrashesOf(report)), "the number of thrashes",
          report.views.empty() ? "the trace has no view" : nullptr);
    check(limits.overBudget, percent(report.framesOverBudget, report.frames),
          "the percentage of frames over the budget", hasTimes ? nullptr : "the engine told no times");
    check(limits.dropped, static_cast<double>(report.droppedEvents), "the number of lost events", nullptr);
    return broken;
}

void printTrace(const TraceCommandOptions& options, const TraceReport& report) {
    const planet::TraceDescription description = report.description.value_or(planet::TraceDescription{});
    fmt::print("{}: {}{} frames, {} to {}, {}\n", options.file.string(),
               description.name.empty() ? "" : description.name + ", ", report.frames, report.firstFrame,
               report.lastFrame, durationText(report.durationS));
    fmt::print("{:<18}{}\n", "nodes", report.nodes);
    if (report.missingFrames > 0) fmt::print("{:<18}{}\n", "missing frames", report.missingFrames);
    if (report.droppedEvents > 0)
        fmt::print("{:<18}{}; frames that lack some are not judged\n", "lost events", report.droppedEvents);
    printSpread("CPU time", report.cpuMs);
    printSpread("GPU time", report.gpuMs);
    if (report.cpuMs.count + report.gpuMs.count > 0)
        fmt::print("{:<18}{} of {} frames took longer than {}\n", "budget", report.framesOverBudget,
                   report.frames, millisecondsText(options.budgetMs));
    printViews(report);
    printPaging(report);
    printFaults(report, options.worst);
}

Json traceJson(const TraceCommandOptions& options, const TraceReport& report) {
    Json json = {{"file", options.file.string()},
                 {"name", report.description ? report.description->name : std::string()},
                 {"frames", report.frames},
                 {"first_frame", report.firstFrame},
                 {"last_frame", report.lastFrame},
                 {"missing_frames", report.missingFrames},
                 {"duration_s", report.durationS},
                 {"dropped_events", report.droppedEvents},
                 {"nodes", report.nodes},
                 {"budget_ms", options.budgetMs},
                 {"frames_over_budget", report.framesOverBudget},
                 {"cpu_ms", jsonOf(report.cpuMs, 1)},
                 {"gpu_ms", jsonOf(report.gpuMs, 1)}};
    json["view"] = Json::array();
    for (const planet::TraceViewReport& view : report.views) json["view"].push_back(jsonOf(report, view));
    json["paging"] = Json::array();
    for (const planet::TraceKindReport& kind : report.kinds) json["paging"].push_back(jsonOf(kind));
    Json& counts = json["fault_counts"] = Json::object();
    for (const planet::TraceFaultKind kind : faultKinds)
        counts[planet::traceFaultName(kind)] = countOf(report, kind);
    json["fault"] = Json::array();
    for (const planet::TraceFault* fault : worstFirst(report))
        json["fault"].push_back(jsonOf(report, *fault));
    json["unlisted_faults"] = report.unlistedFaults;
    json["broken_limits"] = brokenLimits(options.limits, report);
    json["problem"] = report.problem ? Json(*report.problem) : Json(nullptr);
    return json;
}

namespace {

// Returns a sentence for a limit of a count that does not hold.
std::optional<std::string> brokenCount(const std::optional<int>& limit, std::uint64_t count,
                                       const char* what) {
    if (!limit || count <= static_cast<std::uint64_t>(*limit)) return std::nullopt;
    return fmt::format("{} is {}; expected at most {}", what, count, *limit);
}

// Frames that only one trace has differ, too.
std::optional<std::string> brokenDiffering(const std::optional<int>& limit,
                                           const planet::TraceComparison& compared) {
    constexpr const char* what = "the number of frames that draw other nodes, or that only one trace has,";
    if (limit && compared.frames == compared.skippedFrames)
        return fmt::format("{} cannot be checked: no frame could be compared", what);
    return brokenCount(limit, compared.framesThatDiffer + compared.framesOnlyInA + compared.framesOnlyInB,
                       what);
}

// Returns a sentence if the engine's choice contradicts its own numbers too often, or if that is not known.
std::optional<std::string> brokenDisagreeing(const std::optional<int>& limit,
                                             const planet::TraceWhatIfReport& report) {
    constexpr const char* what = "the number of frames that contradict the engine's own numbers";
    const char* const why = planet::whyTraceIsNotJudged(report);
    if (limit && why) return fmt::format("{} cannot be checked: {}", what, why);
    return brokenCount(limit, report.framesThatDisagree, what);
}

bool asksWhatIf(const TraceCommandOptions& options) {
    return !options.whatIf.tausPx.empty() || options.whatIf.goal || options.limits.disagreeing;
}

Result<TraceWhatIfFound> whatIf(const TraceCommandOptions& options, planet::TraceFile& file,
                                const std::function<bool()>& goOn) {
    TraceWhatIfFound found;
    std::vector<planet::TraceSelectorSettings> settings;
    for (const double tauPx : options.whatIf.tausPx) {
        settings.push_back(options.whatIf.settings);
        settings.back().tauPx = tauPx;
    }
    Result<planet::TraceWhatIfReport> report = planet::whatIfOfTrace(file, settings, goOn);
    if (!report) return tl::unexpected(report.error());
    found.report = *std::move(report);
    if (!options.whatIf.goal || found.report.isDamaged) return found;
    found.goal = *options.whatIf.goal;
    const auto tau = planet::suggestTraceTau(file, options.whatIf.settings, found.goal, goOn);
    if (!tau) return tl::unexpected(tau.error());
    found.suggestion = *tau;
    return found;
}

// Prints the sentences; returns whether there are none.
bool holdAll(const std::vector<std::string>& broken) {
    for (const std::string& sentence : broken) printMessage("worldy: {}\n", sentence);
    return broken.empty();
}

// The limits apply to B and are told once, for the comparison.
Json wholeJson(TraceCommandOptions options, const std::filesystem::path& file, const TraceReport& report) {
    options.file = file;
    Json json = traceJson(options, report);
    json.erase("broken_limits");
    return json;
}

Result<bool> runTraceCompare(const TraceCommandOptions& options) {
    const InterruptWatch watch;
    const Result<TraceCompared> both = compareTraceFiles({.fileA = options.file,
                                                          .fileB = options.other,
                                                          .match = options.match,
                                                          .budgetMs = options.budgetMs,
                                                          .faults = options.faults},
                                                         [&](double) { return !watch.interrupted(); });
    if (!both) return tl::unexpected(both.error());
    const planet::TraceComparison& found = both->found;
    std::vector<std::string> broken = brokenLimits(options.limits, both->reportB);
    if (const auto sentence = brokenDiffering(options.limits.differing, found)) broken.push_back(*sentence);
    if (!options.report.json) printTraceComparison(*both, options.worst);
    Json json = traceComparisonJson(*both);
    json["report_a"] = wholeJson(options, options.file, both->reportA);
    json["report_b"] = wholeJson(options, options.other, both->reportB);
    json["broken_limits"] = broken;
    if (Result<void> written = writeReport(options.report, json); !written)
        return tl::unexpected(std::move(written).error());
    if (found.isDamagedA) return planet::badInput(*found.problemA);
    if (found.isDamagedB) return planet::badInput(*found.problemB);
    for (const auto& problem : {found.problemA, found.problemB})
        if (problem) printMessage("worldy: {}\n", *problem);
    return holdAll(broken);
}

}  // namespace

Result<bool> runTrace(const TraceCommandOptions& options) {
    if (!options.other.empty()) return runTraceCompare(options);
    Result<planet::TraceFile> file = planet::TraceFile::open(options.file);
    if (!file) return tl::unexpected(file.error());
    const InterruptWatch watch;
    const auto goOn = [&] { return !watch.interrupted(); };
    const Result<TraceReport> report = planet::reportOfTrace(*file, options.budgetMs, options.faults, goOn);
    if (!report) return tl::unexpected(report.error());
    std::vector<std::string> broken = brokenLimits(options.limits, *report);
    Json json = traceJson(options, *report);
    if (!options.report.json) printTrace(options, *report);
    if (asksWhatIf(options)) {
        const Result<TraceWhatIfFound> found = whatIf(options, *file, goOn);
        if (!found) return tl::unexpected(found.error());
        if (const auto sentence = brokenDisagreeing(options.limits.disagreeing, found->report))
            broken.push_back(*sentence);
        if (!options.report.json) printWhatIf(*found, options.worst);
        json["what_if"] = whatIfJson(*found);
        json["broken_limits"] = broken;
    }
    if (Result<void> written = writeReport(options.report, json); !written)
        return tl::unexpected(std::move(written).error());
    if (report->isDamaged) return planet::badInput(*report->problem);
    if (report->problem) printMessage("worldy: {}\n", *report->problem);
    return holdAll(broken);
}

}  // namespace worldy
