#include "app/scene/observer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "planet/select/screen_error.h"

namespace worldy {

namespace {

constexpr planet::LineColour frustumColour = {255, 214, 90, 255};
constexpr planet::LineColour horizonColour = {90, 200, 255, 255};
constexpr planet::LineColour eyeColour = {255, 255, 255, 255};
constexpr planet::LineColour switchColour = {255, 110, 220, 255};
constexpr planet::LineColour boundsColour = {255, 110, 220, 140};

// Appends the outline of all points within a distance of a rectangle: straight sides, round corners.
void appendRoundedRectangle(const planet::OrientedBox& box, std::size_t first, std::size_t second,
                            double distanceM, const planet::LineColour& colour, planet::Lines& lines) {
    constexpr int segmentsACorner = 12;
    const auto at = [&](int corner, int step) {
        const double x = corner == 0 || corner == 3 ? 1 : -1;
        const double y = corner < 2 ? 1 : -1;
        const double angle = glm::radians(90.0) * (corner + static_cast<double>(step) / segmentsACorner);
        const int i = static_cast<int>(first);
        const int j = static_cast<int>(second);
        return box.centreM + (x * box.halfSizeM[i] + distanceM * std::cos(angle)) * box.axes[first] +
               (y * box.halfSizeM[j] + distanceM * std::sin(angle)) * box.axes[second];
    };
    glm::dvec3 last = at(3, segmentsACorner);
    for (int corner = 0; corner < 4; ++corner) {
        for (int step = 0; step <= segmentsACorner; ++step) {
            const glm::dvec3 next = at(corner, step);
            lines.push_back({last, colour});
            lines.push_back({next, colour});
            last = next;
        }
    }
}

void appendSwitchDistance(const planet::Planet& planet, const planet::View& lodView,
                          const planet::ChunkId& selected, planet::Lines& lines) {
    const planet::NodeIndex index = planet::findNode(planet.tree(), selected);
    if (index == planet::noNode) return;
    const planet::ChunkNode& node = planet.tree().nodes[index];
    planet::appendBox(node.bounds.box, boundsColour, lines);
    const double scale = planet::screenScalePx(lodView) /
                         (planet.views()[0].input.lod.tauPx * static_cast<double>(node.demand.tauFactor));
    const double switchDistanceM =
        static_cast<double>(planet::deltaOf(node, planet.views()[0].input.lod.metric)) * scale;
    if (switchDistanceM == 0) return;  // a leaf is never replaced
    for (std::size_t axis = 0; axis < 3; ++axis) {
        appendRoundedRectangle(node.bounds.box, axis, (axis + 1) % 3, switchDistanceM, switchColour, lines);
    }
}

}  // namespace

double frustumLengthM(const planet::View& view, double groundRadiusM) {
    const double width = view.widthPx;
    const double height = view.heightPx;
    const double eyeRadiusM = glm::length(view.eyeM);
    double farthestM = 0;
    bool seesSky = false;
    for (const glm::dvec2 pixel : {glm::dvec2{width / 2, height / 2}, glm::dvec2{0, 0}, glm::dvec2{width, 0},
                                   glm::dvec2{0, height}, glm::dvec2{width, height}}) {
        const auto groundM = distanceToSphereM(view.eyeM, rayThrough(view, pixel), groundRadiusM);
        farthestM = std::max(farthestM, groundM.value_or(0));
        seesSky |= !groundM;
    }
    // A view of both ground and sky contains the horizon.
    if (farthestM > 0 && seesSky)
        return std::sqrt(std::max(eyeRadiusM * eyeRadiusM - groundRadiusM * groundRadiusM, 1.0));
    // A view of the sky alone gets the height of the eye.
    return farthestM > 0 ? farthestM : std::max(eyeRadiusM - groundRadiusM, minGroundClearanceM);
}

Camera observerStart(const planet::View& lodView, const Ground& ground) {
    const Camera eye{lodView.eyeM, lodView.right, lodView.back};
    const double heightM = heightAboveGroundM(eye, ground);
    const double groundRadiusM = ground.radiusM + ground.heightM;
    // Moves back along the heading, independent of the pitch. From orbit the move is limited, so that the eye
    // and the ground below it stay in view.
    const double backM = std::min(2.5 * heightM, glm::radians(35.0) * groundRadiusM);
    Camera observer = climb(moveOverGround(eye, ground, -backM, 0), std::max(1.2 * heightM, 0.3 * backM));
    observer = keepInRange(observer, ground);
    const double belowM = std::min(0.4 * heightM, 0.25 * glm::length(observer.eyeM - eye.eyeM));
    const glm::dvec3 lookAtM = eye.eyeM - belowM * glm::normalize(eye.eyeM);
    observer.back = glm::normalize(observer.eyeM - lookAtM);
    observer.right = glm::normalize(glm::cross(glm::normalize(observer.eyeM), observer.back));
    return observer;
}

planet::Lines observerLines(const planet::Planet& planet, const planet::View& lodView,
                            const CameraSettings& settings, const std::optional<planet::ChunkId>& selected) {
    planet::Lines lines;
    const planet::ChunkTree& tree = planet.tree();
    const double groundRadiusM =
        tree.shape.radiusM + planet::residentHeightM(tree, glm::normalize(lodView.eyeM));
    const double heightM = std::max(glm::length(lodView.eyeM) - groundRadiusM, minGroundClearanceM);
    planet::appendSphere(lodView.eyeM, 0.04 * heightM, eyeColour, lines);
    if (settings.showFrustum)
        planet::appendFrustum(lodView, frustumLengthM(lodView, groundRadiusM), frustumColour, lines);
    if (settings.showHorizon) {
        const planet::Horizon horizon = planet::horizonOf(lodView.eyeM, tree.occluderRadiusM);
        if (!horizon.seesAll) planet::appendHorizon(horizon, lodView.eyeM, horizonColour, lines);
    }
    if (settings.showSwitchDistances && selected) appendSwitchDistance(planet, lodView, *selected, lines);
    return lines;
}

}  // namespace worldy
