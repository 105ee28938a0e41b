#include "tests/support/made_chunks.h"

#include <cmath>
#include <tuple>
#include <vector>

namespace planet::test {

std::int16_t MadeChunks::step(Face face, int column, int row, int cells) const {
    const glm::dvec3 d = sphereFromCube(cubePoint(face, 2.0 * column / cells - 1, 2.0 * row / cells - 1));
    return static_cast<std::int16_t>(std::lround((heightM(d) - shape.baseHeightM) / shape.quantumM));
}

ChunkData MadeChunks::chunk(const ChunkId& id) const {
    const int size = chunkCells(shape);
    const int cells = size << id.level;
    ChunkData data;
    data.id = id;
    std::vector<std::int16_t> steps;
    for (int row = 0; row <= size; ++row) {
        for (int column = 0; column <= size; ++column)
            steps.push_back(step(id.face, static_cast<int>(id.x) * size + column,
                                 static_cast<int>(id.y) * size + row, cells));
    }
    data.heights = steps;
    std::tie(data.minStep, data.maxStep) = lowestAndHighest(data.heights);
    if (id.level < deepestLevelOf(shape)) {
        data.children = {keyOf(id) + 1, 100};
        data.minStep = lowest;
        data.maxStep = highest;
        // Each level has a quarter of the error of the one above, so that levels split as they come nearer.
        data.deltaCM = data.deltaTightM =
            static_cast<float>(shape.radiusM * 0.3 / (cells * static_cast<double>(cells)));
    }
    return data;
}

}  // namespace planet::test
