#include "planet/select/drawn_surface.h"

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

// Returns the multiple of four next to an odd vertex.
int gatherPoint(int vertex) {
    return (vertex & 3) == 1 ? vertex - 1 : vertex + 1;
}

// Returns the share of the way that an edge's odd vertices have moved.
double gatheredAt(float edgeMorph) {
    return std::max(4 * static_cast<double>(edgeMorph) - 3, 0.0);
}

void add(VertexBlend& blend, glm::ivec2 vertex, double share) {
    if (share > 0) blend.parts[blend.count++] = {vertex, share};
}

// Adds both ends of the segment across a vertex. They are equally far away and added first, so that sums are
// bit-identical in either order: neighbours may count an edge in opposite directions.
void addBetween(VertexBlend& blend, glm::ivec2 vertex, glm::ivec2 aside, double amount, double share) {
    add(blend, vertex - aside, 0.5 * amount * share);
    add(blend, vertex + aside, 0.5 * amount * share);
    add(blend, vertex, (1 - amount) * share);
}

void addOnEdge(VertexBlend& blend, const DrawItem& item, Edge edge, glm::ivec2 vertex, int last,
               bool stitched, double share) {
    const auto index = static_cast<std::size_t>(edge);
    const bool upright = edge == Edge::West || edge == Edge::East;
    const glm::ivec2 along = upright ? glm::ivec2(0, 1) : glm::ivec2(1, 0);
    const int levels = stitched ? item.coarserBy[index] : 0;
    const int here = upright ? vertex.y : vertex.x;
    const int start = static_cast<int>(upright ? item.id.y : item.id.x) * last;
    int at = start + here;
    for (int level = 0; level < levels; ++level) {
        if (((at >> level) & 1) != 0) at = gatherPoint(at >> level) << level;
    }
    const glm::ivec2 gathered = vertex + along * (at - start - here);
    const int coarse = at >> levels;
    if ((coarse & 1) == 0) return add(blend, gathered, share);
    const double onItsWay = stitched ? gatheredAt(item.edgeMorph[index]) : 0;
    addBetween(blend, gathered, along << levels, item.edgeMorph[index], (1 - onItsWay) * share);
    add(blend, gathered + along * ((gatherPoint(coarse) << levels) - at), onItsWay * share);
}

VertexBlend blendOf(const DrawItem& item, glm::ivec2 vertex, int last, bool stitched) {
    VertexBlend blend;
    const auto addDrawn = [&](glm::ivec2 at, double share) {
        if (const std::optional<Edge> edge = edgeOf(at, last))
            addOnEdge(blend, item, *edge, at, last, stitched, share);
        else
            add(blend, at, share);
    };
    const glm::ivec2 aside{vertex.x & 1, vertex.y & 1};
    if (item.morph == 0 || aside == glm::ivec2(0, 0) || edgeOf(vertex, last)) {
        addDrawn(vertex, 1);
        return blend;
    }
    const auto morph = static_cast<double>(item.morph);
    add(blend, vertex, 1 - morph);
    addDrawn(vertex - aside, 0.5 * morph);
    addDrawn(vertex + aside, 0.5 * morph);
    return blend;
}

glm::dvec3 ownPositionM(const PlanetShape& shape, const ChunkId& id, StepsView heights, glm::ivec2 vertex) {
    const int cells = chunkCells(shape);
    const FaceSquare square = faceSquareOf(id);
    const double u = square.u + square.side * vertex.x / cells;
    const double v = square.v + square.side * vertex.y / cells;
    const auto index = static_cast<std::size_t>(vertex.y * (cells + 1) + vertex.x);
    return positionM(shape, sphereFromCube(cubePoint(id.face, u, v)), heightM(shape, heights[index]));
}

template <class OwnPosition>
DrawnVertex blended(glm::ivec2 itself, const VertexBlend& blend, const OwnPosition& own) {
    DrawnVertex drawn{itself, {0, 0, 0}};
    for (std::size_t i = 0; i < blend.count; ++i) {
        const auto& [vertex, share] = blend.parts[i];
        drawn.place += share * glm::dvec2(vertex - itself);  // exactly 0 between equally distant ends
        drawn.positionM += share * own(vertex);
    }
    return drawn;
}

// Returns the point of a triangle at a place; nothing if the triangle does not cover it.
std::optional<glm::dvec3> pointOnTriangle(const DrawnGrid& grid, const CellTriangle& triangle,
                                          glm::dvec2 place) {
    const std::array<std::size_t, 3>& vertex = triangle.vertices;
    const glm::dvec2 a = grid.place[vertex[0]];
    const glm::dvec2 ab = grid.place[vertex[1]] - a;
    const glm::dvec2 ac = grid.place[vertex[2]] - a;
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area <= 0) return std::nullopt;  // stitching has collapsed it to a line
    const glm::dvec2 at = place - a;
    const double b = (at.x * ac.y - at.y * ac.x) / area;
    const double c = (ab.x * at.y - ab.y * at.x) / area;
    constexpr double rounding = 1e-12;
    if (b < -rounding || c < -rounding || b + c > 1 + rounding) return std::nullopt;
    return (1 - b - c) * grid.positionM[vertex[0]] + b * grid.positionM[vertex[1]] +
           c * grid.positionM[vertex[2]];
}

std::optional<glm::dvec3> pointInCell(const DrawnGrid& grid, int column, int row, glm::dvec2 place) {
    for (const CellTriangle& triangle : cellTriangles(column, row, grid.cells)) {
        if (const std::optional<glm::dvec3> point = pointOnTriangle(grid, triangle, place)) return point;
    }
    return std::nullopt;
}

bool isInRing(int cell, int last) {
    return cell < stitchedRingCells || cell > last - stitchedRingCells;
}

std::optional<glm::dvec3> pointInStrip(const DrawnGrid& grid, bool upright, int across, int along,
                                       glm::dvec2 place) {
    const int last = grid.cells - 1;
    const int first = across < stitchedRingCells ? 0 : last - stitchedRingCells + 1;
    for (int away = 0; away < grid.cells; ++away) {
        for (const int at : {along - away, along + away}) {
            if (at < 0 || at > last) continue;
            for (int i = first; i < first + stitchedRingCells; ++i) {
                const auto point =
                    upright ? pointInCell(grid, i, at, place) : pointInCell(grid, at, i, place);
                if (point) return point;
            }
        }
    }
    return std::nullopt;
}

std::optional<glm::dvec3> pointInRing(const DrawnGrid& grid, int column, int row, glm::dvec2 place) {
    const int last = grid.cells - 1;
    if (const auto point = pointInCell(grid, column, row, place)) return point;
    if (isInRing(column, last)) {
        if (const auto point = pointInStrip(grid, true, column, row, place)) return point;
    }
    if (!isInRing(row, last)) return std::nullopt;
    return pointInStrip(grid, false, row, column, place);
}

}  // namespace

VertexBlend vertexBlend(const PlanetShape& shape, const DrawItem& item, bool stitched, int column, int row) {
    return blendOf(item, {column, row}, chunkCells(shape), stitched);
}

DrawnVertex drawnVertex(const PlanetShape& shape, const DrawItem& item, StepsView heights, bool stitched,
                        int column, int row) {
    return blended({column, row}, blendOf(item, {column, row}, chunkCells(shape), stitched),
                   [&](glm::ivec2 vertex) { return ownPositionM(shape, item.id, heights, vertex); });
}

bool gathersVertices(const DrawItem& item, Edge edge) {
    const auto index = static_cast<std::size_t>(edge);
    return item.coarserBy[index] > 0 || gatheredAt(item.edgeMorph[index]) > 0;
}

DrawnGrid drawnGrid(const PlanetShape& shape, const DrawItem& item, StepsView heights, bool stitched) {
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
                blended({column, row}, blendOf(item, {column, row}, cells, stitched), [&](glm::ivec2 at) {
                    return own[static_cast<std::size_t>(at.y) * size + static_cast<std::size_t>(at.x)];
                });
            grid.positionM.push_back(vertex.positionM);
            grid.place.push_back(vertex.place);
            grid.stitched = grid.stitched || vertex.place != glm::dvec2(column, row);
        }
    }
    return grid;
}

std::array<CellTriangle, 2> cellTriangles(int column, int row, int cells) {
    const auto southWest = static_cast<std::size_t>(row * (cells + 1) + column);
    const std::size_t northWest = southWest + static_cast<std::size_t>(cells + 1);
    return {{{{southWest, southWest + 1, northWest + 1}}, {{southWest, northWest + 1, northWest}}}};
}

glm::dvec3 pointOn(const DrawnGrid& grid, double x, double y) {
    assert(x >= 0 && y >= 0 && x <= grid.cells && y <= grid.cells);
    const int column = std::min(static_cast<int>(x), grid.cells - 1);
    const int row = std::min(static_cast<int>(y), grid.cells - 1);
    const int last = grid.cells - 1;
    const bool inRing = isInRing(column, last) || isInRing(row, last);
    const std::optional<glm::dvec3> point = grid.stitched && inRing ? pointInRing(grid, column, row, {x, y})
                                                                    : pointInCell(grid, column, row, {x, y});
    assert(point);
    return *point;
}

}  // namespace planet
