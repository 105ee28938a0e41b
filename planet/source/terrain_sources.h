// The kinds of procedural terrain behind makeTerrain, and their shared parts. Internal to the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "planet/source/gradient_noise.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/height_source_types.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/terrain.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// Limits of the natural face size of procedural terrain, which then bakes in some minutes although it may
// have finer detail.
inline constexpr int mostNaturalCells = 2048;
inline constexpr int leastNaturalCells = 128;

// Rises from 0 to 1 between `from` and `to`, with a continuous derivative.
inline double smoothly(double from, double to, double value) {
    if (to <= from) return value > from ? 1 : 0;
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

constexpr double radFromDeg(double deg) {
    return deg * std::numbers::pi / 180;
}
// Returns the average grid step of a face.
constexpr double gridStepRad(int faceCells) {
    return std::numbers::pi / 2 / faceCells;
}
// Returns the cells of the grid whose step is at most stepRad, within these limits.
int naturalCells(double stepRad);

// An octave of noise, shifted so that the zeros of the octaves' lattices do not coincide.
struct Octave {
    double frequency = 0;  // lattice cells along the sphere's radius
    double cellRad = 0;    // a lattice cell
    double weight = 0;     // gain^i
    std::uint32_t seed = 0;
    glm::dvec3 shift{};
};
std::vector<Octave> octavesOf(std::uint32_t seed, int count, double firstCellRad, double lacunarity,
                              double gain);
// Returns the number of octaves that a grid can represent: those with a lattice cell of at least two steps.
std::size_t heldBy(std::span<const Octave> octaves, double stepRad);

// Returns the octave's noise in a direction.
inline double noiseOf(const Octave& octave, const glm::dvec3& direction) {
    return gradientNoise(direction * octave.frequency + octave.shift, octave.seed);
}

// Return the sum of the octaves that the grid can represent, and the root mean square of all octaves. Heights
// are scaled so that their amplitude is noiseReach times that. Noise has thinner tails than a normal
// distribution, which exceeds this in less than one of a million places.
double fractalNoise(std::span<const Octave> octaves, const glm::dvec3& direction, double stepRad);
double fractalRms(std::span<const Octave> octaves);
inline constexpr double noiseReach = 5;

// The ranges of a terrain source; naturalCells: along a face.
struct TerrainExtent {
    int naturalCells = 0;
    double minM = 0;
    double maxM = 0;
};

// Describes a terrain source without files. Its sample function is still missing.
inline HeightSource describedTerrain(const TerrainSettings& settings, const TerrainExtent& extent) {
    HeightSource source;
    source.description = terrainText({settings, {}});
    source.naturalFaceSize = extent.naturalCells + 1;
    source.minM = extent.minM;
    source.maxM = extent.maxM;
    return source;
}

// Returns the source with the heights height(direction, stepRad), metres, clamped to the extent.
template <class Height>
HeightSource fieldSource(const TerrainSettings& settings, const TerrainExtent& extent, Height height) {
    HeightSource source = describedTerrain(settings, extent);
    source.sample = [height = std::move(height), minM = extent.minM, maxM = extent.maxM](
                        const SampleTile& tile, std::span<float> out) -> Result<void> {
        const double stepRad = gridStepRad(filterCellsOf(tile));
        std::size_t at = 0;
        for (int row = tile.firstRow; row < tile.firstRow + tile.rows; ++row) {
            for (int column = tile.firstColumn; column < tile.firstColumn + tile.columns; ++column) {
                const glm::dvec3 direction = directionOf(tile.face, tile.faceCells, column, row);
                out[at++] = static_cast<float>(std::clamp(height(direction, stepRad), minM, maxM));
            }
        }
        return {};
    };
    return source;
}

// Returns the source that samples pieces of at most `side` samples per side by samplePiece(terrain, piece,
// to, stride), as sampleInPieces does.
template <class Terrain>
using SamplePiece = Result<void> (*)(const Terrain& terrain, const SampleTile& piece, float* to,
                                     std::size_t stride);
template <class Terrain>
HeightSource pieceSource(const TerrainSettings& settings, const TerrainExtent& extent, int side,
                         Terrain terrain, std::type_identity_t<SamplePiece<Terrain>> samplePiece) {
    HeightSource source = describedTerrain(settings, extent);
    source.sample = [side, shared = std::make_shared<const Terrain>(std::move(terrain)), samplePiece](
                        const SampleTile& tile, std::span<float> out) {
        return sampleInPieces(tile, side, out, [&](const SampleTile& piece, float* to, std::size_t stride) {
            return samplePiece(*shared, piece, to, stride);
        });
    };
    return source;
}

HeightSource fractalSource(const FractalTerrain& terrain);
HeightSource ridgedSource(const RidgedTerrain& terrain);
HeightSource faultSource(const FaultTerrain& terrain);
HeightSource midpointSource(const MidpointTerrain& terrain);
HeightSource craterSource(const CraterTerrain& terrain);

}  // namespace planet
