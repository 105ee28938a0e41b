// The nodes of a trace over the open planet. Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "app/settings/view_settings.h"
#include "app/trace/traced_frame.h"
#include "planet/gl/draw/debug_shapes.h"

namespace worldy {

// Returns whether a trace has a place on a planet: its world is a sphere.
bool hasPlaceOnPlanet(const TracedFrame& frame);

// Returns the corners of what a camera sees at a length along its axis, world units, in order around it; not finite if the
// engine's matrices are not.
std::array<glm::dvec3, 4> traceFrustum(const planet::TraceView& camera, double length);

// Returns the bounds of the drawn nodes of a view, and the frusta of the cameras of all views, its own the brightest, scaled so that the engine's sphere is
// the planet's. Nodes behind the horizon of eyeM are left out. Colours are those of the overlay's level, error or morph;
// others stand for the level. Without a place on the planet: nothing.
planet::Lines traceLines(const TracedFrame& frame, const TracedView& view, double planetRadiusM,
                         const glm::dvec3& eyeM, const OverlaySettings& overlay,
                         std::optional<std::uint64_t> selected);

}  // namespace worldy
