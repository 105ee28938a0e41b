// A polygon on the unit sphere, whose edges are arcs of great circles. Internal to the library; pure functions, any thread.
//
// A gnomonic projection onto the plane that touches the sphere in the polygon's middle makes its edges straight, so
// whether a place lies inside, and whether edges cross, are questions about a polygon of the plane.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/sphere/bounds.h"

namespace planet {

inline constexpr double mostPolygonDeg = 80;  // from the middle of its corners to any of them

class SpherePolygon {
public:
    // corners: unit vectors, at least three, each once, in either direction. The Error says which corners are wrong,
    // counted from 1.
    static Result<SpherePolygon> make(std::span<const glm::dvec3> corners);

    // Returns the angle from a unit vector to the polygon's outline, [0, pi]; negative inside.
    double signedDistanceRad(const glm::dvec3& at) const;
    // A cone around the polygon.
    const DirectionCone& cone() const { return cone_; }

private:
    struct Arc {
        glm::dvec3 from;    // its first corner
        glm::dvec3 normal;  // unit, of its great circle
        // A place is beside the arc, rather than beyond one of its ends, if its dot products with both are at least 0.
        glm::dvec3 afterFrom;
        glm::dvec3 beforeTo;
    };

    explicit SpherePolygon(std::span<const glm::dvec3> corners);
    glm::dvec2 onPlane(const glm::dvec3& at) const;
    Result<void> check() const;
    bool contains(const glm::dvec3& at) const;

    DirectionCone cone_;
    glm::dvec3 east_{1, 0, 0};  // the axes of the plane
    glm::dvec3 north_{0, 1, 0};
    std::vector<Arc> arcs_;
    std::vector<glm::dvec2> corners_;  // on the plane
};

// Returns the angle between two unit vectors, exact for small angles too.
double angleBetweenRad(const glm::dvec3& a, const glm::dvec3& b);

}  // namespace planet
