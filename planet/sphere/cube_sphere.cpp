#include "planet/sphere/cube_sphere.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace planet {

namespace {

constexpr std::array<std::string_view, faceCount> faceNames = {"x_pos", "x_neg", "y_pos",
                                                               "y_neg", "z_pos", "z_neg"};

const std::array<FaceAxes, faceCount> axesOfFaces = {{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
    {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
    {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
}};

// Returns the face whose normal is nearest to the vector; among equals, the first in enum order.
Face dominantFace(const glm::dvec3& p) {
    Face best = Face::PosX;
    double most = -1;
    for (const Face face : allFaces) {
        const double along = glm::dot(p, faceAxes(face).normal);
        if (along > most) {
            most = along;
            best = face;
        }
    }
    return best;
}

struct SquarePoint {
    double u, v;
};

// Takes one Newton step towards u sqrt(1/2 - v^2/6) = s, v sqrt(1/2 - u^2/6) = t, Nowell's mapping on a face.
SquarePoint refineInverse(SquarePoint p, double s, double t) {
    const double rootV = std::sqrt(0.5 - p.v * p.v / 6);
    const double rootU = std::sqrt(0.5 - p.u * p.u / 6);
    const double errorS = p.u * rootV - s;
    const double errorT = p.v * rootU - t;
    const double crossS = -p.u * p.v / (6 * rootV);
    const double crossT = -p.u * p.v / (6 * rootU);
    const double determinant = rootV * rootU - crossS * crossT;
    return {std::clamp(p.u - (errorS * rootU - errorT * crossS) / determinant, -1.0, 1.0),
            std::clamp(p.v - (errorT * rootV - errorS * crossT) / determinant, -1.0, 1.0)};
}

}  // namespace

std::string_view faceName(Face face) {
    return faceNames[static_cast<std::size_t>(face)];
}

std::optional<Face> faceFromName(std::string_view name) {
    const auto found = std::find(faceNames.begin(), faceNames.end(), name);
    if (found == faceNames.end()) return std::nullopt;
    return static_cast<Face>(found - faceNames.begin());
}

const FaceAxes& faceAxes(Face face) {
    return axesOfFaces[static_cast<std::size_t>(face)];
}

glm::dvec3 cubePoint(Face face, double u, double v) {
    const FaceAxes& axes = faceAxes(face);
    // Adding 0 * u is exact for every component, but may leave -0; adding 0.0 makes it +0 on every face.
    return axes.normal + u * axes.u + v * axes.v + glm::dvec3(0.0);
}

glm::dvec3 sphereFromCube(const glm::dvec3& cube) {
    const glm::dvec3 s = cube * cube;
    return {cube.x * std::sqrt(1 - (s.y + s.z) / 2 + s.y * s.z / 3),
            cube.y * std::sqrt(1 - (s.z + s.x) / 2 + s.z * s.x / 3),
            cube.z * std::sqrt(1 - (s.x + s.y) / 2 + s.x * s.y / 3)};
}

glm::dvec3 cubeFromSphere(const glm::dvec3& direction) {
    const double length = glm::length(direction);
    assert(length > 0);
    const glm::dvec3 unit = direction / length;
    const Face face = dominantFace(unit);
    const FaceAxes& axes = faceAxes(face);
    const double s = glm::dot(unit, axes.u);
    const double t = glm::dot(unit, axes.v);
    // Squaring both equations of the mapping gives a quadratic equation in u^2, which is solved first.
    const double a = 2 * s * s;
    const double b = 2 * t * t;
    const double inner = b - a - 3;
    const double root = std::sqrt(std::max(0.0, inner * inner - 12 * a));
    SquarePoint p{std::copysign(std::sqrt(std::clamp((3 + a - b - root) / 2, 0.0, 1.0)), s),
                  std::copysign(std::sqrt(std::clamp((3 - a + b - root) / 2, 0.0, 1.0)), t)};
    // Newton steps recover the digits lost by the subtraction.
    p = refineInverse(p, s, t);
    p = refineInverse(p, s, t);
    p = refineInverse(p, s, t);
    return cubePoint(face, p.u, p.v);
}

FacePoint facePointFromCube(const glm::dvec3& cube) {
    const Face face = dominantFace(cube);
    const FaceAxes& axes = faceAxes(face);
    return {face, glm::dot(cube, axes.u), glm::dot(cube, axes.v)};
}

FacePoint facePointFromDirection(const glm::dvec3& direction) {
    return facePointFromCube(cubeFromSphere(direction));
}

glm::dvec3 directionFromGeographic(const Geographic& place) {
    const double ring = std::cos(place.latitudeRad);
    return {ring * std::cos(place.longitudeRad), ring * std::sin(place.longitudeRad),
            std::sin(place.latitudeRad)};
}

Geographic geographicFromDirection(const glm::dvec3& direction) {
    return {std::atan2(direction.z, std::hypot(direction.x, direction.y)),
            std::atan2(direction.y, direction.x)};
}

}  // namespace planet
