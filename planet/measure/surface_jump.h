// Measures the jump of the drawn surface on screen when the chunks of a place are exchanged for coarser or
// finer ones.
//
// Both surfaces are linear on the triangles of nested grids, so they part most at a vertex of one of the two.
// All grid points of the finer chunks are compared, each with the point of the coarser surface at the same
// place. Stitched edges move vertices and so change their triangles. There the drawn points at the grid
// points and in the middle of every triangle of the grid are compared; a jump may be larger elsewhere, by the
// bend of those triangles between the compared places. Screen distance is not linear in the position, but
// almost so across one triangle.
//
// The mean is over the screen area of the finer chunks as drawn after. Their triangles are clipped at the
// picture's border, and the motion is linear between their corners. For stitched edges it counts the grid
// points alone.
//
// A drawn sea is part of the surface: ground below it is drawn at its level. Places that it covers before and
// after do not count, neither for the largest jump nor for the mean. This applies to all ground below the
// level, also to dry land by a colour image, which the shader draws at the level without water.
//
// Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Two pixel measures through one view. screenPx: the distance between the projections of the two points in
// the flat picture. facingPx: K' |a/|a| - b/|b||, with a and b relative to the eye: the distance in a view
// that is turned to face them. The flat picture stretches towards its corners, so screenPx may be larger.
struct SurfaceJump {
    double largestPx = 0;             // screenPx
    double meanPx = 0;                // screenPx, over the screen area that lies in the picture
    double largestFacingPx = 0;       // facingPx
    glm::dvec3 worstPlaceM{0, 0, 0};  // where largestPx is, as drawn after; metres from the planet's centre
    ChunkId worstChunk;               // the finer chunk that holds it
    // Places compared: those that lie in the picture and not under a drawn sea, hidden by ground or not.
    std::uint32_t places = 0;
    bool underSea = false;  // a drawn sea covers all places that lie in the picture
};

struct DrawnChunk {
    DrawItem item;
    SharedHeights heights;  // never null
    bool stitched = false;  // drawn with RenderSettings::stitched
};

// Compares a coarser chunk with chunks within it, of any deeper levels; one side was drawn before, the other
// is drawn after. seaM: level of a sea that is drawn as water, metres above the radius.
SurfaceJump surfaceJump(const PlanetShape& shape, const DrawnChunk& coarser,
                        std::span<const DrawnChunk> finer, bool coarserIsAfter, const View& view,
                        std::optional<double> seaM = std::nullopt);

// Compares one edge of a chunk that is drawn before and after: at the edge's vertices, or if either is
// stitched, at every half cell of the rows whose triangles the edge moves. The mean is over these places.
SurfaceJump edgeJump(const PlanetShape& shape, const DrawnChunk& before, const DrawnChunk& after, Edge edge,
                     const View& view, std::optional<double> seaM = std::nullopt);

}  // namespace planet
