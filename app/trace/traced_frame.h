// A frame of a trace as the panels show it: what each view drew and why, and what was paged.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planet/trace/trace_switches.h"

namespace worldy {

enum class TracedPlace : std::uint8_t {
    Drawn,
    Split,   // an ancestor of drawn or culled nodes
    Culled,  // as the engine told it
    Unseen,  // its parent is split, but the engine neither drew nor culled it: it is outside the view, or a hole
    Below,  // its parent is drawn
};

struct TracedNode {
    planet::TraceNodeIndex index = planet::noTraceNode;
    planet::TraceNodeIndex parent = planet::noTraceNode;  // index
    planet::TraceNode node;
    TracedPlace place = TracedPlace::Drawn;
    planet::TraceCulling culling = planet::TraceCulling::ByFrustum;  // of a culled node
    float morph = 0;                                                 // of a drawn node, [0, 1]
    // On screen, pixels; NaN: unknown.
    double errorPx = std::numeric_limits<double>::quiet_NaN();
    bool isErrorTold =
        false;             // errorPx is the engine's own number, not computed from the error and the bounds
    bool isTwice = false;  // drawn, although one of its ancestors is drawn too
    bool isSwitched = false;        // split or merged in this frame
    planet::TraceDataState data{};  // of kind 0, of the node that loads it
    bool isResident = true;
    std::uint32_t children = 0;         // that were told
    std::uint32_t missingChildren = 0;  // of these, whose data is not there

    // Returns whether it is drawn coarser than τ because data is missing.
    bool isStarved(double tauPx) const {
        return place == TracedPlace::Drawn && missingChildren > 0 && errorPx > tauPx;
    }
};

// A view of a frame.
struct TracedView {
    int view = 0;
    std::optional<planet::TraceView> info{};
    double tauPx = std::numeric_limits<double>::quiet_NaN();  // NaN: not told
    double hysteresis = 0;
    std::vector<TracedNode>
        nodes{};  // drawn, split and culled ones, and the children of drawn and split ones
    std::vector<planet::TraceSwitch> switches{};  // since the frame before
    // Totals over drawn nodes. Nodes that are drawn twice count once.
    std::uint64_t drawn = 0;
    std::uint64_t triangles = 0;                                     // of nodes that told them
    double worstErrorPx = std::numeric_limits<double>::quiet_NaN();  // NaN: no error is known
    std::uint64_t worstNode = 0;                                     // id
    std::uint64_t overTau = 0;                                       // nodes
    std::uint64_t starved = 0;                                       // nodes

    const TracedNode* find(std::uint64_t id) const;  // nullptr: not in this view
};

// Data that was requested and has not arrived.
struct TracedRequest {
    planet::TraceNode node;
    std::uint8_t kind = 0;
    bool isStarted = false;
    double ageS = 0;  // from the request to the end of the frame, monotonic clock; NaN: unknown
    float priority = std::numeric_limits<float>::quiet_NaN();  // NaN: not told
};

struct TracedFrame {
    std::optional<planet::TraceDescription> description{};
    planet::TraceFrame frame;  // without its views
    std::vector<TracedView> views{};
    std::vector<TracedRequest> queue{};  // the oldest first, at most maxTracedRequests
    std::uint64_t queued = 0;
    std::array<std::uint64_t, planet::maxTraceKinds> resident{};  // nodes, by kind
    std::map<std::string, planet::TraceSettingValue> settings{};
    std::map<std::string, double> counters{};  // of this frame
    std::map<int, std::string> threads{};
    std::vector<std::uint64_t> pagedIds{};  // of frame.paged: the nodes' ids
    std::vector<std::string> reasons{};     // of frame.paged: why a step failed, else empty

    const TracedView* view(int which) const;  // nullptr: not in this frame
};
inline constexpr std::size_t maxTracedRequests = 2000;

// Builds frames from the state of a trace. One thread at a time.
class TracedFrameBuilder {
public:
    // Takes state.frame(), which has just ended. Frames in order know their switches.
    void add(const planet::TraceState& state);
    // Returns the frame that was added last; state has not changed since.
    std::shared_ptr<const TracedFrame> build(const planet::TraceState& state) const;

private:
    std::map<int, planet::TraceSwitchFinder> views_;
    std::map<int, std::vector<planet::TraceSwitch>> switches_;  // of the last frame
};

// Returns a node's name: planet::traceIdText. description: none stands for opaque ids.
std::string tracedName(const std::optional<planet::TraceDescription>& description, std::uint64_t id);

}  // namespace worldy
