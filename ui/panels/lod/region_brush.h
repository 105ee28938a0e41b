// Draws a region on the globe: a stroke of the brush is a row of circles of one region, and clicks are the corners of a
// polygon. Pure functions, no ImGui.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/tree/region.h"

namespace worldy::ui {

enum class BrushMode : std::uint8_t { Off, Paint, Erase, Polygon };
struct RegionBrush {
    BrushMode mode = BrushMode::Off;
    double radiusM = 50'000;
};

// The way of the pointer over the ground in a frame, as places of any length: an arc of a great circle. Both are the same if
// the pointer has not moved.
struct BrushStroke {
    glm::dvec3 fromM{};
    glm::dvec3 toM{};
};

// Brings the brush along a stroke, in steps of a third of its radius, so that a fast pointer leaves no gaps; in at most
// mostBrushSteps steps, so a very long stroke of a small brush has gaps. Paint adds a circle to a region at each step, unless its
// circles already cover most of the brush there. Erase removes the circles whose centres lie under the brush. Nothing happens
// to a region that does not exist, or that is full.
inline constexpr int mostBrushSteps = 256;
void paint(const RegionBrush& brush, std::size_t region, const BrushStroke& stroke, double planetRadiusM,
           RegionSettings& regions);

// Adds a corner to a polygon that is being drawn, unless it has as many as it can have.
void addCorner(const glm::dvec3& groundM, planet::RegionPolygon& corners);

// Moves the corners into a region, as a polygon. The Error says why they are none; then nothing changes.
planet::Result<void> closePolygon(planet::RegionPolygon& corners, planet::Region& region);

// Returns a region with what the brush would add at the place under the pointer: its circle, or the polygon with a corner
// there. Without a place it is the polygon so far.
planet::Region draftAt(const RegionBrush& brush, const planet::RegionPolygon& corners,
                       const std::optional<glm::dvec3>& groundM);

}  // namespace worldy::ui
