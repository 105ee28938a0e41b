#include "planet/gl/draw/sea_uniforms.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace planet::gl {

namespace {

constexpr double longestWaveM = 110;
constexpr double shortestWaveM = 1.3;
// Of the variance of all slopes; the rest are ripples that no pixel ever shows.
constexpr double shareOfWaves = 0.3;

// Vectors all around, so that on any side of the planet some run along its surface.
glm::dvec3 waveDirection(std::size_t wave) {
    const double turn = 2.399963 * static_cast<double>(wave) + 0.4;  // the golden angle
    const double z = 2 * std::fmod(0.5 + 0.618034 * static_cast<double>(wave), 1.0) - 1;
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

// And its phase at the eye, worked out in doubles.
glm::vec4 waveVector(double lengthM, std::size_t wave, const glm::dvec3& eyeM) {
    const glm::dvec3 k = 2 * std::numbers::pi / lengthM * waveDirection(wave);
    return glm::dvec4(k, std::remainder(glm::dot(k, eyeM), 2 * std::numbers::pi));
}

}  // namespace

double seaSlopeVariance(double windMps) {
    return 0.003 + 0.00512 * windMps;
}

glm::dvec3 waterExtinction(double clarityM) {
    return glm::dvec3(5.2, 1.0, 0.42) / clarityM;
}

SeaUniforms seaUniforms(const SeaDrawing& sea, const View& view, double exaggeration) {
    SeaUniforms uniforms{};
    const double variance = seaSlopeVariance(sea.windMps);
    // A sine's slope has half the square of its largest as variance, and two thirds of vectors so spread lie
    // along a surface.
    const double slope = sea.waves * std::sqrt(2 * 1.5 * shareOfWaves * variance / seaWaveCount);
    for (std::size_t i = 0; i < seaWaveCount; ++i) {
        const double place = (static_cast<double>(i) + 0.5 * std::sin(7.0 * static_cast<double>(i))) /
                             static_cast<double>(seaWaveCount - 1);
        const double lengthM = longestWaveM * std::pow(shortestWaveM / longestWaveM, place);
        uniforms.waves[i] = waveVector(lengthM, i, view.eyeM);
        uniforms.bends[i] = waveVector(11 * lengthM, i + seaWaveCount, view.eyeM);
    }
    uniforms.water = glm::dvec4(waterExtinction(sea.clarityM), 1 / exaggeration);
    uniforms.roughness = glm::dvec4(variance, slope, 0, 0);
    return uniforms;
}

}  // namespace planet::gl
