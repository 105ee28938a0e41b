// Which level of a clipmap the shader draws at a place: the same formulas as in shaders/colour_clipmap.glsl.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "planet/surface/colour_clipmap.h"

namespace planet {

// Returns the distance of a place, [0, 1] across a face, from the viewer, in half sides of a face, by the
// shape of windows: along the larger axis on the viewer's face, and summed across the edge on the next face.
// Continuous over the whole cube.
inline double clipmapDistance(const ClipmapCentre& centre, Face face, const glm::dvec2& place) {
    const glm::dvec3 point = cubePoint(face, 2 * place.x - 1, 2 * place.y - 1);
    const glm::dvec3 apart = glm::abs(point - centre.cube);
    const glm::dvec3 up = glm::abs(faceAxes(centre.home).normal);
    const glm::dvec3 out = glm::abs(faceAxes(face).normal);
    const double down = glm::dot(apart, up);
    if (up == out) {
        const glm::dvec3 along = apart * (1.0 - up);
        return std::max({along.x, along.y, along.z}) + down;
    }
    // Two faces that meet next to a corner of the viewer's face must agree on their common edge. So the
    // distance there is the larger of the two, in addition to the distance on the unfolded cube.
    const glm::dvec3 side = 1.0 - up - out;
    const double corner = std::abs(2 * glm::dot(point, side) - glm::dot(centre.cube, side)) - 1;
    return std::max({down + glm::dot(apart, out), glm::dot(apart, side), down + corner});
}

// Returns the finest level that may be drawn at a distance, >= wholeLevel. A fraction mixes two levels, so
// that a window's border is invisible.
inline double clipmapFinest(const ClipmapLayout& layout, double distance) {
    const double level = std::log2(clipmapReach(layout) / std::max(distance, 1e-9));
    const double holding = std::floor(level);  // the finest whose window reaches that far
    const double inside = 1 - std::exp2(holding - level);
    const double finest = holding - 1 + std::min(inside / clipmapFade, 1.0);
    return std::clamp(finest, static_cast<double>(layout.wholeLevel), static_cast<double>(layout.leafLevel));
}

}  // namespace planet
