// The placement of an equirectangular image of the whole planet, by its GeoTIFF tags or else by its size.
// Internal to the library. Pure functions, any thread.
#pragma once

#include <string>

#include "planet/base/result.h"
#include "planet/raster/geo_tags.h"

namespace planet {

// The placement of an image with north up and columns that go east.
struct ImagePlacement {
    int period = 0;         // columns once around: the width, or 1 less if the last column repeats the first
    double zeroColumn = 0;  // the column of longitude 0, [-0.5, period - 0.5)
    bool hasPoleRows = false;  // the first and last rows lie on the poles; otherwise half a row from them

    bool operator==(const ImagePlacement&) const = default;
};

// Returns the placement of samples at pixel centres from longitude -180 to 180.
ImagePlacement centredPlacement(int width);

// Returns the placement by the tags, or else by the size. 2 n + 1 by n + 1 samples, or 2 n by n + 1, are
// points of a grid that begins at longitude -180 on the north pole. An image about twice as wide as high has
// its samples at pixel centres. The Error names the file and the area that it covers; expected is an image of
// the whole planet, north up.
Result<ImagePlacement> placementOf(const std::string& file, int width, int height, const GeoTags& tags);

// Returns "equirectangular", followed by the placement unless samples are at pixel centres from longitude
// -180 to 180.
std::string placementText(const ImagePlacement& placement, int width);

}  // namespace planet
