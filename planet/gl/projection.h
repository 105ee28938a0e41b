// From camera space to clip space and back. Pure functions, any thread.
#pragma once

#include <glm/mat4x4.hpp>

#include "planet/view.h"

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

// Metres along the view direction of a depth buffer's value in [0, 1]; infinity at the reversed one's 0.
double viewDistanceM(const Projection& projection, double depth);

}  // namespace planet::gl
