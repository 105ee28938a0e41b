// Computes the latitudes and longitudes of rows of a face's grid, many samples at a time. Internal to the
// library.
#pragma once

#include <span>
#include <vector>

#include "planet/sphere/cube_sphere.h"

namespace planet {

// Latitude, longitude and cos(latitude) of a row's samples. All three spans have the same length.
struct GeographicRow {
    std::span<double> longitudeRad;  // [-pi, pi]; 0 at a pole
    std::span<double> latitudeRad;   // [-pi/2, pi/2]
    std::span<double> ring;          // cos(latitude), [0, 1], exact to the last digits even at the poles
};

// Some columns of a face's grid of (faceCells + 1)^2, for whose rows places are computed. Any thread.
//
// Each value depends only on its point of the cube, by the same operations in any row and from any face, so
// it is bit-identical. The error is a few times 4e-16 rad.
class GeographicColumns {
public:
    // Columns firstColumn, firstColumn + 1, ..., `count` of them.
    GeographicColumns(Face face, int faceCells, int firstColumn, int count);

    // Fills out, whose spans have `count` values, for the columns' samples of a row.
    void placesOfRow(int row, const GeographicRow& out) const;

private:
    Face face_;
    double perCell_;
    std::vector<double> u_;       // of the columns
    std::vector<double> vScale_;  // of Nowell's mapping along v, which depends on the column alone
};

}  // namespace planet
