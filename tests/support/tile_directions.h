// The directions of the samples of a tile, for sources that are formulas.
#pragma once

#include "planet/source/height_source_types.h"
#include "planet/sphere/cube_sphere.h"

namespace planet::test {

// Calls use with each sample's direction from the planet's centre, row by row.
template <class Use>
void forEachDirection(const SampleTile& tile, const Use& use) {
    for (int j = 0; j < tile.rows; ++j) {
        for (int i = 0; i < tile.columns; ++i) {
            const double u = 2.0 * (tile.firstColumn + i) / tile.faceCells - 1;
            const double v = 2.0 * (tile.firstRow + j) / tile.faceCells - 1;
            use(sphereFromCube(cubePoint(tile.face, u, v)));
        }
    }
}

}  // namespace planet::test
