// Sums up a trace: frames, what each view drew and how it changed, paging, and faults. trace_state.h builds the frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "planet/base/result.h"
#include "planet/trace/trace_events.h"
#include "planet/trace/trace_faults.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_state.h"
#include "planet/trace/trace_switches.h"

namespace planet {

// The spread of a measured value. All are NaN if nothing was measured.
struct TraceSpread {
    std::uint64_t count = 0;
    double median = std::numeric_limits<double>::quiet_NaN();
    double p99 = std::numeric_limits<double>::quiet_NaN();  // 99 % of the values are at most this
    double most = std::numeric_limits<double>::quiet_NaN();
};
// Reorders the values. The median and the 99th percentile are values of the list (percentile.h).
TraceSpread spreadOf(std::vector<float>& values);

struct TraceViewReport {
    int view = 0;
    std::uint64_t frames = 0;  // in which it was told or drew something
    std::uint64_t mostDrawn = 0;
    std::uint64_t mostTriangles = 0;  // of nodes that told them
    double meanDrawn = 0;
    // Changes between two frames without a gap. A node that was drawn, or lies in one that was, and now has a drawn or culled
    // descendant, was split; the reverse is a merge. It is a thrash if the same node changed the other way less than 1 s before.
    std::uint64_t splits = 0;
    std::uint64_t merges = 0;
    std::uint64_t thrashes = 0;
    // The largest error on screen of a drawn node, pixels; NaN if no error is known.
    double worstErrorPx = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t worstFrame = 0;
    std::uint64_t worstNode = 0;      // id
    std::optional<double> tauPx{};    // the last one told
    std::uint64_t framesOverTau = 0;  // with a drawn node whose error exceeds τ
};

// Paging of one kind of data.
struct TraceKindReport {
    int kind = 0;
    std::string name{};  // empty: the engine did not tell it
    std::uint64_t requested = 0;
    std::uint64_t arrived = 0;
    std::uint64_t cancelled = 0;
    std::uint64_t failed = 0;
    std::uint64_t evicted = 0;
    std::uint64_t arrivedBytes = 0;  // of nodes that told their bytes
    TraceSpread latencyS{};          // from request to arrival, monotonic clock, seconds
    TraceSpread waitS{};             // from request to start
};

struct TraceReport {
    std::optional<TraceDescription> description{};
    std::uint64_t frames = 0;  // that the trace has
    std::uint64_t firstFrame = 0;
    std::uint64_t lastFrame = 0;
    std::uint64_t missingFrames = 0;  // gaps between frames that follow each other with ascending numbers
    double durationS = 0;             // from the first to the last, engine's clock, of finite times
    std::uint64_t droppedEvents = 0;
    std::uint64_t nodes = 0;
    TraceSpread cpuMs{};  // of frames that told them
    TraceSpread gpuMs{};
    std::uint64_t framesOverBudget = 0;  // with a CPU or GPU time over the budget
    std::vector<TraceViewReport> views{};
    std::vector<TraceKindReport> kinds{};  // that are paged
    std::vector<TraceFault> faults{};
    std::uint64_t unlistedFaults = 0;
    std::optional<std::string>
        problem{};           // where the trace is damaged or cut off; the report has what came before
    bool isDamaged = false;  // of the problem: a block has wrong bytes
};

// Takes the frames of a trace in order. One thread at a time.
class TraceReporter {
public:
    // budgetMs: of a frame, > 0; infinite: no budget.
    explicit TraceReporter(double budgetMs, const TraceFaultLimits& limits = {});

    // Takes state.frame(), which has just ended.
    void add(const TraceState& state);
    // Returns what is known of a view of the last frame; nullptr: it had no such view.
    const TraceSwitchFinder* finder(int view) const;
    // Returns the switches of the last frame, of all views.
    const std::vector<TraceSwitch>& switches() const { return switches_; }
    // Ends the trace. Call it once.
    TraceReport finish(const TraceState& state);

private:
    struct Change {
        double timeS = 0;
        bool isSplit = false;
    };
    struct View {
        TraceViewReport report;
        std::uint64_t drawnTotal = 0;
        std::uint64_t lastFrame = 0;  // that had it
        TraceSwitchFinder switches;
        std::unordered_map<TraceNodeIndex, Change> changes;  // the last one of each node
    };
    struct Kind {
        TraceKindReport report;
        std::vector<float> latencyS;
        std::vector<float> waitS;
    };

    void addView(const TraceState& state, const TraceFrameView& frame, View& view);
    static void addErrors(const TraceState& state, const TraceFrameView& frame, View& view);
    static void note(const TraceSwitch& found, View& view);
    void addPaged(const TraceState& state, const TracePagedStep& step);

    double budgetMs_;
    std::vector<TraceSwitch> switches_;
    TraceReport report_;
    TraceFaultFinder finder_;
    std::vector<float> cpuMs_;
    std::vector<float> gpuMs_;
    std::vector<View> views_;  // in the order in which they were seen
    std::vector<Kind> kinds_;
    std::optional<double> firstS_;  // the first finite time
};

// Reads a whole trace. goOn is called now and then; returning false ends with an Error of the kind Cancelled. A trace that is
// damaged gives a report of what came before, with its problem.
Result<TraceReport> reportOfTrace(TraceFile& file, double budgetMs, const TraceFaultLimits& limits = {},
                                  const std::function<bool()>& goOn = {});

}  // namespace planet
