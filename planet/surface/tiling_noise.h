// Noises that repeat after the unit square in both directions, for textures that tile. The lattice is hashed
// in whole numbers, so that a seed gives the same everywhere. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace planet {

// Of a lattice point; all 32 bits are mixed.
std::uint32_t tilingHash(std::uint32_t x, std::uint32_t y, std::uint32_t seed);
// In [0, 1).
double tilingRandom(std::uint32_t x, std::uint32_t y, std::uint32_t seed);

// Gradient noise (Perlin, "Improving noise", 2002) of so many cells across the square, in about [-1, 1];
// >= 1.
double tilingNoise(const glm::dvec2& place, int cells, std::uint32_t seed);
glm::dvec2 tilingNoise2(const glm::dvec2& place, int cells, std::uint32_t seed);  // two of them

// Octaves, each half as wide and half as strong as the one before; in about [-1, 1].
double tilingFbm(const glm::dvec2& place, int cells, int octaves, std::uint32_t seed);
// The same folded at 0 into ridges (Musgrave); in [0, 1].
double tilingRidges(const glm::dvec2& place, int cells, int octaves, std::uint32_t seed);

// Worley's cells ("A cellular texture basis function", 1996): distances in cells.
struct CellPlace {
    double nearest = 0;       // to the nearest point
    double toBorder = 0;      // half the way from it to the next nearest one's
    glm::dvec2 offset{0, 0};  // from the nearest point
    std::uint32_t id = 0;     // of it, a hash
};
CellPlace tilingCells(const glm::dvec2& place, int cells, std::uint32_t seed);

}  // namespace planet
