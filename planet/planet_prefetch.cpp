// Implements what a Planet predicts: the views of the near future, the blocks that they will want, and which of
// the blocks that are wanted now will still be wanted when they arrive.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_set>
#include <utility>

#include "planet/planet_state.h"
#include "planet/spans/span_recorder.h"

namespace planet {

namespace {

// The number of predicted views of a moving camera.
constexpr int predictedViews = 8;
// The least height of a predicted eye above the ground that is resident there, metres.
constexpr double leastClearanceM = 2;

// Blocks that are wanted sooner come first: the priority is 1 / seconds. Among the blocks of one view, it is raised by up to a
// tenth, less than the step to the next view, for those that exceed the tolerance most.
void appendPredicted(const std::vector<ChildrenRequest>& requests, double factor, double inS,
                     std::vector<MergedRequest>& predicted) {
    constexpr double soonestS = 0.1;  // bounds the priorities of what is wanted at once
    for (const ChildrenRequest& one : requests) {
        const double raised = 1 + 0.1 * (1 - 1 / std::max(static_cast<double>(one.priority), 1.0));
        predicted.push_back(
            {one.parent, one.parentId, static_cast<float>(factor * raised / std::max(inS, soonestS))});
    }
}

// Returns the place of the view that is nearest to a time; nothing if now is nearer.
std::optional<std::size_t> nearestAhead(const std::vector<AnnouncedView>& ahead, double inS) {
    std::optional<std::size_t> nearest;
    double distanceS = inS;
    for (std::size_t i = 0; i < ahead.size(); ++i) {
        if (std::abs(ahead[i].inS - inS) >= distanceS) continue;
        distanceS = std::abs(ahead[i].inS - inS);
        nearest = i;
    }
    return nearest;
}

void insertParents(const std::vector<ChildrenRequest>& requests, std::unordered_set<NodeIndex>& parents) {
    for (const ChildrenRequest& one : requests) parents.insert(one.parent);
}

// Keeps the highest priority of each block.
void mergePredicted(std::vector<MergedRequest>& predicted) {
    sortByPriority(predicted);
    std::unordered_set<NodeIndex> known;
    std::erase_if(predicted, [&](const MergedRequest& one) { return !known.insert(one.parent).second; });
}

}  // namespace

void PlanetState::announce(std::span<const AnnouncedView> path, std::size_t view) {
    std::vector<AnnouncedView>& announced = courses[view].announced;
    announced.assign(path.begin(), path.end());
    std::sort(announced.begin(), announced.end(),
              [](const AnnouncedView& a, const AnnouncedView& b) { return a.inS < b.inS; });
    if (announced.size() > maxAnnounced) announced.resize(maxAnnounced);
}

// Ages the announcements and remembers the views, so that prefetching can begin at any time.
void PlanetState::followCourses(double elapsedS) {
    const double radiusM = heights.tree.shape.radiusM;
    for (std::size_t v = 0; v < courses.size(); ++v) {
        ViewCourse& course = courses[v];
        for (AnnouncedView& one : course.announced) one.inS -= elapsedS;
        std::erase_if(course.announced, [](const AnnouncedView& one) { return one.inS < 0; });
        if (v < views.size())
            addView(course.history, views[v].input.lodView, run.sinceResetS, radiusM);
        else
            course.history.clear();
    }
}

// Returns the views of the near future, within the horizon, in order of time; none for a camera at rest.
std::vector<AnnouncedView> PlanetState::viewsAhead(std::size_t view) const {
    const ViewCourse& course = courses[view];
    const double horizonS = settings.prefetch.horizonS;
    std::vector<AnnouncedView> ahead;
    if (settings.prefetch.mode == PrefetchMode::Announced && !course.announced.empty()) {
        for (const AnnouncedView& one : course.announced)
            if (one.inS <= horizonS) ahead.push_back(one);
        return ahead;
    }
    const double radiusM = heights.tree.shape.radiusM;
    const Motion motion = motionOf(course.history, radiusM);
    if (isStill(motion)) return ahead;
    for (int i = 1; i <= predictedViews; ++i) {
        const double inS = horizonS * i / predictedViews;
        View one = viewAfter(views[view].input.lodView, motion, inS, radiusM);
        // A camera that flies towards a slope will follow it.
        const double groundM = radiusM + residentHeightM(heights.tree, one.eyeM);
        const double eyeM = glm::length(one.eyeM);
        if (eyeM < groundM + leastClearanceM) one.eyeM *= (groundM + leastClearanceM) / eyeM;
        ahead.push_back({one, inS});
    }
    return ahead;
}

// Selects for the views of the near future.
Predicted PlanetState::predict() const {
    const SpanScope span("predict");
    Predicted predicted;
    const double waitS = std::min(backlog.waitS(), settings.prefetch.horizonS);
    for (std::size_t v = 0; v < views.size(); ++v) {
        const ViewInput& input = views[v].input;
        const std::vector<AnnouncedView> ahead = viewsAhead(v);
        const std::optional<std::size_t> onArrival = nearestAhead(ahead, waitS);
        for (std::size_t kind = 0; kind < blockKindCount && !onArrival; ++kind)
            insertParents(requestsIn(views[v], static_cast<BlockKind>(kind)), predicted.lasting[kind]);
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            const View& view = ahead[i].view;
            const auto add = [&](BlockKind kind, const std::vector<ChildrenRequest>& requests) {
                const auto k = static_cast<std::size_t>(kind);
                appendPredicted(requests, input.priorityFactor, ahead[i].inS, predicted.wanted[k]);
                if (i == onArrival) insertParents(requests, predicted.lasting[k]);
            };
            std::vector<ChildrenRequest> requests;
            collectRequests(heights.tree, view, input.lod, requests,
                            predicted.touched[static_cast<std::size_t>(BlockKind::Heights)]);
            add(BlockKind::Heights, requests);
            for (const TilePaging* tiles : {&colours, &normals}) {
                TileSelection selected;
                selectTiles(tiles->tree, heights.tree, view,
                            tiles == &colours ? input.colours : input.normals, input.lod, selected);
                add(tiles->kind(), selected.requests);
                std::vector<NodeIndex>& touched = predicted.touched[static_cast<std::size_t>(tiles->kind())];
                touched.insert(touched.end(), selected.touched.begin(), selected.touched.end());
            }
        }
    }
    for (std::vector<MergedRequest>& wanted : predicted.wanted) mergePredicted(wanted);
    return predicted;
}

void PlanetState::measureBacklog(double elapsedS) {
    constexpr double meanS = 2;
    const double ended = static_cast<double>(std::exchange(backlog.ended, 0));
    // Loaders that had nothing to do say nothing about their rate.
    if (backlog.queued == 0 || elapsedS <= 0) return;
    const double weight = backlog.readsPerS > 0 ? 1 - std::exp(-elapsedS / meanS) : 1;
    backlog.readsPerS += weight * (ended / elapsedS - backlog.readsPerS);
}

void PlanetState::forgetCourses() {
    courses = {};
    backlog = {};
}

}  // namespace planet
