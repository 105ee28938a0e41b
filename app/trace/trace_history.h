// The history of a whole trace, for plots and lists. It grows while the trace is read.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planet/trace/trace_report.h"
#include "planet/trace/trace_switches.h"

namespace worldy {

// One or more frames that follow each other. Numbers are the largest of these frames, sums where a comment says so.
struct TracedSample {
    std::uint64_t frame = 0;  // the first one
    // The time of the first frame by the engine's clock. It is finite and never less than that of the sample before.
    double timeS = 0;
    float cpuMs = std::numeric_limits<float>::quiet_NaN();  // NaN: not told
    float gpuMs = std::numeric_limits<float>::quiet_NaN();
    float queued = 0;   // requests that have not arrived, of all kinds
    float arrived = 0;  // sum
    float failed = 0;   // sum
    float evicted = 0;  // sum
    float dropped = 0;  // events that were lost, sum
};

// The same frames in one view. Frames without the view are zeros, with unknown errors.
struct TracedViewSample {
    float drawn = 0;
    float triangles = 0;
    float worstErrorPx = std::numeric_limits<float>::quiet_NaN();  // NaN: no error is known
    float tauPx = std::numeric_limits<float>::quiet_NaN();         // NaN: not told
    float splits = 0;                                              // sum
    float merges = 0;                                              // sum
    float starved = 0;  // nodes that are drawn coarser than τ because data is missing
};

// A stretch of time in which a view drew at least one node coarser than τ because data was missing.
struct TracedStarvation {
    int view = 0;
    std::uint64_t firstFrame = 0;
    std::uint64_t lastFrame = 0;
    double fromS = 0;   // engine's clock, as TracedSample::timeS
    double untilS = 0;  // of the first frame without it, or of the last frame read
    bool isOver = false;
    std::uint64_t mostNodes = 0;  // in a frame
    double worstErrorPx = 0;      // of these nodes
};

inline constexpr std::size_t tracedLatencyBuckets = 36;
inline constexpr double fastestTracedLatencyS = 1e-4;
inline constexpr double slowestTracedLatencyS = 100;

struct TraceHistory {
    std::uint64_t framesPerSample = 1;
    std::vector<TracedSample> samples{};
    std::map<int, std::vector<TracedViewSample>> views{};  // by view; one for each sample
    std::map<std::string, std::vector<float>>
        counters{};                               // the same; the last value of the frames, NaN: not told
    std::vector<planet::TraceSwitch> switches{};  // in order, at most maxTracedSwitches
    std::uint64_t unlistedSwitches = 0;
    std::vector<TracedStarvation> starvations{};  // in order, at most maxTracedStarvations
    // Requests by kind and time to arrival, on a logarithmic axis from fastestTracedLatencyS to slowestTracedLatencyS.
    std::array<std::array<float, tracedLatencyBuckets>, planet::maxTraceKinds> latencies{};
    planet::TraceReport report{};  // of what was read
    bool isComplete = false;       // the trace was read to its end
};
inline constexpr std::size_t maxTracedSamples =
    100'000;  // reaching it halves the number, and two samples become one
inline constexpr std::size_t maxTracedSwitches = 50'000;
inline constexpr std::size_t maxTracedStarvations = 10'000;
inline constexpr std::size_t maxTracedCounters = 32;  // names; others are left out

// Takes the frames of a trace in order. One thread at a time.
class TraceHistorian {
public:
    // Takes state.frame(), which has just ended.
    void add(const planet::TraceState& state);
    // Returns the history so far. Its cost grows with it.
    std::shared_ptr<const TraceHistory> history(const planet::TraceState& state, bool isComplete) const;

private:
    void beginSample(const planet::TraceFrame& frame);
    void addView(const planet::TraceState& state, const planet::TraceFrameView& view);
    void addStarvation(const planet::TraceState& state, const planet::TraceFrameView& view,
                       TracedViewSample& sample);
    void addPaging(const planet::TraceState& state, TracedSample& sample);
    void addCounters(const planet::TraceState& state);
    void halve();

    TraceHistory history_;
    planet::TraceReporter reporter_{std::numeric_limits<double>::infinity()};
    std::map<int, std::size_t> starving_;  // by view: place in history_.starvations
    std::uint64_t framesInSample_ = 0;
    double timeS_ = 0;      // the latest time of the engine's clock so far
    bool isTimed_ = false;  // a finite time was told
};

}  // namespace worldy
