// Continues the grid of a cube face across its edges, onto the next faces. Internal to the library. Pure
// functions, any thread.
#pragma once

#include <glm/vec3.hpp>

#include "planet/sphere/cube_sphere.h"

namespace planet {

// A point of a face's grid of (cells + 1)^2: column along u, row along v, both in [0, cells] on the face
// itself.
struct FaceGridPoint {
    Face face = Face::PosX;
    int column = 0;
    int row = 0;
};

// Returns the face of an outward normal, a unit vector along a world axis.
Face faceAlong(const glm::dvec3& normal);

// Returns a point that lies beyond one edge of its face, by up to the face's width, folded onto the next
// face. Returns a point on the face, edges included, unchanged.
FaceGridPoint foldedOver(const FaceGridPoint& point, int cells);

// Returns the coordinates of a point on an edge on another face that shares the edge.
FaceGridPoint placeOnFace(Face face, const FaceGridPoint& point, int cells);

}  // namespace planet
