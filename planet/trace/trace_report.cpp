#include "planet/trace/trace_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planet/base/percentile.h"
#include "planet/base/try.h"
#include "planet/trace/trace_reading.h"

namespace planet {

namespace {

constexpr double thrashWithinS = 1;

double sinceS(std::uint64_t fromNs, std::uint64_t toNs) {
    return static_cast<double>(static_cast<std::int64_t>(toNs - fromNs)) * 1e-9;
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
    if (report_.frames++ == 0)
        report_.firstFrame = frame.number;
    else
        report_.missingFrames += frame.number > report_.lastFrame ? frame.number - report_.lastFrame - 1 : 0;
    report_.lastFrame = frame.number;
    if (std::isfinite(frame.timeS)) {
        if (!firstS_) firstS_ = frame.timeS;
        report_.durationS = frame.timeS - *firstS_;
    }
    if (frame.cpuMs >= 0) cpuMs_.push_back(static_cast<float>(frame.cpuMs));
    if (frame.gpuMs >= 0) gpuMs_.push_back(static_cast<float>(frame.gpuMs));
    report_.framesOverBudget += std::max(frame.cpuMs, frame.gpuMs) > budgetMs_;
    for (const TracePagedStep& step : frame.paged) addPaged(state, step);
    finder_.add(state);
    switches_.clear();
    for (const TraceFrameView& each : frame.views) {
        auto view = std::ranges::find(views_, int{each.view}, [](const View& v) { return v.report.view; });
        if (view == views_.end()) {
            views_.emplace_back().report.view = each.view;
            view = std::prev(views_.end());
        }
        addView(state, each, *view);
    }
}

const TraceSwitchFinder* TraceReporter::finder(int view) const {
    const auto found = std::ranges::find(views_, view, [](const View& v) { return v.report.view; });
    const bool isThere = found != views_.end() && found->lastFrame == report_.lastFrame;
    return isThere ? &found->switches : nullptr;
}

void TraceReporter::addView(const TraceState& state, const TraceFrameView& frame, View& view) {
    TraceViewReport& report = view.report;
    ++report.frames;
    view.lastFrame = state.frame().number;
    for (const TraceSwitch& found : view.switches.add(state, frame)) {
        note(found, view);
        switches_.push_back(found);
    }
    const TraceSelection& drawn = view.switches.selection();
    report.mostDrawn = std::max<std::uint64_t>(report.mostDrawn, drawn.drawn.size());
    report.mostTriangles = std::max(report.mostTriangles, drawn.triangles);
    view.drawnTotal += drawn.drawn.size();
    addErrors(state, frame, view);
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
        else if (node.isTold && frame.info)
            errorPx = traceErrorPx(state.descriptionOrDefault(), node, *frame.info);
        if (std::isnan(errorPx)) continue;
        isOver = isOver || (tauPx && errorPx > *tauPx);
        if (errorPx <= report.worstErrorPx) continue;
        report.worstErrorPx = errorPx;
        report.worstFrame = state.frame().number;
        report.worstNode = node.id;
    }
    report.framesOverTau += isOver;
}

void TraceReporter::note(const TraceSwitch& found, View& view) {
    ++(found.isSplit ? view.report.splits : view.report.merges);
    const auto [last, isFirst] = view.changes.try_emplace(found.index, Change{found.timeS, found.isSplit});
    if (isFirst) return;
    const bool isBack =
        last->second.isSplit != found.isSplit && found.timeS - last->second.timeS < thrashWithinS;
    view.report.thrashes += isBack;
    last->second = {found.timeS, found.isSplit};
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
            if (state.descriptionOrDefault().requests == TraceRequests::Children) {
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
    TRY_ASSIGN(TraceEnd end, readTrace(file, goOn, sink));
    TraceReport report = reporter.finish(state);
    report.problem = std::move(end.problem);
    report.isDamaged = end.isDamaged;
    return report;
}

}  // namespace planet
