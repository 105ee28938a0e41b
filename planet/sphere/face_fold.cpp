#include "planet/sphere/face_fold.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>

namespace planet {

Face faceAlong(const glm::dvec3& normal) {
    for (const Face face : allFaces) {
        if (faceAxes(face).normal == normal) return face;
    }
    assert(false);
    return Face::PosX;
}

FaceGridPoint foldedOver(const FaceGridPoint& point, int cells) {
    const FaceAxes& axes = faceAxes(point.face);
    const int u = 2 * point.column - cells;  // the cube is [-cells, cells]^3 here
    const int v = 2 * point.row - cells;
    const int overU = std::abs(u) - cells;
    const int over = std::min(std::max(overU, std::abs(v) - cells), 2 * cells);
    if (over <= 0) return point;
    const glm::dvec3 outward = overU > 0 ? std::copysign(1.0, u) * axes.u : std::copysign(1.0, v) * axes.v;
    const glm::dvec3 along = overU > 0 ? double(v) * axes.v : double(u) * axes.u;
    const glm::dvec3 folded = double(cells) * outward + along + double(cells - over) * axes.normal;
    const Face next = faceAlong(outward);
    const FaceAxes& nextAxes = faceAxes(next);
    return {next, (static_cast<int>(glm::dot(folded, nextAxes.u)) + cells) / 2,
            (static_cast<int>(glm::dot(folded, nextAxes.v)) + cells) / 2};
}

FaceGridPoint placeOnFace(Face face, const FaceGridPoint& point, int cells) {
    const FaceAxes& from = faceAxes(point.face);
    const glm::dvec3 cube = double(cells) * from.normal + double(2 * point.column - cells) * from.u +
                            double(2 * point.row - cells) * from.v;
    const FaceAxes& axes = faceAxes(face);
    assert(glm::dot(cube, axes.normal) == cells);
    return {face, (static_cast<int>(glm::dot(cube, axes.u)) + cells) / 2,
            (static_cast<int>(glm::dot(cube, axes.v)) + cells) / 2};
}

}  // namespace planet
