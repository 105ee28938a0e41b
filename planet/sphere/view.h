// A perspective view of the planet in double precision, with its scale and frustum. Pure functions, any
// thread.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace planet {

// The place and direction of a camera, in a form for users.
struct CameraPose {
    double latitudeDeg = 20;   // [-90, 90]
    double longitudeDeg = 10;  // any; east positive
    double altitudeM = 2.0e7;  // above the planet's radius, metres
    double headingDeg = 0;     // 0 north, 90 east
    double pitchDeg = -90;     // [-90, 90]; -90 straight down, 0 level
};

struct View {
    glm::dvec3 eyeM{0, 0, 0};   // metres from the planet's centre
    glm::dvec3 right{1, 0, 0};  // unit, orthogonal, right x up = back
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 back{0, 0, 1};                      // the view looks along -back
    double horizontalFovRad = 1.0471975511965976;  // (0, pi)
    int widthPx = 1280;
    int heightPx = 720;

    bool operator==(const View&) const = default;
};

View viewFromPose(const CameraPose& pose, double radiusM, double horizontalFovRad, int widthPx, int heightPx);
CameraPose poseFromView(const View& view, double radiusM);

// Returns true if the eye jumps between two frames: it moves farther over the ground than its greater height
// above the radius, or by more than 5 degrees of arc, or its height changes more than tenfold. Heights count
// as at least a thousandth of the radius. In a frame of N tenths of a second, N > 1, the three limits are N
// times as large. Eyes: metres from the planet's centre; seconds >= 0.
bool isCameraJump(const glm::dvec3& fromM, const glm::dvec3& toM, double radiusM, double seconds);

// Returns K' = W / (2 tan(Hfov / 2)): the pixels that 1 m covers at a distance of 1 m.
double screenScalePx(const View& view);

// Returns the rotation from world to camera, without the translation.
glm::dmat3 cameraFromWorldRotation(const View& view);

// A plane; points p with dot(normal, p) + offsetM >= 0 are inside.
struct Plane {
    glm::dvec3 normal{0, 0, 1};  // unit
    double offsetM = 0;
};
// The planes left, right, bottom and top. All pass through the eye, so there are no near and far planes.
using Frustum = std::array<Plane, 4>;
Frustum frustumOf(const View& view);

}  // namespace planet
