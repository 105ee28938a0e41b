// delta_g: how far a chunk's mesh lies from the mesh of its four children.
//
// For each vertex that the children have and the chunk lacks, the distance, in 3-D on the sphere, to the
// point of the chunk's mesh that stands in its place: the middle of the edge or diagonal that replaces it.
// Every cell is drawn with its diagonal from the (west, south) to the (east, north) corner, so those middles
// lie on the triangles really drawn.
//
// Distances at the same place make the sum delta_c = delta_g + max(delta_c of the children) a true bound: the
// children's triangles subdivide the chunk's, the difference of two surfaces is linear on each of them, so it
// is largest at a vertex; and bounds of successive levels add (de Boer 2000 for delta_g, Ulrich 2002 for
// chunks).
//
// The distance to the nearest point of the replacing triangle is smaller where the cube-to-sphere map
// stretches a cell unevenly: on a bare sphere by nothing in a face's middle and by almost half at its
// corners. It would not bound how far a sample moves from its own place, which is what is measured on screen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Memory that is reused between calls; one per thread.
struct GeometricErrorScratch {
    std::vector<double> x, y, z;   // positions in the face's own axes, metres
    std::vector<double> u, uRoot;  // a column's coordinate and sqrt(1/2 - u^2/6)
};

// Fills x, y and z with the vertices of a grid over a square of a face: side^2 heights in
// steps, row-major.
void facePositions(const PlanetShape& shape, const FaceSquare& square, std::size_t side,
                   std::span<const std::int16_t> heights, GeometricErrorScratch& scratch);

// Returns delta_g of a chunk, metres. refined: its grid with its children's samples, (2 c + 1)^2 steps,
// row-major, c = chunkCells.
double geometricErrorM(const PlanetShape& shape, const ChunkId& chunk, std::span<const std::int16_t> refined,
                       GeometricErrorScratch& scratch);

// Returns the nearest float that is not below the value, for stored errors.
float roundedUp(double value);

}  // namespace planet
