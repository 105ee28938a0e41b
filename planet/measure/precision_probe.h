// Measures the float precision of the vertex shader by comparing its vertex positions with doubles. The
// shader computes as vertex_position.h does; both sides include morph and stitched edges, without skirts.
//
// Errors in pixels are K' |a/|a| - b/|b||, a and b relative to the eye: in a view turned to face the vertex.
//
// Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "planet/select/drawn_surface.h"
#include "planet/sphere/steps.h"
#include "planet/sphere/vertex_position.h"
#include "planet/sphere/view.h"

namespace planet {

// A float position and its error.
struct FloatPosition {
    glm::dvec3 positionM{0, 0, 0};  // metres from the planet's centre
    double errorM = 0;              // distance to the exact position, metres
    double errorPx = 0;
};

struct VertexPrecision {
    ChunkId chunk;
    glm::ivec2 vertex{0, 0};        // column and row on the chunk
    glm::dvec3 positionM{0, 0, 0};  // exact, as drawn; metres from the planet's centre
    double distanceM = 0;           // from the eye
    FloatPosition shader;           // as drawn: relative to the eye, through a reference point near the eye
    // For comparison: a float position from the planet's centre, minus a float eye.
    FloatPosition fromCentre;
};

// Measures one vertex. frame: vertexFrame(shape, view.eyeM), as in the shader.
VertexPrecision vertexPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                                StepsView heights, bool stitched, const View& view, glm::ivec2 vertex);

// Returns the chunk's vertex with the largest shader error in pixels.
VertexPrecision worstPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                               StepsView heights, bool stitched, const View& view);

// Returns the chunk's drawn vertex nearest to a point.
glm::ivec2 nearestVertex(const PlanetShape& shape, const DrawItem& item, StepsView heights, bool stitched,
                         const glm::dvec3& pointM);

}  // namespace planet
