// The tags of a GeoTIFF: where its samples lie, and which value means that one is missing. OpenImageIO 2.4
// does not pass them on. Internal to the library. Any thread.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "planet/base/result.h"

namespace planet {

// The kind of the model coordinates; x points east and y points north.
enum class GeoModel : std::uint8_t {
    Degrees,  // longitude and latitude; also where the file does not say
    Metres,   // along the equator and the meridians of an equirectangular projection
    Other     // any other projection or unit
};

struct GeoPlacement {
    GeoModel model = GeoModel::Degrees;
    std::string modelText;       // "projected coordinates, EPSG 32633", for messages
    double metresPerDegree = 0;  // of Metres
    // Maps a sample's (column, row) to its centre: x = x[0] + x[1] column + x[2] row, likewise y.
    std::array<double, 3> x{};
    std::array<double, 3> y{};
};

struct GeoTags {
    std::optional<GeoPlacement> placement;
    std::optional<double> noDataValue;  // GDAL_NODATA; NaN is left out, since it is missing anyway
};

// The tags of a TIFF file; an Error where it cannot be read or its tags contradict themselves.
Result<GeoTags> readGeoTags(const std::filesystem::path& path);

}  // namespace planet
