#include "planet/measure/pick.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

namespace planet {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A ray with two axes perpendicular to it: across, up and along form a right-handed orthonormal frame.
struct Ray {
    glm::dvec3 eyeM;
    glm::dvec3 along;
    glm::dvec3 across;
    glm::dvec3 up;
};

Ray makeRay(const glm::dvec3& eyeM, const glm::dvec3& direction) {
    const glm::dvec3 along = glm::normalize(direction);
    const glm::dvec3 size = glm::abs(along);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    const glm::dvec3 across = glm::normalize(glm::cross(other, along));
    return {eyeM, along, across, glm::cross(along, across)};
}

// Converts a point to the ray's axes.
glm::dvec3 fromRay(const Ray& ray, const glm::dvec3& pointM) {
    const glm::dvec3 offset = pointM - ray.eyeM;
    return {glm::dot(offset, ray.across), glm::dot(offset, ray.up), glm::dot(offset, ray.along)};
}

// Returns the distance at which the ray enters a box; 0 if it starts inside, infinity if it misses.
double entryM(const OrientedBox& box, const Ray& ray) {
    const glm::dvec3 offset = box.centreM - ray.eyeM;
    double entry = 0;
    double exit = infinity;
    for (int a = 0; a < 3; ++a) {
        const glm::dvec3& axis = box.axes[static_cast<std::size_t>(a)];
        const double centre = glm::dot(axis, offset);
        const double speed = glm::dot(axis, ray.along);
        const double half = box.halfSizeM[a];
        if (speed == 0) {
            if (std::abs(centre) > half) return infinity;
            continue;
        }
        const double first = (centre - half) / speed;
        const double second = (centre + half) / speed;
        entry = std::max(entry, std::min(first, second));
        exit = std::min(exit, std::max(first, second));
    }
    return entry <= exit ? entry : infinity;
}

// Returns twice the area of the triangle of the ray and an edge, positive if the ray lies to the edge's left.
// The reversed edge gives exactly the negative, so no ray passes between two triangles.
double sideOf(const glm::dvec3& from, const glm::dvec3& to) {
    return from.x * to.y - from.y * to.x;
}

// Returns the distance along the ray to a triangle in the ray's axes, or infinity. Hits front faces only:
// their corners run counter-clockwise as seen from the front, and clockwise here, since the ray looks along
// +z.
double triangleM(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double overA = sideOf(c, b);
    const double overB = sideOf(a, c);
    const double overC = sideOf(b, a);
    if (overA < 0 || overB < 0 || overC < 0) return infinity;
    const double sum = overA + overB + overC;
    if (sum == 0) return infinity;  // edge-on
    const double alongM = (overA * a.z + overB * b.z + overC * c.z) / sum;
    return alongM >= 0 ? alongM : infinity;
}

// The bounding box of points across the ray.
struct Extent {
    glm::dvec2 low{infinity, infinity};
    glm::dvec2 high{-infinity, -infinity};

    void add(const glm::dvec3& point) {
        low = glm::min(low, glm::dvec2(point));
        high = glm::max(high, glm::dvec2(point));
    }
    bool holdsRay(double margin) const {
        return low.x <= margin && low.y <= margin && high.x >= -margin && high.y >= -margin;
    }
};

// The cells per side of the tiles that a chunk is searched in; most tiles can be skipped.
constexpr int pickCells = 8;
constexpr int pickSide = pickCells + 1;

// A chunk's grid, and the tile in it whose first cell is (column, row).
struct PickTile {
    const PlanetShape& shape;
    const ChunkNode& node;
    FaceSquare square;
    int column;
    int row;

    std::int32_t step(int i, int j) const {
        return (*node.heights)[static_cast<std::size_t>(j * chunkSize(shape) + i)];
    }
    glm::dvec3 direction(int i, int j) const {
        const double cells = chunkCells(shape);
        return sphereFromCube(
            cubePoint(node.id.face, square.u + square.side * i / cells, square.v + square.side * j / cells));
    }
};

// Returns whether the ray may meet one of the tile's triangles. Every direction in a square of side s lies
// within 3 s^2 / 8 of the bilinear hull of its corners' directions (bounds.cpp).
bool mayBeHit(const PickTile& tile, const Ray& ray) {
    std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
    std::int32_t highest = std::numeric_limits<std::int32_t>::min();
    for (int j = tile.row; j <= tile.row + pickCells; ++j) {
        for (int i = tile.column; i <= tile.column + pickCells; ++i) {
            lowest = std::min(lowest, tile.step(i, j));
            highest = std::max(highest, tile.step(i, j));
        }
    }
    Extent extent;
    for (const int j : {tile.row, tile.row + pickCells}) {
        for (const int i : {tile.column, tile.column + pickCells}) {
            const glm::dvec3 direction = tile.direction(i, j);
            for (const std::int32_t step : {lowest, highest}) {
                extent.add(fromRay(ray, positionM(tile.shape, direction, heightM(tile.shape, step))));
            }
        }
    }
    const double side = tile.square.side * pickCells / chunkCells(tile.shape);
    const double highestM = tile.shape.radiusM + heightM(tile.shape, highest);
    return extent.holdsRay((3 * side * side / 8 + 1e-14) * highestM);
}

double nearestInTile(const PickTile& tile, const Ray& ray) {
    std::array<glm::dvec3, pickSide * pickSide> vertices;
    for (int j = 0; j < pickSide; ++j) {
        for (int i = 0; i < pickSide; ++i) {
            const int column = tile.column + i;
            const int row = tile.row + j;
            const double height = heightM(tile.shape, tile.step(column, row));
            vertices[static_cast<std::size_t>(j * pickSide + i)] =
                fromRay(ray, positionM(tile.shape, tile.direction(column, row), height));
        }
    }
    double nearest = infinity;
    for (std::size_t j = 0; j < pickCells; ++j) {
        for (std::size_t i = 0; i < pickCells; ++i) {
            const glm::dvec3* const southWest = &vertices[j * pickSide + i];
            const glm::dvec3* const northEast = southWest + pickSide + 1;
            nearest = std::min({nearest, triangleM(*southWest, southWest[1], *northEast),
                                triangleM(*southWest, *northEast, southWest[pickSide])});
        }
    }
    return nearest;
}

double nearestInChunk(const PlanetShape& shape, const ChunkNode& node, const Ray& ray) {
    double nearest = infinity;
    PickTile tile{shape, node, faceSquareOf(node.id), 0, 0};
    for (tile.row = 0; tile.row < chunkCells(shape); tile.row += pickCells) {
        for (tile.column = 0; tile.column < chunkCells(shape); tile.column += pickCells) {
            if (mayBeHit(tile, ray)) nearest = std::min(nearest, nearestInTile(tile, ray));
        }
    }
    return nearest;
}

// A chunk whose box the ray meets.
struct Candidate {
    double entryM;
    NodeIndex node;
};

}  // namespace

std::optional<SurfaceHit> pickSurface(const ChunkTree& tree, std::span<const DrawItem> items,
                                      const glm::dvec3& eyeM, const glm::dvec3& direction) {
    assert(glm::length(direction) > 0);
    const Ray ray = makeRay(eyeM, direction);
    std::vector<Candidate> candidates;
    for (const DrawItem& item : items) {
        const double entry = entryM(tree.nodes[item.node].bounds.box, ray);
        if (entry < infinity) candidates.push_back({entry, item.node});
    }
    // The nearest chunks come first, so that chunks behind the hit are not searched.
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.entryM < b.entryM; });
    SurfaceHit hit;
    hit.distanceM = infinity;
    for (const Candidate& candidate : candidates) {
        if (candidate.entryM > hit.distanceM) break;
        const double distanceM = nearestInChunk(tree.shape, tree.nodes[candidate.node], ray);
        if (distanceM >= hit.distanceM) continue;
        hit.node = candidate.node;
        hit.id = tree.nodes[candidate.node].id;
        hit.distanceM = distanceM;
    }
    if (hit.node == noNode) return std::nullopt;
    hit.positionM = ray.eyeM + hit.distanceM * ray.along;
    return hit;
}

}  // namespace planet
