// Builds the state of each frame from the events of a trace: nodes, what each view drew, paging, counters and settings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "planet/trace/trace_events.h"

namespace planet {

inline constexpr TraceNodeIndex noTraceNode = 0xFFFFFFFFu;
// A node lists no more children than this, so that a hostile trace costs no quadratic time.
inline constexpr std::size_t maxTraceChildren = 4096;

// The state of a node's data of one kind.
struct TraceDataState {
    TraceData data = TraceData::Absent;
    // The time of the request, in the states Requested and Started. The engine's time and the frame are 0 and NaN if the stream began later.
    std::uint64_t requestedNs = 0;
    std::uint64_t startedNs = 0;  // of Started
    double requestedS = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t requestedFrame = 0;
    float priority = std::numeric_limits<float>::quiet_NaN();  // NaN: unknown
};

struct TraceNodeState {
    TraceNode node;
    TraceNodeIndex parent = noTraceNode;   // noTraceNode: a root, or the engine did not tell the parent
    std::vector<TraceNodeIndex> children;  // that were told
    std::array<TraceDataState, maxTraceKinds> data;
};

struct TraceFrameView {
    std::uint8_t view = 0;
    std::optional<TraceView> info;  // nothing: the engine did not tell it
    std::vector<TraceDrawn> drawn;  // in the engine's order
    std::vector<TraceCulled> culled;
};

// A step of paging, with what was known about the request before.
struct TracePagedStep {
    TracePaged event;
    TraceDataState before;
};

struct TraceFrame {
    std::uint64_t number = 0;
    double timeS = 0;           // the engine's clock
    std::uint64_t beginNs = 0;  // monotonic clock
    std::uint64_t endNs = 0;    // 0: not told
    double cpuMs = -1;          // negative: unknown
    double gpuMs = -1;
    std::uint64_t dropped = 0;          // events lost in or just before it
    bool isEnded = false;               // the engine told its end
    bool followsGap = false;            // the frame before it is missing
    std::vector<TraceFrameView> views;  // that were told or drew something, by number
    std::vector<TracePagedStep> paged;  // since the frame before
    std::vector<TraceCounted> counters;
    std::vector<TraceMessage> messages;

    // Returns whether nothing of it was lost, so that what is not in it was not drawn.
    bool isComplete() const { return isEnded && dropped == 0; }
    const TraceFrameView* view(std::uint8_t which) const;  // nullptr: not in this frame
};

// Takes events one by one. One thread at a time.
class TraceState {
public:
    // Returns true if the event ends a frame: frame() is that frame until the next call that returns true, and the rest of
    // the state is as it was at its end. A frame whose end was lost ends where the next one begins.
    bool add(const TraceEvent& event);

    const TraceFrame& frame() const { return done_; }
    const std::optional<TraceDescription>& description() const { return description_; }
    // Returns the description, or if the engine told none the one with all defaults: errors are world units, ids are opaque.
    const TraceDescription& descriptionOrDefault() const;
    const std::vector<TraceNodeState>& nodes() const { return nodes_; }
    TraceNodeIndex find(std::uint64_t id) const;  // noTraceNode: unknown
    const std::vector<std::string>& names() const { return names_; }
    const std::map<std::string, TraceSettingValue, std::less<>>& settings() const { return settings_; }
    const std::map<int, std::string>& threads() const { return threads_; }
    std::uint64_t droppedTotal() const { return droppedTotal_; }
    bool hasPaging() const { return hasPaging_; }  // the engine told a step of paging
    // Returns how many nodes have data of a kind in a state; Absent is not counted and is 0.
    std::uint64_t count(std::size_t kind, TraceData data) const {
        return counts_[kind][static_cast<std::size_t>(data)];
    }

    // Returns a setting that is a number, for a view: "name/view" if it is set, else "name"; nothing if neither is.
    std::optional<double> setting(std::string_view name, int view) const;

    // Returns whether a node's data of kind 0 is loaded: by TraceDescription::requests, its own request arrived, or its
    // parent's. True for all nodes if the engine told no paging.
    bool isResident(TraceNodeIndex node) const;
    // Returns the node whose request loads a node: itself or its parent; noTraceNode for a root that is always there.
    TraceNodeIndex loaderOf(TraceNodeIndex node) const;

private:
    void on(const TraceRestarted&);
    void on(const TraceKey&);
    void on(const TraceDescription& description) { description_ = description; }
    void on(const TraceNamed& named);
    void on(const TraceNodeTold& told);
    void on(const TraceFrameBegan& began);
    void on(const TraceFrameEnded& ended);
    void on(const TraceViewTold& told) { viewOf(told.view).info = told.info; }
    void on(const TraceDrawn& drawn) { viewOf(drawn.view).drawn.push_back(drawn); }
    void on(const TraceCulled& culled) { viewOf(culled.view).culled.push_back(culled); }
    void on(const TracePaged& paged);
    void on(const TraceCounted& counted) { current_.counters.push_back(counted); }
    void on(const TraceSet& set);
    void on(const TraceMessage& message) { current_.messages.push_back(message); }
    void on(const TraceDropped& dropped);
    void on(const TraceThreadNamed& named);
    void on(const TraceRestored& restored);

    TraceFrameView& viewOf(std::uint8_t view);
    void setParent(TraceNodeIndex child, TraceNodeIndex parent);
    void setData(std::size_t kind, TraceDataState& data, const TraceDataState& to);
    void finishFrame();

    std::optional<TraceDescription> description_;
    std::vector<TraceNodeState> nodes_;
    std::unordered_map<std::uint64_t, TraceNodeIndex> byId_;
    std::unordered_map<std::uint64_t, std::vector<TraceNodeIndex>>
        orphans_;  // by the id of a parent that is not told yet
    std::vector<std::string> names_;
    std::map<std::string, TraceSettingValue, std::less<>> settings_;
    std::map<int, std::string> threads_;
    std::array<std::array<std::uint64_t, 5>, maxTraceKinds> counts_{};  // by TraceData
    TraceFrame current_;  // in progress, or what happens between two frames
    TraceFrame done_;
    bool isInFrame_ = false;
    bool frameEnds_ = false;  // the event that is added ends a frame
    bool hasPaging_ = false;
    std::uint64_t lastNumber_ = 0;
    std::uint64_t droppedTotal_ = 0;
};

// Says to which point of a node a distance is measured.
enum class TraceMetric : std::uint8_t {
    Bounds,  // the sphere or box that the engine told; 0 inside
    Sphere,  // the sphere around a box; 0 inside
    Centre,  // of the bounds
};

// Returns the distance from a point to a node, world units; NaN without bounds. Pure, any thread.
double traceDistance(const TraceBounds& bounds, const glm::dvec3& point,
                     TraceMetric metric = TraceMetric::Bounds);

// Returns a node's error on screen, pixels: as told for TraceErrorUnit::Pixels, else error * K' / D, with K' =
// |projection[0][0]| W / 2 and D the distance by the metric, at least 1 mm. NaN if the bounds are not told. Pure, any thread.
double traceErrorPx(const TraceDescription& description, const TraceNode& node, const TraceView& view,
                    TraceMetric metric = TraceMetric::Bounds);

// Returns a node's id as text: "z_pos/3/5/2", face, level, x and y, if ids say so; "3/5/2" if the world is flat; else the
// number. Pure, any thread.
std::string traceIdText(const TraceDescription& description, std::uint64_t id);

// Returns how long a switch of level may wait for fades, seconds: for two times the setting fade_s, because nodes wait for
// their own fades and for those of their neighbours. 0 if the engine tells no fade_s.
double traceFadeWaitS(const TraceState& state, int view);

}  // namespace planet
