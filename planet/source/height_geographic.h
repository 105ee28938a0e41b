// Computes the latitudes and longitudes of a row of a face's grid, many samples at a time. Internal to the
// library.
#pragma once

#include <span>

#include "planet/sphere/cube_sphere.h"

namespace planet {

// Latitude, longitude and cos(latitude) of a row's samples. All three spans have the same length.
struct GeographicRow {
    std::span<double> longitudeRad;  // [-pi, pi]; 0 at a pole
    std::span<double> latitudeRad;   // [-pi/2, pi/2]
    std::span<double> ring;          // cos(latitude), [0, 1], exact to the last digits even at the poles
};

// Fills out for samples firstColumn, firstColumn + 1, ... of a row of a face's grid of (faceCells + 1)^2.
// Each value depends only on its point of the cube, by the same operations in any row and from any face, so
// it is bit-identical. The error is a few times 4e-16 rad. Any thread.
void geographicRow(Face face, int faceCells, int firstColumn, int row, const GeographicRow& out);

}  // namespace planet
