// Compares two traces of one flight, such as before and after a change of an engine, frame by frame. Nodes are the same if
// their ids are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_report.h"
#include "planet/trace/trace_what_if.h"

namespace planet {

enum class TraceMatch : std::uint8_t {
    Time,    // of the engine's clock; it must ascend
    Number,  // of the frame
};

struct TraceCompareSettings {
    TraceMatch match = TraceMatch::Time;
    double withinS = 1e-6;           // times that differ by at most this are the same, seconds, >= 0
    std::size_t maxFrames = 10'000;  // that differ, to list
    std::size_t maxNodes = 20;       // of a listed frame and trace, to list
};

// A view of a frame that both traces have, in which they draw different nodes.
struct TraceFrameDifference {
    std::uint64_t frameA = 0, frameB = 0;  // numbers
    double timeS = 0;                      // of A
    int view = 0;
    std::uint64_t drawnA = 0, drawnB = 0, trianglesA = 0, trianglesB = 0;
    double worstErrorPxA = std::numeric_limits<double>::quiet_NaN();  // NaN: unknown
    double worstErrorPxB = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t onlyInA = 0, onlyInB = 0;         // nodes
    std::vector<std::uint64_t> nodesA{}, nodesB{};  // ids of the first of these, ascending
};

// One view, over the frames that both traces have, are complete in both, and tell the view in one of them at least.
struct TraceViewComparison {
    int view = 0;
    std::uint64_t frames = 0;
    std::uint64_t framesThatDiffer = 0;      // draw different nodes
    std::uint64_t onlyInA = 0, onlyInB = 0;  // nodes, summed over frames
    TraceSelectionTotals a{}, b{};
};

struct TraceComparison {
    TraceMatch match = TraceMatch::Time;
    std::optional<TraceDescription> descriptionA{}, descriptionB{};
    std::uint64_t frames = 0;  // that both have
    std::uint64_t framesOnlyInA = 0, framesOnlyInB = 0;
    std::uint64_t skippedFrames = 0;                     // of `frames`, that lost events in one of the two
    std::uint64_t framesThatDiffer = 0;                  // in any view
    TraceSpread cpuMsA{}, cpuMsB{}, gpuMsA{}, gpuMsB{};  // of the frames that both have and that told them
    std::vector<TraceViewComparison> views{};            // by number
    std::vector<TraceFrameDifference>
        differences{};  // in order; the first one is the first frame that differs
    std::uint64_t unlistedDifferences = 0;
    std::optional<std::string> problemA{}, problemB{};  // where a trace is damaged or cut off
    bool isDamagedA = false, isDamagedB = false;
};

// Reads both traces once, side by side. Memory: the nodes of both, and the frames of a block. goOn is called now and then;
// returning false ends with an Error of the kind Cancelled. Damaged traces are compared up to there. The Error of times that do
// not ascend says so.
Result<TraceComparison> compareTraces(TraceFile& a, TraceFile& b, const TraceCompareSettings& settings = {},
                                      const std::function<bool()>& goOn = {});

}  // namespace planet
