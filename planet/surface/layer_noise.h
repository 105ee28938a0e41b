// The noise that breaks up the borders of texture layers: value noise on an integer lattice. The lattice is
// hashed in integers, so that shaders/layers.glsl computes the same values to within float rounding. Pure
// functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace planet {

// The ratio of the cell sizes of two octaves, and the octaves' shares.
inline constexpr double layerNoiseOctave = 3.17;
inline constexpr std::array<double, 3> layerNoiseShares = {0.56, 0.28, 0.16};

// Returns the lattice point of integral coordinates of any size. They wrap at 2^32, as in the shader.
glm::uvec3 latticeCell(const glm::dvec3& whole);
// Returns the hash of a lattice point. All 32 bits are mixed.
std::uint32_t layerHash(const glm::uvec3& cell);

// Returns four independent noises in [-1, 1], one per byte of the hash, with cells of side 1.
glm::dvec4 valueNoise(const glm::dvec3& place);

// Returns the sum of all octaves at a place, metres from the planet's centre. sizeM: the side of the coarsest
// cells, metres, > 0. Layer i of a set takes component i % 4.
glm::dvec4 layerNoise(const glm::dvec3& positionM, double sizeM);

}  // namespace planet
