#include "planet/trace/trace_what_if.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planet/base/try.h"
#include "planet/trace/trace_faults.h"
#include "planet/trace/trace_reading.h"

namespace planet {

namespace {

// The descriptions of a trace's nodes, each as the engine told it first.
class DescribedNodes {
public:
    void add(const TraceEvent& event) {
        const TraceNodeTold* told = std::get_if<TraceNodeTold>(&event);
        if (!told) return;
        if (told->index >= nodes_.size()) nodes_.resize(told->index + 1);
        TraceNode& node = nodes_[told->index];
        if (!node.isTold) node = told->node;
    }
    void tell(TraceState& state) const {
        for (TraceNodeIndex node = 0; node < nodes_.size(); ++node)
            state.add(TraceNodeTold{node, nodes_[node]});
    }
    bool isTold(TraceNodeIndex node) const { return node < nodes_.size() && nodes_[node].isTold; }
    std::size_t size() const { return nodes_.size(); }

private:
    std::vector<TraceNode> nodes_;
};

// Reads only definitions where it can. What cannot be read is told when the frames are.
Result<DescribedNodes> describedNodes(TraceFile& file, const std::function<bool()>& goOn) {
    DescribedNodes nodes;
    const TraceDecoder::Sink sink = [&](const TraceEvent& event) { nodes.add(event); };
    const std::optional<TraceFrameRange> range = file.frames();
    if (!file.seek(range ? range->last : 0, sink)) return nodes;
    for (auto more = file.next(sink); more && *more; more = file.next(sink))
        if (goOn && !goOn()) return cancelled();
    (void)file.nextCut(sink);
    return nodes;
}

std::vector<double> tausBetween(double smallestPx, double largestPx, int count) {
    std::vector<double> taus;
    for (int i = 0; i < count; ++i)
        taus.push_back(smallestPx * std::pow(largestPx / smallestPx, static_cast<double>(i) / (count - 1)));
    return taus;
}

}  // namespace

// ---- totals ----

void TraceSelectionTally::add(std::uint64_t frame, const TraceSelection& selection, std::uint64_t worstNode) {
    ++totals_.frames;
    drawn_ += static_cast<double>(selection.drawn.size());
    triangles_ += static_cast<double>(selection.triangles);
    bytes_ += static_cast<double>(selection.bytes);
    totals_.mostDrawn = std::max<std::uint64_t>(totals_.mostDrawn, selection.drawn.size());
    totals_.mostTriangles = std::max(totals_.mostTriangles, selection.triangles);
    totals_.mostBytes = std::max(totals_.mostBytes, selection.bytes);
    totals_.splits += selection.splits;
    totals_.merges += selection.merges;
    totals_.unknown += selection.unknown;
    totals_.waiting += selection.waiting;
    totals_.limited += selection.limited;
    totals_.unknownFrames += selection.unknown > 0;
    if (std::isnan(selection.worstErrorPx)) return;
    errorPx_ += selection.worstErrorPx;
    ++errors_;
    if (selection.worstErrorPx <= totals_.worstErrorPx) return;
    totals_.worstErrorPx = selection.worstErrorPx;
    totals_.worstFrame = frame;
    totals_.worstNode = worstNode;
}

TraceSelectionTotals TraceSelectionTally::totals() const {
    TraceSelectionTotals totals = totals_;
    const auto frames = static_cast<double>(std::max<std::uint64_t>(totals.frames, 1));
    totals.meanDrawn = drawn_ / frames;
    totals.meanTriangles = triangles_ / frames;
    totals.meanBytes = bytes_ / frames;
    if (errors_ > 0) totals.meanErrorPx = errorPx_ / static_cast<double>(errors_);
    return totals;
}

// ---- the frames ----

TraceWhatIf::TraceWhatIf(std::span<const TraceSelectorSettings> settings, Watch watch)
    : settings_(settings.begin(), settings.end()), watch_(std::move(watch)) {}

TraceWhatIf::View& TraceWhatIf::viewOf(int view) {
    const auto found = std::ranges::find(views_, view, &View::view);
    if (found != views_.end()) return *found;
    TraceSelectorSettings own;
    own.residency = TraceResidency::AsTraced;
    TraceSelectorSettings judging = own;
    judging.followSlack = errorSlack;
    View made{view, {}, {}, {}, TraceSelector(judging), {TraceSelector(own), {}}, {}};
    for (const TraceSelectorSettings& each : settings_) made.runs.push_back({TraceSelector(each), {}});
    views_.push_back(std::move(made));
    return views_.back();
}

void TraceWhatIf::add(const TraceState& state, std::span<const char> described) {
    const TraceFrame& frame = state.frame();
    ++report_.frames;
    if (!frame.isComplete()) {
        ++report_.skippedFrames;
        return;
    }
    for (const TraceFrameView& each : frame.views) {
        View& view = viewOf(each.view);
        view.frame.take(state, each, described);
        TraceSelection drawn = engineSelection(state, view.frame);
        view.counter.count(state, view.frame.hasBefore(), drawn);
        add(state, drawn, view.engine);
        if (watch_) watch_(state, view.view, -2, drawn);
        run(state, view, view.own, -1);
        for (std::size_t row = 0; row < view.runs.size(); ++row)
            run(state, view, view.runs[row], static_cast<int>(row));
        judge(state, view);
    }
    frameBefore_ = frame.number;
}

void TraceWhatIf::run(const TraceState& state, View& view, Run& run, int row) {
    const TraceSelection* const selection = run.selector.select(state, view.frame);
    if (!selection) return;
    add(state, *selection, run.tally);
    const auto both = static_cast<std::uint64_t>(std::ranges::count_if(
        selection->drawn, [&](TraceNodeIndex node) { return view.frame.isDrawn(node); }));
    const std::uint64_t differ = selection->drawn.size() + view.frame.drawn().size() - 2 * both;
    run.frames += differ > 0;
    run.nodes += differ;
    if (watch_) watch_(state, view.view, row, *selection);
}

void TraceWhatIf::add(const TraceState& state, const TraceSelection& selection, TraceSelectionTally& tally) {
    const bool hasWorst = selection.worstNode != noTraceNode;
    tally.add(state.frame().number, selection, hasWorst ? state.nodes()[selection.worstNode].node.id : 0);
}

// Compares the engine's choice with what its settings and errors say, given what it had split before.
void TraceWhatIf::judge(const TraceState& state, View& view) {
    const TraceEngineFrame& engine = view.frame;
    const TraceSelection* const right = view.judge.select(state, engine);
    if (!right) return;
    const double tauPx = *state.setting("tau", view.view);
    const double mergePx = tauPx * (1 - state.setting("hysteresis", view.view).value_or(0));
    const double fadeWaitS = traceFadeWaitS(state, view.view);
    const auto limitOf = [&](TraceNodeIndex node) {
        return engine.hasBefore() && !engine.wasSplit(node) ? tauPx : mergePx;
    };
    for (const TraceDrawn& drawn : engine.view().drawn) {
        if (!view.judge.isSplit(drawn.node) || engine.isSplit(drawn.node)) continue;
        note(state, view.view,
             {TraceDisagreementKind::TooCoarse, drawn.node, engine.errorPx(state, drawn.node, true),
              limitOf(drawn.node), drawn.morph > 0},
             fadeWaitS);
    }
    for (const TraceNodeIndex node : right->drawn) {
        if (!engine.isSplit(node) || engine.isDrawn(node)) continue;
        note(state, view.view,
             {TraceDisagreementKind::TooFine, node, engine.errorPx(state, node, true), limitOf(node), false},
             fadeWaitS);
    }
}

void TraceWhatIf::note(const TraceState& state, int view, const Sighting& seen, double fadeWaitS) {
    const TraceFrame& frame = state.frame();
    const bool isCoarse = seen.kind == TraceDisagreementKind::TooCoarse;
    const std::uint64_t key =
        static_cast<std::uint64_t>(seen.kind) << 63 | static_cast<std::uint64_t>(view) << 32 | seen.node;
    const auto [found, isNew] = open_.try_emplace(key, Open{report_.disagreements.size(), frame.timeS});
    const bool goesOn = !isNew && report_.disagreements[found->second.place].lastFrame >=
                                      std::min(frameBefore_, frame.number);
    if (!goesOn && report_.disagreements.size() >= maxDisagreements) {
        open_.erase(found);
        ++report_.unlistedDisagreements;
        return;
    }
    if (!goesOn) {
        found->second = {report_.disagreements.size(), frame.timeS};
        TraceDisagreement& fresh = report_.disagreements.emplace_back();
        fresh.kind = seen.kind;
        fresh.view = view;
        fresh.node = state.nodes()[seen.node].node.id;
        fresh.firstFrame = frame.number;
        fresh.errorPx = seen.errorPx;
        fresh.limitPx = seen.limitPx;
        fresh.isFade = fadeWaitS > 0;
    }
    TraceDisagreement& it = report_.disagreements[found->second.place];
    it.lastFrame = frame.number;
    ++it.frames;
    const bool mayFade = fadeWaitS > 0 && (seen.isMorphed || frame.timeS - found->second.sinceS <= fadeWaitS);
    it.isFade = it.isFade && mayFade;
    if (!it.isFade && disagreedFrame_ != frame.number) {
        disagreedFrame_ = frame.number;
        ++report_.framesThatDisagree;
    }
    if (isCoarse ? seen.errorPx > it.errorPx : seen.errorPx < it.errorPx) {
        it.errorPx = seen.errorPx;
        it.limitPx = seen.limitPx;
    }
    const std::string frames = traceFramesText(it.frames, it.firstFrame, it.lastFrame);
    const std::string name = traceIdText(state.descriptionOrDefault(), it.node);
    const std::uint32_t level = state.nodes()[seen.node].node.level;
    const double deepest = state.setting("max_level", view).value_or(std::numeric_limits<double>::infinity());
    if (isCoarse) {
        it.sentence = fmt::format(
            "{} is drawn with {:.3f} px although its children are there, {}; expected at most {:g} px", name,
            it.errorPx, frames, it.limitPx);
    } else if (level >= deepest) {
        // Its error may exceed the limit, so that is not why.
        it.sentence = fmt::format("{} of level {} is split, {}; expected no split from max_level {:g} on",
                                  name, level, frames, deepest);
    } else {
        it.sentence = fmt::format("{} is split with {:.3f} px, {}; expected more than {:g} px", name,
                                  it.errorPx, frames, it.limitPx);
    }
}

TraceWhatIfRow TraceWhatIf::rowOf(const Run& run) {
    return {run.selector.settings(), run.tally.totals(), run.frames, run.nodes};
}

TraceWhatIfReport TraceWhatIf::finish(const TraceState& state) {
    report_.description = state.description();
    for (const View& view : views_) {
        TraceWhatIfView& made = report_.views.emplace_back();
        made.view = view.view;
        made.engine = view.engine.totals();
        made.own = rowOf(view.own);
        for (const Run& run : view.runs) made.rows.push_back(rowOf(run));
    }
    std::ranges::sort(report_.views, {}, &TraceWhatIfView::view);
    return std::move(report_);
}

const char* whyTraceIsNotJudged(const TraceWhatIfView& view) {
    if (view.own.totals.frames == 0) return "the engine told no tau";
    return std::isnan(view.engine.worstErrorPx) ? "no error of a drawn node is known" : nullptr;
}

const char* whyTraceIsNotJudged(const TraceWhatIfReport& report) {
    const char* why = "no frame is complete";
    for (const TraceWhatIfView& view : report.views) {
        why = whyTraceIsNotJudged(view);
        if (!why) return nullptr;
    }
    return why;
}

Result<TraceWhatIfReport> whatIfOfTrace(TraceFile& file, std::span<const TraceSelectorSettings> settings,
                                        const std::function<bool()>& goOn, const TraceWhatIf::Watch& watch) {
    TRY_ASSIGN(const DescribedNodes nodes, describedNodes(file, goOn));
    TraceState state;
    TraceWhatIf whatIf(settings, watch);
    std::vector<char> described(nodes.size(), 0);
    std::vector<TraceNodeIndex> fresh;  // of the block that is read
    const TraceDecoder::Sink sink = [&](const TraceEvent& event) {
        if (const auto* told = std::get_if<TraceNodeTold>(&event)) {
            // A node that is named before it is described keeps its description.
            if (!told->node.isTold && nodes.isTold(told->index)) return;
            fresh.push_back(told->index);
        }
        const bool isFrame = state.add(event);
        if (std::holds_alternative<TraceRestarted>(event)) nodes.tell(state);
        if (isFrame) whatIf.add(state, described);
    };
    const auto blockEnded = [&] {
        described.resize(std::max(described.size(), state.nodes().size()), 0);
        for (const TraceNodeIndex node : fresh) described[node] = 1;
        fresh.clear();
    };
    TRY_ASSIGN(TraceEnd end, readTrace(file, goOn, sink, blockEnded));
    TraceWhatIfReport report = whatIf.finish(state);
    report.problem = std::move(end.problem);
    report.isDamaged = end.isDamaged;
    return report;
}

// ---- sweeps ----

std::vector<bool> traceFront(std::span<const TraceWhatIfRow> rows, TraceCost cost) {
    const auto costOf = [&](const TraceWhatIfRow& row) {
        return cost == TraceCost::Bytes ? row.totals.mostBytes : row.totals.mostTriangles;
    };
    std::vector<bool> front;
    for (const TraceWhatIfRow& row : rows) {
        const double errorPx = row.totals.worstErrorPx;
        const bool isBeaten = std::ranges::any_of(rows, [&](const TraceWhatIfRow& other) {
            const double otherPx = other.totals.worstErrorPx;
            return (otherPx < errorPx && costOf(other) <= costOf(row)) ||
                   (otherPx <= errorPx && costOf(other) < costOf(row));
        });
        front.push_back(!std::isnan(errorPx) && !isBeaten);
    }
    return front;
}

namespace {

TraceTauSuggestion suggestionAt(double tauPx, std::size_t row, const TraceWhatIfReport& report) {
    TraceTauSuggestion found;
    found.tauPx = tauPx;
    for (const TraceWhatIfView& view : report.views) {
        const TraceSelectionTotals& totals = view.rows[row].totals;
        found.errorPx = std::fmax(found.errorPx, totals.worstErrorPx);
        found.bytes = std::max(found.bytes, totals.mostBytes);
        found.triangles = std::max(found.triangles, totals.mostTriangles);
        found.isBound = found.isBound || totals.unknownFrames > 0;
    }
    return found;
}

bool meetsCost(const TraceTauGoal& goal, const TraceTauSuggestion& found) {
    return (!goal.bytes || static_cast<double>(found.bytes) <= *goal.bytes) &&
           (!goal.triangles || static_cast<double>(found.triangles) <= *goal.triangles);
}

bool meetsError(const TraceTauGoal& goal, const TraceTauSuggestion& found) {
    return !goal.errorPx || found.errorPx <= *goal.errorPx;
}

}  // namespace

Result<TraceTauSuggestion> suggestTraceTau(TraceFile& file, const TraceSelectorSettings& settings,
                                           const TraceTauGoal& goal, const std::function<bool()>& goOn) {
    constexpr double smallestPx = 0.05, largestPx = 100, accuracy = 1.01;
    constexpr int tausInPass = 16, mostPasses = 3;
    const bool byCost = goal.bytes || goal.triangles;
    double fromPx = smallestPx, toPx = largestPx;
    TraceTauSuggestion best;
    for (int pass = 0; pass < mostPasses && toPx / fromPx > accuracy; ++pass) {
        const std::vector<double> taus = tausBetween(fromPx, toPx, tausInPass);
        std::vector<TraceSelectorSettings> swept(taus.size(), settings);
        for (std::size_t i = 0; i < taus.size(); ++i) swept[i].tauPx = taus[i];
        TRY_ASSIGN(const TraceWhatIfReport report, whatIfOfTrace(file, swept, goOn));
        if (report.isDamaged) return badInput(*report.problem);
        std::vector<TraceTauSuggestion> found;
        for (std::size_t i = 0; i < taus.size(); ++i) found.push_back(suggestionAt(taus[i], i, report));
        const auto holds = [&](const TraceTauSuggestion& one) {
            return byCost ? meetsCost(goal, one) : meetsError(goal, one);
        };
        // The wanted τ is at an end of those that hold: the smallest for a cost, the largest for an error.
        std::size_t place = byCost ? taus.size() - 1 : 0;
        if (byCost) {
            while (place > 0 && holds(found[place - 1])) --place;
            fromPx = taus[place > 0 ? place - 1 : 0];
            toPx = taus[place];
        } else {
            while (place + 1 < taus.size() && holds(found[place + 1])) ++place;
            fromPx = taus[place];
            toPx = taus[std::min(place + 1, taus.size() - 1)];
        }
        best = found[place];
        best.isMet = meetsCost(goal, best) && meetsError(goal, best);
        if (!holds(best)) return best;
    }
    return best;
}

}  // namespace planet
