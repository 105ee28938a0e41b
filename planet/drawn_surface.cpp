#include "planet/drawn_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

namespace planet {

namespace {

std::optional<Edge> edgeOf(glm::ivec2 vertex, int last) {
    if (vertex.x == 0) return Edge::West;
    if (vertex.x == last) return Edge::East;
    if (vertex.y == 0) return Edge::South;
    if (vertex.y == last) return Edge::North;
    return std::nullopt;
}

VertexSlide slideOf(const DrawItem& item, glm::ivec2 vertex, int last, bool stitched) {
    const std::optional<Edge> edge = edgeOf(vertex, last);
    if (!edge) return {vertex, {vertex.x & 1, vertex.y & 1}, item.morph};
    const auto index = static_cast<std::size_t>(*edge);
    const bool upright = *edge == Edge::West || *edge == Edge::East;
    const glm::ivec2 along = upright ? glm::ivec2(0, 1) : glm::ivec2(1, 0);
    const int coarser = stitched ? item.coarserBy[index] : 0;
    const int here = upright ? vertex.y : vertex.x;
    const int at = (here + ((1 << coarser) >> 1)) >> coarser;
    return {vertex + along * ((at << coarser) - here), along * ((at & 1) << coarser), item.edgeMorph[index]};
}

glm::dvec3 ownPositionM(const PlanetShape& shape, const ChunkId& id, std::span<const std::int16_t> heights,
                        glm::ivec2 vertex) {
    const int cells = chunkCells(shape);
    const FaceSquare square = faceSquareOf(id);
    const double u = square.u + square.side * vertex.x / cells;
    const double v = square.v + square.side * vertex.y / cells;
    const auto index = static_cast<std::size_t>(vertex.y * (cells + 1) + vertex.x);
    return positionM(shape, sphereFromCube(cubePoint(id.face, u, v)), heightM(shape, heights[index]));
}

template <class OwnPosition>
DrawnVertex slid(const VertexSlide& slide, const OwnPosition& own) {
    const glm::dvec3 here = own(slide.vertex);
    if (slide.amount == 0 || slide.aside == glm::ivec2(0, 0)) return {slide.vertex, here};
    const glm::dvec3 middle = 0.5 * (own(slide.vertex - slide.aside) + own(slide.vertex + slide.aside));
    return {slide.vertex, glm::mix(here, middle, slide.amount)};
}

struct Triangle {
    std::array<std::size_t, 3> vertices;
};

// The two triangles of a cell, its diagonal from south-west to north-east.
std::array<Triangle, 2> trianglesOf(int column, int row, int cells) {
    const auto southWest = static_cast<std::size_t>(row * (cells + 1) + column);
    const std::size_t northWest = southWest + static_cast<std::size_t>(cells + 1);
    return {{{{southWest, southWest + 1, northWest + 1}}, {{southWest, northWest + 1, northWest}}}};
}

// The point of a triangle over a place, or nothing where the triangle does not cover it.
std::optional<glm::dvec3> pointOnTriangle(const DrawnGrid& grid, const Triangle& triangle, glm::dvec2 place) {
    const std::array<std::size_t, 3>& vertex = triangle.vertices;
    const glm::dvec2 a(grid.place[vertex[0]]);
    const glm::dvec2 ab = glm::dvec2(grid.place[vertex[1]]) - a;
    const glm::dvec2 ac = glm::dvec2(grid.place[vertex[2]]) - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area <= 0) return std::nullopt;  // stitching has drawn it to a line
    const glm::dvec2 at = place - a;
    const double b = (at.x * ac.y - at.y * ac.x) / area;
    const double c = (ab.x * at.y - ab.y * at.x) / area;
    constexpr double rounding = 1e-12;
    if (b < -rounding || c < -rounding || b + c > 1 + rounding) return std::nullopt;
    return (1 - b - c) * grid.positionM[vertex[0]] + b * grid.positionM[vertex[1]] +
           c * grid.positionM[vertex[2]];
}

std::optional<glm::dvec3> pointInCell(const DrawnGrid& grid, int column, int row, glm::dvec2 place) {
    for (const Triangle& triangle : trianglesOf(column, row, grid.cells)) {
        if (const std::optional<glm::dvec3> point = pointOnTriangle(grid, triangle, place)) return point;
    }
    return std::nullopt;
}

// Along a stitched edge the triangle over a place may belong to a cell further along: no vertex has moved
// more than a quarter of the edge.
std::optional<glm::dvec3> pointInRing(const DrawnGrid& grid, int column, int row, glm::dvec2 place) {
    const int last = grid.cells - 1;
    const bool besideWestOrEast = column == 0 || column == last;
    const bool besideSouthOrNorth = row == 0 || row == last;
    for (int away = 0; away <= grid.cells / 4; ++away) {
        for (const int step : {-away, away}) {
            const int otherRow = row + step;
            const int otherColumn = column + step;
            if (besideWestOrEast && otherRow >= 0 && otherRow <= last) {
                if (const auto point = pointInCell(grid, column, otherRow, place)) return point;
            }
            if (besideSouthOrNorth && otherColumn >= 0 && otherColumn <= last) {
                if (const auto point = pointInCell(grid, otherColumn, row, place)) return point;
            }
        }
    }
    return std::nullopt;
}

}  // namespace

VertexSlide vertexSlide(const PlanetShape& shape, const DrawItem& item, bool stitched, int column, int row) {
    return slideOf(item, {column, row}, chunkCells(shape), stitched);
}

DrawnVertex drawnVertex(const PlanetShape& shape, const DrawItem& item, std::span<const std::int16_t> heights,
                        bool stitched, int column, int row) {
    return slid(slideOf(item, {column, row}, chunkCells(shape), stitched),
                [&](glm::ivec2 vertex) { return ownPositionM(shape, item.id, heights, vertex); });
}

DrawnGrid drawnGrid(const PlanetShape& shape, const DrawItem& item, std::span<const std::int16_t> heights,
                    bool stitched) {
    const int cells = chunkCells(shape);
    const auto size = static_cast<std::size_t>(cells + 1);
    assert(heights.size() == size * size);
    std::vector<glm::dvec3> own(size * size);
    for (std::size_t i = 0; i < own.size(); ++i) {
        own[i] =
            ownPositionM(shape, item.id, heights, {static_cast<int>(i % size), static_cast<int>(i / size)});
    }
    DrawnGrid grid{item.id, cells, {}, {}, false};
    grid.positionM.reserve(own.size());
    grid.place.reserve(own.size());
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const DrawnVertex vertex =
                slid(slideOf(item, {column, row}, cells, stitched), [&](glm::ivec2 at) {
                    return own[static_cast<std::size_t>(at.y) * size + static_cast<std::size_t>(at.x)];
                });
            grid.positionM.push_back(vertex.positionM);
            grid.place.push_back(vertex.place);
            grid.stitched = grid.stitched || vertex.place != glm::ivec2(column, row);
        }
    }
    return grid;
}

glm::dvec3 pointOn(const DrawnGrid& grid, double x, double y) {
    assert(x >= 0 && y >= 0 && x <= grid.cells && y <= grid.cells);
    const int column = std::min(static_cast<int>(x), grid.cells - 1);
    const int row = std::min(static_cast<int>(y), grid.cells - 1);
    const int last = grid.cells - 1;
    const bool inRing = column == 0 || row == 0 || column == last || row == last;
    const std::optional<glm::dvec3> point = grid.stitched && inRing ? pointInRing(grid, column, row, {x, y})
                                                                    : pointInCell(grid, column, row, {x, y});
    assert(point);
    return *point;
}

}  // namespace planet
