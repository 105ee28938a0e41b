// Paints a region on the globe: a stroke is a row of circles of one region. Pure functions, no ImGui.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "app/settings/view_settings.h"
#include "planet/tree/region.h"

namespace worldy::ui {

enum class BrushMode : std::uint8_t { Off, Paint, Erase };
struct RegionBrush {
    BrushMode mode = BrushMode::Off;
    double radiusM = 50'000;
};

// Paint adds a circle to a region, unless its circles already cover most of the brush there. Erase removes the circles
// whose centres lie under the brush. groundM: the place under the pointer. Nothing happens to a region that does not
// exist, or that is full.
void paint(const RegionBrush& brush, std::size_t region, const glm::dvec3& groundM, double planetRadiusM,
           RegionSettings& regions);

}  // namespace worldy::ui
