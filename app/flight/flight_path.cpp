#include "app/flight/flight_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

using planet::Result;
using Pose = planet::CameraPose;

double degreesBetween(double fromDeg, double toDeg) {
    return std::remainder(toDeg - fromDeg, 360.0);
}

glm::dvec3 slerp(const glm::dvec3& from, const glm::dvec3& to, double t) {
    const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
    if (angle < 1e-9) return glm::normalize(from + t * (to - from));
    return glm::normalize((std::sin((1 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle));
}

// Returns the tangent vector at `from` of the great circle to `to`, as long as the arc.
glm::dvec3 arcTowards(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 along = to - glm::dot(from, to) * from;
    const double sine = glm::length(along);
    if (sine < 1e-12) return {0, 0, 0};
    return along / sine * std::atan2(sine, glm::dot(from, to));
}

glm::dvec3 along(const glm::dvec3& from, const glm::dvec3& arc) {
    const double angle = glm::length(arc);
    if (angle < 1e-12) return from;
    return std::cos(angle) * from + std::sin(angle) * (arc / angle);
}

// Returns true for the first and last key of the flight and of each part between jumps.
bool isEnd(const std::vector<FlightKey>& keys, std::size_t i) {
    return i == 0 || i + 1 == keys.size() || keys[i].jumpedTo || keys[i + 1].jumpedTo;
}

// Returns the velocity over the ground at a key, radians per second; 0 at the ends. It is at most three times
// the mean speed of the slower span beside the key, the bound of monotone cubics (Fritsch and Carlson, 1980),
// so the camera stands still between two keys at one place.
glm::dvec3 velocityAt(const std::vector<FlightKey>& keys, std::size_t i) {
    if (isEnd(keys, i)) return {0, 0, 0};
    const glm::dvec3 here = directionOf(keys[i]);
    const glm::dvec3 ahead = arcTowards(here, directionOf(keys[i + 1]));
    const glm::dvec3 back = arcTowards(here, directionOf(keys[i - 1]));
    const glm::dvec3 velocity = (ahead - back) / (keys[i + 1].timeS - keys[i - 1].timeS);
    const double mostSpeed = 3 * std::min(glm::length(ahead) / (keys[i + 1].timeS - keys[i].timeS),
                                          glm::length(back) / (keys[i].timeS - keys[i - 1].timeS));
    const double speed = glm::length(velocity);
    return speed > mostSpeed ? mostSpeed / speed * velocity : velocity;
}

// Evaluates a Catmull-Rom curve as cubic Bezier arcs on the sphere, built by de Casteljau's scheme from
// great-circle steps (Shoemake, "Animating rotation with quaternion curves", 1985).
glm::dvec3 directionAt(const std::vector<FlightKey>& keys, std::size_t i, double t) {
    const double third = (keys[i + 1].timeS - keys[i].timeS) / 3;
    const glm::dvec3 a = directionOf(keys[i]);
    const glm::dvec3 d = directionOf(keys[i + 1]);
    const glm::dvec3 b = along(a, third * velocityAt(keys, i));
    const glm::dvec3 c = along(d, -third * velocityAt(keys, i + 1));
    const glm::dvec3 ab = slerp(a, b, t), bc = slerp(b, c, t), cd = slerp(c, d, t);
    return slerp(slerp(ab, bc, t), slerp(bc, cd, t), t);
}

using ValueOfKey = std::function<double(std::size_t)>;

// Returns a slope at a key with which no cubic overshoots it (Fritsch and Butland, 1984).
double slopeAt(const std::vector<FlightKey>& keys, const ValueOfKey& value, std::size_t i) {
    if (isEnd(keys, i)) return 0;
    const double before = (value(i) - value(i - 1)) / (keys[i].timeS - keys[i - 1].timeS);
    const double after = (value(i + 1) - value(i)) / (keys[i + 1].timeS - keys[i].timeS);
    return before * after <= 0 ? 0 : 2 * before * after / (before + after);
}

double valueAt(const std::vector<FlightKey>& keys, const ValueOfKey& value, std::size_t i, double t) {
    const double span = keys[i + 1].timeS - keys[i].timeS;
    const double from = value(i), to = value(i + 1);
    const double fromSlope = span * slopeAt(keys, value, i), toSlope = span * slopeAt(keys, value, i + 1);
    const double t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * from + (t3 - 2 * t2 + t) * fromSlope + (3 * t2 - 2 * t3) * to +
           (t3 - t2) * toSlope;
}

}  // namespace

glm::dvec3 directionOf(const FlightKey& key) {
    return planet::directionFromGeographic(
        {glm::radians(key.pose.latitudeDeg), glm::radians(key.pose.longitudeDeg)});
}

double durationS(const FlightPath& path) {
    return path.keys.back().timeS - path.keys.front().timeS;
}

bool jumpsBetween(const FlightPath& path, double fromS, double toS) {
    return std::any_of(path.keys.begin(), path.keys.end(), [&](const FlightKey& key) {
        return key.jumpedTo && key.timeS > fromS && key.timeS <= toS;
    });
}

Result<int> flightViews(const FlightPath& path, double stepS, int most) {
    const double steps = std::floor(durationS(path) / stepS + 1e-9);
    if (!(steps < most)) {
        return planet::badInput(
            fmt::format("--step-s: {} s over a flight of {} s are more than {} views; expected a longer step",
                        stepS, durationS(path), most));
    }
    return static_cast<int>(steps) + 1;
}

FlightFrames framesOf(const FlightPath& path, int count, double stepS) {
    if (stepS == 0 && count > 1) stepS = durationS(path) / (count - 1);
    return {path.keys.front().timeS, stepS, count};
}

Result<FlightFrames> framesOf(const FlightPath& path, const FlightSampling& sampling, int most) {
    if (!sampling.stepS) {
        const int count = sampling.frames.value_or(1);
        if (count > most)
            return planet::badInput(
                fmt::format("--frames: {} is too large; expected at most {}", count, most));
        return framesOf(path, count);
    }
    return flightViews(path, *sampling.stepS, most).map([&](int count) {
        return framesOf(path, count, *sampling.stepS);
    });
}

Pose poseAt(const FlightPath& path, double timeS) {
    const std::vector<FlightKey>& keys = path.keys;
    const double time = std::clamp(timeS, keys.front().timeS, keys.back().timeS);
    const auto after = std::upper_bound(keys.begin() + 1, keys.end() - 1, time,
                                        [](double value, const FlightKey& key) { return value < key.timeS; });
    const std::size_t i = static_cast<std::size_t>(after - keys.begin()) - 1;
    const double share = (time - keys[i].timeS) / (keys[i + 1].timeS - keys[i].timeS);
    const double t = keys[i + 1].jumpedTo ? std::floor(share) : share;

    // Headings are unwrapped, so that each turns the shorter way from the one before.
    std::vector<double> headings = {keys.front().pose.headingDeg};
    for (std::size_t k = 1; k < keys.size(); ++k) {
        headings.push_back(headings.back() + degreesBetween(headings.back(), keys[k].pose.headingDeg));
    }
    const auto logAltitude = [&](std::size_t k) { return std::log(keys[k].pose.altitudeM); };
    const auto heading = [&](std::size_t k) { return headings[k]; };
    const auto pitch = [&](std::size_t k) { return keys[k].pose.pitchDeg; };

    const planet::Geographic place = planet::geographicFromDirection(directionAt(keys, i, t));
    Pose pose;
    pose.latitudeDeg = glm::degrees(place.latitudeRad);
    pose.longitudeDeg = glm::degrees(place.longitudeRad);
    pose.altitudeM = std::exp(valueAt(keys, logAltitude, i, t));
    pose.headingDeg = std::fmod(valueAt(keys, heading, i, t) + 720, 360.0);
    pose.pitchDeg = valueAt(keys, pitch, i, t);
    return pose;
}

}  // namespace worldy
