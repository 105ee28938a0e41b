// Puts an image without a position of its own on the ground, such as a game's heightmap. Internal to the library.
#pragma once

#include <filesystem>
#include <memory>

#include "planet/base/result.h"
#include "planet/raster/height_source_settings.h"
#include "planet/raster/raster.h"

namespace planet {

// A rectangle on the ground. The middle of the image lies at a place, and its samples are the points of a grid of
// squares.
struct ImagePlace {
    double latitudeDeg = 0;   // geodetic, [-90, 90]
    double longitudeDeg = 0;  // [-360, 360]
    double widthM = 0;        // from the first sample of a row to its last one, (0, 1e9]
    double headingDeg = 0;    // of the image's up direction, clockwise from north, [-360, 360]
};

// Opens an image, or a headerless file of 16-bit samples (.raw, .r16) in rows from the top, of settings.rawSize samples
// per side, or settings.rawRows rows of so many; without it the file must be square.
//
// The grid lies in a Lambert azimuthal equal-area projection of a sphere around the place. A sample has the same area
// everywhere, so one spacing of the leaves suits the whole image. The Error says that the file is unreadable, that it
// has a position of its own, or that the rectangle does not fit on a hemisphere.
Result<std::shared_ptr<const Raster>> openPlacedImage(const std::filesystem::path& path,
                                                      const ImagePlace& place, double radiusM,
                                                      const HeightSourceSettings& settings);

}  // namespace planet
