// Rectangles of a face's grid (SampleTile): their sizes, places and pieces. Internal to the library. Pure
// functions, any thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <span>

#include "planet/base/try.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/face_fold.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

inline std::size_t samplesIn(const SampleTile& tile) {
    return static_cast<std::size_t>(tile.columns) * static_cast<std::size_t>(tile.rows);
}

// Returns the index of a sample in the tile's samples, from its column and row on the face.
inline std::size_t indexIn(const SampleTile& tile, int column, int row) {
    return static_cast<std::size_t>(row - tile.firstRow) * static_cast<std::size_t>(tile.columns) +
           static_cast<std::size_t>(column - tile.firstColumn);
}

// Returns the tile of all samples of a chunk's square on the grid of a level's chunks, including its edges,
// with the filter of the finest grid. level: at least the chunk's.
inline SampleTile tileOf(const PlanetShape& shape, const ChunkId& chunk, int level) {
    const int onFace = chunkCells(shape) << level;
    const int cells = onFace >> chunk.level;
    return {chunk.face,
            onFace,
            static_cast<int>(chunk.x) * cells,
            static_cast<int>(chunk.y) * cells,
            cells + 1,
            cells + 1,
            faceCells(shape)};
}
// Returns the same on the finest grid.
inline SampleTile tileOf(const PlanetShape& shape, const ChunkId& chunk) {
    return tileOf(shape, chunk, deepestLevelOf(shape));
}

// Returns the tile with two points of a face as opposite corners.
inline SampleTile tileBetween(const FaceGridPoint& a, const FaceGridPoint& b, int faceCells) {
    return {a.face,
            faceCells,
            std::min(a.column, b.column),
            std::min(a.row, b.row),
            std::abs(a.column - b.column) + 1,
            std::abs(a.row - b.row) + 1};
}

// Returns the unit direction of a sample of a face's grid.
inline glm::dvec3 directionOf(Face face, int faceCells, int column, int row) {
    return sphereFromCube(cubePoint(face, 2.0 * column / faceCells - 1, 2.0 * row / faceCells - 1));
}

// Splits a tile into square pieces of at most `side` samples per side, so that each needs little memory.
// Calls samplePiece(piece, to, stride), which writes the piece's samples starting at `to`, with rows `stride`
// samples apart. Stops at the first Error.
template <class Sample, class SamplePiece>
Result<void> sampleInPieces(const SampleTile& tile, int side, std::span<Sample> out,
                            const SamplePiece& samplePiece) {
    const auto stride = static_cast<std::size_t>(tile.columns);
    for (int row = 0; row < tile.rows; row += side) {
        for (int column = 0; column < tile.columns; column += side) {
            SampleTile piece = tile;
            piece.firstColumn += column;
            piece.firstRow += row;
            piece.columns = std::min(side, tile.columns - column);
            piece.rows = std::min(side, tile.rows - row);
            TRY(samplePiece(piece, &out[indexIn(tile, piece.firstColumn, piece.firstRow)], stride));
        }
    }
    return {};
}

}  // namespace planet
