// The shape of a planet, which converts a chunk's stored steps to points in space. Pure functions, any
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "planet/sphere/cube_sphere.h"

namespace planet {

// On Earth, the cells of a grid of 2^28 a side are 3.7 cm wide. A drawn vertex within 2 km of the eye is within 1 mm of its
// double-precision position, at this depth as at any other, and farther away within 4e-7 of its distance
// (vertex_position.h). The limit is that of the level: the key of a chunk has room for levels up to maxLevel.
inline constexpr int maxFaceCellsLog2 = 28;
// A planet that is this fine everywhere has 10^14 samples. A source must say where it is fine to be baked finer.
inline constexpr int maxDenseFaceCellsLog2 = 22;

// Returns the smallest power of two of cells that is not below count, at most 2^maxFaceCellsLog2.
constexpr int powerOfTwoCells(double count) {
    int cells = 1;
    while (cells < (1 << maxFaceCellsLog2) && cells < count) cells *= 2;
    return cells;
}

inline constexpr double earthRadiusM = 6'371'000;  // mean
// The radii that a planet may have.
inline constexpr double leastRadiusM = 1e-3;
inline constexpr double mostRadiusM = 1e9;

// A file has a quantum. Where its sources are finer, heights are multiples of a power-of-two fraction of it. All steps
// count in the finest of these fractions, 2^-fractionBits of the file's quantum.
inline constexpr int maxFractionBits = 12;
// The steps of a planet lie within this of 0, so that a float holds the difference of any two exactly.
inline constexpr std::int32_t farthestStep = (1 << 23) - 1;

struct PlanetShape {
    double radiusM = earthRadiusM;  // of height 0; [leastRadiusM, mostRadiusM]
    double quantumM = 1;            // metres per step, the file's finest; > 0
    double baseHeightM = 0;         // height of stored step 0
    int faceCellsLog2 = 11;         // log2 of a face's cells per side; [chunkCellsLog2, maxFaceCellsLog2]
    int chunkCellsLog2 = 5;         // log2 of a chunk's cells per side; [4, 7]
    int fractionBits = 0;           // log2 of the steps in the file's quantum; [0, maxFractionBits]
};

// Returns the file's quantum, metres: that of heights whose source is not finer.
constexpr double fileQuantumM(const PlanetShape& shape) {
    return shape.quantumM * (1 << shape.fractionBits);
}
// Return the limits of a planet's steps: without fractions, those of 16 bits.
constexpr std::int32_t lowestStepOf(int fractionBits) {
    return fractionBits == 0 ? -32768 : -farthestStep;
}
constexpr std::int32_t highestStepOf(int fractionBits) {
    return fractionBits == 0 ? 32767 : farthestStep;
}
// Returns the bytes of a step in the GPU's pool of heights, and at most in memory.
constexpr std::size_t stepBytesOf(const PlanetShape& shape) {
    return shape.fractionBits == 0 ? 2 : 4;
}

constexpr int faceCells(const PlanetShape& shape) {
    return 1 << shape.faceCellsLog2;
}
constexpr int chunkCells(const PlanetShape& shape) {
    return 1 << shape.chunkCellsLog2;
}
// Return the numbers of vertices along a chunk's side, and in the whole chunk.
constexpr int chunkSize(const PlanetShape& shape) {
    return chunkCells(shape) + 1;
}
constexpr int chunkVertexCount(const PlanetShape& shape) {
    return chunkSize(shape) * chunkSize(shape);
}
// Returns the deepest level, whose chunks hold the finest samples. In a sparse tree, leaves lie at any level
// down to it: ask the chunk whether it has children.
constexpr int deepestLevelOf(const PlanetShape& shape) {
    return shape.faceCellsLog2 - shape.chunkCellsLog2;
}
constexpr std::uint64_t chunkCellCount(const PlanetShape& shape) {
    return std::uint64_t{1} << (2 * shape.chunkCellsLog2);
}
// Returns the number of chunks of all levels of a planet whose leaves are all at the deepest level.
constexpr std::uint64_t chunkCountOf(const PlanetShape& shape) {
    return faceCount * ((std::uint64_t{1} << (2 * (deepestLevelOf(shape) + 1))) - 1) / 3;
}
// Returns the number of leaves of a tree of any shape: a chunk with children takes the place of one leaf and
// adds four.
constexpr std::uint64_t leafCountOf(std::uint64_t chunks) {
    return faceCount + (chunks - faceCount) / 4 * 3;
}
constexpr double heightM(const PlanetShape& shape, std::int32_t step) {
    return shape.baseHeightM + step * shape.quantumM;
}
// Returns the double-precision position of a vertex, metres from the planet's centre.
inline glm::dvec3 positionM(const PlanetShape& shape, const glm::dvec3& direction, double height) {
    return (shape.radiusM + height) * direction;
}

}  // namespace planet
