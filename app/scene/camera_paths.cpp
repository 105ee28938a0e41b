#include "app/scene/camera_paths.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace worldy {

namespace {

double headingRadOf(const Camera& camera, const glm::dvec3& north, const glm::dvec3& east) {
    return std::atan2(-glm::dot(camera.right, north), glm::dot(camera.right, east));
}

double elevationRad(const glm::dvec3& direction, const glm::dvec3& up) {
    return std::asin(std::clamp(glm::dot(direction, up), -1.0, 1.0));
}

// Interpolates heights by their ratio where they are large, and linearly near 0, where they may be negative.
double blendedHeightM(double fromM, double toM, double share) {
    constexpr double linearM = 1000;
    return linearM * std::sinh(std::lerp(std::asinh(fromM / linearM), std::asinh(toM / linearM), share));
}

}  // namespace

Camera levelled(Camera camera) {
    camera.back = glm::normalize(camera.back);
    const glm::dvec3 up = glm::normalize(camera.eyeM);
    glm::dvec3 right = glm::cross(up, camera.back);
    if (glm::length(right) < 1e-9) right = camera.right - glm::dot(camera.right, camera.back) * camera.back;
    camera.right = glm::normalize(glm::dot(right, camera.right) < 0 ? -right : right);
    return camera;
}

Camera blend(const Camera& from, const Camera& to, double share) {
    const glm::dvec3 a = glm::normalize(from.eyeM);
    const glm::dvec3 b = glm::normalize(to.eyeM);
    glm::dvec3 axis = glm::cross(a, b);
    const double angleRad = std::atan2(glm::length(axis), glm::dot(a, b));
    // Antipodal places have no unique shortest path, so any axis is used.
    if (glm::length(axis) < 1e-12) axis = from.right;
    axis = glm::normalize(axis);
    const glm::dvec3 up = rotated(a, axis, share * angleRad);

    // Heading and pitch are interpolated in frames that move along the path; north points along it.
    const double fromHeading = headingRadOf(from, glm::cross(axis, a), -axis);
    const double toHeading = headingRadOf(to, glm::cross(axis, b), -axis);
    const double heading = fromHeading + share * std::remainder(toHeading - fromHeading, glm::radians(360.0));
    const double pitch = (1 - share) * elevationRad(-from.back, a) + share * elevationRad(-to.back, b);
    const glm::dvec3 north = glm::cross(axis, up);
    const glm::dvec3 east = -axis;
    const glm::dvec3 level = std::cos(heading) * north + std::sin(heading) * east;
    Camera camera;
    camera.eyeM = std::pow(glm::length(from.eyeM), 1 - share) * std::pow(glm::length(to.eyeM), share) * up;
    camera.right = std::cos(heading) * east - std::sin(heading) * north;
    camera.back = -(std::cos(pitch) * level + std::sin(pitch) * up);
    return camera;
}

Camera glideAt(const Camera& from, const Camera& to, double share, double radiusM) {
    if (share <= 0) return from;
    if (share >= 1) return to;
    const double fromM = glm::length(from.eyeM) - radiusM;
    const double toM = glm::length(to.eyeM) - radiusM;
    const glm::dvec3 across = glm::cross(glm::normalize(from.eyeM), glm::normalize(to.eyeM));
    const double wayM = radiusM * std::atan2(glm::length(across),
                                             glm::dot(glm::normalize(from.eyeM), glm::normalize(to.eyeM)));
    const double riseM = std::max(0.5 * wayM - blendedHeightM(fromM, toM, 0.5), 0.0);
    const double t = share * share * (3 - 2 * share);
    Camera camera = blend(from, to, t);
    const double heightM = blendedHeightM(fromM, toM, t) + 4 * t * (1 - t) * riseM;
    camera.eyeM = (radiusM + heightM) * glm::normalize(camera.eyeM);
    return camera;
}

Camera lookingAt(const Camera& camera, const glm::dvec3& pointM) {
    return levelled({camera.eyeM, camera.right, camera.eyeM - pointM});
}

Camera holding(const Camera& camera, const glm::dvec3& pointM, const glm::dvec3& direction) {
    const glm::dvec3 up = glm::normalize(camera.eyeM);
    const glm::dvec3 wanted = glm::normalize(pointM - camera.eyeM);
    Camera turned = camera;
    // Tilting also moves a direction beside the middle sideways, less each time.
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 now = direction.x * turned.right +
                               direction.y * glm::cross(turned.back, turned.right) +
                               direction.z * turned.back;
        const double leftRad = std::atan2(glm::dot(up, glm::cross(now, wanted)),
                                          glm::dot(now, wanted) - glm::dot(now, up) * glm::dot(wanted, up));
        turned = look(turned, -leftRad, elevationRad(wanted, up) - elevationRad(now, up));
    }
    return turned;
}

glm::dvec3 directionOf(const Camera& camera, const glm::dvec3& pointM) {
    const glm::dvec3 towards = glm::normalize(pointM - camera.eyeM);
    return {glm::dot(towards, camera.right), glm::dot(towards, glm::cross(camera.back, camera.right)),
            glm::dot(towards, camera.back)};
}

}  // namespace worldy
