#include "app/scene/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

#include "app/settings/settings_schema.h"

namespace worldy {

namespace {

Camera turnedAboutCentre(const Camera& camera, const glm::dvec3& axis, double angleRad) {
    return {rotated(camera.eyeM, axis, angleRad), rotated(camera.right, axis, angleRad),
            rotated(camera.back, axis, angleRad)};
}

// Removes the roll and the rounding errors that add up over thousands of small turns.
Camera straightened(Camera camera) {
    const glm::dvec3 up = glm::normalize(camera.eyeM);
    camera.right = glm::normalize(camera.right - glm::dot(camera.right, up) * up);
    camera.back = glm::normalize(camera.back - glm::dot(camera.back, camera.right) * camera.right);
    return camera;
}

glm::dvec3 levelForward(const Camera& camera) {
    return glm::cross(glm::normalize(camera.eyeM), camera.right);
}

double pitchRad(const Camera& camera) {
    return std::asin(std::clamp(-glm::dot(camera.back, glm::normalize(camera.eyeM)), -1.0, 1.0));
}

}  // namespace

std::optional<double> distanceToSphereM(const glm::dvec3& eyeM, const glm::dvec3& ray, double sphereRadiusM) {
    const double towards = -glm::dot(eyeM, ray);
    const double halfChordSquared = sphereRadiusM * sphereRadiusM - glm::dot(eyeM, eyeM) + towards * towards;
    if (towards <= 0 || halfChordSquared < 0) return std::nullopt;
    return std::max(towards - std::sqrt(halfChordSquared), 0.0);
}

glm::dvec3 rotated(const glm::dvec3& vector, const glm::dvec3& axis, double angleRad) {
    const double cosine = std::cos(angleRad);
    return cosine * vector + std::sin(angleRad) * glm::cross(axis, vector) +
           (1 - cosine) * glm::dot(axis, vector) * axis;
}

Camera cameraFromPose(const planet::CameraPose& pose, double radiusM) {
    const planet::View view = planet::viewFromPose(pose, radiusM, glm::radians(60.0), 1, 1);
    return {view.eyeM, view.right, view.back};
}

planet::View viewOf(const Camera& camera, double horizontalFovRad, int widthPx, int heightPx) {
    planet::View view;
    view.eyeM = camera.eyeM;
    view.right = camera.right;
    view.back = camera.back;
    view.up = glm::cross(camera.back, camera.right);
    view.horizontalFovRad = horizontalFovRad;
    view.widthPx = widthPx;
    view.heightPx = heightPx;
    return view;
}

planet::CameraPose wholePlanetPose(double radiusM) {
    planet::CameraPose pose;
    pose.altitudeM = 2.2 * radiusM;
    return pose;
}

planet::CameraPose startPose(const planet::CameraPose& kept, double radiusM) {
    planet::CameraPose pose = kept;
    if (pose.altitudeM == 0) pose.altitudeM = wholePlanetPose(radiusM).altitudeM;
    return pose;
}

planet::CameraPose poseOf(const Camera& camera, double radiusM) {
    return planet::poseFromView(viewOf(camera, 1, 1, 1), radiusM);
}

double altitudeM(const Camera& camera, const Ground& ground) {
    return glm::length(camera.eyeM) - ground.radiusM;
}

double heightAboveGroundM(const Camera& camera, const Ground& ground) {
    return std::max(altitudeM(camera, ground) - ground.heightM, minGroundClearanceM);
}

Camera moveOverGround(const Camera& camera, const Ground& ground, double forwardM, double rightM) {
    const double groundRadiusM = ground.radiusM + ground.heightM;
    const glm::dvec3 up = glm::normalize(camera.eyeM);
    const glm::dvec3 way = forwardM * levelForward(camera) + rightM * camera.right;
    const double lengthM = glm::length(way);
    if (lengthM == 0) return camera;
    return straightened(turnedAboutCentre(camera, glm::cross(up, way / lengthM), lengthM / groundRadiusM));
}

Camera climb(const Camera& camera, double upM) {
    // The eye never reaches the planet's centre.
    const double distanceM = glm::length(camera.eyeM);
    Camera moved = camera;
    moved.eyeM *= std::max(distanceM + upM, 0.01 * distanceM) / distanceM;
    return moved;
}

Camera fly(const Camera& camera, const Ground& ground, double forwardM, double rightM) {
    const double pitch = pitchRad(camera);
    // The ground below a high camera moves slower than the camera.
    const double atGround = (ground.radiusM + ground.heightM) / glm::length(camera.eyeM);
    return climb(moveOverGround(camera, ground, atGround * forwardM * std::cos(pitch), atGround * rightM),
                 forwardM * std::sin(pitch));
}

Camera look(const Camera& camera, double rightRad, double upRad) {
    // A camera that does not turn must keep every bit, so that measurements of its view stay current.
    if (rightRad == 0 && upRad == 0) return camera;
    const glm::dvec3 up = glm::normalize(camera.eyeM);
    Camera turned = camera;
    turned.right = rotated(camera.right, up, -rightRad);
    turned.back = rotated(camera.back, up, -rightRad);
    const double limit = glm::radians(90.0);
    const double pitch = pitchRad(turned);
    turned.back = rotated(turned.back, turned.right, std::clamp(pitch + upRad, -limit, limit) - pitch);
    return straightened(turned);
}

Camera drag(const Camera& camera, const Ground& ground, const planet::View& view, const glm::dvec2& movePx) {
    const double groundRadiusM = ground.radiusM + ground.heightM;
    // Towards the sky or along the ground, the distance does not exist or is far too long.
    const double heightM = heightAboveGroundM(camera, ground);
    const double distanceM =
        std::min(distanceToSphereM(camera.eyeM, -camera.back, groundRadiusM).value_or(heightM), 4 * heightM);
    const double metresAPx = distanceM / planet::screenScalePx(view);
    return moveOverGround(camera, ground, movePx.y * metresAPx, -movePx.x * metresAPx);
}

glm::dvec3 rayThrough(const planet::View& view, const glm::dvec2& pixel) {
    const double scale = planet::screenScalePx(view);
    const double x = (pixel.x - view.widthPx / 2.0) / scale;
    const double y = (view.heightPx / 2.0 - pixel.y) / scale;
    return glm::normalize(x * view.right + y * view.up - view.back);
}

std::optional<glm::dvec2> pixelOf(const planet::View& view, const glm::dvec3& pointM) {
    const glm::dvec3 fromEye = pointM - view.eyeM;
    const double aheadM = -glm::dot(fromEye, view.back);
    if (aheadM <= 0) return std::nullopt;
    const double scale = planet::screenScalePx(view) / aheadM;
    return glm::dvec2(view.widthPx / 2.0 + scale * glm::dot(fromEye, view.right),
                      view.heightPx / 2.0 - scale * glm::dot(fromEye, view.up));
}

Camera approach(const Camera& camera, const Ground& ground, const glm::dvec3& ray, double notches) {
    const double heightM = heightAboveGroundM(camera, ground);
    const double share = 1 - std::pow(0.85, notches);
    const double groundRadiusM = ground.radiusM + ground.heightM;
    const std::optional<double> hitM = distanceToSphereM(camera.eyeM, ray, groundRadiusM);
    // With the pointer on the sky, the camera moves straight down.
    if (!hitM) return climb(camera, -share * heightM);
    const glm::dvec3 across = glm::cross(camera.eyeM, camera.eyeM + *hitM * ray);
    if (glm::length(across) == 0) return climb(camera, -share * heightM);
    // Towards the horizon, the move is limited to a reasonable step.
    const double angleRad =
        std::min(std::asin(std::min(
                     *hitM * glm::length(glm::cross(ray, glm::normalize(camera.eyeM))) / groundRadiusM, 1.0)),
                 4 * heightM / groundRadiusM);
    return climb(straightened(turnedAboutCentre(camera, glm::normalize(across), share * angleRad)),
                 -share * heightM);
}

Camera keepInRange(const Camera& camera, const Ground& ground) {
    const double lowestM = ground.radiusM + ground.heightM + minGroundClearanceM;
    const double highestM = std::max(lowestM, (1 + maxAltitudeRadii) * ground.radiusM);
    const double distanceM = glm::length(camera.eyeM);
    const double factor = std::clamp(distanceM, lowestM, highestM) / distanceM;
    // A camera that differs from a limit only by rounding stays unchanged.
    if (std::abs(factor - 1) < 4 * std::numeric_limits<double>::epsilon()) return camera;
    Camera kept = camera;
    kept.eyeM *= factor;
    return kept;
}

double speedMS(const Camera& camera, const Ground& ground, double speedFactor) {
    // Above 1.5 planet radii per second the user would lose orientation.
    const double naturalMS = std::min(0.6 * heightAboveGroundM(camera, ground), 1.5 * ground.radiusM);
    return speedFactor * naturalMS;
}

CameraMotion operator+(const CameraMotion& a, const CameraMotion& b) {
    return {a.forward + b.forward, a.right + b.right, a.up + b.up, a.lookRight + b.lookRight,
            a.lookUp + b.lookUp};
}

CameraMotion scaled(const CameraMotion& motion, double factor) {
    return {factor * motion.forward, factor * motion.right, factor * motion.up, factor * motion.lookRight,
            factor * motion.lookUp};
}

double narrowedFovDeg(double fovDeg, double notches) {
    const NumberRange& range = rangeOf("view.fov_deg");
    return std::clamp(fovDeg * std::pow(1.1, -notches), range.min, range.max);
}

Camera steered(const Camera& camera, const Ground& ground, const CameraMotion& motion, double speedFactor,
               double seconds) {
    const double turnRad = glm::radians(60.0) * seconds;
    const double stepM = speedMS(camera, ground, speedFactor) * seconds;
    Camera moved = look(camera, motion.lookRight * turnRad, motion.lookUp * turnRad);
    moved = fly(moved, ground, motion.forward * stepM, motion.right * stepM);
    return climb(moved, motion.up * stepM);
}

}  // namespace worldy
