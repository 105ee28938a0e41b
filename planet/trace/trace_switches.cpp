#include "planet/trace/trace_switches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace planet {

namespace {

constexpr int ancestorLimit = 64;       // a hostile trace can link parents in a ring
constexpr double fullyMorphed = 0.999;  // engines round their morphs
constexpr double limitSlack = 1e-4;     // share by which an engine's own errors may differ from ours

double diameterPx(const TraceBounds& bounds, const TraceView& view) {
    if (bounds.shape == TraceBoundsShape::None) return std::numeric_limits<double>::quiet_NaN();
    const double radius = bounds.reach();
    const double distance = glm::length(bounds.centre - view.eye);
    if (!(distance > radius)) return std::numeric_limits<double>::infinity();
    // The tangent of half the angle under which a sphere is seen.
    const double halfTangent = radius / std::sqrt(distance * distance - radius * radius);
    return std::abs(view.projection[0][0]) * view.width * halfTangent;
}

}  // namespace

const char* traceSwitchCauseName(TraceSwitchCause cause) {
    constexpr std::array names = {"error", "settings", "arrival", "eviction", "other", "unknown"};
    return names[static_cast<std::size_t>(cause)];
}

bool lacksTraceChildren(const TraceState& state, TraceNodeIndex node) {
    return std::ranges::any_of(state.nodes()[node].children,
                               [&](TraceNodeIndex child) { return !state.isResident(child); });
}

const std::vector<TraceSwitch>& TraceSwitchFinder::add(const TraceState& state, const TraceFrameView& view) {
    engine_.take(state, view);
    selection_ = engineSelection(state, engine_);
    counter_.count(state, engine_.hasBefore(), selection_);
    limitsBefore_ = limits_;
    limits_ = {};
    if (const std::optional<double> tauPx = state.setting("tau", view.view)) {
        limits_.tauPx = *tauPx;
        limits_.mergePx = *tauPx * (1 - state.setting("hysteresis", view.view).value_or(0));
    }
    see(state, view);
    switches_.clear();
    for (const TraceNodeIndex node : counter_.splitNow()) switches_.push_back(switchOf(state, node, true));
    for (const TraceNodeIndex node : counter_.mergedNow()) switches_.push_back(switchOf(state, node, false));
    return switches_;
}

void TraceSwitchFinder::see(const TraceState& state, const TraceFrameView& view) {
    std::swap(seen_, seenBefore_);
    ++stamp_;
    seen_.resize(state.nodes().size());
    seenBefore_.resize(state.nodes().size());
    for (const TraceNodeIndex node : engine_.split())
        seen_[node] = {stamp_, false, 0, engine_.errorPx(state, node, true)};
    for (const TraceDrawn& drawn : view.drawn) {
        const double errorPx = engine_.errorPx(state, drawn.node, true);
        const bool isWaiting =
            state.nodes()[drawn.node].children.empty() || lacksTraceChildren(state, drawn.node);
        seen_[drawn.node] = {stamp_, isWaiting, drawn.morph, errorPx};
    }
}

const TraceSwitchFinder::Seen* TraceSwitchFinder::seen(const std::vector<Seen>& in, TraceNodeIndex node,
                                                       std::uint32_t stamp) const {
    return node < in.size() && in[node].stamp == stamp ? &in[node] : nullptr;
}

TraceSwitch TraceSwitchFinder::switchOf(const TraceState& state, TraceNodeIndex node, bool isSplit) const {
    const TraceNode& told = state.nodes()[node].node;
    TraceSwitch found{.frame = state.frame().number,
                      .timeS = state.frame().timeS,
                      .view = engine_.view().view,
                      .index = node,
                      .node = told.id,
                      .level = told.level,
                      .isSplit = isSplit,
                      .errorPx = engine_.errorPx(state, node, isSplit || engine_.isDrawn(node)),
                      .limitPx = isSplit ? limits_.tauPx : limits_.mergePx};
    if (engine_.view().info) found.sizePx = diameterPx(told.bounds, *engine_.view().info);
    found.isMorphed = isMorphed(state, node, isSplit);
    found.cause = causeOf(state, found);
    return found;
}

TraceSwitchCause TraceSwitchFinder::causeOf(const TraceState& state, const TraceSwitch& found) const {
    const bool isKnown = !std::isnan(found.errorPx) && !std::isnan(found.limitPx);
    const bool asksNow = found.isSplit ? found.errorPx > found.limitPx * (1 - limitSlack)
                                       : found.errorPx <= found.limitPx * (1 + limitSlack);
    if (!found.isSplit && !(isKnown && asksNow) && lacksTraceChildren(state, found.index))
        return TraceSwitchCause::Eviction;
    if (!isKnown) return TraceSwitchCause::Unknown;
    if (!asksNow) return TraceSwitchCause::Other;
    // A node that was split together with its parent was not seen in the frame before: what was drawn there decides.
    TraceNodeIndex node = found.index;
    const Seen* before = nullptr;
    for (int step = 0; step < ancestorLimit && node != noTraceNode && !before; ++step) {
        before = seen(seenBefore_, node, stamp_ - 1);
        node = state.nodes()[node].parent;
    }
    if (!before || std::isnan(before->errorPx)) return TraceSwitchCause::Unknown;
    const double limitBefore = found.isSplit ? limitsBefore_.tauPx : limitsBefore_.mergePx;
    const auto asked = [&](double limitPx) {
        return found.isSplit ? before->errorPx > limitPx * (1 + limitSlack)
                             : before->errorPx <= limitPx * (1 - limitSlack);
    };
    if (!asked(limitBefore))
        return asked(found.limitPx) ? TraceSwitchCause::Settings : TraceSwitchCause::Error;
    return before->isWaiting ? TraceSwitchCause::Arrival : TraceSwitchCause::Other;
}

// A split is smooth if the nodes that are drawn instead begin with the surface of the split one, and a merge if those that
// it replaces had ended with it.
bool TraceSwitchFinder::isMorphed(const TraceState& state, TraceNodeIndex node, bool isSplit) const {
    const std::vector<Seen>& in = isSplit ? seen_ : seenBefore_;
    const std::uint32_t stamp = isSplit ? stamp_ : stamp_ - 1;
    bool isAny = false;
    for (const TraceNodeIndex child : state.nodes()[node].children) {
        const Seen* const drawn = seen(in, child, stamp);
        if (!drawn) continue;  // culled
        if (!(static_cast<double>(drawn->morph) >= fullyMorphed)) return false;
        isAny = true;
    }
    return isAny;
}

}  // namespace planet
