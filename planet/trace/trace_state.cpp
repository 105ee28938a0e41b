#include "planet/trace/trace_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "planet/trace/trace_quadtree.h"

namespace planet {

const TraceFrameView* TraceFrame::view(std::uint8_t which) const {
    const auto found =
        std::find_if(views.begin(), views.end(), [&](const auto& v) { return v.view == which; });
    return found == views.end() ? nullptr : &*found;
}

bool TraceState::add(const TraceEvent& event) {
    frameEnds_ = false;
    std::visit([this](const auto& told) { on(told); }, event);
    return frameEnds_;
}

void TraceState::on(const TraceRestarted&) {
    *this = TraceState{};
}

void TraceState::on(const TraceKey&) {
    settings_.clear();
    threads_.clear();
    for (TraceNodeState& node : nodes_) {
        for (TraceDataState& data : node.data) {
            // A request that is still pending keeps what the key does not tell.
            if (data.data != TraceData::Requested && data.data != TraceData::Started) data = {};
            data.data = TraceData::Absent;
        }
    }
    counts_ = {};
}

// Changes a state and keeps the counts.
void TraceState::setData(std::size_t kind, TraceDataState& data, const TraceDataState& to) {
    if (data.data != TraceData::Absent) --counts_[kind][static_cast<std::size_t>(data.data)];
    if (to.data != TraceData::Absent) ++counts_[kind][static_cast<std::size_t>(to.data)];
    data = to;
}

void TraceState::on(const TraceNamed& named) {
    if (named.index >= names_.size()) names_.resize(named.index + 1);
    names_[named.index] = named.name;
}

void TraceState::on(const TraceNodeTold& told) {
    const bool isNew = told.index >= nodes_.size();
    if (isNew) nodes_.resize(told.index + 1);
    TraceNodeState& state = nodes_[told.index];
    if (!isNew && state.node.id != told.node.id) byId_.erase(state.node.id);
    state.node = told.node;
    byId_[told.node.id] = told.index;
    const TraceNodeIndex parent = told.node.hasParent ? find(told.node.parent) : noTraceNode;
    setParent(told.index, parent);
    if (told.node.hasParent && parent == noTraceNode) orphans_[told.node.parent].push_back(told.index);
    if (const auto waiting = orphans_.find(told.node.id); waiting != orphans_.end()) {
        for (const TraceNodeIndex child : waiting->second)
            if (nodes_[child].node.hasParent && nodes_[child].node.parent == told.node.id)
                setParent(child, told.index);
        orphans_.erase(waiting);
    }
}

void TraceState::setParent(TraceNodeIndex child, TraceNodeIndex parent) {
    const TraceNodeIndex before = nodes_[child].parent;
    if (before == parent) return;
    if (before != noTraceNode) std::erase(nodes_[before].children, child);
    nodes_[child].parent = parent;
    if (parent != noTraceNode && nodes_[parent].children.size() < maxTraceChildren)
        nodes_[parent].children.push_back(child);
}

void TraceState::on(const TraceFrameBegan& began) {
    if (isInFrame_) finishFrame();
    current_.followsGap = lastNumber_ != 0 && began.number != lastNumber_ + 1;
    current_.number = lastNumber_ = began.number;
    current_.beginNs = began.ns;
    current_.timeS = began.timeS;
    isInFrame_ = true;
}

void TraceState::on(const TraceFrameEnded& ended) {
    if (!isInFrame_) return;
    current_.endNs = ended.ns;
    current_.cpuMs = ended.cpuMs;
    current_.gpuMs = ended.gpuMs;
    current_.isEnded = true;
    finishFrame();
}

void TraceState::finishFrame() {
    std::sort(current_.views.begin(), current_.views.end(),
              [](const auto& a, const auto& b) { return a.view < b.view; });
    done_ = std::exchange(current_, {});
    isInFrame_ = false;
    frameEnds_ = true;
}

TraceFrameView& TraceState::viewOf(std::uint8_t view) {
    for (TraceFrameView& known : current_.views)
        if (known.view == view) return known;
    return current_.views.emplace_back(TraceFrameView{view, {}, {}, {}});
}

void TraceState::on(const TracePaged& paged) {
    hasPaging_ = true;
    TraceDataState& data = nodes_[paged.node].data[paged.kind];
    current_.paged.push_back({paged, data});
    TraceDataState next;
    switch (paged.step) {
        case TraceStep::Requested:
            next = {.data = TraceData::Requested,
                    .requestedNs = paged.ns,
                    .requestedS = isInFrame_ ? current_.timeS : done_.timeS,
                    .requestedFrame = lastNumber_};
            if (paged.hasPriority) next.priority = paged.priority;
            break;
        case TraceStep::Started:
            next = data;
            next.data = TraceData::Started;
            next.startedNs = paged.ns;
            break;
        case TraceStep::Arrived:
            next.data = TraceData::Resident;
            break;
        case TraceStep::Failed:
            next.data = TraceData::Failed;
            break;
        case TraceStep::Cancelled:
        case TraceStep::Evicted:
            break;
    }
    setData(paged.kind, data, next);
}

void TraceState::on(const TraceSet& set) {
    if (set.name < names_.size()) settings_[names_[set.name]] = set.value;
}

void TraceState::on(const TraceDropped& dropped) {
    current_.dropped += dropped.count;
    droppedTotal_ += dropped.count;
}

void TraceState::on(const TraceThreadNamed& named) {
    if (named.name < names_.size()) threads_[named.thread] = names_[named.name];
}

void TraceState::on(const TraceRestored& restored) {
    hasPaging_ = true;
    TraceDataState& data = nodes_[restored.node].data[restored.kind];
    const bool isPending = restored.data == TraceData::Requested || restored.data == TraceData::Started;
    const bool isKnown = isPending && data.requestedNs == restored.requestedNs;
    TraceDataState next = isKnown ? data : TraceDataState{};
    next.data = restored.data;
    next.requestedNs = restored.requestedNs;
    next.startedNs = restored.startedNs;
    setData(restored.kind, data, next);
}

const TraceDescription& TraceState::descriptionOrDefault() const {
    static const TraceDescription undescribed;
    return description_ ? *description_ : undescribed;
}

TraceNodeIndex TraceState::find(std::uint64_t id) const {
    const auto found = byId_.find(id);
    return found == byId_.end() ? noTraceNode : found->second;
}

std::optional<double> TraceState::setting(std::string_view name, int view) const {
    for (const std::string& key : {fmt::format("{}/{}", name, view), std::string(name)}) {
        const auto found = settings_.find(key);
        if (found == settings_.end()) continue;
        if (const double* number = std::get_if<double>(&found->second)) return *number;
    }
    return std::nullopt;
}

TraceNodeIndex TraceState::loaderOf(TraceNodeIndex node) const {
    const bool isByParent = descriptionOrDefault().requests == TraceRequests::Children;
    return isByParent ? nodes_[node].parent : node;
}

bool TraceState::isResident(TraceNodeIndex node) const {
    if (!hasPaging_) return true;
    const TraceNodeIndex loader = loaderOf(node);
    return loader == noTraceNode || nodes_[loader].data[0].data == TraceData::Resident;
}

double traceDistance(const TraceBounds& bounds, const glm::dvec3& point, TraceMetric metric) {
    const glm::dvec3 from = point - bounds.centre;
    const bool isTold = bounds.shape != TraceBoundsShape::None;
    if (isTold && metric == TraceMetric::Centre) return glm::length(from);
    if (bounds.shape == TraceBoundsShape::Box && metric == TraceMetric::Sphere)
        return std::max(glm::length(from) - glm::length(bounds.halfSize), 0.0);
    if (bounds.shape == TraceBoundsShape::Sphere) return std::max(glm::length(from) - bounds.radius, 0.0);
    if (bounds.shape != TraceBoundsShape::Box) return std::numeric_limits<double>::quiet_NaN();
    glm::dvec3 outside{0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const double along = std::abs(glm::dot(from, bounds.axes[static_cast<std::size_t>(axis)]));
        outside[axis] = std::max(along - bounds.halfSize[axis], 0.0);
    }
    return glm::length(outside);
}

double traceErrorPx(const TraceDescription& description, const TraceNode& node, const TraceView& view,
                    TraceMetric metric) {
    if (description.error == TraceErrorUnit::Pixels) return node.error;
    constexpr double nearestM = 1e-3;
    const double distance = traceDistance(node.bounds, view.eye, metric);
    if (std::isnan(distance)) return distance;
    const double scale = std::abs(view.projection[0][0]) * view.width / 2;
    return node.error * scale / std::max(distance, nearestM / description.metresPerUnit);
}

std::string traceIdText(const TraceDescription& description, std::uint64_t id) {
    if (description.ids == TraceIds::Opaque) return fmt::format("{}", id);
    constexpr std::array faces = {"x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg", "face_6", "face_7"};
    const TraceQuadtreePlace place = traceQuadtreePlace(id);
    const std::string text = fmt::format("{}/{}/{}", place.level, place.x, place.y);
    return description.shape == TraceShape::Flat ? text : fmt::format("{}/{}", faces[place.face], text);
}

double traceFadeWaitS(const TraceState& state, int view) {
    return 2 * std::max(0.0, state.setting("fade_s", view).value_or(0));
}

}  // namespace planet
