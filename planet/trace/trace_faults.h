// Finds faults of an engine's level of detail in its trace. Each fault names the frames, the view and the nodes.
//
// | fault          | what is wrong                                                                                        |
// |----------------|------------------------------------------------------------------------------------------------------|
// | DrawnTwice     | a node and its ancestor are drawn in one view                                                        |
// | Hole           | a visible part of a split node is not drawn                                                          |
// | Thrash         | a node splits and merges again and again                                                             |
// | LatePage       | data arrives long after it was requested, or fails or does not arrive at all                         |
// | Starvation     | a node is drawn coarser than τ for long because its children's data is not there                     |
// | LevelStep      | two neighbours that are drawn differ by more than one level                                          |
// | TooCoarse      | nodes exceed τ for long although their children's data is there: selection ignores its own τ         |
// | TooFine        | most drawn nodes have a parent that would do: selection ignores its own τ                            |
//
// A trace is judged only by what the engine tells: without views no Hole, without τ no Starvation, TooCoarse and TooFine, without
// bounds or ids no LevelStep, without parents nothing but LatePage. A frame that lost events is not judged. If the engine tells
// fade_s, a node counts for TooCoarse and TooFine only once it has waited longer than traceFadeWaitS().
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "planet/trace/trace_state.h"

namespace planet {

enum class TraceFaultKind : std::uint8_t {
    DrawnTwice,
    Hole,
    Thrash,
    LatePage,
    Starvation,
    LevelStep,
    TooCoarse,
    TooFine,
};
const char* traceFaultName(TraceFaultKind kind);

struct TraceFaultLimits {
    double thrashWithinS = 1;  // a change back counts if it comes within this time, engine's seconds, > 0
    int thrashReversals = 3;   // changes back of one node, each soon after the last, that make a fault, >= 1
    double lateAfterS = 0.5;   // from request to arrival, engine's seconds, > 0
    double starvedAfterS = 0.5;  // drawn too coarse, engine's seconds, > 0
    double ignoredAfterS = 0.5;  // the same with data there, after the wait for fades, engine's seconds, > 0
    double errorSlack = 1e-4;    // share of τ by which errors may differ from the engine's own, [0, 1]
    double tooFineShare = 0.5;   // of drawn nodes with a parent; splits for balance are a smaller one, (0, 1]
    std::size_t maxFaults = 10'000;  // that are listed, >= 1
};

struct TraceFault {
    TraceFaultKind kind = TraceFaultKind::DrawnTwice;
    std::uint64_t firstFrame = 0;
    std::uint64_t lastFrame = 0;
    std::uint64_t frames = 0;  // in which it was seen
    int view = -1;             // -1: of no view
    std::uint64_t node =
        0;  // id. DrawnTwice: the descendant; LevelStep: the finer one; TooCoarse, TooFine: the worst one
    bool hasOther = false;
    std::uint64_t other =
        0;  // id. DrawnTwice: the ancestor; Hole: the split parent; Starvation: what is missing;
            // LevelStep: the coarser neighbour
    double value =
        0;  // Thrash: changes back; LatePage, Starvation: seconds; LevelStep: levels; Too...: largest error, px
    double limit = 0;         // of the value: TraceFaultLimits, τ, or 1 level
    std::uint64_t count = 0;  // TooCoarse, TooFine: most nodes in a frame
    std::string sentence;     // for users; names the nodes by traceIdText
};

// Returns "in frame 12" or "in 3 frames from 12 to 14". Pure.
std::string traceFramesText(std::uint64_t frames, std::uint64_t first, std::uint64_t last);

// Takes the frames of a trace in order. One thread at a time.
class TraceFaultFinder {
public:
    explicit TraceFaultFinder(const TraceFaultLimits& limits = {}) : limits_(limits) {}

    // Takes state.frame(), which has just ended.
    void add(const TraceState& state);
    // Ends the trace: requests that are still pending become faults if they are late.
    void finish(const TraceState& state);

    // Returns the faults so far, in the order in which they were found.
    const std::vector<TraceFault>& faults() const { return faults_; }
    std::uint64_t unlisted() const { return unlisted_; }  // sightings beyond TraceFaultLimits::maxFaults

private:
    // A fault that goes on while it is seen in each frame.
    struct Key {
        TraceFaultKind kind;
        int view;
        TraceNodeIndex node;
        TraceNodeIndex other;
        bool operator==(const Key&) const = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const;
    };
    struct Change {
        double timeS = 0;
        bool isSplit = false;
        int reversals = 0;
        std::uint64_t firstFrame = 0;
    };
    // The drawn nodes of a view, by node: stamps are frames_ of the last frame in which it holds.
    struct ViewMemory {
        std::vector<std::uint32_t> drawn, below;              // below: a descendant is drawn
        std::vector<std::uint32_t> drawnBefore, belowBefore;  // of the frame before
        std::vector<std::uint32_t> culled;
        std::vector<TraceNodeIndex> split, splitBefore;  // nodes with a drawn descendant
        std::vector<TraceNodeIndex> list, listBefore;    // drawn nodes
        std::uint32_t frame = 0;                         // frames_ when it was told last
        std::unordered_map<TraceNodeIndex, Change> changes;
        std::unordered_map<TraceNodeIndex, double> coarseSinceS;
        std::unordered_map<TraceNodeIndex, double> starvedSinceS;
        std::unordered_map<TraceNodeIndex, double> fineNodeSinceS;
        double fineSinceS = 0;
        bool isFine = false;
    };

    // The errors of one view in one frame.
    struct ErrorTally {
        double tauPx = 0;
        double mergePx = 0;  // τ (1 - hysteresis)
        double maxLevel = 0;
        double fadeWaitS = 0;
        std::unordered_map<TraceNodeIndex, double> coarseSinceS, starvedSinceS, fineNodeSinceS;
        std::uint64_t coarse = 0, fine = 0, withParent = 0;  // nodes
        TraceNodeIndex worstCoarse = noTraceNode, worstFine = noTraceNode;
        double worstCoarsePx = 0, worstFinePx = 0;
    };

    void markView(const TraceState& state, const TraceFrameView& view, ViewMemory& memory);
    void findHoles(const TraceState& state, const TraceFrameView& view, const ViewMemory& memory);
    void findThrash(const TraceState& state, int view, ViewMemory& memory);
    void noteChange(const TraceState& state, int view, ViewMemory& memory, TraceNodeIndex node, bool isSplit);
    void findLate(const TraceState& state);
    void late(const TraceState& state, TraceNodeIndex node, const TraceDataState& request, const char* end,
              double endS, std::uint64_t endNs);
    void judgeErrors(const TraceState& state, const TraceFrameView& view, ViewMemory& memory);
    void judgeCoarse(const TraceState& state, const TraceFrameView& view, const ViewMemory& memory,
                     const TraceDrawn& drawn, ErrorTally& tally);
    void judgeFine(const TraceState& state, const TraceFrameView& view, const ViewMemory& memory,
                   TraceNodeIndex node, ErrorTally& tally) const;
    void reportCoarse(const TraceState& state, int view, const ErrorTally& tally);
    void reportFine(const TraceState& state, const TraceFrameView& view, const ErrorTally& tally);
    void findSteps(const TraceState& state, const TraceFrameView& view, const ViewMemory& memory);
    void findStepsById(const TraceState& state, int view, const ViewMemory& memory);
    void findStepsByBounds(const TraceState& state, int view, const ViewMemory& memory);
    void step(const TraceState& state, int view, TraceNodeIndex finer, TraceNodeIndex coarser);
    // Returns the fault with this key if it was seen in the frame before or in this one, or a new one.
    TraceFault& note(const TraceState& state, const Key& key, std::uint64_t firstFrame = 0);

    TraceFaultLimits limits_;
    std::vector<TraceFault> faults_;
    TraceFault unlistedFault_;
    std::uint64_t unlisted_ = 0;
    std::unordered_map<Key, std::size_t, KeyHash> open_;  // of faults_
    std::unordered_map<int, ViewMemory> views_;
    std::uint32_t frames_ = 0;
    std::uint64_t frameBefore_ = 0;  // number of the last frame that was judged
};

}  // namespace planet
