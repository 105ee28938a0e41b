// Selects nodes again in the views of a trace, with other settings, another metric or other data than the engine had.
//
// A node is split while its error on screen exceeds τ, and a split node stays split until its error is at most
// τ (1 - hysteresis), as lod_select.h does it, but without fades and without limits of seams. It is drawn itself while the
// data of its children is not there.
//
// These parts are approximate:
// - Nodes that the engine culled stay culled, and so do those that it neither drew nor split beside nodes that it did. Only
//   below the nodes that it drew are bounds compared with the frustum and with a horizon of the world's radius. They are
//   culled if all of the bounds lies outside; terrain below the radius can be seen beyond that horizon.
// - The children of a node are those that the trace describes, even if the engine had more.
// - Where children were never described, or the error of a node is not known, the node is drawn and counted as unknown: the
//   triangles and bytes are then lower bounds, and the largest error is an upper one. The same holds for a leaf of the data
//   whose error exceeds τ, because a trace does not say which nodes are leaves.
// - An error in pixels (TraceErrorUnit::Pixels) is known only for nodes that the engine drew, split or culled; 0 stands for
//   not told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "planet/trace/trace_state.h"

namespace planet {

// Holds what the engine drew in one view of a frame. One thread at a time.
class TraceEngineFrame {
public:
    // Takes a view of state.frame(). described: by node, whether its description came before this frame for certain; empty:
    // all did. The nodes of later frames are known to state if the whole trace was read before.
    void take(const TraceState& state, const TraceFrameView& view, std::span<const char> described = {});

    const TraceFrameView& view() const { return *view_; }  // valid as long as the one taken
    const std::vector<TraceNodeIndex>& drawn() const { return drawnList_; }
    const std::vector<TraceNodeIndex>& split() const {
        return splitList_;
    }                                                                    // ancestors of drawn or culled nodes
    const std::vector<TraceNodeIndex>& roots() const { return roots_; }  // of what was drawn or culled
    bool isDrawn(TraceNodeIndex node) const { return has(drawn_, node, stamp_); }
    bool isSplit(TraceNodeIndex node) const { return has(split_, node, stamp_); }
    bool isCulled(TraceNodeIndex node) const { return has(culled_, node, stamp_); }
    // In the frame before. False for all nodes if that is not known: it is missing or lost events.
    bool wasSplit(TraceNodeIndex node) const { return hasBefore_ && has(splitBefore_, node, stamp_ - 1); }
    bool hasBefore() const { return hasBefore_; }
    // Returns whether the children's data was there for the engine. What came or went since the frame before counts as there
    // only if the engine split the node, because a trace does not say whether the engine saw it in this frame already.
    bool hasChildren(const TraceState& state, TraceNodeIndex node) const;
    // Returns a node's error, pixels: as the engine told it in this frame, if that differs from traceErrorPx() by more than
    // 1e-4 of it, else traceErrorPx(). NaN: unknown. isVisited: the engine drew, split or culled it. With another metric than
    // Bounds, an error that is a distance is always converted here, because the engine's number says nothing about that metric.
    double errorPx(const TraceState& state, TraceNodeIndex node, bool isVisited,
                   TraceMetric metric = TraceMetric::Bounds) const;

private:
    using Stamps = std::vector<std::uint32_t>;  // by node: stamp_ of the last frame in which something holds
    static bool has(const Stamps& stamps, TraceNodeIndex node, std::uint32_t stamp) {
        return node < stamps.size() && stamps[node] == stamp;
    }
    bool isCertain(const TraceState& state, TraceNodeIndex child) const;

    const TraceFrameView* view_ = nullptr;
    std::span<const char> described_;
    std::uint32_t stamp_ = 1;
    std::uint64_t number_ = 0;  // of the frame that was taken
    bool hasBefore_ = false;
    bool isWhole_ = false;  // the frame that was taken lost nothing
    Stamps drawn_, split_, culled_, splitBefore_, moved_;
    std::vector<TraceNodeIndex> drawnList_, splitList_, roots_;
    std::unordered_map<TraceNodeIndex, double> toldPx_;
};

// Which data is there.
enum class TraceResidency : std::uint8_t {
    AllThere,  // all that the trace ever describes
    AsTraced,  // what the engine had in the frame
    Disk,      // what a disk by TraceDiskModel has delivered, from none in the first frame on
};

// Loaders take the request with the largest error over τ first, one at a time. What nothing wants any more is not started.
// Without a budget nothing is evicted; with one, what was not used for the longest time.
struct TraceDiskModel {
    double latencyS = 0.01;    // of a request, engine's seconds, >= 0
    double bytesPerS = 100e6;  // of each loader, > 0; infinite: only the latency counts
    int loaders = 1;           // that work at the same time, >= 1
};

struct TraceSelectorSettings {
    // Nothing: as the engine told it for the view and frame. Without any τ, nothing is selected.
    std::optional<double> tauPx{};       // pixels, > 0
    std::optional<double> hysteresis{};  // [0, 1); 0 if the engine told none
    std::optional<double> maxLevel{};    // unlimited if the engine told none
    // The errors that are compared with τ use this distance. Those of the result are always by the bounds, so that results can
    // be compared.
    TraceMetric metric = TraceMetric::Bounds;
    // Nodes with the largest error are split first, as long as the bytes that the view needs stay within the budget.
    std::optional<std::uint64_t> budgetBytes{};
    TraceResidency residency = TraceResidency::AllThere;
    TraceDiskModel disk{};
    // Judges the engine: what it had split in the frame before is the memory of hysteresis, and where an error differs from
    // its threshold by at most this share, its own choice is taken. Nothing: the selector has a memory of its own.
    std::optional<double> followSlack{};
};

// The nodes of a view in a frame, and what they cost.
struct TraceSelection {
    std::vector<TraceNodeIndex> drawn, split;
    std::uint64_t triangles = 0;  // of nodes that told them
    // Of the nodes that it needs, those that told them: drawn and split ones, and with TraceRequests::Children all children of
    // split ones.
    std::uint64_t bytes = 0;
    // The largest error of a drawn node, pixels; NaN if none is known.
    double worstErrorPx = std::numeric_limits<double>::quiet_NaN();
    TraceNodeIndex worstNode = noTraceNode;
    std::uint64_t splits = 0, merges = 0;  // since the frame before, counted as TraceViewReport does
    std::uint64_t unknown = 0;             // drawn because children or errors are not known
    std::uint64_t waiting = 0;             // drawn because the children's data is not there
    std::uint64_t limited = 0;             // drawn because of the budget
};

// Counts the changes of level between the frames of a view: a node that was drawn, or lies in one that was, and is now split
// was split; the reverse is a merge. One thread at a time.
class TraceLevelCounter {
public:
    // Fills the changes of a selection. isContinued: the last one was that of the frame before.
    void count(const TraceState& state, bool isContinued, TraceSelection& selection);
    // The nodes that changed in the last call.
    const std::vector<TraceNodeIndex>& splitNow() const { return splitNow_; }
    const std::vector<TraceNodeIndex>& mergedNow() const { return mergedNow_; }

private:
    using Stamps = std::vector<std::uint32_t>;
    bool covers(const TraceState& state, const Stamps& drawn, std::uint32_t stamp, TraceNodeIndex node) const;

    Stamps drawn_, split_, drawnBefore_, splitBefore_;
    std::vector<TraceNodeIndex> list_, listBefore_;  // split nodes
    std::vector<TraceNodeIndex> splitNow_, mergedNow_;
    std::uint32_t stamp_ = 1;
};

// Returns what the engine drew, with its costs, but without changes. Pure.
TraceSelection engineSelection(const TraceState& state, const TraceEngineFrame& engine);

// The data that a disk has delivered. One thread at a time.
class TraceDisk {
public:
    TraceDisk(const TraceDiskModel& model, std::optional<std::uint64_t> budgetBytes);

    // Begins a frame, engine's seconds: what was asked for in the frame before has begun, and some of it has arrived.
    void beginFrame(double timeS);
    bool isThere(TraceNodeIndex node) const;
    void use(TraceNodeIndex node);  // in this frame
    void ask(TraceNodeIndex node, double priority, std::uint64_t bytes);
    // Ends the frame: evicts what the budget does not hold.
    void endFrame();
    std::uint64_t bytes() const { return bytes_; }  // that are there

private:
    struct Data {
        double atS = 0;  // when it arrives
        std::uint64_t bytes = 0;
        std::uint64_t usedFrame = 0;
        bool isThere = false;
    };
    struct Request {
        double priority = 0;
        std::uint64_t bytes = 0;
        TraceNodeIndex node = 0;
    };

    TraceDiskModel model_;
    std::optional<std::uint64_t> budgetBytes_;
    std::vector<double> freeS_;  // of each loader: when it has ended its last request
    std::vector<Request> asked_;
    std::unordered_map<TraceNodeIndex, Data> data_;
    std::uint64_t frame_ = 0;
    std::uint64_t bytes_ = 0;
    double timeS_ = 0;
};

// The selection of one view, with its memory. One thread at a time.
class TraceSelector {
public:
    explicit TraceSelector(const TraceSelectorSettings& settings);

    // Selects in the frame and view that engine took, of the same state. The first selection takes over what the engine had
    // split for hysteresis. Returns nothing without τ. The result is valid until the next call.
    const TraceSelection* select(const TraceState& state, const TraceEngineFrame& engine);
    // In the last selection.
    bool isSplit(TraceNodeIndex node) const { return node < splitAt_.size() && splitAt_[node] == stamp_; }
    const TraceSelectorSettings& settings() const { return settings_; }

private:
    struct Open {
        double errorPx = 0;  // by the metric; NaN: unknown
        TraceNodeIndex node = noTraceNode;
        bool isBelow = false;  // below a node that the engine drew
        bool operator<(const Open& other) const;
    };
    enum class Children : std::uint8_t { There, Missing, Unknown };

    void open(const TraceState& state, const TraceEngineFrame& engine, TraceNodeIndex node, bool isBelow);
    void visit(const TraceState& state, const TraceEngineFrame& engine, const Open& node);
    bool wants(const TraceState& state, const TraceEngineFrame& engine, const Open& node, Children children);
    Children childrenOf(const TraceState& state, const TraceEngineFrame& engine, TraceNodeIndex node);
    bool fits(const TraceState& state, const TraceEngineFrame& engine, const Open& node);
    void ask(const TraceState& state, const Open& node);
    bool wasSplit(const TraceEngineFrame& engine, TraceNodeIndex node) const;

    TraceSelectorSettings settings_;
    double tauPx_ = 0, mergePx_ = 0, maxLevel_ = 0;  // of this frame
    std::vector<std::uint32_t> splitAt_, seenAt_;    // by node
    std::vector<std::uint32_t> splitBefore_;
    std::vector<Open> open_;  // a heap, the largest error first
    TraceSelection selection_;
    TraceLevelCounter counter_;
    TraceDisk disk_;
    std::uint32_t stamp_ = 1;
    bool hasMemory_ = false;
};

}  // namespace planet
