// Bounding volumes of everything that a chunk and its descendants can draw: the vertices of its square of the
// sphere between its lowest and highest finest heights, and every triangle between those vertices. Pure
// functions, any thread.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/view.h"

namespace planet {

// A box in the local frame of the chunk's middle, roughly east, north and up. It is convex and contains every
// vertex, so it contains every triangle, even where triangles sag below the sphere.
struct OrientedBox {
    glm::dvec3 centreM{0, 0, 0};
    std::array<glm::dvec3, 3> axes{};  // unit, orthogonal
    glm::dvec3 halfSizeM{0, 0, 0};     // along each axis
};

// All directions within an angle of an axis.
struct DirectionCone {
    glm::dvec3 axis{0, 0, 1};  // unit
    double halfAngleRad = 0;   // [0, pi]
};

struct ChunkBounds {
    OrientedBox box;
    DirectionCone cone;     // contains the direction of every vertex
    double coneSine = 0;    // of the cone's half angle, which is at most pi / 2
    double maxRadiusM = 0;  // largest distance of a vertex from the planet's centre
};

// The part of the bounds that does not depend on heights and is expensive to compute: the range of the
// chunk's directions along the axes of the box, at most [-1, 1].
struct ChunkDirections {
    std::array<glm::dvec3, 3> axes{};  // unit, orthogonal
    glm::dvec3 low{0, 0, 0};           // along each axis
    glm::dvec3 high{0, 0, 0};
    DirectionCone cone;
};
ChunkDirections chunkDirections(const ChunkId& id);

// Computes the bounds. radiusM + minHeightM > 0, and minHeightM <= maxHeightM.
ChunkBounds chunkBounds(const ChunkDirections& directions, double radiusM, double minHeightM,
                        double maxHeightM);
ChunkBounds chunkBounds(const ChunkId& id, double radiusM, double minHeightM, double maxHeightM);

// Returns the distance from a point to the box; 0 inside it.
double distanceM(const OrientedBox& box, const glm::dvec3& pointM);

enum class Containment { Outside, Crossing, Inside };
Containment classify(const OrientedBox& box, const Plane& plane);

// The part of the planet that is visible from an eye, computed once per frame.
struct Horizon {
    glm::dvec3 eyeDirection{0, 0, 1};  // unit
    double occluderRadiusM = 0;
    double angleRad =
        0;  // at the planet's centre, from the eye to where a line of sight touches the occluder
    double angleCosine = 1;
    double angleSine = 0;
    bool seesAll = true;  // the eye is inside the occluder
};
Horizon horizonOf(const glm::dvec3& eyeM, double occluderRadiusM);

// Classifies a chunk against the horizon. Outside: the occluder hides every point in the cone up to
// maxRadiusM. Inside: it hides no point of the cone that is outside it, so it hides nothing of this chunk and
// its descendants. Crossing: neither is certain.
Containment classify(const ChunkBounds& bounds, const Horizon& horizon);

// Returns the radius of a sphere around the planet's centre that is inside every triangle between vertices of
// any level. lowestRadiusM: lower bound of the vertices' distances from the centre. rootCells: cells along
// the side of a face's root chunk, whose triangles sag most.
double radiusInsideTriangles(double lowestRadiusM, int rootCells);

}  // namespace planet
