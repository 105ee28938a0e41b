#include "ui/panels/lod/region_brush.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/tree/region.h"

namespace worldy::ui {

void paint(const RegionBrush& brush, std::size_t region, const glm::dvec3& groundM, double planetRadiusM,
           RegionSettings& regions) {
    std::vector<planet::Region> list = regions.all();
    if (brush.mode == BrushMode::Off || region >= list.size()) return;
    std::vector<planet::RegionCircle>& circles = list[region].circles;
    const glm::dvec3 at = glm::normalize(groundM);
    const auto awayM = [&](const planet::RegionCircle& circle) {
        return glm::distance(planet::directionOf(circle.centre), at) * planetRadiusM;
    };
    if (brush.mode == BrushMode::Erase) {
        if (std::erase_if(circles, [&](const auto& circle) { return awayM(circle) < brush.radiusM; }) == 0)
            return;
    } else {
        // Circles a third of their radius apart leave notches of 1 % of it.
        const bool isCovered = std::any_of(circles.begin(), circles.end(), [&](const auto& circle) {
            return awayM(circle) + brush.radiusM < circle.radiusM + brush.radiusM / 3;
        });
        if (isCovered || circles.size() >= planet::mostCircles) return;
        circles.push_back({planet::pointOf(at), brush.radiusM});
    }
    regions.list = std::make_shared<const std::vector<planet::Region>>(std::move(list));
}

}  // namespace worldy::ui
