// The uniform block of shaders/sea.glsl, which describes its members. Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "planet/sphere/view.h"
#include "planet/surface/light_drawing.h"

namespace planet::gl {

inline constexpr std::size_t seaWaveCount = 32;

// Members have std140 offsets, because every vec3 is aligned to 16 bytes.
struct WaveUniforms {
    alignas(16) glm::vec3 vector;
    float phase;
    alignas(16) glm::vec3 bendVector;
    float bendPhase;
};

struct SeaUniforms {
    std::array<WaveUniforms, seaWaveCount> waves;
    alignas(16) glm::vec3 extinction;
    float perExaggeration, slopeVariance, waveSlope;
};

// Returns the variance of the sea's slopes, summed over both axes, for a wind speed 12.5 m above it: the
// clean sea of Cox and Munk.
double seaSlopeVariance(double windMps);

// Returns the extinction of downwelling light, 1/m, in water that leaves 1/e of green after clarityM metres.
// Red is absorbed first and blue last, as in the clear ocean (Jerlov's type I).
glm::dvec3 waterExtinction(double clarityM);

// Returns the uniform block. exaggeration: of the drawn heights, > 0.
SeaUniforms seaUniforms(const SeaDrawing& sea, const View& view, double exaggeration);

}  // namespace planet::gl
