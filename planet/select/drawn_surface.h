// The surface that is drawn of a chunk, in doubles: what the vertex shader makes of its heights, morph and
// stitched edges included, skirts left out. What instruments compare with the truth, and with each other.
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

namespace planet {

struct DrawnGrid {
    ChunkId id;
    int cells = 0;                      // along a side
    std::vector<glm::dvec3> positionM;  // (cells + 1)^2, rows from the south; metres from the planet's centre
    // Where each vertex lies on the chunk, in cells from its west and south edges: its own column and row, or
    // on a stitched edge, further along it.
    std::vector<glm::dvec2> place;
    bool stitched = false;  // whether any vertex lies elsewhere than on its own place
};

// Heights: the chunk's (cells + 1)^2 steps. Stitched: whether it is drawn with RenderSettings::stitched.
DrawnGrid drawnGrid(const PlanetShape& shape, const DrawItem& item, std::span<const std::int16_t> heights,
                    bool stitched);

// The two triangles of a cell, its diagonal from south-west to north-east.
struct CellTriangle {
    std::array<std::size_t, 3>
        vertices;  // their places in DrawnGrid::positionM, counterclockwise from outside
};
std::array<CellTriangle, 2> cellTriangles(int column, int row, int cells);

// The point drawn at (x, y) cells from the chunk's west and south edges, both in [0, cells]: on the triangle
// that covers the place, metres from the planet's centre.
glm::dvec3 pointOn(const DrawnGrid& grid, double x, double y);

// How a vertex slides onto a coarser surface, as the vertex shader has it: what share it is drawn of which of
// the chunk's own vertices; the shares are over 0 and come to 1.
//
// A vertex that its parent lacks slides to the middle between those two of the parent's vertices that it lies
// between, where the parent would draw them.
//
// Where edges are stitched, vertices are gathered along them: level by level each odd one, counted along the
// face's edge, joins its neighbour that is a multiple of four. Beside a coarser chunk those it lacks are
// gathered for good. On any edge the odd ones of those that are left, as both sides count them, are on their
// way while its morph is over 3/4, and there at 1; the outermost triangles are then those that they will be
// beside a coarser chunk, and no switch cuts them anew. The order is such that what is gathered for one level
// more is what was gathered before.
struct VertexBlend {
    struct Part {
        glm::ivec2 vertex{0, 0};
        double share = 0;
    };
    std::array<Part, 9> parts{};
    std::size_t count = 0;
};
VertexBlend vertexBlend(const PlanetShape& shape, const DrawItem& item, bool stitched, int column, int row);

// One vertex of it.
struct DrawnVertex {
    glm::dvec2 place{0, 0};
    glm::dvec3 positionM{0, 0, 0};
};
DrawnVertex drawnVertex(const PlanetShape& shape, const DrawItem& item, std::span<const std::int16_t> heights,
                        bool stitched, int column, int row);

// Stitched edges move the vertices on them and those beside them, along the edge: so far in from it the
// triangle over a place may belong to a cell further along.
inline constexpr int stitchedRingCells = 2;

// Where stitched: whether vertices of an edge lie elsewhere than on their own places.
bool gathersVertices(const DrawItem& item, Edge edge);

}  // namespace planet
