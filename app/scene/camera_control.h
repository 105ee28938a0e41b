// Moves the camera. Pure functions, any thread.
//
// The camera has no roll: its right vector is always level. A move over the planet rotates eye and axes
// together about the planet's centre, so the poles are not special, and a level flight keeps its altitude.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "planet/sphere/view.h"

namespace worldy {

inline constexpr double minGroundClearanceM = 2;
inline constexpr double maxAltitudeRadii = 20;  // largest altitude of the camera, in planet radii

struct Camera {
    glm::dvec3 eyeM{0, 0, 0};   // metres from the planet's centre, never 0
    glm::dvec3 right{1, 0, 0};  // unit, level
    glm::dvec3 back{0, 0, 1};   // unit, orthogonal to right; the camera looks along -back
};

Camera cameraFromPose(const planet::CameraPose& pose, double radiusM);
// Rotates a vector about a unit axis, counterclockwise if the axis points to the viewer (Rodrigues' formula).
glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& axis, double angleRad);

planet::View viewOf(const Camera& camera, double horizontalFovRad, int widthPx, int heightPx);

// Returns a pose that shows the whole planet.
planet::CameraPose wholePlanetPose(double radiusM);

// Returns the pose that settings store. There, altitude 0 stands for the altitude that shows the whole
// planet.
planet::CameraPose startPose(const planet::CameraPose& kept, double radiusM);

planet::CameraPose poseOf(const Camera& camera, double radiusM);

// The ground below the camera.
struct Ground {
    double radiusM = 6'371'000;
    double heightM = 0;  // height of the surface below the eye, above the radius
};
double altitudeM(const Camera& camera, const Ground& ground);           // above the radius
double heightAboveGroundM(const Camera& camera, const Ground& ground);  // at least minGroundClearanceM

// Moves over the ground along the heading and to the right, by distances in metres at the ground.
Camera moveOverGround(const Camera& camera, const Ground& ground, double forwardM, double rightM);

// Moves straight up, in metres.
Camera climb(const Camera& camera, double upM);

// Moves in the direction of view and sideways. A camera with a level view keeps its altitude.
Camera fly(const Camera& camera, const Ground& ground, double forwardM, double rightM);

// Turns right about the local vertical and up about the right vector. Stops at straight up and straight down.
Camera look(const Camera& camera, double rightRad, double upRad);

// Drags the planet by a number of pixels (right, down). The ground in the middle of the view follows the
// pointer.
Camera drag(const Camera& camera, const Ground& ground, const planet::View& view, const glm::dvec2& movePx);

// Returns the unit direction through a pixel, which is counted from the top left of the view.
glm::dvec3 rayThrough(const planet::View& view, const glm::dvec2& pixel);

// Returns the pixel that shows a point, counted from the top left of the view, inside the picture or not; nothing behind the
// camera.
std::optional<glm::dvec2> pixelOf(const planet::View& view, const glm::dvec3& pointM);

// Returns the distance along a unit ray to a sphere about the planet's centre, from an eye outside it;
// nothing if the ray misses the sphere.
std::optional<double> distanceToSphereM(const glm::dvec3& eyeM, const glm::dvec3& ray, double sphereRadiusM);

// Moves a share of the distance to the ground under the pointer per notch; negative notches move away.
Camera approach(const Camera& camera, const Ground& ground, const glm::dvec3& ray, double notches);

// Clamps the altitude between minGroundClearanceM above the ground and maxAltitudeRadii.
Camera keepInRange(const Camera& camera, const Ground& ground);

// Returns the speed in m/s. It grows with the height above ground, so the picture always moves at a similar
// pace.
double speedMS(const Camera& camera, const Ground& ground, double speedFactor);

inline constexpr double minSpeedFactor = 1.0 / 64;
inline constexpr double maxSpeedFactor = 64;

// A motion of the camera, as shares of full speed: a held key gives -1 or 1, a stick any value between, times its
// sensitivity.
struct CameraMotion {
    double forward = 0;    // W S
    double right = 0;      // D A
    double up = 0;         // E Q
    double lookRight = 0;  // L J
    double lookUp = 0;     // I K

    bool operator==(const CameraMotion&) const = default;
};
CameraMotion operator+(const CameraMotion& a, const CameraMotion& b);
CameraMotion scaled(const CameraMotion& motion, double factor);
// Moves and turns. Full speed turns by 60 degrees a second.
Camera steered(const Camera& camera, const Ground& ground, const CameraMotion& motion, double speedFactor,
               double seconds);

// Returns the field of view, in degrees, after some notches of the wheel; positive ones narrow it. Clamped to the range of
// the setting.
double narrowedFovDeg(double fovDeg, double notches);

}  // namespace worldy
