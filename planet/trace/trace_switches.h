// Finds the switches of a trace: the nodes that were split or merged between two frames, how far the picture can change,
// and why.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "planet/trace/trace_selector.h"
#include "planet/trace/trace_state.h"

namespace planet {

// Why a node was split or merged, by the engine's own numbers: its error on screen and the limit, which is τ for a split
// and τ (1 - hysteresis) for a merge.
enum class TraceSwitchCause : std::uint8_t {
    Error,     // the error crossed the limit because the view moved
    Settings,  // the error crossed the limit because the limit changed
    Arrival,   // a split: the error exceeded the limit before, and the children's data came
    Eviction,  // a merge: the children's data is gone
    Other,  // the numbers did not ask for it in this frame: a fade, a neighbour, a budget or another rule of the engine
    Unknown,  // the error or the limit is not known
};
const char* traceSwitchCauseName(TraceSwitchCause cause);  // "error", "settings", ...

struct TraceSwitch {
    std::uint64_t frame = 0;  // the first one with the new level
    double timeS = 0;         // engine's clock
    int view = 0;
    TraceNodeIndex index = noTraceNode;
    std::uint64_t node = 0;  // id
    std::uint32_t level = 0;
    bool isSplit = false;  // false: merged
    // The error of the node, pixels: the surface jumps by at most this if the error is a bound. NaN: unknown.
    double errorPx = std::numeric_limits<double>::quiet_NaN();
    double limitPx = std::numeric_limits<double>::quiet_NaN();
    // Diameter of the node's bounding sphere on screen, pixels; infinite if the eye is inside; NaN: unknown.
    double sizePx = std::numeric_limits<double>::quiet_NaN();
    // All nodes that take part were morphed into the other level's surface, so that nothing jumps.
    bool isMorphed = false;
    TraceSwitchCause cause = TraceSwitchCause::Unknown;
};

// Follows one view of a trace. One thread at a time.
class TraceSwitchFinder {
public:
    // Takes a view of state.frame(), which has just ended. Returns the switches since the frame before, valid until the next
    // call: those of a frame that lost events, or that follows a gap, are not known.
    const std::vector<TraceSwitch>& add(const TraceState& state, const TraceFrameView& view);

    // Return the state of the view that was added last.
    const TraceEngineFrame& engine() const { return engine_; }
    const TraceSelection& selection() const { return selection_; }
    double tauPx() const { return limits_.tauPx; }  // NaN: not told

private:
    struct Limits {
        double tauPx = std::numeric_limits<double>::quiet_NaN();
        double mergePx = std::numeric_limits<double>::quiet_NaN();
    };
    // The facts about a drawn or split node that the next frame compares with.
    struct Seen {
        std::uint32_t stamp = 0;  // stamp_ of the frame
        bool isWaiting = false;   // drawn, while its children were not told or their data is missing
        float morph = 0;          // of a drawn node
        double errorPx = 0;
    };

    void see(const TraceState& state, const TraceFrameView& view);
    const Seen* seen(const std::vector<Seen>& in, TraceNodeIndex node, std::uint32_t stamp) const;
    TraceSwitch switchOf(const TraceState& state, TraceNodeIndex node, bool isSplit) const;
    TraceSwitchCause causeOf(const TraceState& state, const TraceSwitch& found) const;
    bool isMorphed(const TraceState& state, TraceNodeIndex node, bool isSplit) const;

    TraceEngineFrame engine_;
    TraceLevelCounter counter_;
    TraceSelection selection_;
    Limits limits_, limitsBefore_;
    std::vector<Seen> seen_, seenBefore_;  // by node
    std::uint32_t stamp_ = 1;
    std::vector<TraceSwitch> switches_;
};

// Returns whether the children of a node were told and the data of one of them is not there. Pure.
bool lacksTraceChildren(const TraceState& state, TraceNodeIndex node);

}  // namespace planet
