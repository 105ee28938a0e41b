// The position of a vertex relative to the eye, in floats: mirrors the computation of the vertex shader.
//
// A float has seven digits and a planet needs ten, so nothing here is relative to the planet's centre. Each
// face has a reference point near the eye, computed in doubles once per frame: a grid point (u0, v0), whose
// coordinates a float holds exactly, and a height step h0. A vertex's grid distance to it is taken in integers. A float
// holds it exactly near the eye, and elsewhere within 6e-8 of itself. The difference of the two directions
// d(u, v) - d(u0, v0) of Nowell's mapping is computed without cancellation. So
//
//   position - eye = (P0 - eye) + (R + h) (d - d0) + (h - h0) d0,     P0 = (R + h0) d0
//
// has an error of about 1e-7 of the vertex's distance to the eye. Vertices that chunks of any level share are
// bit-identical: on the cube's edges and corners, all faces use the point's owning face.
//
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Grid coordinates here count cells of the finest possible grid, 2^28 per side, whatever the planet's own
// grid: [0, 2^28] from the west or south edge of the face.
inline constexpr int fineGridLog2 = maxFaceCellsLog2;
// The reference point lies on a grid of 2^22 cells per side, whose coordinates are exact in a float.
inline constexpr int referenceGridLog2 = 22;

struct FaceReference {
    std::int32_t gridU = 0;  // of the reference point
    std::int32_t gridV = 0;
    float u0 = 0;  // its cube coordinates, exact
    float v0 = 0;
    glm::vec3 roots{1, 0, 0};      // square roots of Nowell's mapping at it: along normal, u and v
    glm::vec3 direction{1, 0, 0};  // d0 in world axes, unit vector
    glm::vec3 originM{0, 0, 0};    // P0 - eye in world axes, metres
};

struct VertexFrame {
    std::array<FaceReference, faceCount> faces;
    std::int32_t referenceStep = 0;  // h0, the step nearest to the eye's height
    float referenceRadiusM = 0;      // R + h0
    float quantumM = 1;
};

VertexFrame vertexFrame(const PlanetShape& shape, const glm::dvec3& eyeM);

struct FineGridPoint {
    Face face = Face::PosX;
    std::int32_t gridU = 0;
    std::int32_t gridV = 0;

    bool operator==(const FineGridPoint&) const = default;
};

// Returns a point on an edge or a corner of the cube as a point of the face with the lowest index that
// contains it; any other point unchanged.
FineGridPoint onOwningFace(const FineGridPoint& point);

// Returns the position in metres from the eye, in world axes. The skirt drops towards the planet's centre.
glm::vec3 vertexFromEyeM(const VertexFrame& frame, Face face, std::int32_t gridU, std::int32_t gridV,
                         std::int32_t step, float skirtDropM = 0);

// Returns the cells of the finest grid between two neighbouring vertices of a chunk.
constexpr std::int32_t fineCellsPerVertex(const PlanetShape& shape, int level) {
    return std::int32_t{1} << (fineGridLog2 - shape.chunkCellsLog2 - level);
}

}  // namespace planet
