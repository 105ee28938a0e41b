// From camera space to clip space and back. Pure functions, any thread.
#pragma once

#include <glm/mat4x4.hpp>

#include "planet/sphere/view.h"

namespace planet::gl {

struct Projection {
    glm::dmat4 clipFromCamera{1};
    bool reversedZ = true;
    double nearM = 0.1;
    double farM = 0;  // of the classic one; the reversed one has no far plane
};

// Depth 1 at the near plane, 0 at infinity: for clip depth 0 to 1 and a float depth buffer, which keeps about
// seven digits of the distance at any distance.
Projection reversedProjection(const View& view, double nearM);

// Depth 0 at the near plane, 1 at the far plane, clip depth -1 to 1, as OpenGL always had it.
Projection classicProjection(const View& view, double nearM, double farM);

// The classic one with planes for a planet: as near as the ground may be, and as far as any of it can be
// seen. highestRadiusM: of the highest ground drawn, from the planet's centre.
Projection fallbackProjection(const View& view, double radiusM, double highestRadiusM);

// Metres along the view direction of a depth buffer's value in [0, 1]; infinity at the reversed one's 0.
double viewDistanceM(const Projection& projection, double depth);

// Metres along the view direction from one value of a depth buffer to the next farther one, at a distance
// that the buffer can tell, nearM or more: nearer together two surfaces may show through each other. For a
// float depth buffer; one of 24 bits is the same on the classic projection's farther half. Infinity where
// there is no farther value.
double depthStepM(const Projection& projection, double distanceM);

}  // namespace planet::gl
