#include "planet/sphere/vertex_position.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

namespace planet {

namespace {

constexpr double fineCells = 1 << fineGridLog2;
constexpr float fineCell = static_cast<float>(2 / fineCells);  // a power of two

// Returns the nearest line of the reference points' grid.
std::int32_t nearestGridLine(double coordinate) {
    constexpr double referenceCells = 1 << referenceGridLog2;
    const auto line =
        static_cast<std::int32_t>(std::lround((std::clamp(coordinate, -1.0, 1.0) + 1) / 2 * referenceCells));
    return line << (fineGridLog2 - referenceGridLog2);
}

std::int32_t nearestStep(const PlanetShape& shape, double heightAboveRadiusM) {
    const double step = std::round((heightAboveRadiusM - shape.baseHeightM) / shape.quantumM);
    return static_cast<std::int32_t>(
        std::clamp<double>(step, lowestStepOf(shape.fractionBits), highestStepOf(shape.fractionBits)));
}

FaceReference faceReference(Face face, const glm::dvec3& eyeOnCube, double radiusM, const glm::dvec3& eyeM) {
    const FaceAxes& axes = faceAxes(face);
    FaceReference reference;
    // The eye's cube point, projected straight onto the face, is the point of the face nearest to the eye.
    reference.gridU = nearestGridLine(glm::dot(eyeOnCube, axes.u));
    reference.gridV = nearestGridLine(glm::dot(eyeOnCube, axes.v));
    const double u = reference.gridU * (2 / fineCells) - 1;
    const double v = reference.gridV * (2 / fineCells) - 1;
    reference.u0 = static_cast<float>(u);
    reference.v0 = static_cast<float>(v);
    reference.roots = {std::sqrt(1 - (u * u + v * v) / 2 + u * u * v * v / 3), std::sqrt(0.5 - v * v / 6),
                       std::sqrt(0.5 - u * u / 6)};
    const glm::dvec3 direction = sphereFromCube(cubePoint(face, u, v));
    reference.direction = direction;
    reference.originM = radiusM * direction - eyeM;
    return reference;
}

}  // namespace

VertexFrame vertexFrame(const PlanetShape& shape, const glm::dvec3& eyeM) {
    const double eyeRadiusM = glm::length(eyeM);
    const glm::dvec3 eyeOnCube = cubeFromSphere(eyeRadiusM > 0 ? eyeM : glm::dvec3(1, 0, 0));
    VertexFrame frame;
    frame.referenceStep = nearestStep(shape, eyeRadiusM - shape.radiusM);
    const double radiusM = shape.radiusM + shape.baseHeightM + frame.referenceStep * shape.quantumM;
    frame.referenceRadiusM = static_cast<float>(radiusM);
    frame.quantumM = static_cast<float>(shape.quantumM);
    for (const Face face : allFaces)
        frame.faces[static_cast<std::size_t>(face)] = faceReference(face, eyeOnCube, radiusM, eyeM);
    return frame;
}

// Doubled grid coordinates from a face's middle are exact coordinates on a cube of twice the grid's side.
FineGridPoint onOwningFace(const FineGridPoint& point) {
    constexpr std::int32_t side = 1 << fineGridLog2;
    const std::int32_t alongU = 2 * point.gridU - side;
    const std::int32_t alongV = 2 * point.gridV - side;
    if (std::max(std::abs(alongU), std::abs(alongV)) < side) return point;
    const FaceAxes& from = faceAxes(point.face);
    const glm::dvec3 cube = double{side} * from.normal + static_cast<double>(alongU) * from.u +
                            static_cast<double>(alongV) * from.v;
    int axis = 0;
    while (std::abs(cube[axis]) != side) ++axis;
    const Face owner = static_cast<Face>(2 * axis + (cube[axis] < 0 ? 1 : 0));
    const FaceAxes& to = faceAxes(owner);
    const auto gridAlong = [&](const glm::dvec3& direction) {
        return (static_cast<std::int32_t>(glm::dot(cube, direction)) + side) / 2;
    };
    return {owner, gridAlong(to.u), gridAlong(to.v)};
}

glm::vec3 vertexFromEyeM(const VertexFrame& frame, Face anyFace, std::int32_t anyGridU, std::int32_t anyGridV,
                         std::int32_t step, float skirtDropM) {
    const auto [face, gridU, gridV] = onOwningFace({anyFace, anyGridU, anyGridV});
    const FaceReference& reference = frame.faces[static_cast<std::size_t>(face)];
    const float u0 = reference.u0;
    const float v0 = reference.v0;
    const float du = static_cast<float>(gridU - reference.gridU) * fineCell;
    const float dv = static_cast<float>(gridV - reference.gridV) * fineCell;
    const float u = u0 + du;
    const float v = v0 + dv;
    const float a = du * (u0 + u);  // u^2 - u0^2
    const float b = dv * (v0 + v);  // v^2 - v0^2

    const float underRoot = a * (v * v * (1.0f / 3) - 0.5f) + b * (u0 * u0 * (1.0f / 3) - 0.5f);
    const glm::vec3 roots0 = reference.roots;
    const glm::vec3 roots(std::sqrt(roots0.x * roots0.x + underRoot), std::sqrt(0.5f - v * v * (1.0f / 6)),
                          std::sqrt(0.5f - u * u * (1.0f / 6)));
    const float alongNormal = underRoot / (roots.x + roots0.x);
    const float alongU = du * roots.y - u0 * (b * (1.0f / 6)) / (roots.y + roots0.y);
    const float alongV = dv * roots.z - v0 * (a * (1.0f / 6)) / (roots.z + roots0.z);

    const FaceAxes& axes = faceAxes(face);
    const glm::vec3 turn = alongNormal * glm::vec3(axes.normal) + alongU * glm::vec3(axes.u) +
                           alongV * glm::vec3(axes.v);  // d - d0
    const float rise = static_cast<float>(step - frame.referenceStep) * frame.quantumM - skirtDropM;
    return reference.originM + (frame.referenceRadiusM + rise) * turn + rise * reference.direction;
}

}  // namespace planet
