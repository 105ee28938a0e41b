#include "planet/select/prediction.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "planet/select/screen_error.h"
#include "planet/sphere/culling.h"
#include "planet/tree/sphere_polygon.h"

namespace planet {

namespace {

constexpr double historyS = 0.5;
// A prediction never turns farther than this, because a turn seldom goes on for longer.
constexpr double mostTurnRad = glm::radians(180.0);

glm::dvec3 turned(const glm::dvec3& vector, const glm::dvec3& axis, double angleRad) {
    return glm::angleAxis(angleRad, axis) * vector;
}

// The shortest way along the sphere from one eye to another.
struct Travel {
    glm::dvec3 axis{0, 0, 1};  // orthogonal to both; any such axis if they are equal
    double angleRad = 0;
};

Travel travelBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 across = glm::cross(from, to);
    const double length = glm::length(across);
    if (length < 1e-14 * glm::length(from) * glm::length(to)) return {};
    return {across / length, angleBetweenRad(from, to)};
}

glm::dmat3 orientationOf(const View& view) {
    return {view.right, view.up, view.back};
}

// Heights near or below the radius count as at least a thousandth of it, so that their logarithm is finite.
double scaleHeightM(const glm::dvec3& eyeM, double radiusM) {
    return std::max(glm::length(eyeM) - radiusM, radiusM / 1000);
}

// Returns the view of the history that is nearest to the middle of its time.
const TimedView& middleOf(const ViewHistory& history) {
    const double middleS = (history.front().timeS + history.back().timeS) / 2;
    return *std::min_element(history.begin(), history.end(), [&](const TimedView& a, const TimedView& b) {
        return std::abs(a.timeS - middleS) < std::abs(b.timeS - middleS);
    });
}

// Returns the turn of the track per second, to the left: the angle between the ways from the first view to
// the middle one and from there to the last one, over the time between the middles of both.
double turnOf(const ViewHistory& history) {
    const TimedView& middle = middleOf(history);
    const Travel first = travelBetween(history.front().view.eyeM, middle.view.eyeM);
    const Travel second = travelBetween(middle.view.eyeM, history.back().view.eyeM);
    if (first.angleRad == 0 || second.angleRad == 0) return 0;
    const double leftRad =
        std::atan2(glm::dot(glm::cross(first.axis, second.axis), glm::normalize(middle.view.eyeM)),
                   glm::dot(first.axis, second.axis));
    return 2 * leftRad / (history.back().timeS - history.front().timeS);
}

}  // namespace

void addView(ViewHistory& history, const View& view, double timeS, double radiusM) {
    if (!history.empty()) {
        const TimedView& last = history.back();
        assert(timeS >= last.timeS);
        if (isCameraJump(last.view.eyeM, view.eyeM, radiusM, timeS - last.timeS)) history.clear();
    }
    if (!history.empty() && history.back().timeS == timeS) history.pop_back();
    history.push_back({view, timeS});
    // The oldest view that is kept is at least as old as the window, so that slow frames have a history too.
    while (history.size() > 2 && history[1].timeS <= timeS - historyS) history.erase(history.begin());
}

Motion motionOf(const ViewHistory& history, double radiusM) {
    Motion motion;
    if (history.size() < 2) return motion;
    const View& before = history.front().view;
    const View& now = history.back().view;
    const double elapsedS = history.back().timeS - history.front().timeS;
    if (elapsedS <= 0) return motion;
    const Travel travel = travelBetween(before.eyeM, now.eyeM);
    motion.travelRadS = travel.angleRad / elapsedS;
    motion.climbPerS =
        std::log(scaleHeightM(now.eyeM, radiusM) / scaleHeightM(before.eyeM, radiusM)) / elapsedS;
    motion.travelAxis = travel.axis;
    if (travel.angleRad > 0) {
        motion.turnRadS = turnOf(history);
        // The way between two points of a curve has the direction of its middle.
        motion.travelAxis = turned(travel.axis, glm::normalize(now.eyeM), motion.turnRadS * elapsedS / 2);
    }
    const glm::dmat3 carried =
        glm::mat3_cast(glm::angleAxis(travel.angleRad, travel.axis)) * orientationOf(before);
    const glm::dquat rotation = glm::normalize(glm::quat_cast(orientationOf(now) * glm::transpose(carried)));
    const glm::dvec3 axis = rotation.w < 0 ? -glm::dvec3(rotation.x, rotation.y, rotation.z)
                                           : glm::dvec3(rotation.x, rotation.y, rotation.z);
    const double sine = glm::length(axis);
    if (sine > 1e-12) {
        motion.lookAxis = axis / sine;
        motion.lookRadS = 2 * std::atan2(sine, std::abs(rotation.w)) / elapsedS;
    }
    return motion;
}

bool isStill(const Motion& motion) {
    return motion.travelRadS == 0 && motion.climbPerS == 0 && motion.lookRadS == 0;
}

View viewAfter(const View& now, const Motion& motion, double seconds, double radiusM) {
    assert(seconds >= 0);
    if (isStill(motion) || seconds == 0) return now;
    constexpr int steps = 16;
    const double lookRad = std::min(motion.lookRadS * seconds, mostTurnRad) / steps;
    const double turnRad = std::clamp(motion.turnRadS * seconds, -mostTurnRad, mostTurnRad) / steps;
    const double travelRad = motion.travelRadS * seconds / steps;
    glm::dvec3 up = glm::normalize(now.eyeM);
    glm::dvec3 axis = motion.travelAxis, lookAxis = motion.lookAxis;
    glm::dmat3 orientation = orientationOf(now);
    for (int i = 0; i < steps; ++i) {
        // Half of the turn before and half after the way makes the path a smooth curve.
        axis = turned(axis, up, turnRad / 2);
        const glm::dmat3 carry = glm::mat3_cast(glm::angleAxis(travelRad, axis));
        up = carry * up;
        lookAxis = carry * lookAxis;
        axis = turned(axis, up, turnRad / 2);
        orientation = glm::mat3_cast(glm::angleAxis(lookRad, lookAxis)) * carry * orientation;
    }
    View view = now;
    const double growth = std::exp(std::clamp(motion.climbPerS * seconds, -2.0, 2.0)) - 1;
    view.eyeM = glm::normalize(up) * (glm::length(now.eyeM) + growth * scaleHeightM(now.eyeM, radiusM));
    view.right = glm::normalize(orientation[0]);
    view.up = glm::normalize(orientation[1] - glm::dot(orientation[1], view.right) * view.right);
    view.back = glm::cross(view.right, view.up);
    return view;
}

namespace {

struct Wanted {
    const ChunkTree& tree;
    const LodSettings& settings;
    glm::dvec3 eyeM;
    double reach;  // K = K' / τ
    Culling culling;
    std::vector<ChildrenRequest>& requests;
    std::vector<NodeIndex>& touched;
};

void collectBelow(const Wanted& wanted, NodeIndex index, OpenTests open) {
    const ChunkNode& node = wanted.tree.nodes[index];
    wanted.touched.push_back(index);
    if (cull(wanted.culling, node.bounds, open) != Culled::No) return;
    if (node.childrenState == ChildrenState::None || node.id.level >= wanted.settings.maxLevel) return;
    const double priority =
        deltaOf(node, wanted.settings.metric) * wanted.reach / distanceToM(node, wanted.eyeM);
    if (priority <= 1) return;
    if (node.childrenState == ChildrenState::Resident) {
        for (NodeIndex q = 0; q < quadrantCount; ++q) collectBelow(wanted, node.firstChild + q, open);
    } else if (node.childrenState != ChildrenState::Failed) {
        wanted.requests.push_back({index, node.id, static_cast<float>(priority)});
    }
}

}  // namespace

void collectRequests(const ChunkTree& tree, const View& view, const LodSettings& settings,
                     std::vector<ChildrenRequest>& requests, std::vector<NodeIndex>& touched) {
    const Wanted wanted{tree,
                        settings,
                        view.eyeM,
                        screenScalePx(view) / settings.tauPx,
                        {frustumOf(view), horizonOf(view.eyeM, tree.occluderRadiusM)},
                        requests,
                        touched};
    const OpenTests all = openTests(settings.frustumCulling, settings.horizonCulling);
    for (NodeIndex root = 0; root < faceCount; ++root) collectBelow(wanted, root, all);
}

}  // namespace planet
