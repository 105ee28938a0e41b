#include "planet/gl/draw/sea_uniforms.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "planet/gl/device/shader_inputs.h"

namespace planet::gl {

namespace {

constexpr double longestWaveM = 110;
constexpr double shortestWaveM = 1.3;
constexpr double shareOfWaves = 0.3;  // of the variance of all slopes; ripples below a pixel have the rest

// Returns directions spread over the sphere, so that anywhere on the planet some run along its surface.
glm::dvec3 waveDirection(std::size_t wave) {
    const double turn = 2.399963 * static_cast<double>(wave) + 0.4;  // the golden angle
    const double z = 2 * std::fmod(0.5 + 0.618034 * static_cast<double>(wave), 1.0) - 1;
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

glm::dvec3 waveVector(double lengthM, std::size_t wave) {
    return 2 * std::numbers::pi / lengthM * waveDirection(wave);
}

float phaseAt(const glm::dvec3& eyeM, const glm::dvec3& vector) {
    return toFloat(std::remainder(glm::dot(vector, eyeM), 2 * std::numbers::pi));
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
    // The slope of a sine has a variance of half its squared maximum. Two thirds of vectors spread over the
    // sphere lie along a surface.
    const double slope = sea.waves * std::sqrt(2 * 1.5 * shareOfWaves * variance / seaWaveCount);
    for (std::size_t i = 0; i < seaWaveCount; ++i) {
        const double place = (static_cast<double>(i) + 0.5 * std::sin(7.0 * static_cast<double>(i))) /
                             static_cast<double>(seaWaveCount - 1);
        const double lengthM = longestWaveM * std::pow(shortestWaveM / longestWaveM, place);
        const glm::dvec3 vector = waveVector(lengthM, i);
        const glm::dvec3 bendVector = waveVector(11 * lengthM, i + seaWaveCount);
        uniforms.waves[i] = {vector, phaseAt(view.eyeM, vector), bendVector, phaseAt(view.eyeM, bendVector)};
    }
    uniforms.extinction = waterExtinction(sea.clarityM);
    uniforms.perExaggeration = toFloat(1 / exaggeration);
    uniforms.slopeVariance = toFloat(variance);
    uniforms.waveSlope = toFloat(slope);
    return uniforms;
}

}  // namespace planet::gl
