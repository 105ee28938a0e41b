// Noises that repeat over the unit square in both directions, for tileable textures. The lattice is hashed in
// integers, so that a seed gives the same values everywhere. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace planet {

// Returns the hash of a lattice point. All 32 bits are mixed.
std::uint32_t tilingHash(std::uint32_t x, std::uint32_t y, std::uint32_t seed);
// Returns a value in [0, 1).
double tilingRandom(std::uint32_t x, std::uint32_t y, std::uint32_t seed);

// Returns gradient noise (Perlin, "Improving noise", 2002), in about [-1, 1]. cells: number across the
// square, >= 1.
double tilingNoise(const glm::dvec2& place, int cells, std::uint32_t seed);
glm::dvec2 tilingNoise2(const glm::dvec2& place, int cells, std::uint32_t seed);  // two independent noises

// Returns a sum of octaves, each with half the cell size and half the strength of the one before; in about
// [-1, 1].
double tilingFbm(const glm::dvec2& place, int cells, int octaves, std::uint32_t seed);
// Returns ridged octaves, folded at 0 (Musgrave); in [0, 1].
double tilingRidges(const glm::dvec2& place, int cells, int octaves, std::uint32_t seed);

// A place in cellular noise (Worley, "A cellular texture basis function", 1996). Distances are in cells.
struct CellPlace {
    double nearest = 0;       // to the nearest point
    double toBorder = 0;      // half the difference of the distances to the two nearest points
    glm::dvec2 offset{0, 0};  // from the nearest point
    std::uint32_t id = 0;     // hash of the nearest point
};
CellPlace tilingCells(const glm::dvec2& place, int cells, std::uint32_t seed);

}  // namespace planet
