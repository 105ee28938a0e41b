// The formats that GDAL reads for planets. Only those on a list are opened: none of them fetches anything from a network,
// and a VRT may only name files beside it (vrt_file.h). A copy of a netCDF file is opened instead of the file
// (netcdf_copy.h). The drivers of all other formats are removed from GDAL for the
// whole process. Internal to the library.
#pragma once

#include <cpl_error.h>
#include <gdal.h>

#include <filesystem>
#include <memory>
#include <string>

namespace planet {

struct DataSetCloser {
    void operator()(GDALDatasetH dataSet) const { GDALClose(dataSet); }
};
using DataSet = std::unique_ptr<void, DataSetCloser>;

// Keeps GDAL's messages of this thread from the terminal while it exists; the last one can be asked for.
struct QuietErrors {
    QuietErrors() {
        CPLPushErrorHandler(CPLQuietErrorHandler);
        CPLErrorReset();
    }
    ~QuietErrors() { CPLPopErrorHandler(); }
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;
    static std::string lastMessage() {
        const std::string message = CPLGetLastErrorMsg();
        return message.empty() ? "truncated or damaged" : message;
    }
};

// Returns whether a file is netCDF, or GDAL recognises it as a raster in one of the formats on the list. The file may still be
// unusable.
bool isGdalRaster(const std::filesystem::path& path);
// Returns whether GDAL recognises a file as a VRT.
bool isVrtFile(const std::filesystem::path& path);

// Returns whether GDAL finds one band in a file, and the coordinates of its samples.
bool isPlacedBand(const std::filesystem::path& path);

// Opens a file, or the text of a VRT that was checked; null if it cannot be read.
DataSet openDataSet(const std::string& name, bool isVrt);

}  // namespace planet
