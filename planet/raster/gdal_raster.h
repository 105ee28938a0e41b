// Reads the first band of georeferenced rasters with GDAL, in metres. Only the formats on a list are opened:
// none of them fetches anything from a network. Internal to the library.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_source_settings.h"
#include "planet/raster/raster.h"

namespace planet {

// Returns whether GDAL recognises a file as a raster in one of the formats on the list. The file may still be
// unusable.
bool isGdalRaster(const std::filesystem::path& path);

// A raster that GDAL reads. Each thread that reads borrows a data set of its own. At most 64 idle data
// sets of the whole process stay open, so that a mosaic of thousands of files does not use up the process's
// file descriptors.
class GdalRaster : public Raster {
public:
    // Opens a raster. The Error says that the file is unreadable, has no coordinate reference system or
    // position, or that its samples are no heights. settings: units, offset and no-data value as in
    // HeightSourceSettings.
    static Result<std::shared_ptr<const Raster>> open(const std::filesystem::path& path,
                                                      const HeightSourceSettings& settings);
    ~GdalRaster() override;

    // Missing samples are those with the no-data value, those that a mask or alpha hides, and those without a finite
    // height.
    Result<std::vector<float>> readBlock(int blockX, int blockY) const override;

private:
    GdalRaster() = default;

    bool hasMask_ = false;
};

}  // namespace planet
