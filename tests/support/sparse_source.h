// Sources that are fine only in some boxes of the cube, for tests of sparse trees.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "planet/source/height_source_types.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "tests/support/synthetic_source.h"

namespace planet::test {

// The part of the cube's surface in a box. A box around an edge or a corner of the cube lies on two or three
// faces; one without thickness on one.
struct FineBox {
    glm::dvec3 low{0, 0, 0};
    glm::dvec3 high{0, 0, 0};
    int cells = 1024;  // along a face, of the data there
};

inline FineBox boxAround(const glm::dvec3& middle, double reach, int cells) {
    return {middle - reach, middle + reach, cells};
}

// Returns whether a chunk and a box share an area.
inline bool overlap(const ChunkId& id, const FineBox& box) {
    const FaceSquare square = faceSquareOf(id);
    const glm::dvec3 a = cubePoint(id.face, square.u, square.v);
    const glm::dvec3 b = cubePoint(id.face, square.u + square.side, square.v + square.side);
    const glm::dvec3 low = glm::max(glm::min(a, b), box.low);
    const glm::dvec3 high = glm::min(glm::max(a, b), box.high);
    int wide = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (high[axis] < low[axis]) return false;
        wide += high[axis] > low[axis];
    }
    return wide == 2;
}

// Makes a source fine in boxes only.
inline HeightSource sparse(HeightSource source, std::vector<FineBox> boxes, int cellsElsewhere = 1) {
    source.finestCells = [boxes = std::move(boxes), cellsElsewhere](const ChunkId& id) {
        int cells = cellsElsewhere;
        for (const FineBox& box : boxes) {
            if (overlap(id, box)) cells = std::max(cells, box.cells);
        }
        return cells;
    };
    return source;
}

// Fine data in the middle of a face, across an edge of the cube and around a corner of it.
inline std::vector<FineBox> middleEdgeAndCorner(int cells) {
    return {boxAround({0.1, 0.2, 1}, 0.05, cells), boxAround({1, 0.3, -1}, 0.04, cells),
            boxAround({-1, 1, 1}, 0.04, cells)};
}
inline HeightSource sparseHills(int cells) {
    return sparse(hillsSource(cells + 1), middleEdgeAndCorner(cells));
}

}  // namespace planet::test
