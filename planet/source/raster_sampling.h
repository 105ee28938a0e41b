// Samples mosaics of rasters at the places of a piece of a face's grid. Internal to the library; any thread.
//
// The filter is that of height_filter.h, in the mosaic's own grid, stretched along its rows and its columns to
// the spacing of the face's grid. A mosaic that is more than four times as fine is reduced first, by means of
// pairs of samples. A place is covered if the sample nearest to it has a height. Samples without a height have
// no weight in the filter: the rest, without the kernel's negative parts, is made to sum to 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/raster_area.h"
#include "planet/source/height_source_types.h"
#include "planet/source/piece_places.h"

namespace planet {

// The places of a piece that lie on a tile of a mosaic, and where on its grid. Columns are those of the turn
// around the middle of the mosaic.
struct PlacesOnGrid {
    std::vector<std::size_t> index;  // in the piece, ascending
    std::vector<double> column;
    std::vector<double> row;
};
PlacesOnGrid placesOnGrid(const RasterArea& area, const PiecePlaces& places);

// A sample of a mosaic's grid.
struct GridCell {
    std::int64_t column = 0;
    std::int64_t row = 0;
};
// Returns the sample nearest to a place on a mosaic. A place on its outer edge belongs to the outermost sample.
GridCell nearestSample(const RasterMosaic& mosaic, double column, double row);

// Fills in the heights of a piece that are still NaN, in metres, where the area covers their places.
Result<void> fillFrom(const RasterArea& area, const PiecePlaces& places, const PlacesOnGrid& onGrid,
                      std::span<float> heightsM);

// Interpolates the heights that are still NaN from those around them: from means of 2 x 2, 4 x 4, ... samples, the
// finer ones where they have heights. Gaps between the tiles are no voids.
Result<void> fillVoids(const RasterArea& area, const PlacesOnGrid& onGrid, std::span<float> heightsM);

}  // namespace planet
