// Lines that show what cannot be seen: bounding boxes, frusta, horizons, distances. In doubles, metres from
// the planet's centre; whoever draws them makes them relative to the eye. Pure functions, any thread.
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
// Two vertices a line.
using Lines = std::vector<LineVertex>;

void appendBox(const OrientedBox& box, const LineColour& colour, Lines& lines);

// The four edges from the eye and rectangles at a third, two thirds and the whole of a length along its axis.
void appendFrustum(const View& view, double lengthM, const LineColour& colour, Lines& lines);

// Lines of sight that touch the occluder, and the circle where they do; none where the horizon sees all.
void appendHorizon(const Horizon& horizon, const glm::dvec3& eyeM, const LineColour& colour, Lines& lines);

// Three great circles of a sphere about a point.
void appendSphere(const glm::dvec3& centreM, double radiusM, const LineColour& colour, Lines& lines);

// A chunk's outline on its own surface, liftM above it so that the surface does not hide it.
void appendOutline(const ChunkTree& tree, const ChunkNode& node, double liftM, const LineColour& colour,
                   Lines& lines);

}  // namespace planet
