// What lies over the edges of a cube face, on the next one. Internal to the library. Pure functions, any
// thread.
#pragma once

#include <glm/vec3.hpp>

#include "planet/sphere/cube_sphere.h"

namespace planet {

// A point of a face's grid of (cells + 1)^2, column along u, row along v, both [0, cells] on the face itself.
struct FaceGridPoint {
    Face face = Face::PosX;
    int column = 0;
    int row = 0;
};

// The face whose outward normal, a unit vector along a world axis, this is.
Face faceAlong(const glm::dvec3& normal);

// A point over one edge of its face, by up to its width: folded down onto the next face. One on the face,
// edges included, is itself.
FaceGridPoint foldedOver(const FaceGridPoint& point, int cells);

// The same point of the cube on another face that it lies on, for a point on an edge.
FaceGridPoint placeOnFace(Face face, const FaceGridPoint& point, int cells);

}  // namespace planet
