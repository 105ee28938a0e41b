#include "ui/panels/lod/region_brush.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/base/try.h"
#include "planet/tree/region.h"

namespace worldy::ui {

namespace {

// Returns the places at which the brush works, from the beginning to the end.
std::vector<glm::dvec3> placesOf(const BrushStroke& stroke, double radiusM, double planetRadiusM) {
    const glm::dvec3 from = glm::normalize(stroke.fromM);
    const glm::dvec3 to = glm::normalize(stroke.toM);
    const double lengthM = glm::distance(from, to) * planetRadiusM;
    const int steps =
        static_cast<int>(std::clamp(std::ceil(3 * lengthM / radiusM), 1.0, double{mostBrushSteps}));
    std::vector<glm::dvec3> places;
    for (int i = 1; i <= steps; ++i) {
        const glm::dvec3 between = glm::mix(from, to, double(i) / steps);
        // Opposite places have no arc between them.
        if (glm::length(between) > 1e-6) places.push_back(glm::normalize(between));
    }
    return places;
}

// Returns whether it has changed the circles.
bool applyAt(const RegionBrush& brush, const glm::dvec3& at, double planetRadiusM,
             std::vector<planet::RegionCircle>& circles) {
    const auto awayM = [&](const planet::RegionCircle& circle) {
        return glm::distance(planet::directionOf(circle.centre), at) * planetRadiusM;
    };
    if (brush.mode == BrushMode::Erase)
        return std::erase_if(circles, [&](const auto& circle) { return awayM(circle) < brush.radiusM; }) > 0;
    // Circles a third of their radius apart leave notches of 1 % of it.
    const bool isCovered = std::ranges::any_of(circles, [&](const auto& circle) {
        return awayM(circle) + brush.radiusM < circle.radiusM + brush.radiusM / 3;
    });
    if (isCovered || circles.size() >= planet::mostCircles) return false;
    circles.push_back({planet::pointOf(at), brush.radiusM});
    return true;
}

}  // namespace

void paint(const RegionBrush& brush, std::size_t region, const BrushStroke& stroke, double planetRadiusM,
           RegionSettings& regions) {
    std::vector<planet::Region> list = regions.all();
    const bool paints = brush.mode == BrushMode::Paint || brush.mode == BrushMode::Erase;
    if (!paints || region >= list.size()) return;
    bool hasChanged = false;
    for (const glm::dvec3& at : placesOf(stroke, brush.radiusM, planetRadiusM))
        hasChanged = applyAt(brush, at, planetRadiusM, list[region].circles) || hasChanged;
    if (hasChanged) regions.list = std::make_shared<const std::vector<planet::Region>>(std::move(list));
}

void addCorner(const glm::dvec3& groundM, planet::RegionPolygon& corners) {
    if (corners.size() < planet::mostCorners) corners.push_back(planet::pointOf(groundM));
}

planet::Result<void> closePolygon(planet::RegionPolygon& corners, planet::Region& region) {
    planet::Region closed = region;
    closed.polygons.push_back(corners);
    TRY(planet::checkRegion(closed));
    region = std::move(closed);
    corners.clear();
    return {};
}

planet::Region draftAt(const RegionBrush& brush, const planet::RegionPolygon& corners,
                       const std::optional<glm::dvec3>& groundM) {
    planet::Region draft;
    if (brush.mode == BrushMode::Off) return draft;
    if (brush.mode != BrushMode::Polygon) {
        if (groundM) draft.circles = {{planet::pointOf(*groundM), brush.radiusM}};
    } else if (!corners.empty()) {
        draft.polygons = {corners};
        if (groundM) addCorner(*groundM, draft.polygons[0]);
    }
    return draft;
}

}  // namespace worldy::ui
