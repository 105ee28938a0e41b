// How keys and mouse move the camera. Pure functions, any thread.
//
// The camera has no roll: its right vector is level wherever it is. A move over the planet turns eye and
// frame together about the planet's centre, so there is no special place at the poles, and a level flight
// keeps its altitude.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "planet/sphere/view.h"

namespace worldy {

inline constexpr double minGroundClearanceM = 2;
inline constexpr double maxAltitudeRadii = 20;  // how far out the camera goes, in planet radii

struct Camera {
    glm::dvec3 eyeM{0, 0, 0};   // metres from the planet's centre, never 0
    glm::dvec3 right{1, 0, 0};  // unit, level
    glm::dvec3 back{0, 0, 1};   // unit, orthogonal to right; the camera looks along -back
};

Camera cameraFromPose(const planet::CameraPose& pose, double radiusM);
// About a unit axis, counterclockwise seen against it. Rodrigues' formula.
glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& axis, double angleRad);

planet::View viewOf(const Camera& camera, double horizontalFovRad, int widthPx, int heightPx);

// The whole planet in view, for a planet of any size.
planet::CameraPose wholePlanetPose(double radiusM);

// A pose as settings keep it: altitude 0 stands for the whole planet in view.
planet::CameraPose startPose(const planet::CameraPose& kept, double radiusM);

planet::CameraPose poseOf(const Camera& camera, double radiusM);

// What the moves need to know of the planet below the camera.
struct Ground {
    double radiusM = 6'371'000;
    double heightM = 0;  // of the surface below the eye, above the radius
};
double altitudeM(const Camera& camera, const Ground& ground);           // above the radius
double heightAboveGroundM(const Camera& camera, const Ground& ground);  // at least minGroundClearanceM

// Over the ground: forward along the heading and to the right, metres at the ground.
Camera moveOverGround(const Camera& camera, const Ground& ground, double forwardM, double rightM);

// Straight up, metres.
Camera climb(const Camera& camera, double upM);

// Where the camera looks (forward) and sideways; level where it looks level.
Camera fly(const Camera& camera, const Ground& ground, double forwardM, double rightM);

// Turns the head: right about the local vertical, up about the right vector, stopping straight up and down.
Camera look(const Camera& camera, double rightRad, double upRad);

// Drags the planet by a number of pixels (right, down): the ground in the middle of the view follows the
// pointer.
Camera drag(const Camera& camera, const Ground& ground, const planet::View& view, const glm::dvec2& movePx);

// The direction through a pixel, counted from the view's top left; unit.
glm::dvec3 rayThrough(const planet::View& view, const glm::dvec2& pixel);

// Goes a share of the way to what lies under the pointer for each notch; negative: away from it.
Camera approach(const Camera& camera, const Ground& ground, const glm::dvec3& ray, double notches);

// Lifts the camera to minGroundClearanceM above the ground, and keeps it within maxAltitudeRadii.
Camera keepInRange(const Camera& camera, const Ground& ground);

// Metres a second: grows with the height above ground, so that the picture always moves at about one pace.
double speedMS(const Camera& camera, const Ground& ground, double speedFactor);

inline constexpr double minSpeedFactor = 1.0 / 64;
inline constexpr double maxSpeedFactor = 64;

// What is held down in a frame; each is -1, 0 or 1.
struct HeldKeys {
    double forward = 0;    // W S
    double right = 0;      // D A
    double up = 0;         // E Q
    double lookRight = 0;  // L J
    double lookUp = 0;     // I K
};
Camera moveByKeys(const Camera& camera, const Ground& ground, const HeldKeys& keys, double speedFactor,
                  double seconds);

}  // namespace worldy
