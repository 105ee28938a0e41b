// How far the drawn surface jumps on screen when one place's chunks are exchanged for coarser or finer ones.
//
// Both surfaces are linear on the triangles of nested grids, so they part most at a vertex of one of the two.
// All grid points of the finer chunks are compared, each with the point of the coarser surface at the same
// place. Stitched edges move vertices and so cut their triangles anew: there what is drawn at the grid points
// is compared instead, and between them too, in the middle of every triangle of the grid; a jump may be
// larger elsewhere, by so much as those triangles bend between the places looked at. Screen distance is no
// linear function of where points are, but across one triangle it hardly differs from one.
//
// The mean is over the screen area of the finer chunks as drawn after: their triangles are cut at the
// picture's border, and where a point moves to is linear between their corners. Of stitched edges it counts
// the grid points alone.
//
// A drawn sea is part of the surface: what lies below it is drawn at its level. Places that it covers before
// and after do not count, neither for the largest jump nor for the mean. This holds for all ground below the
// level: where a colour image shows dry land there, the shader paints no water, but draws it at the level too.
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

// Two pixel measures, both through one view. screenPx: the distance between the projections of the two
// points in the flat picture. facingPx: K' |a/|a| - b/|b||, a and b as seen from the eye: the same if the
// view were turned to face them. The flat picture stretches towards its corners, so screenPx may be larger.
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

// A coarser chunk and chunks within it, of any deeper levels; one of the two sides was drawn before, the
// other is drawn after. seaM: level of a sea that is drawn as water, metres above the radius.
SurfaceJump surfaceJump(const PlanetShape& shape, const DrawnChunk& coarser,
                        std::span<const DrawnChunk> finer, bool coarserIsAfter, const View& view,
                        std::optional<double> seaM = std::nullopt);

// Of one chunk that is drawn before and after, what one of its edges does: at the edge's vertices, or where
// either is stitched, at every half cell of the rows whose triangles the edge moves. The mean is over these.
SurfaceJump edgeJump(const PlanetShape& shape, const DrawnChunk& before, const DrawnChunk& after, Edge edge,
                     const View& view, std::optional<double> seaM = std::nullopt);

}  // namespace planet
