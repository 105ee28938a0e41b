// Chunks' heights made of one function of the direction.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

using HeightFunction = std::function<double(const glm::dvec3& direction)>;  // metres

inline double flat(const glm::dvec3&) {
    return 0;
}

inline std::vector<std::int16_t> chunkSteps(const PlanetShape& shape, const ChunkId& id,
                                            const HeightFunction& height) {
    const FaceSquare square = faceSquareOf(id);
    const int size = chunkSize(shape);
    std::vector<std::int16_t> steps;
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const double u = square.u + square.side * column / (size - 1);
            const double v = square.v + square.side * row / (size - 1);
            const double value = height(sphereFromCube(cubePoint(id.face, u, v)));
            steps.push_back(
                static_cast<std::int16_t>(std::lround((value - shape.baseHeightM) / shape.quantumM)));
        }
    }
    return steps;
}

}  // namespace planet
