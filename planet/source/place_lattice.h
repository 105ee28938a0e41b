// Computes a smooth function of places, such as a projection, on a lattice of a face's grid, and interpolates between its
// points: PROJ is slow, and a raster's projection is almost linear over a few samples. Internal to the library; any thread.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "planet/source/piece_places.h"

namespace planet {

// Computes two values at each place. All spans have the same length. A value depends only on its place.
using PlaceFunction =
    std::function<void(std::span<const double> longitudeRad, std::span<const double> latitudeRad,
                       std::span<double> first, std::span<double> second)>;

// Returns the cells along a face of a lattice for a projection, on which places are interpolated with an error of less
// than 0.002 samples; 0: every place is to be computed, because the filter's grid is hardly finer. filterCells: of the filter's
// grid. samplesPerRad: of the raster.
int latticeCellsFor(int filterCells, double samplesPerRad);

// Computes a function at some places of a piece, whose indices are `wanted`. first and second have room for all places; those
// that are not wanted may get any value. The function is interpolated where it bends by at most `mostBend` over two cells of
// the lattice, and is computed for each place elsewhere, as where the projection is torn or not defined. A value depends
// only on the point of the cube and on latticeCells, not on the piece, the face or the grid's spacing.
void overPiece(const PiecePlaces& places, std::span<const std::size_t> wanted, int latticeCells,
               double mostBend, const PlaceFunction& function, std::span<double> first,
               std::span<double> second);

}  // namespace planet
