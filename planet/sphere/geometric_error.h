// The geometric error δg: the distance of a chunk's mesh from the mesh of its four children.
//
// It is the largest over the vertices that the children have and the chunk lacks: the 3-D distance on the
// sphere to the point of the chunk's mesh that replaces the vertex, the middle of an edge or diagonal. Every
// cell is drawn with its diagonal from the south-west to the north-east corner, so those middles lie on the
// drawn triangles.
//
// Distances at the same place make the sum δc = δg + max(δc of the children) a true bound. The children's
// triangles subdivide the chunk's, and the difference of two surfaces is linear on each of them, so it is
// largest at a vertex; and the bounds of successive levels add (de Boer 2000 for δg, Ulrich 2002 for chunks).
//
// The distance to the nearest point of the replacing triangle would be smaller where the cube-to-sphere
// mapping stretches a cell unevenly: on a bare sphere not at all in a face's middle, and by almost half at
// its corners. It would not bound the movement of a sample from its own place, which is measured on screen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"

namespace planet {

// Memory reused between calls; one per thread.
struct GeometricErrorScratch {
    std::vector<double> x, y, z;    // positions in the face's axes, metres
    std::vector<double> u, uRoot;   // a column's coordinate and sqrt(1/2 - u^2/6)
    std::vector<std::int32_t> row;  // the steps of a row
};

// Fills x, y and z with the vertices of a grid over a square of a face. heights: side^2 steps, row-major.
void facePositions(const PlanetShape& shape, const FaceSquare& square, std::size_t side, StepsView heights,
                   GeometricErrorScratch& scratch);

// Returns the δg of a chunk, metres. refined: its grid including its children's samples, (2 c + 1)^2 steps,
// row-major, c = chunkCells.
double geometricErrorM(const PlanetShape& shape, const ChunkId& chunk, StepsView refined,
                       GeometricErrorScratch& scratch);

// The grid of a chunk including its children's samples, as part of a finer grid.
struct RefinedSquare {
    std::size_t firstColumn = 0;  // of the finer grid
    std::size_t firstRow = 0;
    std::size_t stride = 1;  // columns and rows of the finer grid between those of the chunk's
    std::size_t cells = 0;   // 2 c
};
// Returns the δg of a chunk, metres. positions: a finer grid of side^2 vertices, from facePositions; the result has the
// same bits as that of geometricErrorM.
double geometricErrorOnGridM(const GeometricErrorScratch& positions, std::size_t side,
                             const RefinedSquare& square);

// Returns the smallest float that is not below the value, for stored errors.
float roundedUp(double value);

}  // namespace planet
