// Defines how the program that copies netCDF files and the one that starts it talk to each other.
#pragma once

namespace planet {

constexpr const char* netcdfProgram = "worldy_netcdf";
constexpr int netcdfCopyDescriptor = 3;  // the file that is written
constexpr int netcdfRefused =
    1;  // the exit code if the file is no netCDF that can be copied; stderr says why
constexpr int netcdfUnreadable = 2;  // the exit code if the file cannot be read; stderr says why

// The metadata of the copy with the coordinate reference system, as WKT.
constexpr const char* netcdfDomain = "WORLDY";
constexpr const char* netcdfCrsItem = "CRS";

}  // namespace planet
