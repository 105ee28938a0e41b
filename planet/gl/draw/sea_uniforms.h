// What shaders/sea.glsl is told once a frame, in the layout of its uniform block. Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "planet/sphere/view.h"
#include "planet/surface/light_drawing.h"

namespace planet::gl {

inline constexpr std::size_t seaWaveCount = 32;

// std140: only members of 16 bytes.
struct SeaUniforms {
    std::array<glm::vec4, seaWaveCount> waves, bends;
    glm::vec4 water, roughness;
};
static_assert(sizeof(SeaUniforms) == (2 * seaWaveCount + 2) * 16);

// Variance of the slopes of a sea's surface along both axes together, by the wind 12.5 m above it: Cox and
// Munk's clean sea.
double seaSlopeVariance(double windMps);

// Extinction of downwelling light in water that takes away all but 1 / e of green in so many metres, 1 /
// metre: red goes first, blue last, as in the clear ocean (Jerlov's type I).
glm::dvec3 waterExtinction(double clarityM);

// exaggeration: of the heights drawn, > 0.
SeaUniforms seaUniforms(const SeaDrawing& sea, const View& view, double exaggeration);

}  // namespace planet::gl
