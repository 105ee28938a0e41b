// Measures the float precision of the vertex shader: its vertex positions against doubles. The shader's maths
// is that of vertex_position.h; both sides include morph and stitched edges, without skirts.
//
// Pixels are K' |a/|a| - b/|b||, a and b from the eye: as if the view were turned to face the vertex.
//
// Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "planet/select/drawn_surface.h"
#include "planet/sphere/vertex_position.h"
#include "planet/sphere/view.h"

namespace planet {

// A position in floats against the true one.
struct FloatPosition {
    glm::dvec3 positionM{0, 0, 0};  // metres from the planet's centre
    double errorM = 0;              // distance to the true one
    double errorPx = 0;
};

struct VertexPrecision {
    ChunkId chunk;
    glm::ivec2 vertex{0, 0};        // column and row on the chunk
    glm::dvec3 positionM{0, 0, 0};  // in doubles, as drawn; metres from the planet's centre
    double distanceM = 0;           // from the eye
    FloatPosition shader;           // as it is drawn: relative to the eye, from a reference point beside it
    // For comparison, the error of a float position from the planet's centre minus a float eye.
    FloatPosition fromCentre;
};

// Measures one vertex. frame: vertexFrame(shape, view.eyeM), as in the shader.
VertexPrecision vertexPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                                std::span<const std::int16_t> heights, bool stitched, const View& view,
                                glm::ivec2 vertex);

// Returns the chunk's vertex with the largest shader error in pixels.
VertexPrecision worstPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                               std::span<const std::int16_t> heights, bool stitched, const View& view);

// Returns the chunk's drawn vertex nearest to a point.
glm::ivec2 nearestVertex(const PlanetShape& shape, const DrawItem& item,
                         std::span<const std::int16_t> heights, bool stitched, const glm::dvec3& pointM);

}  // namespace planet
