// How exact the floats of the vertex shader are: where it puts a vertex, against doubles. The shader's maths
// is that of vertex_position.h; morph and stitched edges are counted in on both sides, skirts are left out.
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
    // For comparison, what it would be with a float position from the planet's centre, less a float eye.
    FloatPosition fromCentre;
};

// One vertex. Frame: vertexFrame(shape, view.eyeM), as the shader has it.
VertexPrecision vertexPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                                std::span<const std::int16_t> heights, bool stitched, const View& view,
                                glm::ivec2 vertex);

// The chunk's vertex whose shader error is largest in pixels.
VertexPrecision worstPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                               std::span<const std::int16_t> heights, bool stitched, const View& view);

// The chunk's vertex, as drawn, that stands nearest to a point.
glm::ivec2 nearestVertex(const PlanetShape& shape, const DrawItem& item,
                         std::span<const std::int16_t> heights, bool stitched, const glm::dvec3& pointM);

}  // namespace planet
