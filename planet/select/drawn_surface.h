// The drawn surface of a chunk, in doubles. Mirrors the vertex shader, with morph and stitched edges, without
// skirts. Meters compare it with the finest data.
//
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/select/lod_types.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"

namespace planet {

struct DrawnGrid {
    ChunkId id;
    int cells = 0;                      // along a side
    std::vector<glm::dvec3> positionM;  // (cells + 1)^2, rows from the south; metres from the planet's centre
    // The place of each vertex on the chunk, in cells from its west and south edges: its own column and row,
    // or a place further along a stitched edge.
    std::vector<glm::dvec2> place;
    bool stitched = false;  // some vertices are not at their own places
};

// Computes the drawn vertices. heights: the chunk's (cells + 1)^2 steps. stitched: RenderSettings::stitched.
DrawnGrid drawnGrid(const PlanetShape& shape, const DrawItem& item, StepsView heights, bool stitched);

// The two triangles of a cell, its diagonal from south-west to north-east.
struct CellTriangle {
    std::array<std::size_t, 3> vertices;  // indices of DrawnGrid::positionM, counterclockwise from outside
};
std::array<CellTriangle, 2> cellTriangles(int column, int row, int cells);

// Returns the drawn point at (x, y) cells from the chunk's west and south edges, both in [0, cells], metres
// from the planet's centre. It lies on the triangle that covers the place.
glm::dvec3 pointOn(const DrawnGrid& grid, double x, double y);

// The slide of a vertex onto a coarser surface, as in the vertex shader: the shares, > 0, of the chunk's
// vertices. Their sum is 1.
//
// A vertex that its parent lacks slides to the middle between the two vertices of the parent on either side
// of it, at the places where the parent would draw them.
//
// Stitched edges gather vertices along them: level by level, each odd vertex, counted along the face's edge,
// joins its neighbour that is a multiple of four. Next to a coarser chunk, the vertices that the coarser
// chunk lacks are always gathered. On any edge, the odd ones of the remaining vertices move while the morph
// exceeds 3/4, and arrive at 1. The outermost triangles are then the same as next to a coarser chunk, so a
// switch does not change them. This order makes the vertices of the next level join those gathered before.
struct VertexBlend {
    struct Part {
        glm::ivec2 vertex{0, 0};
        double share = 0;
    };
    std::array<Part, 9> parts{};
    std::size_t count = 0;
};
VertexBlend vertexBlend(const PlanetShape& shape, const DrawItem& item, bool stitched, int column, int row);

// A vertex and its share.
struct DrawnVertex {
    glm::dvec2 place{0, 0};
    glm::dvec3 positionM{0, 0, 0};
};
DrawnVertex drawnVertex(const PlanetShape& shape, const DrawItem& item, StepsView heights, bool stitched,
                        int column, int row);

// The number of outer rows of cells that stitching changes. It moves the vertices on and near a stitched edge
// along the edge, so the triangle at a place there may belong to a cell further along.
inline constexpr int stitchedRingCells = 2;

// Returns whether stitching moves vertices of an edge.
bool gathersVertices(const DrawItem& item, Edge edge);

}  // namespace planet
