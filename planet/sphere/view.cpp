#include "planet/sphere/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "planet/sphere/cube_sphere.h"

namespace planet {

namespace {

struct LocalFrame {
    glm::dvec3 east, north, up;
};

LocalFrame localFrame(const Geographic& place) {
    const glm::dvec3 up = directionFromGeographic(place);
    // East is computed from the longitude instead of a cross product, so that the poles have a frame too.
    const glm::dvec3 east(-std::sin(place.longitudeRad), std::cos(place.longitudeRad), 0);
    return {east, glm::cross(up, east), up};
}

}  // namespace

View viewFromPose(const CameraPose& pose, double radiusM, double horizontalFovRad, int widthPx,
                  int heightPx) {
    const LocalFrame frame = localFrame({glm::radians(pose.latitudeDeg), glm::radians(pose.longitudeDeg)});
    const double heading = glm::radians(pose.headingDeg);
    const double pitch = glm::radians(pose.pitchDeg);
    const glm::dvec3 level = std::cos(heading) * frame.north + std::sin(heading) * frame.east;
    View view;
    view.eyeM = (radiusM + pose.altitudeM) * frame.up;
    view.right = std::cos(heading) * frame.east - std::sin(heading) * frame.north;
    view.back = -(std::cos(pitch) * level + std::sin(pitch) * frame.up);
    view.up = glm::cross(view.back, view.right);
    view.horizontalFovRad = horizontalFovRad;
    view.widthPx = widthPx;
    view.heightPx = heightPx;
    return view;
}

CameraPose poseFromView(const View& view, double radiusM) {
    const Geographic place = geographicFromDirection(view.eyeM);
    const LocalFrame frame = localFrame(place);
    CameraPose pose;
    pose.latitudeDeg = glm::degrees(place.latitudeRad);
    pose.longitudeDeg = glm::degrees(place.longitudeRad);
    pose.altitudeM = glm::length(view.eyeM) - radiusM;
    // The right vector is level at any pitch, so heading is defined even when looking straight down.
    const double heading = std::atan2(-glm::dot(view.right, frame.north), glm::dot(view.right, frame.east));
    // Rounding can give a heading slightly west of north for north.
    pose.headingDeg = glm::degrees(heading < -1e-12 ? heading + glm::radians(360.0) : std::max(0.0, heading));
    pose.pitchDeg = glm::degrees(std::asin(std::clamp(-glm::dot(view.back, frame.up), -1.0, 1.0)));
    return pose;
}

bool isCameraJump(const glm::dvec3& fromM, const glm::dvec3& toM, double radiusM, double seconds) {
    constexpr double spanS = 0.1;
    constexpr double mostArcRad = glm::radians(5.0);
    const double arcRad = std::atan2(glm::length(glm::cross(fromM, toM)), glm::dot(fromM, toM));
    const auto heightM = [&](const glm::dvec3& eyeM) {
        return std::max(glm::length(eyeM) - radiusM, radiusM / 1000);
    };
    const double low = std::min(heightM(fromM), heightM(toM));
    const double high = std::max(heightM(fromM), heightM(toM));
    const double spans = std::max(seconds / spanS, 1.0);
    return arcRad > spans * mostArcRad || std::log(high / low) > spans * std::log(10) ||
           arcRad * radiusM > spans * high;
}

double screenScalePx(const View& view) {
    return view.widthPx / (2 * std::tan(view.horizontalFovRad / 2));
}

glm::dmat3 cameraFromWorldRotation(const View& view) {
    return glm::transpose(glm::dmat3(view.right, view.up, view.back));
}

Frustum frustumOf(const View& view) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    const auto through = [&](const glm::dvec3& inward) {
        const glm::dvec3 normal = glm::normalize(inward);
        return Plane{normal, -glm::dot(normal, view.eyeM)};
    };
    return {through(view.right - tanX * view.back), through(-view.right - tanX * view.back),
            through(view.up - tanY * view.back), through(-view.up - tanY * view.back)};
}

}  // namespace planet
