// The drawn nodes of a trace in three dimensions: their bounds, seen by a camera that turns around a place or by the
// engine's own. Pure functions, no ImGui.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/trace/traced_frame.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// A camera that turns around a place.
struct SpaceCamera {
    glm::dvec3 target{0, 0, 0};  // world units
    double distance = 1;         // from it, world units, > 0
    double yawRad = 0.6;         // around the up axis
    double pitchRad = 0.5;       // above the ground, [-1.5, 1.5]
    glm::dvec3 up{0, 0, 1};
    bool isPlaced = false;  // false: not chosen yet
};

// Looks at all drawn nodes; if they are spread over a globe, at the globe, from the side of the engine's camera.
SpaceCamera cameraAround(const TracedFrame& frame, const TracedView& view);
// Turns by pixels of a drag, moves by pixels, or comes nearer by a factor.
SpaceCamera turned(const SpaceCamera& camera, double xPx, double yPx);
SpaceCamera moved(const SpaceCamera& camera, const Rect& area, double xPx, double yPx);
SpaceCamera nearer(const SpaceCamera& camera, double factor);

// Projects the world onto a part of the screen.
struct SpaceView {
    glm::dmat4 clipFromWorld{1};
    glm::dvec3 eye{0, 0, 0};
    Rect area{};  // pixels

    // Returns a segment's ends on the screen, without what is behind the eye; nothing if all of it is.
    std::optional<std::array<glm::dvec2, 2>> segment(const glm::dvec3& from, const glm::dvec3& to) const;
};
SpaceView spaceView(const SpaceCamera& camera, const Rect& area);
// Returns the projection of the engine's camera, fitted into the area.
SpaceView spaceView(const planet::TraceView& camera, const Rect& area);

// The edges of bounds on the screen, and their convex hull.
struct SpaceShape {
    std::size_t node = 0;   // place in TracedView::nodes
    double distance = 0;    // from the eye to the middle
    bool isBehind = false;  // the middle is behind the horizon of a spherical world
    std::vector<std::array<glm::dvec2, 2>> edges{};
    std::vector<glm::dvec2> hull{};  // of what is in front of the eye; empty if that is less than a triangle
};
// Returns the drawn nodes, and the selected one, the farthest first.
std::vector<SpaceShape> spaceShapes(const SpaceView& space, const TracedFrame& frame, const TracedView& view,
                                    std::optional<std::uint64_t> selected);
// Returns the edges of the frustum of the engine's camera, up to a length in world units.
std::vector<std::array<glm::dvec2, 2>> spaceFrustum(const SpaceView& space, const planet::TraceView& camera,
                                                    double length);

// Returns the nearest node whose hull holds a point; none: noTracedNode.
std::size_t nodeAt(const std::vector<SpaceShape>& shapes, const glm::dvec2& point);

}  // namespace worldy::ui
