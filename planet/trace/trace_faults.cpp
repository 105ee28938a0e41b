#include "planet/trace/trace_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "planet/sphere/chunk_id.h"
#include "planet/trace/trace_quadtree.h"

namespace planet {

namespace {

// A hostile trace can link parents in a ring.
constexpr int mostAncestors = 64;

std::string nameOf(const TraceState& state, TraceNodeIndex node) {
    return traceIdText(state.descriptionOrDefault(), state.nodes()[node].node.id);
}

// Returns whether a point is inside the sides of the frustum and before the eye.
bool isInFrustum(const TraceView& view, const glm::dvec3& point) {
    const glm::dvec4 clip = view.projection * (view.view * glm::dvec4(point, 1));
    return clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
}

// Returns whether the sphere of the world's radius leaves the direction of a point visible.
bool isBeforeHorizon(const TraceDescription& description, const TraceView& view, const glm::dvec3& point) {
    if (description.shape != TraceShape::Sphere) return true;
    const double distance = glm::length(view.eye);
    const double length = glm::length(point);
    if (!(distance > description.radius) || !(length > 0)) return true;
    return glm::dot(view.eye, point) / (distance * length) > description.radius / distance;
}

// Returns whether the middle of a node's bounds must be seen: an engine can cull it neither by frustum nor by horizon.
bool isVisible(const TraceState& state, const TraceView& view, TraceNodeIndex node) {
    const TraceBounds& bounds = state.nodes()[node].node.bounds;
    if (bounds.shape == TraceBoundsShape::None) return false;
    return isInFrustum(view, bounds.centre) &&
           isBeforeHorizon(state.descriptionOrDefault(), view, bounds.centre);
}

// Marks a node; returns false if it was marked in this frame.
bool mark(std::vector<std::uint32_t>& stamps, TraceNodeIndex node, std::uint32_t frame) {
    return std::exchange(stamps[node], frame) != frame;
}

double elapsedS(const TraceDataState& request, double endS, std::uint64_t endNs) {
    if (!std::isnan(request.requestedS)) return endS - request.requestedS;
    return static_cast<double>(static_cast<std::int64_t>(endNs - request.requestedNs)) * 1e-9;
}

// Bounds can touch whose centres are at most this times the sum of their radii apart.
constexpr double touchReach = 1.1;

// Returns whether the coarser box contains the place just beyond the middle of a side of the finer one. Heights count only as
// far as the two boxes reach together, because neighbours lie beside each other.
bool boxesTouch(const TraceBounds& finer, const TraceBounds& coarser) {
    constexpr double beyond = 1.02;
    constexpr double slack = 1.001;
    for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t axis = side / 2;
        const double sign = side % 2 == 0 ? 1 : -1;
        const glm::dvec3 place =
            finer.centre + finer.axes[axis] * (sign * beyond * finer.halfSize[static_cast<int>(axis)]);
        const glm::dvec3 from = place - coarser.centre;
        const bool isBeside = std::abs(glm::dot(from, coarser.axes[0])) <= coarser.halfSize.x * slack &&
                              std::abs(glm::dot(from, coarser.axes[1])) <= coarser.halfSize.y * slack;
        const double reach =
            coarser.halfSize.z + std::max({finer.halfSize.x, finer.halfSize.y, finer.halfSize.z});
        if (isBeside && std::abs(glm::dot(from, coarser.axes[2])) <= reach) return true;
    }
    return false;
}

// Spheres around squares that share an edge are nearer to each other than those that share a corner.
bool spheresTouch(const TraceBounds& a, const TraceBounds& b) {
    return glm::length(a.centre - b.centre) <= std::hypot(a.radius, b.radius) * 1.001;
}

bool areNear(const TraceBounds& a, const TraceBounds& b) {
    return glm::length(a.centre - b.centre) <= touchReach * (a.reach() + b.reach());
}

bool touch(const TraceBounds& finer, const TraceBounds& coarser) {
    if (finer.shape != coarser.shape) return false;
    if (!areNear(finer, coarser)) return false;
    return finer.shape == TraceBoundsShape::Sphere
               ? spheresTouch(finer, coarser)
               : finer.shape == TraceBoundsShape::Box && boxesTouch(finer, coarser);
}

std::string framesOf(const TraceFault& fault) {
    return traceFramesText(fault.frames, fault.firstFrame, fault.lastFrame);
}

// Returns since when something holds for a node, seconds, and notes it for the next frame. before: of the frame before.
double sinceWhen(TraceNodeIndex node, double nowS, const std::unordered_map<TraceNodeIndex, double>& before,
                 std::unordered_map<TraceNodeIndex, double>& noted) {
    const auto found = before.find(node);
    return noted[node] = found == before.end() ? nowS : found->second;
}

// Returns whether a node's data came in this frame: too late for what the frame drew.
bool arrives(const TraceState& state, TraceNodeIndex node) {
    return std::ranges::any_of(state.frame().paged, [&](const TracePagedStep& step) {
        return step.event.node == node && step.event.kind == 0 && step.event.step == TraceStep::Arrived;
    });
}

// Returns a child for whose data a node waits; noTraceNode if all data is there. An engine need not load children that it
// culls, so one that is being loaded is preferred.
TraceNodeIndex missingChild(const TraceState& state, const TraceNodeState& node) {
    TraceNodeIndex missing = noTraceNode, arriving = noTraceNode;
    for (const TraceNodeIndex child : node.children) {
        const TraceNodeIndex loader = state.loaderOf(child);
        if (state.isResident(child)) {
            if (loader != noTraceNode && arrives(state, loader)) arriving = child;
            continue;
        }
        const TraceData data = state.nodes()[loader].data[0].data;
        if (data == TraceData::Requested || data == TraceData::Started) return child;
        if (missing == noTraceNode) missing = child;
    }
    return missing != noTraceNode && arriving != noTraceNode ? arriving : missing;
}

// The bounds of a drawn node along an axis, for a sweep over all of them.
struct SweptNode {
    double from = 0, to = 0;
    TraceNodeIndex node = noTraceNode;
    std::uint64_t level = 0;
};

}  // namespace

std::string traceFramesText(std::uint64_t frames, std::uint64_t first, std::uint64_t last) {
    return frames == 1 ? fmt::format("in frame {}", first)
                       : fmt::format("in {} frames from {} to {}", frames, first, last);
}

const char* traceFaultName(TraceFaultKind kind) {
    switch (kind) {
        case TraceFaultKind::DrawnTwice:
            return "drawn twice";
        case TraceFaultKind::Hole:
            return "hole";
        case TraceFaultKind::Thrash:
            return "thrash";
        case TraceFaultKind::LatePage:
            return "late page";
        case TraceFaultKind::Starvation:
            return "starvation";
        case TraceFaultKind::LevelStep:
            return "level step";
        case TraceFaultKind::TooCoarse:
            return "too coarse";
        case TraceFaultKind::TooFine:
            return "too fine";
    }
    return "";
}

std::size_t TraceFaultFinder::KeyHash::operator()(const Key& key) const {
    const std::uint64_t nodes = static_cast<std::uint64_t>(key.node) << 32 | key.other;
    return static_cast<std::size_t>((nodes ^ static_cast<std::uint64_t>(key.kind) << 60 ^
                                     static_cast<std::uint64_t>(key.view + 1) << 28) *
                                        0x9E3779B97F4A7C15u >>
                                    7);
}

TraceFault& TraceFaultFinder::note(const TraceState& state, const Key& key, std::uint64_t firstFrame) {
    const std::uint64_t frame = state.frame().number;
    const auto [found, isNew] = open_.try_emplace(key, faults_.size());
    if (isNew && faults_.size() >= limits_.maxFaults) {
        open_.erase(found);
        ++unlisted_;
        unlistedFault_ = {};
        return unlistedFault_;
    }
    if (!isNew) {
        TraceFault& known = faults_[found->second];
        if (known.lastFrame == frame) return known;
        if (known.lastFrame >= frameBefore_) {
            known.lastFrame = frame;
            ++known.frames;
            return known;
        }
        found->second = faults_.size();
    }
    TraceFault fault;
    fault.kind = key.kind;
    fault.view = key.view;
    fault.firstFrame = firstFrame != 0 ? firstFrame : frame;
    fault.lastFrame = frame;
    fault.frames = 1;
    if (key.node != noTraceNode) fault.node = state.nodes()[key.node].node.id;
    fault.hasOther = key.other != noTraceNode;
    if (fault.hasOther) fault.other = state.nodes()[key.other].node.id;
    return faults_.emplace_back(std::move(fault));
}

void TraceFaultFinder::add(const TraceState& state) {
    const TraceFrame& frame = state.frame();
    findLate(state);
    if (!frame.isComplete()) {
        // It is not known what a view drew, so nothing in the next frame is a change.
        views_.clear();
        return;
    }
    ++frames_;
    for (const TraceFrameView& view : frame.views) {
        ViewMemory& memory = views_[view.view];
        markView(state, view, memory);
        findHoles(state, view, memory);
        findThrash(state, view.view, memory);
        judgeErrors(state, view, memory);
        findSteps(state, view, memory);
    }
    frameBefore_ = frame.number;
}

// Marks what is drawn and all its ancestors, and finds ancestors that are drawn too.
void TraceFaultFinder::markView(const TraceState& state, const TraceFrameView& view, ViewMemory& memory) {
    const auto& nodes = state.nodes();
    if (memory.frame + 1 != frames_) memory.listBefore = memory.splitBefore = {};
    if (memory.frame + 1 == frames_) {
        std::swap(memory.drawn, memory.drawnBefore);
        std::swap(memory.below, memory.belowBefore);
        std::swap(memory.list, memory.listBefore);
        std::swap(memory.split, memory.splitBefore);
    }
    memory.frame = frames_;
    for (auto* stamps :
         {&memory.drawn, &memory.below, &memory.drawnBefore, &memory.belowBefore, &memory.culled})
        stamps->resize(nodes.size(), 0);
    memory.list.clear();
    memory.split.clear();
    for (const TraceCulled& culled : view.culled) memory.culled[culled.node] = frames_;
    for (const TraceDrawn& drawn : view.drawn)
        if (mark(memory.drawn, drawn.node, frames_)) memory.list.push_back(drawn.node);
    for (const TraceNodeIndex node : memory.list) {
        TraceNodeIndex ancestor = nodes[node].parent;
        for (int step = 0; step < mostAncestors && ancestor != noTraceNode && ancestor != node; ++step) {
            if (mark(memory.below, ancestor, frames_)) memory.split.push_back(ancestor);
            if (memory.drawn[ancestor] == frames_) {
                TraceFault& fault = note(state, {TraceFaultKind::DrawnTwice, view.view, node, ancestor});
                fault.sentence =
                    fmt::format("{} is drawn although its {} {} is drawn too, {}", nameOf(state, node),
                                step == 0 ? "parent" : "ancestor", nameOf(state, ancestor), framesOf(fault));
            }
            ancestor = nodes[ancestor].parent;
        }
    }
}

void TraceFaultFinder::findHoles(const TraceState& state, const TraceFrameView& view,
                                 const ViewMemory& memory) {
    if (!view.info) return;
    const auto& nodes = state.nodes();
    for (const TraceNodeIndex parent : memory.split) {
        bool isCovered = false;
        TraceNodeIndex ancestor = parent;
        for (int step = 0; step < mostAncestors && ancestor != noTraceNode && !isCovered; ++step) {
            isCovered = memory.drawn[ancestor] == frames_ || memory.culled[ancestor] == frames_;
            ancestor = nodes[ancestor].parent;
        }
        if (isCovered) continue;
        for (const TraceNodeIndex child : nodes[parent].children) {
            const bool isDrawn = memory.drawn[child] == frames_ || memory.below[child] == frames_;
            if (isDrawn || memory.culled[child] == frames_ || !isVisible(state, *view.info, child)) continue;
            TraceFault& fault = note(state, {TraceFaultKind::Hole, view.view, child, parent});
            fault.sentence =
                fmt::format("nothing is drawn at {} although its parent {} is split and it is in view, {}",
                            nameOf(state, child), nameOf(state, parent), framesOf(fault));
        }
    }
}

void TraceFaultFinder::findThrash(const TraceState& state, int view, ViewMemory& memory) {
    const auto heldBefore = [&](const std::vector<std::uint32_t>& stamps, TraceNodeIndex node) {
        return stamps[node] + 1 == frames_ && frames_ > 1;
    };
    for (const TraceNodeIndex node : memory.listBefore) {
        if (memory.below[node] == frames_ && memory.drawn[node] != frames_)
            noteChange(state, view, memory, node, true);
    }
    for (const TraceNodeIndex node : memory.list) {
        if (heldBefore(memory.belowBefore, node) && !heldBefore(memory.drawnBefore, node))
            noteChange(state, view, memory, node, false);
    }
}

void TraceFaultFinder::noteChange(const TraceState& state, int view, ViewMemory& memory, TraceNodeIndex node,
                                  bool isSplit) {
    const TraceFrame& frame = state.frame();
    const auto [found, isNew] = memory.changes.try_emplace(node);
    Change& change = found->second;
    const bool isBack =
        !isNew && change.isSplit != isSplit && std::abs(frame.timeS - change.timeS) <= limits_.thrashWithinS;
    change.reversals = isBack ? change.reversals + 1 : 0;
    // The change that is taken back first was right.
    if (change.reversals <= 1) change.firstFrame = frame.number;
    change.timeS = frame.timeS;
    change.isSplit = isSplit;
    if (change.reversals < limits_.thrashReversals) return;
    // One fault for as long as it goes on, although a change is not in each frame.
    const Key key{TraceFaultKind::Thrash, view, node, noTraceNode};
    const auto open = open_.find(key);
    const bool goesOn = open != open_.end() && faults_[open->second].firstFrame == change.firstFrame;
    if (!goesOn) open_.erase(key);
    TraceFault& fault = goesOn ? faults_[open->second] : note(state, key, change.firstFrame);
    fault.lastFrame = frame.number;
    fault.frames = fault.lastFrame - fault.firstFrame + 1;
    fault.value = change.reversals;
    fault.limit = limits_.thrashReversals;
    const std::uint32_t level = state.nodes()[node].node.level;
    fault.sentence =
        fmt::format("{} changes between levels {} and {} and back {} times within {} frames from {} to {}",
                    nameOf(state, node), level, level + 1, change.reversals, fault.frames, fault.firstFrame,
                    fault.lastFrame);
}

void TraceFaultFinder::late(const TraceState& state, TraceNodeIndex node, const TraceDataState& request,
                            const char* end, double endS, std::uint64_t endNs) {
    const double seconds = elapsedS(request, endS, endNs);
    if (!(seconds > limits_.lateAfterS)) return;
    open_.erase({TraceFaultKind::LatePage, -1, node, noTraceNode});  // each request is a fault of its own
    TraceFault& fault =
        note(state, {TraceFaultKind::LatePage, -1, node, noTraceNode}, request.requestedFrame);
    fault.frames = fault.lastFrame - std::min(fault.firstFrame, fault.lastFrame) + 1;
    fault.value = seconds;
    fault.limit = limits_.lateAfterS;
    fault.sentence =
        fmt::format("the data of {} {} {:.3f} s after its request in frame {}; expected at most {} s",
                    nameOf(state, node), end, seconds, fault.firstFrame, limits_.lateAfterS);
}

void TraceFaultFinder::findLate(const TraceState& state) {
    for (const TracePagedStep& step : state.frame().paged) {
        const bool wasPending =
            step.before.data == TraceData::Requested || step.before.data == TraceData::Started;
        const bool isEnd = step.event.step == TraceStep::Arrived || step.event.step == TraceStep::Failed;
        if (!wasPending || !isEnd) continue;
        late(state, step.event.node, step.before, step.event.step == TraceStep::Arrived ? "arrives" : "fails",
             state.frame().timeS, step.event.ns);
    }
}

void TraceFaultFinder::finish(const TraceState& state) {
    for (TraceNodeIndex node = 0; node < state.nodes().size(); ++node) {
        for (const TraceDataState& data : state.nodes()[node].data) {
            if (data.data != TraceData::Requested && data.data != TraceData::Started) continue;
            const TraceFrame& last = state.frame();
            late(state, node, data, "is still not there", last.timeS, std::max(last.beginNs, last.endNs));
        }
    }
}

// Compares errors with τ, as the engine's selection must have: split above τ, merge below τ (1 - hysteresis).
void TraceFaultFinder::judgeErrors(const TraceState& state, const TraceFrameView& view, ViewMemory& memory) {
    const auto tau = state.setting("tau", view.view);
    if (!tau || !view.info) return;
    ErrorTally tally;
    tally.tauPx = *tau;
    tally.mergePx = *tau * (1 - state.setting("hysteresis", view.view).value_or(0));
    tally.maxLevel = state.setting("max_level", view.view).value_or(1e9);
    tally.fadeWaitS = traceFadeWaitS(state, view.view);
    for (const TraceDrawn& drawn : view.drawn) {
        judgeCoarse(state, view, memory, drawn, tally);
        judgeFine(state, view, memory, drawn.node, tally);
    }
    memory.coarseSinceS = std::move(tally.coarseSinceS);
    memory.starvedSinceS = std::move(tally.starvedSinceS);
    memory.fineNodeSinceS = std::move(tally.fineNodeSinceS);
    if (tally.coarse > 0) reportCoarse(state, view.view, tally);
    const bool isFine =
        static_cast<double>(tally.fine) > limits_.tooFineShare * static_cast<double>(tally.withParent);
    const double now = state.frame().timeS;
    if (isFine && !memory.isFine) memory.fineSinceS = now;
    memory.isFine = isFine;
    if (isFine && now - memory.fineSinceS >= limits_.ignoredAfterS) reportFine(state, view, tally);
}

// Judges a drawn node that exceeds τ: its children's data is missing, or selection did not split it.
void TraceFaultFinder::judgeCoarse(const TraceState& state, const TraceFrameView& view,
                                   const ViewMemory& memory, const TraceDrawn& drawn, ErrorTally& tally) {
    const TraceNodeState& node = state.nodes()[drawn.node];
    const double error = drawn.hasErrorPx ? static_cast<double>(drawn.errorPx)
                                          : traceErrorPx(state.descriptionOrDefault(), node.node, *view.info);
    if (!(error > tally.tauPx * (1 + limits_.errorSlack)) || node.node.level >= tally.maxLevel ||
        node.children.empty())
        return;
    const double now = state.frame().timeS;
    const TraceNodeIndex missing = missingChild(state, node);
    if (missing == noTraceNode) {
        const double waitedS = now - sinceWhen(drawn.node, now, memory.coarseSinceS, tally.coarseSinceS);
        if (waitedS < limits_.ignoredAfterS + tally.fadeWaitS) return;
        ++tally.coarse;
        if (error <= tally.worstCoarsePx) return;
        tally.worstCoarse = drawn.node;
        tally.worstCoarsePx = error;
        return;
    }
    const double starvedS = now - sinceWhen(drawn.node, now, memory.starvedSinceS, tally.starvedSinceS);
    if (starvedS < limits_.starvedAfterS) return;
    const TraceNodeIndex loader = state.loaderOf(missing);
    TraceFault& fault = note(state, {TraceFaultKind::Starvation, view.view, drawn.node, loader});
    fault.value = starvedS;
    fault.limit = limits_.starvedAfterS;
    fault.sentence = fmt::format(
        "{} is drawn with an error of {:.2f} px for {:.3f} s, until frame {}, because the data of {} is not "
        "there; expected at most {} px",
        nameOf(state, drawn.node), error, starvedS, fault.lastFrame, nameOf(state, loader), tally.tauPx);
}

void TraceFaultFinder::judgeFine(const TraceState& state, const TraceFrameView& view,
                                 const ViewMemory& memory, TraceNodeIndex node, ErrorTally& tally) const {
    const TraceNodeIndex parent = state.nodes()[node].parent;
    if (parent == noTraceNode) return;
    ++tally.withParent;
    const double error = traceErrorPx(state.descriptionOrDefault(), state.nodes()[parent].node, *view.info);
    if (!(error < tally.mergePx * (1 - limits_.errorSlack))) return;
    if (tally.fadeWaitS > 0) {
        const double now = state.frame().timeS;
        const double sinceS = sinceWhen(node, now, memory.fineNodeSinceS, tally.fineNodeSinceS);
        if (now - sinceS < tally.fadeWaitS) return;
    }
    ++tally.fine;
    if (tally.worstFine != noTraceNode && error >= tally.worstFinePx) return;
    tally.worstFine = node;
    tally.worstFinePx = error;
}

// A view has one fault of this kind, whichever node is the worst in a frame.
void TraceFaultFinder::reportCoarse(const TraceState& state, int view, const ErrorTally& tally) {
    TraceFault& fault = note(state, {TraceFaultKind::TooCoarse, view, noTraceNode, noTraceNode});
    fault.count = std::max(fault.count, tally.coarse);
    fault.limit = tally.tauPx;
    if (tally.worstCoarsePx > fault.value) {
        fault.value = tally.worstCoarsePx;
        fault.node = state.nodes()[tally.worstCoarse].node.id;
    }
    fault.sentence = fmt::format(
        "selection ignores its own tau: {} nodes exceed it for more than {} s although their children are "
        "there, {} with {:.2f} px, {}; expected at most {} px",
        fault.count, limits_.ignoredAfterS + tally.fadeWaitS,
        traceIdText(state.descriptionOrDefault(), fault.node), fault.value, framesOf(fault), tally.tauPx);
}

void TraceFaultFinder::reportFine(const TraceState& state, const TraceFrameView& view,
                                  const ErrorTally& tally) {
    TraceFault& fault = note(state, {TraceFaultKind::TooFine, view.view, noTraceNode, noTraceNode});
    if (fault.frames == 1 || tally.worstFinePx < fault.value) {
        fault.value = tally.worstFinePx;
        fault.node = state.nodes()[tally.worstFine].node.id;
    }
    fault.count = std::max(fault.count, tally.fine);
    fault.limit = tally.mergePx;
    fault.sentence = fmt::format(
        "selection ignores its own tau: {} of {} drawn nodes are finer than necessary, the parent of {} has "
        "{:.3f} px, {}; expected more than {:.3f} px",
        tally.fine, view.drawn.size(), traceIdText(state.descriptionOrDefault(), fault.node), fault.value,
        framesOf(fault), tally.mergePx);
}

void TraceFaultFinder::step(const TraceState& state, int view, TraceNodeIndex finer, TraceNodeIndex coarser) {
    const std::uint32_t fine = state.nodes()[finer].node.level, coarse = state.nodes()[coarser].node.level;
    TraceFault& fault = note(state, {TraceFaultKind::LevelStep, view, finer, coarser});
    fault.value = static_cast<double>(fine) - static_cast<double>(coarse);
    fault.limit = 1;
    fault.sentence = fmt::format("{} of level {} is drawn beside {} of level {}, {}", nameOf(state, finer),
                                 fine, nameOf(state, coarser), coarse, framesOf(fault));
}

void TraceFaultFinder::findSteps(const TraceState& state, const TraceFrameView& view,
                                 const ViewMemory& memory) {
    const bool hasPlaces = state.descriptionOrDefault().ids == TraceIds::Quadtree;
    if (hasPlaces) {
        findStepsById(state, view.view, memory);
    } else {
        findStepsByBounds(state, view.view, memory);
    }
}

// Finds the drawn node beyond each edge. A sphere with more than two faces is a cube, whose faces lie as those of
// cube_sphere.h. Another engine may turn its faces, so beyond the edge of a face the bounds must be near as well, if they are told.
void TraceFaultFinder::findStepsById(const TraceState& state, int view, const ViewMemory& memory) {
    const auto placeOfNode = [&](TraceNodeIndex node) {
        return traceQuadtreePlace(state.nodes()[node].node.id);
    };
    const auto boundsOf = [&](TraceNodeIndex node) -> const TraceBounds& {
        return state.nodes()[node].node.bounds;
    };
    const bool isCube =
        state.descriptionOrDefault().shape == TraceShape::Sphere &&
        std::ranges::any_of(memory.list, [&](TraceNodeIndex node) { return placeOfNode(node).face >= 2; });
    for (const TraceNodeIndex node : memory.list) {
        const TraceQuadtreePlace place = placeOfNode(node);
        for (const Edge edge : allEdges) {
            std::optional<TraceQuadtreePlace> beyond = tracePlaceBeyond(place, edge, isCube);
            while (beyond && beyond->level > 0) {
                beyond = {beyond->face, beyond->level - 1, beyond->x / 2, beyond->y / 2};
                if (place.level - beyond->level < 2) continue;
                const TraceNodeIndex found = state.find(traceQuadtreeId(*beyond));
                if (found == noTraceNode || found >= memory.drawn.size() || memory.drawn[found] != frames_)
                    continue;
                // Neither its own ancestor nor a node that is drawn with its descendants: those are other faults.
                const TraceQuadtreePlace own{place.face, beyond->level,
                                             place.x >> (place.level - beyond->level),
                                             place.y >> (place.level - beyond->level)};
                const bool isBeside = place.face == beyond->face ||
                                      boundsOf(node).shape == TraceBoundsShape::None ||
                                      boundsOf(found).shape == TraceBoundsShape::None ||
                                      areNear(boundsOf(node), boundsOf(found));
                if (traceQuadtreeId(own) != traceQuadtreeId(*beyond) && memory.below[found] != frames_ &&
                    isBeside)
                    step(state, view, node, found);
                break;
            }
        }
    }
}

// Compares only nodes whose bounds overlap along the axis along which their centres spread the most.
void TraceFaultFinder::findStepsByBounds(const TraceState& state, int view, const ViewMemory& memory) {
    const auto boundsOf = [&](TraceNodeIndex node) -> const TraceBounds& {
        return state.nodes()[node].node.bounds;
    };
    // A node that is drawn with its descendants is another fault.
    const auto isSwept = [&](TraceNodeIndex node) {
        const TraceBounds& bounds = boundsOf(node);
        return memory.below[node] != frames_ && bounds.shape != TraceBoundsShape::None &&
               std::isfinite(glm::length(bounds.centre) + bounds.reach());
    };
    glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const TraceNodeIndex node : memory.list) {
        if (!isSwept(node)) continue;
        low = glm::min(low, boundsOf(node).centre);
        high = glm::max(high, boundsOf(node).centre);
    }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
    std::vector<SweptNode> swept;
    for (const TraceNodeIndex node : memory.list) {
        if (!isSwept(node)) continue;
        const double middle = boundsOf(node).centre[axis], reach = touchReach * boundsOf(node).reach();
        swept.push_back({middle - reach, middle + reach, node, state.nodes()[node].node.level});
    }
    std::ranges::stable_sort(swept, {}, &SweptNode::from);
    for (std::size_t i = 0; i < swept.size(); ++i) {
        for (std::size_t j = i + 1; j < swept.size() && swept[j].from <= swept[i].to; ++j) {
            const bool isFiner = swept[i].level > swept[j].level;
            const SweptNode &finer = isFiner ? swept[i] : swept[j], &coarser = isFiner ? swept[j] : swept[i];
            if (finer.level < coarser.level + 2) continue;
            if (touch(boundsOf(finer.node), boundsOf(coarser.node)))
                step(state, view, finer.node, coarser.node);
        }
    }
}

}  // namespace planet
