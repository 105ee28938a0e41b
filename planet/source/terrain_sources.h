// The kinds of made terrain behind makeTerrain, and what they share. Internal to the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "planet/source/gradient_noise.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/height_source_types.h"
#include "planet/source/terrain.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/face_fold.h"

namespace planet {

// A made source names a face that bakes in some minutes as its natural one, though it may go on below.
inline constexpr int mostNaturalCells = 2048;
inline constexpr int leastNaturalCells = 128;

// From 0 to 1 without a bend.
inline double smoothly(double from, double to, double value) {
    if (to <= from) return value > from ? 1 : 0;
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

constexpr double radFromDeg(double deg) {
    return deg * std::numbers::pi / 180;
}
// A grid step of a face, on the average over it.
constexpr double gridStepRad(int faceCells) {
    return std::numbers::pi / 2 / faceCells;
}
// The cells of the grid whose step is at most that, within what a made source names.
int naturalCells(double stepRad);

// Octaves of noise, each moved to a place of its own so that their lattices' zeros do not meet.
struct Octave {
    double frequency = 0;  // lattice cells along the sphere's radius
    double cellRad = 0;    // a lattice cell
    double weight = 0;     // gain^i
    std::uint32_t seed = 0;
    glm::dvec3 shift{};
};
std::vector<Octave> octavesOf(std::uint32_t seed, int count, double firstCellRad, double lacunarity,
                              double gain);
// How many of them a grid can hold: those with a lattice cell of two steps at least.
std::size_t heldBy(std::span<const Octave> octaves, double stepRad);

// The octave's noise in a direction.
inline double noiseOf(const Octave& octave, const glm::dvec3& direction) {
    return gradientNoise(direction * octave.frequency + octave.shift, octave.seed);
}

// The octaves that the grid holds, summed, and the root mean square of all of them. Heights are scaled so
// that noiseReach times that is their amplitude: noise thins out faster than a normal distribution, of which
// less than one in a million lies beyond.
double fractalNoise(std::span<const Octave> octaves, const glm::dvec3& direction, double stepRad);
double fractalRms(std::span<const Octave> octaves);
inline constexpr double noiseReach = 5;

// A source of terrain without files: height(direction, stepRad) in metres, held to [minM, maxM].
template <class Height>
HeightSource fieldSource(const TerrainSettings& settings, int cells, double minM, double maxM,
                         Height height) {
    HeightSource source;
    source.description = terrainText({settings, {}});
    source.naturalFaceSize = cells + 1;
    source.minM = minM;
    source.maxM = maxM;
    source.sample = [height = std::move(height), minM, maxM](const SampleTile& tile,
                                                             std::span<float> out) -> Result<void> {
        const double stepRad = gridStepRad(tile.faceCells);
        std::size_t at = 0;
        for (int row = tile.firstRow; row < tile.firstRow + tile.rows; ++row) {
            for (int column = tile.firstColumn; column < tile.firstColumn + tile.columns; ++column) {
                const glm::dvec3 direction = sphereFromCube(
                    cubePoint(tile.face, 2.0 * column / tile.faceCells - 1, 2.0 * row / tile.faceCells - 1));
                out[at++] = static_cast<float>(std::clamp(height(direction, stepRad), minM, maxM));
            }
        }
        return {};
    };
    return source;
}

HeightSource fractalSource(const FractalTerrain& terrain);
HeightSource ridgedSource(const RidgedTerrain& terrain);
HeightSource faultSource(const FaultTerrain& terrain);
HeightSource midpointSource(const MidpointTerrain& terrain);
HeightSource craterSource(const CraterTerrain& terrain);

}  // namespace planet
