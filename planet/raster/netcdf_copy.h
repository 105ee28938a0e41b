// Opens netCDF files by copying them. The libraries that read netCDF and the HDF5 in it crash on damaged files, so another
// process, worldy_netcdf (netcdf/netcdf_program.cpp), reads the file and copies it to a temporary GeoTIFF. If that process
// crashes, the file is refused. Internal to the library.
#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include "planet/base/open_file.h"
#include "planet/base/result.h"

namespace planet {

// A nameless GeoTIFF, which disappears with this object, even if the program is killed.
struct NetcdfCopy {
    std::shared_ptr<const OpenFile> file;
    std::string name;  // what GDAL opens
};

// Returns whether a file begins as netCDF does.
bool isNetcdf(const std::filesystem::path& path);

// Returns a copy of all bands of a netCDF file with their position, units, scale, offset and no-data value. Waits for the
// other process, which reads the whole file. Any thread; threads that ask for the same file share a copy, and the last one
// is kept, because a file is often opened several times in a row. The Error names the file, or the temporary folder; if
// `stop` is requested, it says that the copy was cancelled. program: the program that copies; the tests give others.
Result<std::shared_ptr<const NetcdfCopy>> copyOfNetcdf(const std::filesystem::path& path,
                                                       const std::stop_token& stop = {});
Result<std::shared_ptr<const NetcdfCopy>> copyOfNetcdf(const std::filesystem::path& path,
                                                       const std::stop_token& stop,
                                                       const std::filesystem::path& program);

// Returns the coordinate reference system that a copy says its original has, as WKT; empty if it says none. GeoTIFF cannot
// express all that netCDF can. dataSet: of GDAL, the copy.
std::string netcdfReferenceSystem(void* dataSet);

}  // namespace planet
