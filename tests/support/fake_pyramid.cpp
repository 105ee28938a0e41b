#include "tests/support/fake_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace planet {

namespace {

// Plains and mountains: heights from about -2% to 4% of the radius.
double fakeHeightM(const PlanetShape& shape, const glm::dvec3& d) {
    const double wide = std::sin(3 * d.x + 1) * std::cos(4 * d.y - 2 * d.z);
    const double rough = std::max(0.0, wide) * std::sin(37 * d.x + 11 * d.z) * std::sin(41 * d.y - 5 * d.x);
    return shape.radiusM * (0.015 * wide + 0.025 * rough);
}

// The (faceCells + 1)^2 finest samples of a face, and chunks cut from it.
struct FaceGrid {
    Face face;
    int cells;
    std::vector<std::int16_t> steps;
    std::vector<glm::dvec3> positionsM;

    std::size_t at(int i, int j) const { return static_cast<std::size_t>(j * (cells + 1) + i); }
};

FaceGrid makeFaceGrid(const PlanetShape& shape, Face face) {
    FaceGrid grid{face, faceCells(shape), {}, {}};
    for (int j = 0; j <= grid.cells; ++j) {
        for (int i = 0; i <= grid.cells; ++i) {
            const glm::dvec3 direction =
                sphereFromCube(cubePoint(face, 2.0 * i / grid.cells - 1, 2.0 * j / grid.cells - 1));
            const double steps = (fakeHeightM(shape, direction) - shape.baseHeightM) / shape.quantumM;
            grid.steps.push_back(static_cast<std::int16_t>(std::lround(steps)));
            grid.positionsM.push_back(positionM(shape, direction, heightM(shape, grid.steps.back())));
        }
    }
    return grid;
}

// The largest distance from a vertex of the children to the middle of the edge or diagonal it refines.
double ownErrorM(const FaceGrid& grid, int firstColumn, int firstRow, int cells, int stride) {
    const int half = stride / 2;
    double most = 0;
    for (int j = 0; j <= 2 * cells; ++j) {
        for (int i = 0; i <= 2 * cells; ++i) {
            const int di = i % 2 * half;
            const int dj = j % 2 * half;
            if (di == 0 && dj == 0) continue;
            const int column = firstColumn + i * half;
            const int row = firstRow + j * half;
            const glm::dvec3 middle = (grid.positionsM[grid.at(column - di, row - dj)] +
                                       grid.positionsM[grid.at(column + di, row + dj)]) /
                                      2.0;
            most = std::max(most, glm::length(middle - grid.positionsM[grid.at(column, row)]));
        }
    }
    return most;
}

// The largest distance from a finest sample under a chunk to the point of its own triangles there.
double finestDistanceM(const FaceGrid& grid, int firstColumn, int firstRow, int cells, int stride) {
    double most = 0;
    for (int j = 0; j <= cells * stride; ++j) {
        for (int i = 0; i <= cells * stride; ++i) {
            const int column = firstColumn + std::min(i / stride, cells - 1) * stride;
            const int row = firstRow + std::min(j / stride, cells - 1) * stride;
            const double s = static_cast<double>(firstColumn + i - column) / stride;
            const double t = static_cast<double>(firstRow + j - row) / stride;
            const glm::dvec3 southWest = grid.positionsM[grid.at(column, row)];
            const glm::dvec3 northEast = grid.positionsM[grid.at(column + stride, row + stride)];
            const glm::dvec3 corner = s >= t ? grid.positionsM[grid.at(column + stride, row)]
                                             : grid.positionsM[grid.at(column, row + stride)];
            const glm::dvec3 drawn =
                (1 - std::max(s, t)) * southWest + std::abs(s - t) * corner + std::min(s, t) * northEast;
            most =
                std::max(most, glm::length(drawn - grid.positionsM[grid.at(firstColumn + i, firstRow + j)]));
        }
    }
    return most;
}

ChunkData cutChunk(const PlanetShape& shape, const FaceGrid& grid, const ChunkId& id) {
    const int cells = chunkCells(shape);
    const int stride = 1 << (deepestLevelOf(shape) - id.level);
    const int firstColumn = static_cast<int>(id.x) * cells * stride;
    const int firstRow = static_cast<int>(id.y) * cells * stride;
    ChunkData data;
    data.id = id;
    std::vector<std::int16_t> steps;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            steps.push_back(grid.steps[grid.at(firstColumn + i * stride, firstRow + j * stride)]);
        }
    }
    data.heights = steps;
    std::tie(data.minStep, data.maxStep) = lowestAndHighest(data.heights);
    if (stride > 1) {
        data.deltaCM = static_cast<float>(ownErrorM(grid, firstColumn, firstRow, cells, stride));
        data.deltaTightM = static_cast<float>(finestDistanceM(grid, firstColumn, firstRow, cells, stride));
        data.children = {keyOf(id) + 1, 100};
    }
    return data;
}

void addChunk(FakePyramid& pyramid, const FaceGrid& grid, const ChunkId& id) {
    ChunkData data = cutChunk(pyramid.shape, grid, id);
    float below = 0;
    float tightBelow = 0;
    for (int q = 0; q < quadrantCount && data.children.exists(); ++q) {
        const ChunkId childId = childOf(id, q);
        addChunk(pyramid, grid, childId);
        const ChunkData& child = pyramid.at(childId);
        data.minStep = std::min(data.minStep, child.minStep);
        data.maxStep = std::max(data.maxStep, child.maxStep);
        below = std::max(below, child.deltaCM);
        tightBelow = std::max(tightBelow, child.deltaTightM);
    }
    data.deltaCM += below;
    data.deltaTightM = std::min(std::max(data.deltaTightM, tightBelow), data.deltaCM);
    pyramid.minStep = std::min(pyramid.minStep, data.minStep);
    pyramid.maxStep = std::max(pyramid.maxStep, data.maxStep);
    pyramid.chunks.emplace(id, std::move(data));
}

}  // namespace

FakePyramid makeFakePyramid(int leafLevelWanted) {
    FakePyramid pyramid;
    pyramid.shape.radiusM = 1e5;
    pyramid.shape.quantumM = 0.25;
    pyramid.shape.chunkCellsLog2 = 4;
    pyramid.shape.faceCellsLog2 = 4 + leafLevelWanted;
    for (const Face face : allFaces) {
        addChunk(pyramid, makeFaceGrid(pyramid.shape, face), {face, 0, 0, 0});
    }
    return pyramid;
}

}  // namespace planet
