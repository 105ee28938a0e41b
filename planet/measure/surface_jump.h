// Measures the jump of the drawn surface on screen when the chunks of a place are replaced by coarser or
// finer ones.
//
// Both surfaces are linear on the triangles of nested grids, so their distance is largest at a vertex of one
// of them. All grid points of the finer chunks are compared with the points of the coarser surface at the
// same places. Stitched edges move vertices and so change their triangles. There, the drawn points at the
// grid points and in the middle of every triangle of the grid are compared. A jump may be larger between
// these places, by the bend of the triangles. Screen distance is almost, but not exactly, linear across a
// triangle.
//
// The mean is over the screen area of the finer chunks as drawn after the switch. Their triangles are clipped
// at the picture's border, and the motion is interpolated linearly between their corners. With stitched
// edges, the mean is over the grid points alone.
//
// A drawn sea is part of the surface: ground below it is drawn at its level. Places that it covers before and
// after count neither for the largest jump nor for the mean. This applies to all ground below the level,
// including what the colour image shows as dry land, which the shader draws at the level without water.
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

// Two pixel measures in one view. screenPx is the distance between the projections of the two points in the
// flat picture. facingPx is K' |a/|a| - b/|b||, with a and b relative to the eye: the distance in a view
// turned to face them. The flat picture stretches towards its corners, so screenPx may be larger.
struct SurfaceJump {
    double largestPx = 0;             // screenPx
    double meanPx = 0;                // screenPx, averaged over the screen area in the picture
    double largestFacingPx = 0;       // facingPx
    glm::dvec3 worstPlaceM{0, 0, 0};  // place of largestPx, as drawn after; metres from the planet's centre
    ChunkId worstChunk;               // the finer chunk at that place
    // Number of compared places: in the picture and not under a drawn sea, whether ground hides them or not.
    std::uint32_t places = 0;
    bool underSea = false;  // a drawn sea covers all places that lie in the picture
};

struct DrawnChunk {
    DrawItem item;
    SharedHeights heights;  // never null
    bool stitched = false;  // drawn with RenderSettings::stitched
};

// Compares a coarser chunk with chunks within it, of any deeper levels. One side was drawn before, the other
// is drawn after. seaM: level of a sea that is drawn as water, metres above the radius.
SurfaceJump surfaceJump(const PlanetShape& shape, const DrawnChunk& coarser,
                        std::span<const DrawnChunk> finer, bool coarserIsAfter, const View& view,
                        std::optional<double> seaM = std::nullopt);

// Compares one edge of a chunk that is drawn before and after, at the edge's vertices. If either edge is
// stitched, compares every half cell of the rows whose triangles the edge moves. The mean is over these
// places.
SurfaceJump edgeJump(const PlanetShape& shape, const DrawnChunk& before, const DrawnChunk& after, Edge edge,
                     const View& view, std::optional<double> seaM = std::nullopt);

}  // namespace planet
