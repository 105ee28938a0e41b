#include "planet/raster/gdal_formats.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <string_view>
#include <system_error>

#include "planet/raster/netcdf_copy.h"

namespace planet {

namespace {

constexpr int gdalCacheBytes = 8 << 20;  // heights are cached after conversion

// A VRT is opened only after a check of what it names, and netCDF only in another process (netcdf_copy.h).
constexpr std::array<const char*, 2> vrtOnly = {"VRT", nullptr};
constexpr std::array<const char*, 14> formats = {
    "GTiff", "SRTMHGT", "DTED",    "AAIGrid", "GRASSASCIIGrid", "JP2OpenJPEG", "ENVI", "EHdr",
    "HFA",   "BIL",     "USGSDEM", "PNG",     "JPEG",           nullptr};

bool isListed(const char* driver) {
    const auto is = [&](const char* name) { return name && std::string_view(name) == driver; };
    return std::ranges::any_of(formats, is) || std::ranges::any_of(vrtOnly, is);
}

// Removes all other drivers: a file that GDAL opens because another one names it can use any that is registered.
void removeOtherDrivers() {
    for (int i = GDALGetDriverCount() - 1; i >= 0; --i) {
        const GDALDriverH driver = GDALGetDriver(i);
        if (isListed(GDALGetDriverShortName(driver))) continue;
        GDALDeregisterDriver(driver);
        GDALDestroyDriver(driver);
    }
}

// Makes GDAL initialise its reader of TIFF now, and puts libtiff's message handlers back that it replaces: without
// its own, OpenImageIO does not notice a truncated file.
void registerFormats() {
    const TIFFErrorHandler errors = TIFFSetErrorHandler(nullptr);
    const TIFFErrorHandler warnings = TIFFSetWarningHandler(nullptr);
    GDALAllRegister();
    removeOtherDrivers();
    constexpr const char* inMemory = "/vsimem/worldy-first.tif";
    GDALClose(GDALCreate(GDALGetDriverByName("GTiff"), inMemory, 1, 1, 1, GDT_Byte, nullptr));
    VSIUnlink(inMemory);
    TIFFSetErrorHandler(errors);
    TIFFSetWarningHandler(warnings);
}

void prepareGdal() {
    static std::once_flag once;
    std::call_once(once, [] {
        const QuietErrors quiet;
        registerFormats();
        GDALSetCacheMax(gdalCacheBytes);
        // GDAL would list the folder of each file, which takes long for a folder of ten thousand tiles.
        CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
        // A truncated file is an error instead of zeros.
        CPLSetConfigOption("GTIFF_IGNORE_READ_ERRORS", "FALSE");
        CPLSetConfigOption("RAW_CHECK_FILE_SIZE", "YES");
        CPLSetConfigOption("PROJ_NETWORK", "OFF");
        // No file system of a network opens a file of another name than this.
        CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", "none");
        CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
    });
}

bool isFileOf(const char* const* drivers, const std::filesystem::path& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) return false;
    prepareGdal();
    const QuietErrors quiet;
    return GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, drivers, nullptr) != nullptr;
}

}  // namespace

DataSet openDataSet(const std::string& name, bool isVrt) {
    prepareGdal();
    return DataSet(GDALOpenEx(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                              isVrt ? vrtOnly.data() : formats.data(), nullptr, nullptr));
}

bool isGdalRaster(const std::filesystem::path& path) {
    return isNetcdf(path) || isFileOf(formats.data(), path) || isFileOf(vrtOnly.data(), path);
}

bool isVrtFile(const std::filesystem::path& path) {
    return isFileOf(vrtOnly.data(), path);
}

bool isPlacedBand(const std::filesystem::path& path) {
    const QuietErrors quiet;
    const DataSet dataSet = openDataSet(path.string(), false);
    std::array<double, 6> corner{};
    return dataSet && GDALGetRasterCount(dataSet.get()) == 1 &&
           GDALGetGeoTransform(dataSet.get(), corner.data()) == CE_None &&
           std::ranges::all_of(corner, [](double number) { return std::isfinite(number); });
}

}  // namespace planet
