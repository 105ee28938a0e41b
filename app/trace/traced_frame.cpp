#include "app/trace/traced_frame.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace worldy {

namespace {

using planet::noTraceNode;
using planet::TraceData;
using planet::TraceNodeIndex;
using planet::TraceState;

constexpr int mostAncestors = 64;  // a hostile trace can link parents in a ring

// Fills a view's nodes, each once.
class NodeList {
public:
    NodeList(const TraceState& state, const planet::TraceEngineFrame& engine, TracedView& view)
        : state_(state), engine_(engine), view_(view) {}

    void addAll(const planet::TraceFrameView& told, const std::vector<planet::TraceSwitch>& switches) {
        for (const planet::TraceDrawn& drawn : told.drawn) addDrawn(drawn);
        for (const TraceNodeIndex split : engine_.split()) add(split, TracedPlace::Split);
        for (const planet::TraceCulled& culled : told.culled) {
            if (TracedNode* const node = add(culled.node, TracedPlace::Culled)) node->culling = culled.reason;
        }
        addChildren();
        for (const planet::TraceSwitch& one : switches) {
            if (const auto found = places_.find(one.index); found != places_.end())
                view_.nodes[found->second].isSwitched = true;
        }
    }

private:
    // Returns null if the node is in the list.
    TracedNode* add(TraceNodeIndex index, TracedPlace place) {
        if (!places_.try_emplace(index, view_.nodes.size()).second) return nullptr;
        const planet::TraceNodeState& known = state_.nodes()[index];
        const bool isVisited = place != TracedPlace::Unseen && place != TracedPlace::Below;
        TracedNode node{.index = index, .parent = known.parent, .node = known.node, .place = place};
        node.errorPx = engine_.errorPx(state_, index, isVisited);
        node.isResident = state_.isResident(index);
        if (const TraceNodeIndex loader = state_.loaderOf(index); loader != noTraceNode)
            node.data = state_.nodes()[loader].data[0];
        node.children = static_cast<std::uint32_t>(known.children.size());
        node.missingChildren = static_cast<std::uint32_t>(std::ranges::count_if(
            known.children, [&](TraceNodeIndex child) { return !state_.isResident(child); }));
        view_.nodes.push_back(node);
        return &view_.nodes.back();
    }

    void addDrawn(const planet::TraceDrawn& drawn) {
        TracedNode* const node = add(drawn.node, TracedPlace::Drawn);
        if (!node) return;
        node->morph = drawn.morph;
        node->isErrorTold = drawn.hasErrorPx;
        TraceNodeIndex ancestor = node->parent;
        for (int step = 0; step < mostAncestors && ancestor != noTraceNode && !node->isTwice; ++step) {
            node->isTwice = engine_.isDrawn(ancestor);
            ancestor = state_.nodes()[ancestor].parent;
        }
    }

    void addChildren() {
        const std::size_t visited = view_.nodes.size();
        for (std::size_t i = 0; i < visited; ++i) {
            const TracedPlace place = view_.nodes[i].place;
            if (place == TracedPlace::Culled) continue;
            for (const TraceNodeIndex child : state_.nodes()[view_.nodes[i].index].children)
                add(child, place == TracedPlace::Split ? TracedPlace::Unseen : TracedPlace::Below);
        }
    }

    const TraceState& state_;
    const planet::TraceEngineFrame& engine_;
    TracedView& view_;
    std::unordered_map<TraceNodeIndex, std::size_t> places_;
};

void sumUp(const TraceState& state, const planet::TraceSwitchFinder& finder, TracedView& view) {
    const planet::TraceSelection& selection = finder.selection();
    view.drawn = selection.drawn.size();
    view.triangles = selection.triangles;
    view.worstErrorPx = selection.worstErrorPx;
    if (selection.worstNode != noTraceNode) view.worstNode = state.nodes()[selection.worstNode].node.id;
    for (const TracedNode& node : view.nodes) {
        view.overTau += node.place == TracedPlace::Drawn && node.errorPx > view.tauPx;
        view.starved += node.isStarved(view.tauPx);
    }
}

TracedView viewOf(const TraceState& state, const planet::TraceFrameView& told,
                  const planet::TraceSwitchFinder& finder, std::vector<planet::TraceSwitch> switches) {
    TracedView view{.view = told.view, .info = told.info, .tauPx = finder.tauPx()};
    view.hysteresis = state.setting("hysteresis", told.view).value_or(0);
    NodeList(state, finder.engine(), view).addAll(told, switches);
    view.switches = std::move(switches);
    sumUp(state, finder, view);
    return view;
}

void fillQueue(const TraceState& state, TracedFrame& frame) {
    for (std::size_t kind = 0; kind < planet::maxTraceKinds; ++kind) {
        frame.queued += state.count(kind, TraceData::Requested) + state.count(kind, TraceData::Started);
        frame.resident[kind] = state.count(kind, TraceData::Resident);
    }
    if (frame.queued == 0) return;
    const std::uint64_t nowNs = frame.frame.endNs != 0 ? frame.frame.endNs : frame.frame.beginNs;
    for (const planet::TraceNodeState& node : state.nodes()) {
        for (std::size_t kind = 0; kind < planet::maxTraceKinds; ++kind) {
            const planet::TraceDataState& data = node.data[kind];
            if (data.data != TraceData::Requested && data.data != TraceData::Started) continue;
            const double ageS =
                data.requestedNs == 0
                    ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(static_cast<std::int64_t>(nowNs - data.requestedNs)) * 1e-9;
            frame.queue.push_back({node.node, static_cast<std::uint8_t>(kind),
                                   data.data == TraceData::Started, std::max(ageS, 0.0), data.priority});
        }
    }
    // A request whose age is not known counts as the oldest.
    const auto older = [](const TracedRequest& a, const TracedRequest& b) {
        if (std::isnan(a.ageS) != std::isnan(b.ageS)) return std::isnan(a.ageS);
        return a.ageS > b.ageS;
    };
    std::ranges::stable_sort(frame.queue, older);
    if (frame.queue.size() > maxTracedRequests) frame.queue.resize(maxTracedRequests);
}

std::string nameOf(const TraceState& state, planet::TraceNameIndex name) {
    return name < state.names().size() ? state.names()[name] : std::string();
}

// Copies a frame, but for its views.
planet::TraceFrame withoutViews(const planet::TraceFrame& frame) {
    planet::TraceFrame copy;
    copy.number = frame.number;
    copy.timeS = frame.timeS;
    copy.beginNs = frame.beginNs;
    copy.endNs = frame.endNs;
    copy.cpuMs = frame.cpuMs;
    copy.gpuMs = frame.gpuMs;
    copy.dropped = frame.dropped;
    copy.isEnded = frame.isEnded;
    copy.followsGap = frame.followsGap;
    copy.paged = frame.paged;
    copy.messages = frame.messages;
    return copy;
}

}  // namespace

const TracedNode* TracedView::find(std::uint64_t id) const {
    const auto found = std::ranges::find(nodes, id, [](const TracedNode& node) { return node.node.id; });
    return found == nodes.end() ? nullptr : &*found;
}

const TracedView* TracedFrame::view(int which) const {
    const auto found = std::ranges::find(views, which, &TracedView::view);
    return found == views.end() ? nullptr : &*found;
}

void TracedFrameBuilder::add(const TraceState& state) {
    switches_.clear();
    for (const planet::TraceFrameView& view : state.frame().views)
        switches_[view.view] = views_[view.view].add(state, view);
}

std::shared_ptr<const TracedFrame> TracedFrameBuilder::build(const TraceState& state) const {
    const planet::TraceFrame& told = state.frame();
    auto frame = std::make_shared<TracedFrame>();
    frame->description = state.description();
    frame->frame = withoutViews(told);
    for (const planet::TraceFrameView& view : told.views)
        frame->views.push_back(viewOf(state, view, views_.at(view.view), switches_.at(view.view)));
    fillQueue(state, *frame);
    frame->settings = {state.settings().begin(), state.settings().end()};
    frame->threads = state.threads();
    for (const planet::TraceCounted& counted : told.counters)
        frame->counters[nameOf(state, counted.name)] = counted.value;
    for (const planet::TracePagedStep& step : told.paged) {
        frame->pagedIds.push_back(state.nodes()[step.event.node].node.id);
        const bool hasFailed = step.event.step == planet::TraceStep::Failed;
        frame->reasons.push_back(hasFailed ? nameOf(state, step.event.reason) : std::string());
    }
    return frame;
}

std::string tracedName(const std::optional<planet::TraceDescription>& description, std::uint64_t id) {
    return planet::traceIdText(description.value_or(planet::TraceDescription{}), id);
}

}  // namespace worldy
