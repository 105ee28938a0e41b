#include "app/trace/trace_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/plot_scale.h"

namespace worldy {

namespace {

using planet::TraceData;
using planet::TraceState;
using planet::TraceStep;

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

float largest(float a, float b) {
    return std::fmax(a, b);  // of a number and NaN it takes the number
}

void merge(TracedSample& into, const TracedSample& other) {
    into.cpuMs = largest(into.cpuMs, other.cpuMs);
    into.gpuMs = largest(into.gpuMs, other.gpuMs);
    into.queued = std::max(into.queued, other.queued);
    into.arrived += other.arrived;
    into.failed += other.failed;
    into.evicted += other.evicted;
    into.dropped += other.dropped;
}

void merge(TracedViewSample& into, const TracedViewSample& other) {
    into.drawn = std::max(into.drawn, other.drawn);
    into.triangles = std::max(into.triangles, other.triangles);
    into.worstErrorPx = largest(into.worstErrorPx, other.worstErrorPx);
    into.tauPx = largest(into.tauPx, other.tauPx);
    into.splits += other.splits;
    into.merges += other.merges;
    into.starved = std::max(into.starved, other.starved);
}

void merge(float& into, float other) {
    if (!std::isnan(other)) into = other;
}

template <class Sample>
void halve(std::vector<Sample>& samples) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.size(); i += 2, ++kept) {
        Sample sample = samples[i];
        if (i + 1 < samples.size()) merge(sample, samples[i + 1]);
        samples[kept] = sample;
    }
    samples.resize(kept);
}

float toldMs(double ms) {
    return ms >= 0 ? static_cast<float>(ms) : unknown;
}

std::size_t latencyBucket(double seconds) {
    const double position = logarithmicPosition(std::max(seconds, fastestTracedLatencyS),
                                                fastestTracedLatencyS, slowestTracedLatencyS);
    return std::min(static_cast<std::size_t>(position * tracedLatencyBuckets), tracedLatencyBuckets - 1);
}

}  // namespace

void TraceHistorian::add(const TraceState& state) {
    const planet::TraceFrame& frame = state.frame();
    reporter_.add(state);
    // An engine's clock may go back or be no number, and the timeline orders the samples by their times.
    if (std::isfinite(frame.timeS)) timeS_ = isTimed_ ? std::max(timeS_, frame.timeS) : frame.timeS;
    isTimed_ = isTimed_ || std::isfinite(frame.timeS);
    if (history_.samples.empty() || framesInSample_ == history_.framesPerSample) beginSample(frame);
    ++framesInSample_;
    TracedSample now{.cpuMs = toldMs(frame.cpuMs),
                     .gpuMs = toldMs(frame.gpuMs),
                     .dropped = static_cast<float>(frame.dropped)};
    addPaging(state, now);
    merge(history_.samples.back(), now);
    for (const planet::TraceFrameView& view : frame.views) addView(state, view);
    addCounters(state);
    for (const planet::TraceSwitch& found : reporter_.switches()) {
        if (history_.switches.size() < maxTracedSwitches)
            history_.switches.push_back(found);
        else
            ++history_.unlistedSwitches;
    }
}

void TraceHistorian::beginSample(const planet::TraceFrame& frame) {
    if (history_.samples.size() == maxTracedSamples) halve();
    history_.samples.push_back({.frame = frame.number, .timeS = timeS_});
    for (auto& [view, samples] : history_.views) samples.emplace_back();
    for (auto& [name, values] : history_.counters) values.push_back(unknown);
    framesInSample_ = 0;
}

void TraceHistorian::halve() {
    worldy::halve(history_.samples);
    for (auto& [view, samples] : history_.views) worldy::halve(samples);
    for (auto& [name, values] : history_.counters) worldy::halve(values);
    history_.framesPerSample *= 2;
}

void TraceHistorian::addView(const TraceState& state, const planet::TraceFrameView& view) {
    const planet::TraceSwitchFinder& finder = *reporter_.finder(view.view);
    const planet::TraceSelection& selection = finder.selection();
    TracedViewSample now{.drawn = static_cast<float>(selection.drawn.size()),
                         .triangles = static_cast<float>(selection.triangles),
                         .worstErrorPx = static_cast<float>(selection.worstErrorPx),
                         .tauPx = static_cast<float>(finder.tauPx())};
    for (const planet::TraceSwitch& found : reporter_.switches()) {
        if (found.view == view.view) ++(found.isSplit ? now.splits : now.merges);
    }
    addStarvation(state, view, now);
    std::vector<TracedViewSample>& samples = history_.views[view.view];
    samples.resize(history_.samples.size());
    merge(samples.back(), now);
}

void TraceHistorian::addStarvation(const TraceState& state, const planet::TraceFrameView& view,
                                   TracedViewSample& sample) {
    const planet::TraceFrame& frame = state.frame();
    const planet::TraceSwitchFinder& finder = *reporter_.finder(view.view);
    std::uint64_t nodes = 0;
    double worstPx = 0;
    for (const planet::TraceNodeIndex node : finder.selection().drawn) {
        const double errorPx = finder.engine().errorPx(state, node, true);
        if (!(errorPx > finder.tauPx()) || !planet::lacksTraceChildren(state, node)) continue;
        ++nodes;
        worstPx = std::max(worstPx, errorPx);
    }
    sample.starved = static_cast<float>(nodes);
    const auto open = starving_.find(view.view);
    if (open != starving_.end()) {
        TracedStarvation& starvation = history_.starvations[open->second];
        starvation.untilS = timeS_;
        if (nodes == 0) {
            starvation.isOver = true;
            starving_.erase(open);
            return;
        }
        starvation.lastFrame = frame.number;
        starvation.mostNodes = std::max(starvation.mostNodes, nodes);
        starvation.worstErrorPx = std::max(starvation.worstErrorPx, worstPx);
    } else if (nodes > 0 && history_.starvations.size() < maxTracedStarvations) {
        starving_[view.view] = history_.starvations.size();
        history_.starvations.push_back(
            {view.view, frame.number, frame.number, timeS_, timeS_, false, nodes, worstPx});
    }
}

void TraceHistorian::addPaging(const TraceState& state, TracedSample& sample) {
    for (std::size_t kind = 0; kind < planet::maxTraceKinds; ++kind)
        sample.queued += static_cast<float>(state.count(kind, TraceData::Requested) +
                                            state.count(kind, TraceData::Started));
    for (const planet::TracePagedStep& step : state.frame().paged) {
        sample.failed += step.event.step == TraceStep::Failed;
        sample.evicted += step.event.step == TraceStep::Evicted;
        if (step.event.step != TraceStep::Arrived) continue;
        ++sample.arrived;
        if (step.before.requestedNs == 0) continue;
        const double latencyS =
            static_cast<double>(static_cast<std::int64_t>(step.event.ns - step.before.requestedNs)) * 1e-9;
        ++history_.latencies[step.event.kind][latencyBucket(latencyS)];
    }
}

void TraceHistorian::addCounters(const TraceState& state) {
    for (const planet::TraceCounted& counted : state.frame().counters) {
        if (counted.name >= state.names().size()) continue;
        const std::string& name = state.names()[counted.name];
        if (!history_.counters.contains(name)) {
            if (history_.counters.size() == maxTracedCounters) continue;
            history_.counters[name].assign(history_.samples.size(), unknown);
        }
        history_.counters[name].back() = static_cast<float>(counted.value);
    }
}

std::shared_ptr<const TraceHistory> TraceHistorian::history(const TraceState& state, bool isComplete) const {
    auto history = std::make_shared<TraceHistory>(history_);
    planet::TraceReporter reporter = reporter_;
    history->report = reporter.finish(state);
    history->isComplete = isComplete;
    return history;
}

}  // namespace worldy
