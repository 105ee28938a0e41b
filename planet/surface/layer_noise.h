// The noise that breaks up the borders of texture layers: value noise on an integer lattice, which is hashed
// in whole numbers, so that shaders/layers.glsl has the same to within float rounding. Pure functions, any
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace planet {

// Each octave's cells are so many times smaller than those of the one before; and the octaves' shares.
inline constexpr double layerNoiseOctave = 3.17;
inline constexpr std::array<double, 3> layerNoiseShares = {0.56, 0.28, 0.16};

// The lattice point of whole coordinates of any size: they wrap at 2^32, as the shader's do.
glm::uvec3 latticeCell(const glm::dvec3& whole);
// Of a lattice point; all 32 bits are mixed.
std::uint32_t layerHash(const glm::uvec3& cell);

// Four noises at once, each of a byte of the hash; in [-1, 1], over cells one unit a side.
glm::dvec4 valueNoise(const glm::dvec3& place);

// All octaves at a place on the planet, metres from its centre; sizeM: a side of the coarse cells, > 0.
// Layer i of a set takes component i % 4.
glm::dvec4 layerNoise(const glm::dvec3& positionM, double sizeM);

}  // namespace planet
