#include "planet/tree/sphere_polygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "planet/base/try.h"

namespace planet {

namespace {

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// Returns on which side of the line through a and b a point lies: -1, 0 or 1.
int sideOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& at) {
    const double area = cross2(b - a, at - a);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool isWithinBox(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& at) {
    return std::min(a.x, b.x) <= at.x && at.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= at.y &&
           at.y <= std::max(a.y, b.y);
}

// Returns whether two line segments have a point in common.
bool segmentsMeet(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const int c1 = sideOf(a, b, c);
    const int d1 = sideOf(a, b, d);
    const int a1 = sideOf(c, d, a);
    const int b1 = sideOf(c, d, b);
    if (c1 * d1 < 0 && a1 * b1 < 0) return true;
    return (c1 == 0 && isWithinBox(a, b, c)) || (d1 == 0 && isWithinBox(a, b, d)) ||
           (a1 == 0 && isWithinBox(c, d, a)) || (b1 == 0 && isWithinBox(c, d, b));
}

glm::dvec3 unitOr(const glm::dvec3& vector, const glm::dvec3& otherwise) {
    const double length = glm::length(vector);
    return length > 1e-12 ? vector / length : otherwise;
}

}  // namespace

double angleBetweenRad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Result<SpherePolygon> SpherePolygon::make(std::span<const glm::dvec3> corners) {
    const std::size_t count = corners.size();
    if (count < 3) return badInput(fmt::format("{} corners; expected at least 3", count));
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        if (glm::distance(corners[i], corners[next]) > 1e-12) continue;
        return badInput(
            fmt::format("corners {} and {} are the same place; expected each corner once", i + 1, next + 1));
    }
    SpherePolygon polygon(corners);
    TRY(polygon.check());
    return polygon;
}

SpherePolygon::SpherePolygon(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum{0, 0, 0};
    for (const glm::dvec3& corner : corners) sum += corner;
    cone_.axis = unitOr(sum, corners[0]);
    for (const glm::dvec3& corner : corners)
        cone_.halfAngleRad = std::max(cone_.halfAngleRad, angleBetweenRad(cone_.axis, corner));
    const glm::dvec3 aside = std::abs(cone_.axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    east_ = glm::normalize(glm::cross(aside, cone_.axis));
    north_ = glm::cross(cone_.axis, east_);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& from = corners[i];
        const glm::dvec3& to = corners[(i + 1) % corners.size()];
        // Accurate for close corners too: the cross product of their sum and difference.
        const glm::dvec3 normal = glm::normalize(glm::cross(from + to, to - from));
        arcs_.push_back({from, normal, glm::cross(normal, from), glm::cross(to, normal)});
        corners_.push_back(onPlane(from));
    }
}

glm::dvec2 SpherePolygon::onPlane(const glm::dvec3& at) const {
    return glm::dvec2(glm::dot(east_, at), glm::dot(north_, at)) / glm::dot(cone_.axis, at);
}

Result<void> SpherePolygon::check() const {
    if (cone_.halfAngleRad > glm::radians(mostPolygonDeg)) {
        return badInput(fmt::format(
            "a corner is {:.3g} degrees from the middle of all corners; expected at most {} degrees",
            glm::degrees(cone_.halfAngleRad), mostPolygonDeg));
    }
    const std::size_t count = corners_.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t iEnd = (i + 1) % count;
        const auto meet = [&](std::size_t j) {
            return badInput(
                fmt::format("the edges from corner {} and from corner {} meet; expected edges that "
                            "meet only at a shared corner",
                            i + 1, j + 1));
        };
        // Edges that share a corner meet elsewhere too if one runs back over the other.
        const glm::dvec2 along = corners_[iEnd] - corners_[i];
        const glm::dvec2 after = corners_[(iEnd + 1) % count] - corners_[iEnd];
        if (cross2(along, after) == 0 && glm::dot(along, after) < 0) return meet(iEnd);
        for (std::size_t j = i + 2; j < count; ++j) {
            if ((j + 1) % count == i) continue;
            if (segmentsMeet(corners_[i], corners_[iEnd], corners_[j], corners_[(j + 1) % count]))
                return meet(j);
        }
    }
    return {};
}

// Counts the edges that a line from the place crosses (Shimrat, "Algorithm 112", 1962).
bool SpherePolygon::contains(const glm::dvec3& at) const {
    if (glm::dot(cone_.axis, at) <= std::cos(cone_.halfAngleRad) - 1e-12) return false;
    const glm::dvec2 place = onPlane(at);
    bool isInside = false;
    for (std::size_t i = 0, last = corners_.size() - 1; i < corners_.size(); last = i++) {
        const glm::dvec2& a = corners_[i];
        const glm::dvec2& b = corners_[last];
        if ((a.y > place.y) == (b.y > place.y)) continue;
        if (place.x < a.x + (place.y - a.y) * (b.x - a.x) / (b.y - a.y)) isInside = !isInside;
    }
    return isInside;
}

double SpherePolygon::signedDistanceRad(const glm::dvec3& at) const {
    double leastChord2 = 4;
    double leastSine = 1;
    for (const Arc& arc : arcs_) {
        const glm::dvec3 away = arc.from - at;
        leastChord2 = std::min(leastChord2, glm::dot(away, away));
        const bool isBeside = glm::dot(arc.afterFrom, at) >= 0 && glm::dot(arc.beforeTo, at) >= 0;
        if (isBeside) leastSine = std::min(leastSine, std::abs(glm::dot(arc.normal, at)));
    }
    const double toCorner = 2 * std::asin(std::min(1.0, std::sqrt(leastChord2) / 2));
    const double distance =
        leastSine < 1 ? std::min(toCorner, std::asin(leastSine)) : std::min(toCorner, std::numbers::pi);
    return contains(at) ? -distance : distance;
}

}  // namespace planet
