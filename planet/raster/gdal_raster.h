// Reads the first band of georeferenced rasters with GDAL, in metres. Only the formats on a list are opened:
// none of them fetches anything from a network. Internal to the library.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/height_source_settings.h"

namespace planet {

struct RasterLayout {
    int width = 0;  // samples, [1, 2^22]
    int height = 0;
    int blockWidth = 0;  // samples that are decoded together; the last blocks of a row or column are cut off
    int blockHeight = 0;
    // Maps a sample's (column, row) to the coordinates of its centre in the reference system: x = x[0] + x[1]
    // column + x[2] row, and y likewise.
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    std::string crs;              // the horizontal coordinate reference system as WKT 2
    std::string crsName;          // "WGS 84 / UTM zone 19S"
    std::string typeName;         // "int16"
    HeightConversion conversion;  // from floats, which hold the values of all types that heights need
    double stepM = 0;             // of an integer raster, metres; 0 for floats
};

// Returns whether GDAL recognises a file as a raster in one of the formats on the list. The file may still be
// unusable.
bool isGdalRaster(const std::filesystem::path& path);

// An open raster. Several threads may read at once; each borrows a data set of its own. At most 64 idle data
// sets of the whole process stay open, so that a mosaic of thousands of files does not use up the process's
// file descriptors.
class GdalRaster {
public:
    // Opens a raster. The Error says that the file is unreadable, has no coordinate reference system or
    // position, or that its samples are no heights. settings: units, offset and no-data value as in
    // HeightSourceSettings.
    static Result<std::shared_ptr<const GdalRaster>> open(const std::filesystem::path& path,
                                                          const HeightSourceSettings& settings);
    ~GdalRaster();
    GdalRaster(const GdalRaster&) = delete;
    GdalRaster& operator=(const GdalRaster&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const RasterLayout& layout() const { return layout_; }

    // Reads a block as heights in metres, row-major, with NaN for missing samples: those with the no-data
    // value, those that a mask or alpha hides, and those without a finite height. The last blocks of a row
    // or column are narrower or lower. The Error names the file and the block.
    Result<std::vector<float>> readBlock(int blockX, int blockY) const;

private:
    GdalRaster() = default;

    std::filesystem::path path_;
    RasterLayout layout_;
    bool hasMask_ = false;
};

}  // namespace planet
