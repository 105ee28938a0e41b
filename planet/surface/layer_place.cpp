#include "planet/surface/layer_place.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include "planet/sphere/chunk_surface.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

namespace {

struct Grid {
    const PlanetShape& shape;
    ChunkId id;
    StepsView heights;
    int cells = 0;
    FaceSquare square{};

    double stepAt(int x, int y) const { return heights[static_cast<std::size_t>(y * (cells + 1) + x)]; }
    glm::dvec3 direction(double x, double y) const {
        return sphereFromCube(
            cubePoint(id.face, square.u + square.side * x / cells, square.v + square.side * y / cells));
    }
};

// Returns the slope in steps per cell: a central difference, or a second-order one-sided one at the last
// vertex.
template <class At>
double slopeAlong(int at, int last, const At& stepAt) {
    if (at == 0) return (4 * stepAt(1) - 3 * stepAt(0) - stepAt(2)) / 2;
    if (at == last) return (3 * stepAt(last) - 4 * stepAt(last - 1) + stepAt(last - 2)) / 2;
    return (stepAt(at + 1) - stepAt(at - 1)) / 2;
}

// Returns the unit normal at a vertex.
glm::dvec3 normalAt(const Grid& grid, int x, int y) {
    const double alongX =
        grid.shape.quantumM * slopeAlong(x, grid.cells, [&](int at) { return grid.stepAt(at, y); });
    const double alongY =
        grid.shape.quantumM * slopeAlong(y, grid.cells, [&](int at) { return grid.stepAt(x, at); });
    const double radiusM =
        grid.shape.radiusM + grid.shape.baseHeightM + grid.stepAt(x, y) * grid.shape.quantumM;
    const glm::dvec3 up = grid.direction(x, y);
    // The mapping is smooth, so a small step to either side gives its derivative to many digits.
    constexpr double step = 1.0 / 64;
    const auto tangent = [&](double byX, double byY, double rise) {
        const glm::dvec3 turn =
            (grid.direction(x + byX, y + byY) - grid.direction(x - byX, y - byY)) / (2 * step);
        return radiusM * turn + rise * up;
    };
    return glm::normalize(glm::cross(tangent(step, 0, alongX), tangent(0, step, alongY)));
}

}  // namespace

LayerPlace layerPlace(const PlanetShape& shape, const ChunkId& id, StepsView heights,
                      const glm::dvec3& positionM, double seaLevelM, double exaggeration) {
    assert(exaggeration > 0 && heights.size() == static_cast<std::size_t>(chunkVertexCount(shape)));
    const Grid grid{shape, id, heights, chunkCells(shape), faceSquareOf(id)};
    const glm::dvec3 cube = cubeFromSphere(positionM);
    const FaceAxes& axes = faceAxes(id.face);
    const double depth = std::max(glm::dot(cube, axes.normal), 1e-9);
    const glm::dvec2 place(glm::dot(cube, axes.u) / depth - grid.square.u,
                           glm::dot(cube, axes.v) / depth - grid.square.v);
    const double last = grid.cells;
    const double x = std::clamp(place.x / grid.square.side * last, 0.0, last);
    const double y = std::clamp(place.y / grid.square.side * last, 0.0, last);
    const int column = std::min(static_cast<int>(x), grid.cells - 1);
    const int row = std::min(static_cast<int>(y), grid.cells - 1);
    const double east = x - column, north = y - row;
    // Each cell's diagonal runs from its south-west to its north-east.
    const glm::dvec3 corner = normalAt(grid, column, row), across = normalAt(grid, column + 1, row + 1);
    const glm::dvec3 normal =
        east >= north
            ? (1 - east) * corner + (east - north) * normalAt(grid, column + 1, row) + north * across
            : (1 - north) * corner + (north - east) * normalAt(grid, column, row + 1) + east * across;
    const glm::dvec3 up = glm::normalize(positionM);
    const double upright = std::max(glm::dot(normal, up), 1e-9);
    const double tangent = glm::length(normal - up * glm::dot(normal, up)) / upright / exaggeration;
    const double drawnM = shape.baseHeightM + shape.quantumM * stepOnTriangles(heights, grid.cells, x, y);
    return {positionM, drawnM / exaggeration - seaLevelM, glm::degrees(std::atan(tangent)),
            glm::degrees(std::atan2(up.z, std::hypot(up.x, up.y)))};
}

}  // namespace planet
