// Views from anywhere to anywhere, for tests that have to hold for all of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "planet/sphere/view.h"

namespace planet {

// Half of them close to the ground, the others up to ten radii away; half look about the horizon.
template <class Random>
View randomView(Random& random, double radiusM) {
    const auto within = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    CameraPose pose;
    pose.latitudeDeg = std::asin(within(-1, 1)) * 180 / std::numbers::pi;
    pose.longitudeDeg = within(-180, 180);
    const bool low = within(0, 1) < 0.5;
    pose.altitudeM = radiusM * (low ? within(-0.03, 0.1) : std::exp(within(std::log(0.01), std::log(10.0))));
    pose.headingDeg = within(0, 360);
    pose.pitchDeg = within(0, 1) < 0.5 ? within(-40, 10) : within(-90, 90);
    View view = viewFromPose(pose, radiusM, within(0.2, 2.2), 1280, 720);
    // Rolled too: right and up turned about the line of sight.
    const double roll = within(-std::numbers::pi, std::numbers::pi);
    const glm::dvec3 right = view.right;
    view.right = std::cos(roll) * right + std::sin(roll) * view.up;
    view.up = std::cos(roll) * view.up - std::sin(roll) * right;
    return view;
}

// Whether a line of sight meets the inside of the sphere.
inline bool sphereHides(const glm::dvec3& eye, const glm::dvec3& point, double radius) {
    const glm::dvec3 along = point - eye;
    const double t = std::clamp(-glm::dot(eye, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(eye + t * along) < radius;
}

}  // namespace planet
