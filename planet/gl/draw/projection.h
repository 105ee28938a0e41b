// Conversions between camera space and clip space. Pure functions, any thread.
#pragma once

#include <glm/mat4x4.hpp>

#include "planet/sphere/view.h"

namespace planet::gl {

struct Projection {
    glm::dmat4 clipFromCamera{1};
    bool reversedZ = true;
    double nearM = 0.1;
    double farM = 0;  // of the non-reversed projection; the reversed one has no far plane
};

// Returns a projection with depth 1 at the near plane and 0 at infinity, for clip depth [0, 1] and a float
// depth buffer, which keeps about seven digits of the distance at any distance.
Projection reversedProjection(const View& view, double nearM);

// Returns a projection with depth 0 at the near plane and 1 at the far plane, for OpenGL's default clip depth
// [-1, 1].
Projection classicProjection(const View& view, double nearM, double farM);

// Returns the classic projection with planes for a planet: the near plane as near as the ground may be, the
// far plane as far as ground is visible. highestRadiusM: the highest drawn ground, from the planet's centre.
Projection fallbackProjection(const View& view, double radiusM, double highestRadiusM);

// Returns the metres along the view direction of a depth value in [0, 1]; infinity for the reversed one's 0.
double viewDistanceM(const Projection& projection, double depth);

// Returns the metres along the view direction from one depth value to the next farther one: surfaces nearer
// together may show through each other. distanceM: >= nearM. Assumes a float depth buffer; a 24-bit one is
// the same on the farther half of the classic projection. Infinity if there is no farther value.
double depthStepM(const Projection& projection, double distanceM);

}  // namespace planet::gl
