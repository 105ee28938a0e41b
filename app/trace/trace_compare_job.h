// Compares two trace files of one flight, frame by frame and as a whole (planet/trace/trace_compare.h).
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "app/base/log.h"
#include "planet/base/result.h"
#include "planet/trace/trace_compare.h"
#include "planet/trace/trace_report.h"

namespace worldy {

struct TraceCompareRequest {
    std::filesystem::path fileA{}, fileB{};
    planet::TraceMatch match = planet::TraceMatch::Time;
    double budgetMs = std::numeric_limits<double>::infinity();  // of a frame, for the reports; infinite: none
    planet::TraceFaultLimits faults{};                          // for the reports
};

struct TraceCompared {
    TraceCompareRequest request{};
    planet::TraceComparison found{};           // of the frames that both have
    planet::TraceReport reportA{}, reportB{};  // of the whole traces
    // A filter searches these. Each text holds the frame numbers of one listed difference and the names of its nodes.
    std::vector<std::string> texts{};
};

// Reads each trace twice, up to what is there now. goOn gets the progress in [0, 1]; returning false ends with an Error of the
// kind Cancelled. Damaged traces are compared up to there.
planet::Result<TraceCompared> compareTraceFiles(const TraceCompareRequest& request,
                                                const std::function<bool(double)>& goOn);
// Returns a sentence that says why no frame was compared; empty if one was.
std::string whyNothingCompared(const TraceCompared& compared);

// Compares on a thread of its own. All calls come from one thread. The destructor cancels and waits for the current block of the
// traces.
class TraceCompareJob {
public:
    explicit TraceCompareJob(TraceCompareRequest request);

    double progress() const { return progress_; }  // [0, 1]
    void cancel() { job_.cancel(); }
    bool cancelling() const { return job_.cancelling(); }
    // Returns the result once, when there is one.
    std::optional<planet::Result<TraceCompared>> takeResult() { return job_.takeResult(); }

private:
    std::atomic<double> progress_{0};
    Job<planet::Result<TraceCompared>> job_;  // last: it uses progress_
};

// The comparison that the window asks for, and the last result.
struct TraceCompareRun {
    std::unique_ptr<TraceCompareJob> job{};  // null if none is running
    int runs = 0;                            // so many were started
    TraceCompareRequest request{};           // the last one
    std::optional<TraceCompared> result{};   // of the last one that finished
    std::string problem{};                   // why the last one failed, ended early or found nothing
    bool isCancelled = false;                // the last one was ended by the user
};

// Does nothing without a file A or while a comparison is running.
void startTraceCompare(TraceCompareRun& run, const TraceCompareRequest& request, const Log& log);
// Takes the result when there is one. Call it in each frame.
void advanceTraceCompare(TraceCompareRun& run, const Log& log);

}  // namespace worldy
