// Reads georeferenced rasters with GDAL (gdal_formats.h): the first band as heights in metres, or one channel of a
// picture. Internal to the library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_source_settings.h"
#include "planet/raster/raster.h"

namespace planet {

struct NetcdfCopy;

// A raster that GDAL reads. Each thread that reads borrows a data set of its own. At most 64 idle data
// sets of the whole process stay open, so that a mosaic of thousands of files does not use up the process's
// file descriptors.
class GdalRaster : public Raster {
public:
    // Opens a raster. The Error says that the file is unreadable, has no coordinate reference system or
    // position, or that its samples are no heights. settings: units, offset, no-data value and colour channel as in
    // HeightSourceSettings; bands are chosen by what the file says of their colours.
    static Result<std::shared_ptr<const GdalRaster>> open(const std::filesystem::path& path,
                                                          const HeightSourceSettings& settings);
    ~GdalRaster() override;

    // Returns the name that GDAL opens: the path, that of a copy (netcdf_copy.h) or, for a VRT, its checked text
    // (vrt_file.h).
    const std::string& gdalName() const { return gdalName_; }
    bool isVrt() const { return isVrt_; }
    // Returns whether a mask or alpha can hide samples.
    bool hidesSamples() const { return hasMask_ || alphaBand_ > 0; }

    // Missing samples are those with the no-data value, those that a mask or alpha hides, and those without a finite
    // height.
    Result<std::vector<float>> readBlock(int blockX, int blockY) const override;
    bool isEmpty(int blockX, int blockY) const override;

private:
    GdalRaster() = default;
    void chooseBands(void* dataSet, int channel);
    bool readMask(void* dataSet, int x, int y, int width, int height, std::vector<std::uint8_t>& mask) const;
    bool readPalette(void* dataSet, std::vector<float>& values) const;
    bool readVoids(void* dataSet, int x, int y, int width, int height, std::vector<std::uint8_t>& mask) const;

    std::string gdalName_;
    std::vector<std::shared_ptr<const NetcdfCopy>> copies_;  // what gdalName_ names instead of netCDF files
    bool isVrt_ = false;
    bool hasMask_ = false;
    int alphaBand_ = 0;  // of a type that GDAL makes no mask of; 0: none
    int band_ = 1;
    bool hasNoData_ = false;  // heights with a no-data value
    bool isPalette_ = false;  // the band holds indices of a colour table
    int channel_ = 0;         // of a colour of the table
    // A pixel of a picture is missing if all of these bands have the file's no-data value.
    std::vector<int> voidBands_;
    double voidValue_ = 0;
};

}  // namespace planet
