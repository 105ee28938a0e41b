// Hashes and gradient noise for procedural terrain. Pure functions, any thread. The same input gives the same
// bits on every machine.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace planet {

// Scrambles a number with the finalizer of splitmix64 (Steele, Lea and Flood 2014).
constexpr std::uint64_t scrambled64(std::uint64_t value) {
    value += 0x9E3779B97F4A7C15u;
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
    return value ^ (value >> 31);
}

// Maps a hash to a number in [0, 1).
constexpr double unitOf(std::uint64_t hash) {
    return static_cast<double>(hash >> 11) * 0x1p-53;
}

// Hashes a point of the integer lattice.
constexpr std::uint32_t latticeHash(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    std::uint32_t h = seed + static_cast<std::uint32_t>(x) * 0x8DA6B343u +
                      static_cast<std::uint32_t>(y) * 0xD8163841u +
                      static_cast<std::uint32_t>(z) * 0xCB1AB31Fu;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return h ^ (h >> 15);
}

// Returns Perlin's improved noise (Perlin, "Improving Noise", SIGGRAPH 2002): 0 at lattice points, within
// about +-1, with features about a lattice cell wide and a continuous second derivative. A hash of the cell
// and the seed replaces the table of 256 permutations, so nothing repeats after 256 cells. Coordinates:
// within +-2^30.
double gradientNoise(const glm::dvec3& point, std::uint32_t seed);

// The root mean square of gradientNoise, and the mean of (1 - |noise|)^2; both measured.
inline constexpr double gradientNoiseRms = 0.2700;
inline constexpr double meanRidge = 0.6325;

}  // namespace planet
