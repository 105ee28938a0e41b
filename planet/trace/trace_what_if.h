// Selects again over a whole trace, with other settings, and compares the cost and the error with what the engine
// did. With the engine's own settings it finds where the engine's choice is not what its own numbers say. trace_selector.h
// selects, and says what is approximate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "planet/base/result.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_selector.h"

namespace planet {

// Means and largest values over the frames of a view.
struct TraceSelectionTotals {
    std::uint64_t frames = 0;
    double meanDrawn = 0, meanTriangles = 0, meanBytes = 0;
    std::uint64_t mostDrawn = 0, mostTriangles = 0, mostBytes = 0;
    double meanErrorPx = std::numeric_limits<double>::quiet_NaN();   // of the largest errors of the frames
    double worstErrorPx = std::numeric_limits<double>::quiet_NaN();  // NaN: no error is known
    std::uint64_t worstFrame = 0;
    std::uint64_t worstNode = 0;  // id
    std::uint64_t splits = 0, merges = 0;
    // Sums over frames of nodes that are drawn for want of something; see TraceSelection.
    std::uint64_t unknown = 0, waiting = 0, limited = 0;
    std::uint64_t unknownFrames = 0;  // with at least one unknown: the totals are bounds
};

// Adds the frames of a view up.
class TraceSelectionTally {
public:
    // worstNode: the id of selection.worstNode; it does not matter if that is noTraceNode.
    void add(std::uint64_t frame, const TraceSelection& selection, std::uint64_t worstNode);
    TraceSelectionTotals totals() const;

private:
    TraceSelectionTotals totals_;
    double drawn_ = 0, triangles_ = 0, bytes_ = 0, errorPx_ = 0;  // sums
    std::uint64_t errors_ = 0;
};

// One selection beside the engine's, in one view.
struct TraceWhatIfRow {
    TraceSelectorSettings settings{};
    TraceSelectionTotals totals{};
    std::uint64_t framesThatDiffer = 0;  // in which it draws other nodes than the engine
    std::uint64_t nodesThatDiffer = 0;   // that only one of the two draws, summed over frames
};

struct TraceWhatIfView {
    int view = 0;
    TraceSelectionTotals engine{};
    TraceWhatIfRow own{};                // the engine's own settings and data; without τ it has no frames
    std::vector<TraceWhatIfRow> rows{};  // in the order of the settings
};

enum class TraceDisagreementKind : std::uint8_t {
    TooCoarse,  // drawn although its error exceeds τ and its children are there
    TooFine,  // split although its error does not exceed τ, or τ (1 - hysteresis) if it was split before, or beyond max_level
};

// A node for which the engine did not do what its own numbers say, in frames that follow each other.
struct TraceDisagreement {
    TraceDisagreementKind kind = TraceDisagreementKind::TooCoarse;
    int view = 0;
    std::uint64_t node = 0;  // id
    std::uint64_t firstFrame = 0, lastFrame = 0, frames = 0;
    double errorPx = 0;    // of the frame in which it is furthest from the limit
    double limitPx = 0;    // τ, or τ (1 - hysteresis)
    bool isFade = false;   // the engine tells fade_s, and this may be a switch that waits for it
    std::string sentence;  // for users
};

struct TraceWhatIfReport {
    std::optional<TraceDescription> description{};
    std::uint64_t frames = 0;
    std::uint64_t skippedFrames = 0;  // lost events or their end: what the engine drew is not known
    std::vector<TraceWhatIfView> views{};
    std::vector<TraceDisagreement> disagreements{};  // in the order in which they begin, fades too
    std::uint64_t unlistedDisagreements = 0;         // sightings beyond the limit of the list
    std::uint64_t framesThatDisagree = 0;            // of all views together, without fades
    std::optional<std::string> problem{};            // where the trace is damaged or cut off
    bool isDamaged = false;                          // of the problem: a block has wrong bytes
};

// Returns why it is not known whether the engine's choice is what its own numbers say; nullptr if it is. Pure.
const char* whyTraceIsNotJudged(const TraceWhatIfReport& report);
const char* whyTraceIsNotJudged(const TraceWhatIfView& view);

// Takes the frames of a trace in order. One thread at a time.
class TraceWhatIf {
public:
    // Called with each selection of each frame. row: of the settings; -1 the engine's own settings, -2 what the engine drew.
    using Watch = std::function<void(const TraceState&, int view, int row, const TraceSelection&)>;

    static constexpr double errorSlack = 1e-4;  // share of a threshold within which either choice is right
    static constexpr std::size_t maxDisagreements = 10'000;

    explicit TraceWhatIf(std::span<const TraceSelectorSettings> settings, Watch watch = {});

    // Takes state.frame(), which has just ended. described: see TraceEngineFrame::take.
    void add(const TraceState& state, std::span<const char> described = {});
    // Ends the trace. Call it once.
    TraceWhatIfReport finish(const TraceState& state);

private:
    struct Run {
        TraceSelector selector;
        TraceSelectionTally tally;
        std::uint64_t frames = 0, nodes = 0;  // that differ
    };
    struct View {
        int view = 0;
        TraceEngineFrame frame;
        TraceLevelCounter counter;
        TraceSelectionTally engine;
        TraceSelector judge;
        Run own;
        std::vector<Run> runs;
    };
    struct Open {
        std::size_t place = 0;  // in the report's list
        double sinceS = 0;
    };
    struct Sighting {
        TraceDisagreementKind kind;
        TraceNodeIndex node;
        double errorPx, limitPx;
        bool isMorphed;
    };

    View& viewOf(int view);
    void run(const TraceState& state, View& view, Run& run, int row);
    void judge(const TraceState& state, View& view);
    void note(const TraceState& state, int view, const Sighting& seen, double fadeWaitS);
    static void add(const TraceState& state, const TraceSelection& selection, TraceSelectionTally& tally);
    static TraceWhatIfRow rowOf(const Run& run);

    std::vector<TraceSelectorSettings> settings_;
    Watch watch_;
    TraceWhatIfReport report_;
    std::vector<View> views_;
    std::unordered_map<std::uint64_t, Open> open_;  // by kind, view and node
    std::uint64_t frameBefore_ = 0;                 // number of the last frame that was judged
    std::uint64_t disagreedFrame_ = 0;
};

// Reads a whole trace twice: the descriptions of its nodes, so that nodes count as known before the engine described them,
// and its frames. Memory: some hundred bytes for each node, and 16 for each node and each of the settings. goOn is called
// now and then; returning false ends with an Error of the kind Cancelled. A damaged trace gives a report of what came before.
Result<TraceWhatIfReport> whatIfOfTrace(TraceFile& file, std::span<const TraceSelectorSettings> settings,
                                        const std::function<bool()>& goOn = {},
                                        const TraceWhatIf::Watch& watch = {});

// ---- sweeps ----

enum class TraceCost : std::uint8_t { Bytes, Triangles };
// Returns which rows are on the Pareto front of the largest error and the largest cost of a frame: no other row is better in
// one and not worse in the other. Rows without a known error are not on it. Pure.
std::vector<bool> traceFront(std::span<const TraceWhatIfRow> rows, TraceCost cost);

// Limits of a frame, in each view. An unset one always holds.
struct TraceTauGoal {
    std::optional<double> errorPx{};    // > 0
    std::optional<double> bytes{};      // that the view needs, > 0
    std::optional<double> triangles{};  // > 0
};
struct TraceTauSuggestion {
    double tauPx = 0;
    bool isMet =
        false;  // false: no τ meets all limits, and this one meets the limit of the cost, or is nearest to it
    bool isBound = false;  // some nodes were not known, so the cost may be larger
    // The largest of all views at this τ.
    double errorPx = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t bytes = 0, triangles = 0;
};
// Finds the smallest τ that meets the limits of bytes and triangles; without those the largest that meets the limit of the
// error. To 1 %, between 0.05 and 100 px. settings: all but τ. Reads the trace at most six times.
Result<TraceTauSuggestion> suggestTraceTau(TraceFile& file, const TraceSelectorSettings& settings,
                                           const TraceTauGoal& goal, const std::function<bool()>& goOn = {});

}  // namespace planet
