// Makes terrain of octaves of gradient noise: Perlin's fBm and Musgrave's ridged multifractal.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "planet/source/terrain_sources.h"

namespace planet {

namespace {

// Returns the cells of the grid that can represent all octaves.
int cellsFor(std::span<const Octave> octaves) {
    return naturalCells(octaves.back().cellRad / 2);
}

}  // namespace

double fractalNoise(std::span<const Octave> octaves, const glm::dvec3& direction, double stepRad) {
    double sum = 0;
    for (const Octave& octave : octaves.first(heldBy(octaves, stepRad))) {
        sum += octave.weight * noiseOf(octave, direction);
    }
    return sum;
}

double fractalRms(std::span<const Octave> octaves) {
    double squares = 0;
    for (const Octave& octave : octaves) squares += octave.weight * octave.weight;
    return gradientNoiseRms * std::sqrt(squares);
}

HeightSource fractalSource(const FractalTerrain& terrain) {
    const std::vector<Octave> octaves = octavesOf(
        terrain.seed, terrain.octaves, radFromDeg(terrain.featureDeg), terrain.lacunarity, terrain.gain);
    const double scaleM = terrain.amplitudeM / (noiseReach * fractalRms(octaves));
    return fieldSource(
        terrain,
        {cellsFor(octaves), terrain.offsetM - terrain.amplitudeM, terrain.offsetM + terrain.amplitudeM},
        [=](const glm::dvec3& direction, double stepRad) {
            return terrain.offsetM + scaleM * fractalNoise(octaves, direction, stepRad);
        });
}

HeightSource ridgedSource(const RidgedTerrain& terrain) {
    const std::vector<Octave> octaves = octavesOf(
        terrain.seed, terrain.octaves, radFromDeg(terrain.featureDeg), terrain.lacunarity, terrain.gain);
    double weights = 0;
    for (const Octave& octave : octaves) weights += octave.weight;
    const double scaleM = terrain.amplitudeM / (weights * (1 - meanRidge));
    const auto height = [=](const glm::dvec3& direction, double stepRad) {
        double sum = 0;
        double trust = 1;  // weight of the next octave
        for (const Octave& octave : std::span(octaves).first(heldBy(octaves, stepRad))) {
            const double edge = std::max(0.0, 1 - std::abs(noiseOf(octave, direction)));
            const double ridge = edge * edge;
            sum += octave.weight * trust * (ridge - meanRidge);
            trust = std::min(1.0, trust * ridge * terrain.sharpness);
        }
        return terrain.offsetM + scaleM * sum;
    };
    return fieldSource(terrain,
                       {cellsFor(octaves), terrain.offsetM - scaleM * weights * meanRidge,
                        terrain.offsetM + terrain.amplitudeM},
                       height);
}

}  // namespace planet
