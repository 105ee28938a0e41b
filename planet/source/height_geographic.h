// Where a row of a face's grid lies on the sphere, many samples at a time. Internal to the library.
#pragma once

#include <span>

#include "planet/sphere/cube_sphere.h"

namespace planet {

// Latitude and longitude of a row's samples, beside cos(latitude). All three spans have the same length.
struct GeographicRow {
    std::span<double> longitudeRad;  // [-pi, pi]; 0 at a pole
    std::span<double> latitudeRad;   // [-pi/2, pi/2]
    std::span<double> ring;          // cos(latitude), [0, 1], exact to the last digits at the poles too
};

// Samples firstColumn, firstColumn + 1, ... of row `row` of a face's grid of (faceCells + 1)^2. Each is
// computed from its point of the cube alone, in the same operations wherever it stands in a row and whichever
// face it is asked through, so it comes out bit-identical. Within 4e-16 rad times a few of exact. Any thread.
void geographicRow(Face face, int faceCells, int firstColumn, int row, const GeographicRow& out);

}  // namespace planet
