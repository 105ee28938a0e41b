// Checks GDAL's virtual rasters (VRT), which can name any file, address or program: only plain mosaics of rasters beside
// them pass. Internal to the library.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/netcdf_copy.h"

namespace planet {

struct VrtFile {
    std::string xml;  // what GDAL opens, with the absolute paths of its sources or of their copies
    std::vector<std::filesystem::path> sources;             // each once
    std::vector<std::shared_ptr<const NetcdfCopy>> copies;  // what the text names instead of netCDF files
};

// Reads a VRT of at most 16 MiB and 2^20 sources. It may only have bands of SimpleSource and ComplexSource. Each source
// must be a raster in one of the formats on the list, no VRT itself, in the folder of the VRT or below it, after links
// are resolved. The Error says what else was found.
Result<VrtFile> checkedVrt(const std::filesystem::path& path);

}  // namespace planet
