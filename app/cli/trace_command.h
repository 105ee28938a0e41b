// The command worldy trace: sums up the trace of any engine's level of detail (planet/trace/lod_trace.h) and finds its
// faults. With limits it is a check. Needs no GL.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/base/report.h"
#include "planet/trace/trace_compare.h"
#include "planet/trace/trace_report.h"
#include "planet/trace/trace_what_if.h"

namespace worldy {

// Limits of a check. An unset one is not checked. One for which the trace tells no value does not hold.
struct TraceLimits {
    std::optional<int> faults;         // of all kinds, >= 0
    std::optional<double> errorPx;     // the worst of a drawn node, in any view, pixels, >= 0
    std::optional<double> latencyMs;   // the 99th percentile from request to arrival, of any kind, >= 0
    std::optional<double> thrashes;    // over all views, >= 0
    std::optional<double> overBudget;  // share of the frames, percent, [0, 100]
    std::optional<int> dropped;        // events that the trace lost, >= 0
    std::optional<int>
        differing;  // frames in which the other trace draws other nodes, or that only one has, >= 0
    std::optional<int>
        disagreeing;  // frames in which the engine's choice is not what its own numbers say, >= 0
};

// Selects again over the same frames, with other settings.
struct TraceWhatIfOptions {
    std::vector<double> tausPx{};                // > 0; empty, and no goal: nothing is selected again
    planet::TraceSelectorSettings settings{};    // all but τ
    std::optional<planet::TraceTauGoal> goal{};  // a τ is searched
};

struct TraceCommandOptions {
    std::filesystem::path file;
    std::filesystem::path other{};  // a later trace of the same flight, to compare; the limits apply to it
    planet::TraceMatch match = planet::TraceMatch::Time;
    ReportTo report;
    int worst = 20;                 // faults to list, >= 0; the report contains all
    double budgetMs = 1000.0 / 60;  // of a frame, > 0
    planet::TraceFaultLimits faults;
    TraceLimits limits;
    TraceWhatIfOptions whatIf;
};

// Sums a trace up, selects over it again if whatIf says so, or compares it with another one. Returns true if all limits hold. A trace that is damaged is an Error, after a report of what came before. One that is cut
// off, as by an engine that was killed, is reported with a message.
planet::Result<bool> runTrace(const TraceCommandOptions& options);

// The parts of runTrace().
void printTrace(const TraceCommandOptions& options, const planet::TraceReport& report);
nlohmann::ordered_json traceJson(const TraceCommandOptions& options, const planet::TraceReport& report);
// Returns a sentence for each limit that does not hold or cannot be checked.
std::vector<std::string> brokenLimits(const TraceLimits& limits, const planet::TraceReport& report);

}  // namespace worldy
