// Paths between cameras, and turns about a point. Pure functions, any thread.
#pragma once

#include "app/scene/camera_control.h"

namespace worldy {

// Removes roll and keeps the view direction. For a vertical direction every right vector is level.
Camera levelled(Camera camera);

// Interpolates between two cameras, over the ground. share 0: from; 1: to.
Camera blend(const Camera& from, const Camera& to, double share);

// Returns the camera on its way from one place to another, along a great circle. Where the way is long compared with the
// heights, it rises, at most to half its length, so that the ground passes at a similar pace. It starts and ends slowly.
// share 0: from, 1: to, both to the bit.
Camera glideAt(const Camera& from, const Camera& to, double share, double radiusM);

// Turns the camera so that a point lies in the middle of the picture. The point must not be the eye.
Camera lookingAt(const Camera& camera, const glm::dvec3& pointM);

// Turns the camera so that a point lies in a direction, given by its shares of right, up and back (unit). The camera stays
// level, so this is exact only where a level camera can look so.
Camera holding(const Camera& camera, const glm::dvec3& pointM, const glm::dvec3& direction);
// Returns the direction of a point from the camera, as holding() takes it.
glm::dvec3 directionOf(const Camera& camera, const glm::dvec3& pointM);

}  // namespace worldy
