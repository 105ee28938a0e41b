// Line shapes for debugging: bounding boxes, frusta, horizons, distances. Coordinates are doubles, metres
// from the planet's centre; the caller makes them relative to the eye. Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/sphere/bounds.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

using LineColour = std::array<std::uint8_t, 4>;  // sRGB and opacity

struct LineVertex {
    glm::dvec3 positionM{0, 0, 0};
    LineColour colour{255, 255, 255, 255};
};
// Two vertices per line.
using Lines = std::vector<LineVertex>;

void appendBox(const OrientedBox& box, const LineColour& colour, Lines& lines);

// Appends the frustum's four edges from the eye, and its rectangles at one third, two thirds and all of a
// length along its axis.
void appendFrustum(const View& view, double lengthM, const LineColour& colour, Lines& lines);

// Appends lines of sight that touch the occluder, and the circle where they do; nothing if the horizon hides
// nothing.
void appendHorizon(const Horizon& horizon, const glm::dvec3& eyeM, const LineColour& colour, Lines& lines);

// Appends three great circles of a sphere.
void appendSphere(const glm::dvec3& centreM, double radiusM, const LineColour& colour, Lines& lines);

// Appends a chunk's outline on its own surface, raised by liftM so that the surface does not hide it.
void appendOutline(const ChunkTree& tree, const ChunkNode& node, double liftM, const LineColour& colour,
                   Lines& lines);

}  // namespace planet
