#include "planet/trace/trace_selector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace planet {

namespace {

constexpr int mostGenerations = 64;      // a hostile trace can link parents in a ring
constexpr double sameErrorSlack = 1e-4;  // share by which errors may differ and be the same measure
constexpr int mostLoaders = 1024;

// Marks a node; returns false if it was marked with this stamp before.
bool stampOnce(std::vector<std::uint32_t>& stamps, TraceNodeIndex node, std::uint32_t stamp) {
    return std::exchange(stamps[node], stamp) != stamp;
}

// Returns how far bounds reach from their centre along a direction of any length, in units of that length.
double reachAlong(const TraceBounds& bounds, const glm::dvec3& direction) {
    if (bounds.shape == TraceBoundsShape::Sphere) return bounds.radius * glm::length(direction);
    double reach = 0;
    for (int axis = 0; axis < 3; ++axis)
        reach += std::abs(glm::dot(direction, bounds.axes[static_cast<std::size_t>(axis)])) *
                 bounds.halfSize[axis];
    return reach;
}

// Returns whether all of the bounds is outside one of the sides of the frustum, or behind the eye.
bool isOutsideFrustum(const TraceView& view, const TraceBounds& bounds) {
    const glm::dmat4 rows = glm::transpose(view.projection * view.view);
    const std::array planes = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                               rows[3]};
    return std::ranges::any_of(planes, [&](const glm::dvec4& plane) {
        const glm::dvec3 normal(plane);
        return glm::dot(normal, bounds.centre) + plane.w < -reachAlong(bounds, normal);
    });
}

// Returns whether the sphere of the world's radius hides all of the bounds: they are beyond the plane of its horizon, and
// within the cone from the eye that touches it.
bool isBelowHorizon(const TraceDescription& description, const TraceView& view, const TraceBounds& bounds) {
    const double distance = glm::length(view.eye);
    if (description.shape != TraceShape::Sphere || !(distance > description.radius)) return false;
    const double radius = bounds.reach();
    const double horizon = description.radius / distance;
    if (glm::dot(bounds.centre, view.eye) / distance + radius >= description.radius * horizon) return false;
    const glm::dvec3 towards = bounds.centre - view.eye;
    const double away = glm::length(towards);
    if (!(away > radius)) return false;
    const double cosine = std::clamp(-glm::dot(towards, view.eye) / (away * distance), -1.0, 1.0);
    return std::acos(cosine) + std::asin(radius / away) < std::asin(horizon);
}

// Returns whether a node is not culled.
bool isSeen(const TraceState& state, const TraceEngineFrame& engine, TraceNodeIndex node, bool isBelow) {
    if (!isBelow) return engine.isDrawn(node) || engine.isSplit(node);
    const TraceBounds& bounds = state.nodes()[node].node.bounds;
    if (!engine.view().info || bounds.shape == TraceBoundsShape::None) return true;
    if (isOutsideFrustum(*engine.view().info, bounds)) return false;
    return !isBelowHorizon(state.descriptionOrDefault(), *engine.view().info, bounds);
}

bool requestsChildren(const TraceState& state) {
    return state.descriptionOrDefault().requests == TraceRequests::Children;
}

// Returns the bytes that a split needs in addition.
std::uint64_t bytesOfSplit(const TraceState& state, const TraceEngineFrame& engine, TraceNodeIndex node,
                           bool isBelow) {
    std::uint64_t bytes = 0;
    for (const TraceNodeIndex child : state.nodes()[node].children)
        if (requestsChildren(state) || isSeen(state, engine, child, isBelow))
            bytes += state.nodes()[child].node.bytes;
    return bytes;
}

void addDrawn(const TraceState& state, TraceNodeIndex node, double errorPx, TraceSelection& selection) {
    selection.drawn.push_back(node);
    selection.triangles += state.nodes()[node].node.triangles;
    if (std::isnan(errorPx) || errorPx <= selection.worstErrorPx) return;
    selection.worstErrorPx = errorPx;
    selection.worstNode = node;
}

}  // namespace

// ---- the engine ----

void TraceEngineFrame::take(const TraceState& state, const TraceFrameView& view,
                            std::span<const char> described) {
    const TraceFrame& frame = state.frame();
    const bool follows = isWhole_ && frame.isComplete() && frame.number == number_ + 1;
    number_ = frame.number;
    isWhole_ = frame.isComplete();
    hasBefore_ = follows && view_ != nullptr;
    view_ = &view;
    described_ = described;
    std::swap(split_, splitBefore_);
    ++stamp_;
    for (Stamps* stamps : {&drawn_, &split_, &culled_, &splitBefore_, &moved_})
        stamps->resize(state.nodes().size(), 0);
    drawnList_.clear();
    splitList_.clear();
    roots_.clear();
    toldPx_.clear();
    for (const TracePagedStep& step : frame.paged) {
        const bool changes = step.event.step == TraceStep::Arrived || step.before.data == TraceData::Resident;
        if (step.event.kind == 0 && changes) moved_[step.event.node] = stamp_;
    }
    const auto addAncestors = [&](TraceNodeIndex node) {
        TraceNodeIndex ancestor = state.nodes()[node].parent;
        if (ancestor == noTraceNode) roots_.push_back(node);
        for (int step = 0; step < mostGenerations && ancestor != noTraceNode; ++step) {
            if (!stampOnce(split_, ancestor, stamp_)) return;
            splitList_.push_back(ancestor);
            const TraceNodeIndex above = state.nodes()[ancestor].parent;
            if (above == noTraceNode) roots_.push_back(ancestor);
            ancestor = above;
        }
    };
    for (const TraceDrawn& drawn : view.drawn) {
        if (!stampOnce(drawn_, drawn.node, stamp_)) continue;
        drawnList_.push_back(drawn.node);
        if (drawn.hasErrorPx) toldPx_[drawn.node] = static_cast<double>(drawn.errorPx);
        addAncestors(drawn.node);
    }
    for (const TraceCulled& culled : view.culled) {
        if (!stampOnce(culled_, culled.node, stamp_)) continue;
        // A root that is culled is no root of what is seen.
        if (state.nodes()[culled.node].parent != noTraceNode) addAncestors(culled.node);
    }
    std::ranges::sort(roots_);
    roots_.erase(std::unique(roots_.begin(), roots_.end()), roots_.end());
}

bool TraceEngineFrame::isCertain(const TraceState& state, TraceNodeIndex child) const {
    if (!described_.empty() && (child >= described_.size() || !described_[child])) return false;
    const TraceNodeIndex loader = state.loaderOf(child);
    return state.isResident(child) && (loader == noTraceNode || !has(moved_, loader, stamp_));
}

bool TraceEngineFrame::hasChildren(const TraceState& state, TraceNodeIndex node) const {
    if (isSplit(node)) return true;
    const std::vector<TraceNodeIndex>& children = state.nodes()[node].children;
    return std::ranges::all_of(children, [&](TraceNodeIndex child) { return isCertain(state, child); });
}

double TraceEngineFrame::errorPx(const TraceState& state, TraceNodeIndex node, bool isVisited,
                                 TraceMetric metric) const {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const TraceNode& told = state.nodes()[node].node;
    double computed = unknown;
    if (told.isTold) {
        const bool isPixels = state.descriptionOrDefault().error == TraceErrorUnit::Pixels;
        if (isPixels) {
            if (isVisited && told.error != 0) computed = told.error;
        } else if (view_->info) {
            computed = traceErrorPx(state.descriptionOrDefault(), told, *view_->info, metric);
            if (metric != TraceMetric::Bounds && !std::isnan(computed)) return computed;
        }
    }
    const auto found = toldPx_.find(node);
    if (found == toldPx_.end()) return computed;
    // The engine's number is a float. Its threshold was compared with the number before it was rounded.
    const bool isSame = std::abs(found->second - computed) <= sameErrorSlack * std::abs(computed);
    return isSame ? computed : found->second;
}

TraceSelection engineSelection(const TraceState& state, const TraceEngineFrame& engine) {
    TraceSelection selection;
    for (const TraceNodeIndex node : engine.drawn()) {
        const double errorPx = engine.errorPx(state, node, true);
        addDrawn(state, node, errorPx, selection);
        selection.unknown += std::isnan(errorPx);
    }
    selection.split = engine.split();
    for (const TraceNodeIndex root : engine.roots()) selection.bytes += state.nodes()[root].node.bytes;
    for (const TraceNodeIndex node : engine.split())
        selection.bytes += bytesOfSplit(state, engine, node, false);
    return selection;
}

// ---- changes ----

bool TraceLevelCounter::covers(const TraceState& state, const Stamps& drawn, std::uint32_t stamp,
                               TraceNodeIndex node) const {
    for (int step = 0; step < mostGenerations && node != noTraceNode; ++step) {
        if (node < drawn.size() && drawn[node] == stamp) return true;
        node = state.nodes()[node].parent;
    }
    return false;
}

void TraceLevelCounter::count(const TraceState& state, bool isContinued, TraceSelection& selection) {
    std::swap(drawn_, drawnBefore_);
    std::swap(split_, splitBefore_);
    std::swap(list_, listBefore_);
    ++stamp_;
    for (Stamps* stamps : {&drawn_, &split_, &drawnBefore_, &splitBefore_})
        stamps->resize(state.nodes().size(), 0);
    for (const TraceNodeIndex node : selection.drawn) drawn_[node] = stamp_;
    list_ = selection.split;
    for (const TraceNodeIndex node : list_) split_[node] = stamp_;
    splitNow_.clear();
    mergedNow_.clear();
    if (isContinued) {
        for (const TraceNodeIndex node : list_)
            if (splitBefore_[node] != stamp_ - 1 && covers(state, drawnBefore_, stamp_ - 1, node))
                splitNow_.push_back(node);
        for (const TraceNodeIndex node : listBefore_)
            if (split_[node] != stamp_ && covers(state, drawn_, stamp_, node)) mergedNow_.push_back(node);
    }
    selection.splits = splitNow_.size();
    selection.merges = mergedNow_.size();
}

// ---- the disk ----

TraceDisk::TraceDisk(const TraceDiskModel& model, std::optional<std::uint64_t> budgetBytes)
    : model_(model),
      budgetBytes_(budgetBytes),
      freeS_(static_cast<std::size_t>(std::clamp(model.loaders, 1, mostLoaders)),
             -std::numeric_limits<double>::infinity()) {}

void TraceDisk::beginFrame(double timeS) {
    ++frame_;
    std::ranges::sort(asked_, [](const Request& a, const Request& b) {
        return a.priority != b.priority ? a.priority > b.priority : a.node < b.node;
    });
    for (const Request& request : asked_) {
        const auto loader = std::ranges::min_element(freeS_);
        const double startS = std::max(*loader, timeS_);
        if (startS >= timeS) break;
        *loader = startS + model_.latencyS + static_cast<double>(request.bytes) / model_.bytesPerS;
        data_[request.node] = {*loader, request.bytes, frame_, false};
    }
    asked_.clear();
    timeS_ = timeS;
    for (auto& [node, data] : data_) {
        if (data.isThere || !(data.atS <= timeS)) continue;
        data.isThere = true;
        data.usedFrame = frame_;
        bytes_ += data.bytes;
    }
}

bool TraceDisk::isThere(TraceNodeIndex node) const {
    const auto found = data_.find(node);
    return found != data_.end() && found->second.isThere;
}

void TraceDisk::use(TraceNodeIndex node) {
    if (const auto found = data_.find(node); found != data_.end()) found->second.usedFrame = frame_;
}

void TraceDisk::ask(TraceNodeIndex node, double priority, std::uint64_t bytes) {
    if (!data_.contains(node)) asked_.push_back({priority, bytes, node});
}

void TraceDisk::endFrame() {
    if (!budgetBytes_ || bytes_ <= *budgetBytes_) return;
    std::vector<std::pair<std::uint64_t, TraceNodeIndex>> unused;  // by the frame of the last use
    for (const auto& [node, data] : data_)
        if (data.isThere && data.usedFrame < frame_) unused.emplace_back(data.usedFrame, node);
    std::ranges::sort(unused);
    for (const auto& [frame, node] : unused) {
        if (bytes_ <= *budgetBytes_) return;
        bytes_ -= data_[node].bytes;
        data_.erase(node);
    }
}

// ---- the selection ----

bool TraceSelector::Open::operator<(const Open& other) const {
    const double own = std::isnan(errorPx) ? 0 : errorPx,
                 others = std::isnan(other.errorPx) ? 0 : other.errorPx;
    return own != others ? own < others : node > other.node;
}

TraceSelector::TraceSelector(const TraceSelectorSettings& settings)
    : settings_(settings), disk_(settings.disk, settings.budgetBytes) {}

bool TraceSelector::wasSplit(const TraceEngineFrame& engine, TraceNodeIndex node) const {
    const bool knows = settings_.followSlack ? engine.hasBefore() : hasMemory_;
    if (!knows) return engine.isSplit(node);
    return settings_.followSlack ? engine.wasSplit(node) : splitBefore_[node] == stamp_ - 1;
}

TraceSelector::Children TraceSelector::childrenOf(const TraceState& state, const TraceEngineFrame& engine,
                                                  TraceNodeIndex node) {
    const std::vector<TraceNodeIndex>& children = state.nodes()[node].children;
    const bool isLoader = requestsChildren(state);
    if (children.empty()) {
        const bool isAbsent =
            isLoader && state.hasPaging() && state.nodes()[node].data[0].data != TraceData::Resident;
        return settings_.residency == TraceResidency::AsTraced && isAbsent ? Children::Missing
                                                                           : Children::Unknown;
    }
    bool isThere = true;
    if (settings_.residency == TraceResidency::AsTraced) isThere = engine.hasChildren(state, node);
    if (settings_.residency == TraceResidency::Disk) {
        isThere = isLoader ? disk_.isThere(node)
                           : std::ranges::all_of(children, [&](auto child) { return disk_.isThere(child); });
    }
    return isThere ? Children::There : Children::Missing;
}

// Returns whether a node should be drawn as its children.
bool TraceSelector::wants(const TraceState& state, const TraceEngineFrame& engine, const Open& node,
                          Children children) {
    if (state.nodes()[node.node].node.level >= maxLevel_) return false;
    if (std::isnan(node.errorPx)) return !node.isBelow && engine.isSplit(node.node);
    const bool was = wasSplit(engine, node.node);
    if (settings_.followSlack) {
        const double thresholdPx = was ? mergePx_ : tauPx_;
        if (std::abs(node.errorPx - thresholdPx) <= *settings_.followSlack * thresholdPx)
            return engine.isSplit(node.node);
    }
    if (node.errorPx > tauPx_) return true;
    return was && node.errorPx > mergePx_ && children == Children::There;
}

bool TraceSelector::fits(const TraceState& state, const TraceEngineFrame& engine, const Open& node) {
    const bool isBelow = node.isBelow || !engine.isSplit(node.node);
    const std::uint64_t bytes = selection_.bytes + bytesOfSplit(state, engine, node.node, isBelow);
    if (settings_.budgetBytes && bytes > *settings_.budgetBytes) return false;
    selection_.bytes = bytes;
    return true;
}

void TraceSelector::ask(const TraceState& state, const Open& node) {
    const double priority = node.errorPx / tauPx_;
    std::uint64_t bytes = 0;
    for (const TraceNodeIndex child : state.nodes()[node.node].children) {
        const std::uint64_t own = state.nodes()[child].node.bytes;
        if (!requestsChildren(state)) disk_.ask(child, priority, own);
        bytes += own;
    }
    if (requestsChildren(state)) disk_.ask(node.node, priority, bytes);
}

void TraceSelector::open(const TraceState& state, const TraceEngineFrame& engine, TraceNodeIndex node,
                         bool isBelow) {
    if (!isSeen(state, engine, node, isBelow) || !stampOnce(seenAt_, node, stamp_)) return;
    open_.push_back({engine.errorPx(state, node, !isBelow, settings_.metric), node, isBelow});
    std::push_heap(open_.begin(), open_.end());
}

void TraceSelector::visit(const TraceState& state, const TraceEngineFrame& engine, const Open& node) {
    const Children children = childrenOf(state, engine, node.node);
    const bool isDisk = settings_.residency == TraceResidency::Disk;
    if (isDisk) disk_.use(node.node);
    if (wants(state, engine, node, children)) {
        if (children == Children::There && fits(state, engine, node)) {
            splitAt_[node.node] = stamp_;
            selection_.split.push_back(node.node);
            const bool isBelow = node.isBelow || !engine.isSplit(node.node);
            for (const TraceNodeIndex child : state.nodes()[node.node].children) {
                if (isDisk) disk_.use(child);
                open(state, engine, child, isBelow);
            }
            return;
        }
        selection_.limited += children == Children::There;
        selection_.waiting += children == Children::Missing;
        selection_.unknown += children == Children::Unknown;
        if (children == Children::Missing && isDisk) ask(state, node);
    }
    selection_.unknown += std::isnan(node.errorPx);
    addDrawn(state, node.node, engine.errorPx(state, node.node, !node.isBelow), selection_);
}

const TraceSelection* TraceSelector::select(const TraceState& state, const TraceEngineFrame& engine) {
    const int view = engine.view().view;
    const std::optional<double> tau = settings_.tauPx ? settings_.tauPx : state.setting("tau", view);
    if (!tau || !(*tau > 0)) return nullptr;
    tauPx_ = *tau;
    mergePx_ = tauPx_ * (1 - settings_.hysteresis.value_or(state.setting("hysteresis", view).value_or(0)));
    maxLevel_ = settings_.maxLevel.value_or(
        state.setting("max_level", view).value_or(std::numeric_limits<double>::infinity()));
    std::swap(splitAt_, splitBefore_);
    ++stamp_;
    for (auto* stamps : {&splitAt_, &splitBefore_, &seenAt_}) stamps->resize(state.nodes().size(), 0);
    selection_ = {};
    open_.clear();
    const bool isDisk = settings_.residency == TraceResidency::Disk;
    if (isDisk) disk_.beginFrame(state.frame().timeS);
    for (const TraceNodeIndex root : engine.roots()) {
        selection_.bytes += state.nodes()[root].node.bytes;
        open(state, engine, root, false);
    }
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end());
        const Open node = open_.back();
        open_.pop_back();
        visit(state, engine, node);
    }
    if (isDisk) disk_.endFrame();
    counter_.count(state, engine.hasBefore(), selection_);
    hasMemory_ = true;
    return &selection_;
}

}  // namespace planet
