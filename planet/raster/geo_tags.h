// Reads the metadata of an image's samples: their placement, the value that marks missing samples, and the
// scale from values to heights. It is in the tags of a GeoTIFF, which OpenImageIO 2.4 does not pass on, and
// in the ESRI world file or .aux.xml next to an image. Internal to the library; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/result.h"

namespace planet {

// The kind of the model coordinates; x points east and y points north.
enum class GeoModel : std::uint8_t {
    Degrees,  // longitude and latitude; also if the file does not say
    Metres,   // along the equator and the meridians of an equirectangular projection
    Other     // any other projection or unit
};

struct GeoPlacement {
    GeoModel model = GeoModel::Degrees;
    std::string modelText;                  // such as "projected coordinates, EPSG 32633", for messages
    std::string from = "its GeoTIFF tags";  // where this was found, for messages
    double metresPerDegree = 0;             // if model is Metres
    // Maps a sample's (column, row) to its centre: x = x[0] + x[1] column + x[2] row, and y likewise.
    std::array<double, 3> x{};
    std::array<double, 3> y{};

    bool operator==(const GeoPlacement&) const = default;
};

struct GeoTags {
    std::optional<GeoPlacement> placement;
    std::optional<double> noDataValue;  // GDAL_NODATA; NaN is omitted, because it is always missing
    // The height of a sample of the first band is (offset + scale * value) units.
    std::optional<double> scale;
    std::optional<double> offset;
    std::string unit;  // "m", "ft"; empty: unknown

    bool operator==(const GeoTags&) const = default;
};

// Returns the tags of an image, completed from the files next to it: an ESRI world file (.tfw, .pgw, .jgw, .wld and
// similar) or GDAL's .aux.xml. isTiff: the file itself has tags.
Result<GeoTags> geoTagsOf(const std::filesystem::path& image, bool isTiff);

// Reads the tags of a TIFF file. The Error says that the file cannot be read, or that its tags are
// inconsistent.
Result<GeoTags> readGeoTags(const std::filesystem::path& path);

}  // namespace planet
