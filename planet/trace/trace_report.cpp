#include "planet/trace/trace_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planet/base/percentile.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr double thrashWithinS = 1;
constexpr int mostParents = 64;  // a hostile trace can link parents in a ring

double sinceS(std::uint64_t fromNs, std::uint64_t toNs) {
    return static_cast<double>(static_cast<std::int64_t>(toNs - fromNs)) * 1e-9;
}

// Returns whether a set has a node or one of its ancestors.
bool coversOne(const TraceState& state, const std::unordered_set<TraceNodeIndex>& drawn,
               TraceNodeIndex node) {
    for (int step = 0; step < mostParents && node != noTraceNode; ++step) {
        if (drawn.contains(node)) return true;
        node = state.nodes()[node].parent;
    }
    return false;
}

// Returns the ancestors of drawn nodes and of those that were culled.
std::unordered_set<TraceNodeIndex> splitNodes(const TraceState& state, const TraceFrameView& view) {
    std::unordered_set<TraceNodeIndex> split;
    const auto addAncestors = [&](TraceNodeIndex node) {
        TraceNodeIndex ancestor = state.nodes()[node].parent;
        for (int step = 0; step < mostParents && ancestor != noTraceNode; ++step) {
            if (!split.insert(ancestor).second) break;
            ancestor = state.nodes()[ancestor].parent;
        }
    };
    for (const TraceDrawn& each : view.drawn) addAncestors(each.node);
    for (const TraceCulled& each : view.culled) addAncestors(each.node);
    return split;
}

}  // namespace

TraceSpread spreadOf(std::vector<float>& values) {
    TraceSpread spread;
    std::erase_if(values, [](float value) { return std::isnan(value); });
    spread.count = values.size();
    if (values.empty()) return spread;
    spread.median = static_cast<double>(percentileOf(values, 0.5));
    spread.p99 = static_cast<double>(percentileOf(values, 0.99));
    spread.most = static_cast<double>(percentileOf(values, 1));
    return spread;
}

TraceReporter::TraceReporter(double budgetMs, const TraceFaultLimits& limits)
    : budgetMs_(budgetMs), finder_(limits) {}

void TraceReporter::add(const TraceState& state) {
    const TraceFrame& frame = state.frame();
    if (report_.frames++ == 0) {
        report_.firstFrame = frame.number;
        firstS_ = frame.timeS;
    }
    report_.lastFrame = frame.number;
    report_.durationS = frame.timeS - firstS_;
    if (frame.cpuMs >= 0) cpuMs_.push_back(static_cast<float>(frame.cpuMs));
    if (frame.gpuMs >= 0) gpuMs_.push_back(static_cast<float>(frame.gpuMs));
    report_.framesOverBudget += std::max(frame.cpuMs, frame.gpuMs) > budgetMs_;
    for (const TracePagedStep& step : frame.paged) addPaged(state, step);
    finder_.add(state);
    for (View& view : views_) {
        // Without all of its events, nothing in the next frame is a change.
        view.hasBefore = view.hasBefore && frame.isComplete() && !frame.followsGap &&
                         frame.view(static_cast<std::uint8_t>(view.report.view)) != nullptr;
    }
    for (const TraceFrameView& each : frame.views) {
        auto view = std::ranges::find(views_, int{each.view}, [](const View& v) { return v.report.view; });
        if (view == views_.end()) {
            views_.emplace_back().report.view = each.view;
            view = std::prev(views_.end());
        }
        addView(state, each, *view);
    }
}

void TraceReporter::addView(const TraceState& state, const TraceFrameView& frame, View& view) {
    TraceViewReport& report = view.report;
    ++report.frames;
    std::unordered_set<TraceNodeIndex> drawn;
    std::uint64_t triangles = 0;
    for (const TraceDrawn& each : frame.drawn) {
        if (drawn.insert(each.node).second) triangles += state.nodes()[each.node].node.triangles;
    }
    report.mostDrawn = std::max<std::uint64_t>(report.mostDrawn, drawn.size());
    report.mostTriangles = std::max(report.mostTriangles, triangles);
    view.drawnTotal += drawn.size();
    addErrors(state, frame, view);
    addChanges(state, frame, std::move(drawn), view);
}

void TraceReporter::addErrors(const TraceState& state, const TraceFrameView& frame, View& view) {
    TraceViewReport& report = view.report;
    const std::optional<double> tauPx = state.setting("tau", report.view);
    if (tauPx) report.tauPx = tauPx;
    bool isOver = false;
    for (const TraceDrawn& each : frame.drawn) {
        const TraceNode& node = state.nodes()[each.node].node;
        double errorPx = std::numeric_limits<double>::quiet_NaN();
        if (each.hasErrorPx)
            errorPx = static_cast<double>(each.errorPx);
        else if (node.isTold && frame.info && state.description())
            errorPx = traceErrorPx(*state.description(), node, *frame.info);
        if (std::isnan(errorPx)) continue;
        isOver = isOver || (tauPx && errorPx > *tauPx);
        if (errorPx <= report.worstErrorPx) continue;
        report.worstErrorPx = errorPx;
        report.worstFrame = state.frame().number;
        report.worstNode = node.id;
    }
    report.framesOverTau += isOver;
}

void TraceReporter::addChanges(const TraceState& state, const TraceFrameView& frame,
                               std::unordered_set<TraceNodeIndex> drawn, View& view) {
    std::unordered_set<TraceNodeIndex> split = splitNodes(state, frame);
    if (view.hasBefore) {
        for (const TraceNodeIndex node : split) {
            if (!view.split.contains(node) && coversOne(state, view.drawn, node))
                note(state, node, true, view);
        }
        for (const TraceNodeIndex node : view.split) {
            if (!split.contains(node) && coversOne(state, drawn, node)) note(state, node, false, view);
        }
    }
    view.hasBefore = state.frame().isComplete();
    view.drawn = std::move(drawn);
    view.split = std::move(split);
}

void TraceReporter::note(const TraceState& state, TraceNodeIndex node, bool isSplit, View& view) {
    ++(isSplit ? view.report.splits : view.report.merges);
    const double timeS = state.frame().timeS;
    const auto [last, isFirst] = view.changes.try_emplace(node, Change{timeS, isSplit});
    if (isFirst) return;
    const bool isBack = last->second.isSplit != isSplit && timeS - last->second.timeS < thrashWithinS;
    view.report.thrashes += isBack;
    last->second = {timeS, isSplit};
}

void TraceReporter::addPaged(const TraceState& state, const TracePagedStep& step) {
    auto kind = std::ranges::find(kinds_, int{step.event.kind}, [](const Kind& k) { return k.report.kind; });
    if (kind == kinds_.end()) {
        kinds_.emplace_back().report.kind = step.event.kind;
        kind = std::prev(kinds_.end());
    }
    TraceKindReport& report = kind->report;
    const bool wasPending =
        step.before.data == TraceData::Requested || step.before.data == TraceData::Started;
    const auto since = [&] { return static_cast<float>(sinceS(step.before.requestedNs, step.event.ns)); };
    switch (step.event.step) {
        case TraceStep::Requested:
            ++report.requested;
            break;
        case TraceStep::Started:
            if (wasPending && step.before.requestedNs != 0) kind->waitS.push_back(since());
            break;
        case TraceStep::Arrived:
            ++report.arrived;
            if (wasPending && step.before.requestedNs != 0) kind->latencyS.push_back(since());
            if (state.description() && state.description()->requests == TraceRequests::Children) {
                for (const TraceNodeIndex child : state.nodes()[step.event.node].children)
                    report.arrivedBytes += state.nodes()[child].node.bytes;
            } else {
                report.arrivedBytes += state.nodes()[step.event.node].node.bytes;
            }
            break;
        case TraceStep::Cancelled:
            ++report.cancelled;
            break;
        case TraceStep::Failed:
            ++report.failed;
            break;
        case TraceStep::Evicted:
            ++report.evicted;
            break;
    }
}

TraceReport TraceReporter::finish(const TraceState& state) {
    finder_.finish(state);
    report_.description = state.description();
    report_.nodes = state.nodes().size();
    report_.droppedEvents = state.droppedTotal();
    if (report_.frames > 0)
        report_.missingFrames = report_.lastFrame - report_.firstFrame + 1 - report_.frames;
    report_.cpuMs = spreadOf(cpuMs_);
    report_.gpuMs = spreadOf(gpuMs_);
    for (View& view : views_) {
        view.report.meanDrawn =
            static_cast<double>(view.drawnTotal) / static_cast<double>(view.report.frames);
        report_.views.push_back(view.report);
    }
    std::ranges::sort(report_.views, {}, &TraceViewReport::view);
    for (Kind& kind : kinds_) {
        kind.report.latencyS = spreadOf(kind.latencyS);
        kind.report.waitS = spreadOf(kind.waitS);
        if (report_.description)
            kind.report.name = report_.description->kinds[static_cast<std::size_t>(kind.report.kind)];
        report_.kinds.push_back(kind.report);
    }
    std::ranges::sort(report_.kinds, {}, &TraceKindReport::kind);
    report_.faults = finder_.faults();
    report_.unlistedFaults = finder_.unlisted();
    return std::move(report_);
}

Result<TraceReport> reportOfTrace(TraceFile& file, double budgetMs, const TraceFaultLimits& limits,
                                  const std::function<bool()>& goOn) {
    TraceState state;
    TraceReporter reporter(budgetMs, limits);
    const TraceDecoder::Sink sink = [&](const TraceEvent& event) {
        if (state.add(event)) reporter.add(state);
    };
    std::optional<std::string> problem = file.problem();
    bool isDamaged = false;
    TRY(file.seek(0, sink));
    for (;;) {
        if (goOn && !goOn()) return cancelled();
        const Result<bool> more = file.next(sink);
        isDamaged = !more;
        if (isDamaged) problem = more.error().message;
        if (isDamaged || !*more) break;
    }
    TraceReport report = reporter.finish(state);
    report.problem = std::move(problem);
    report.isDamaged = isDamaged;
    return report;
}

}  // namespace planet
