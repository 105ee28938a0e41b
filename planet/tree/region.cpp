#include "planet/tree/region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string_view>
#include <unordered_set>

#include "planet/base/check_range.h"
#include "planet/base/try.h"
#include "planet/sphere/bounds.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/tree/sphere_polygon.h"

namespace planet {

namespace {

Result<void> checkName(const std::string& name) {
    const bool isPlain = std::none_of(name.begin(), name.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7f;
    });
    if (!name.empty() && name.size() <= mostNameBytes && isPlain) return {};
    return badInput(fmt::format("name: {} bytes{}; expected 1 to {} bytes without control characters",
                                name.size(), isPlain ? "" : " with control characters", mostNameBytes));
}

Result<void> checkCount(std::string_view what, std::size_t count, std::size_t most) {
    if (count <= most) return {};
    return badInput(fmt::format("{}: {} of them; expected at most {}", what, count, most));
}

Result<void> checkPoint(const RegionPoint& point) {
    TRY(checkRange("lat", point.latitudeDeg, -90.0, 90.0));
    return checkRange("lon", point.longitudeDeg, -180.0, 180.0);
}

Result<void> checkCircle(const RegionCircle& circle) {
    TRY(checkPoint(circle.centre));
    if (circle.radiusM > 0 && circle.radiusM <= mostRegionM) return {};
    return badInput(fmt::format("radius_m: {} is out of range; expected above 0 and at most {}",
                                circle.radiusM, mostRegionM));
}

Result<void> checkPolygon(const RegionPolygon& polygon) {
    TRY(checkCount("corners", polygon.size(), mostCorners));
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        TRY(checkPoint(polygon[i]).map_error([&](Error error) {
            error.message = fmt::format("corner {}: {}", i + 1, error.message);
            return error;
        }));
        corners.push_back(directionOf(polygon[i]));
    }
    return SpherePolygon::make(corners).map([](const SpherePolygon&) {});
}

Result<void> checkHeights(const HeightBand& heights) {
    TRY(checkRange("heights_m: lowest", heights.lowestM, -mostRegionM, mostRegionM));
    TRY(checkRange("heights_m: highest", heights.highestM, -mostRegionM, mostRegionM));
    TRY(checkRange("heights_border_m", heights.borderM, 0.0, mostRegionM));
    if (heights.lowestM <= heights.highestM) return {};
    return badInput(fmt::format("heights_m: {} to {} is empty; expected the lowest height first",
                                heights.lowestM, heights.highestM));
}

// Returns a closed line along the edge of a cone.
std::vector<glm::dvec3> circleOf(const DirectionCone& cone) {
    constexpr int steps = 96;
    const glm::dvec3 aside = std::abs(cone.axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 east = glm::normalize(glm::cross(aside, cone.axis));
    const glm::dvec3 north = glm::cross(cone.axis, east);
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= steps; ++i) {
        const double turn = 2 * std::numbers::pi * i / steps;
        points.push_back(std::cos(cone.halfAngleRad) * cone.axis +
                         std::sin(cone.halfAngleRad) * (std::cos(turn) * east + std::sin(turn) * north));
    }
    return points;
}

// Returns the closed outline of a polygon, with points at most a degree apart.
std::vector<glm::dvec3> outlineOf(const RegionPolygon& polygon) {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 from = directionOf(polygon[i]);
        const glm::dvec3 to = directionOf(polygon[(i + 1) % polygon.size()]);
        const double lengthRad = angleBetweenRad(from, to);
        const int steps = std::max(1, static_cast<int>(std::ceil(glm::degrees(lengthRad))));
        for (int k = 0; k < steps; ++k)
            points.push_back(glm::normalize(from + (to - from) * (static_cast<double>(k) / steps)));
    }
    if (!points.empty()) points.push_back(glm::dvec3(points.front()));
    return points;
}

}  // namespace

glm::dvec3 directionOf(const RegionPoint& point) {
    return directionFromGeographic({glm::radians(point.latitudeDeg), glm::radians(point.longitudeDeg)});
}

RegionPoint pointOf(const glm::dvec3& direction) {
    const Geographic place = geographicFromDirection(direction);
    return {glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad)};
}

std::vector<std::vector<glm::dvec3>> outlinesOf(const Region& region, double radiusM) {
    struct Circle {
        DirectionCone cone;
        double chord = 2;  // from its centre to its edge
    };
    std::vector<Circle> circles;
    for (const RegionCircle& circle : region.circles) {
        const double angle = std::min(circle.radiusM / radiusM, std::numbers::pi);
        circles.push_back({{directionOf(circle.centre), angle}, 2 * std::sin(angle / 2)});
    }
    std::vector<std::vector<glm::dvec3>> lines;
    const auto add = [&](const std::vector<glm::dvec3>& points, const std::vector<const Circle*>& others) {
        bool isOpen = false;
        for (const glm::dvec3& point : points) {
            const bool isWithin = std::any_of(others.begin(), others.end(), [&](const Circle* other) {
                return glm::distance(other->cone.axis, point) < other->chord;
            });
            if (!isWithin && !isOpen) lines.emplace_back();
            if (!isWithin) lines.back().push_back(point);
            isOpen = !isWithin;
        }
    };
    std::vector<const Circle*> near;
    for (const Circle& circle : circles) {
        near.clear();
        for (const Circle& other : circles) {
            const double reach = circle.cone.halfAngleRad + other.cone.halfAngleRad;
            if (&other != &circle && glm::distance(circle.cone.axis, other.cone.axis) < reach)
                near.push_back(&other);
        }
        if (circle.cone.halfAngleRad < std::numbers::pi) add(circleOf(circle.cone), near);
    }
    near.clear();
    for (const Circle& circle : circles) near.push_back(&circle);
    for (const RegionPolygon& polygon : region.polygons) add(outlineOf(polygon), near);
    return lines;
}

Result<void> checkRegion(const Region& region) {
    TRY(checkName(region.name));
    TRY(checkCount("circles", region.circles.size(), mostCircles));
    TRY(checkCount("polygons", region.polygons.size(), mostPolygons));
    TRY(checkRange("border_m", region.borderM, 0.0, mostRegionM));
    if (region.tauFactor) TRY(checkRange("tau_factor", *region.tauFactor, leastTauFactor, mostTauFactor));
    if (region.leastLevel) TRY(checkRange("least_level", *region.leastLevel, 0, maxLevel));
    if (region.mostLevel) TRY(checkRange("most_level", *region.mostLevel, 0, maxLevel));
    if (region.leastLevel.value_or(0) > region.mostLevel.value_or(maxLevel)) {
        return badInput(
            fmt::format("least_level: {0} is larger than most_level, {1}; expected at most {1}, or a "
                        "larger most_level",
                        *region.leastLevel, *region.mostLevel));
    }
    if (region.heights) TRY(checkHeights(*region.heights));
    const auto named = [](std::string_view what, std::size_t i) {
        return [what, i](Error error) {
            error.message = fmt::format("{} {}: {}", what, i + 1, error.message);
            return error;
        };
    };
    for (std::size_t i = 0; i < region.circles.size(); ++i)
        TRY(checkCircle(region.circles[i]).map_error(named("circle", i)));
    for (std::size_t i = 0; i < region.polygons.size(); ++i)
        TRY(checkPolygon(region.polygons[i]).map_error(named("polygon", i)));
    return {};
}

Result<void> checkCounts(std::span<const Region> regions) {
    TRY(checkCount("regions", regions.size(), mostRegions));
    std::size_t circles = 0;
    std::size_t corners = 0;
    for (const Region& region : regions) {
        circles += region.circles.size();
        for (const RegionPolygon& polygon : region.polygons) corners += polygon.size();
    }
    TRY(checkCount("circles of all regions", circles, mostCirclesOfAll));
    return checkCount("corners of all regions", corners, mostCornersOfAll);
}

Result<void> checkRegions(std::span<const Region> regions) {
    TRY(checkCounts(regions));
    std::unordered_set<std::string_view> names;
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const auto naming = [&](Error error) {
            error.message = fmt::format("region {} \"{}\": {}", i + 1, regions[i].name, error.message);
            return error;
        };
        TRY(checkRegion(regions[i]).map_error(naming));
        if (names.insert(regions[i].name).second) continue;
        return badInput(fmt::format("region {} \"{}\": name: another region has it; expected a unique name",
                                    i + 1, regions[i].name));
    }
    return {};
}

}  // namespace planet
