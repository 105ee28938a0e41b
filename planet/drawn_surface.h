// The surface that is drawn of a chunk, in doubles: what the vertex shader makes of its heights, morph and
// stitched edges included, skirts left out. What instruments compare with the truth, and with each other.
//
// Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/lod_select.h"
#include "planet/planet_shape.h"

namespace planet {

struct DrawnGrid {
    ChunkId id;
    int cells = 0;                      // along a side
    std::vector<glm::dvec3> positionM;  // (cells + 1)^2, rows from the south; metres from the planet's centre
    // Where each vertex lies on the chunk, in cells from its west and south edges: its own column and row,
    // or along a coarser chunk that is stitched to, those of the nearest vertex of that.
    std::vector<glm::ivec2> place;
    bool stitched = false;  // whether any vertex lies elsewhere than on its own place
};

// Heights: the chunk's (cells + 1)^2 steps. Stitched: whether it is drawn with RenderSettings::stitched.
DrawnGrid drawnGrid(const PlanetShape& shape, const DrawItem& item, std::span<const std::int16_t> heights,
                    bool stitched);

// The point drawn at (x, y) cells from the chunk's west and south edges, both in [0, cells]: on the triangle
// that covers the place, metres from the planet's centre.
glm::dvec3 pointOn(const DrawnGrid& grid, double x, double y);

// How a vertex slides onto a coarser surface, as the vertex shader's slideOf has it.
struct VertexSlide {
    glm::ivec2 vertex{0, 0};  // itself, or the nearest vertex of a coarser chunk beside it
    glm::ivec2 aside{0, 0};   // from it to either end of what will replace it; 0 where it stays
    double amount = 0;        // [0, 1] of the way to the middle between those ends
};
VertexSlide vertexSlide(const PlanetShape& shape, const DrawItem& item, bool stitched, int column, int row);

// One vertex of it.
struct DrawnVertex {
    glm::ivec2 place{0, 0};
    glm::dvec3 positionM{0, 0, 0};
};
DrawnVertex drawnVertex(const PlanetShape& shape, const DrawItem& item, std::span<const std::int16_t> heights,
                        bool stitched, int column, int row);

}  // namespace planet
