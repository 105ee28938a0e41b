// worldy_netcdf FILE: copies the bands of a netCDF file to the descriptor 3 as a GeoTIFF. It is a program of its own because
// the libraries that read netCDF crash on damaged files: the program that starts it then still runs (../netcdf_copy.h).
#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "planet/raster/netcdf_format.h"
#include "planet/raster/raster_limits.h"

namespace {

using namespace planet;

constexpr rlim_t mostMemory = rlim_t{4} << 30;  // bytes
// A damaged file can keep its library busy for ever. This is many times what whole files take.
constexpr rlim_t openingS = 60;             // CPU time
constexpr rlim_t samplesASecond = 200'000;  // of CPU time

struct Closer {
    void operator()(GDALDatasetH dataSet) const { GDALClose(dataSet); }
};
using OpenDataSet = std::unique_ptr<void, Closer>;

void limit(__rlimit_resource resource, rlim_t most) {
    rlimit limits{};
    ::getrlimit(resource, &limits);
    limits.rlim_cur = std::min(most, limits.rlim_max);
    ::setrlimit(resource, &limits);
}

// Ends with the program that started this one, and before a damaged file takes all memory or time.
void limitProcess() {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, openingS);
    if (WORLDY_LIMIT_MEMORY) limit(RLIMIT_AS, mostMemory);
}

int fail(int code, const std::string& why) {
    std::fputs(why.c_str(), stderr);
    return code;
}

int failAsGdalSays(const char* otherwise) {
    const std::string message = CPLGetLastErrorMsg();
    return fail(netcdfUnreadable, message.empty() ? otherwise : message);
}

void prepareGdal() {
    // GDAL would write a file beside the netCDF file.
    CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
    CPLSetConfigOption("PROJ_NETWORK", "OFF");
    GDALAllRegister();
    GDALSetCacheMax64(GIntBig{256} << 20);
    CPLPushErrorHandler(CPLQuietErrorHandler);
}

std::string sizeText(GDALDatasetH dataSet) {
    return fmt::format("is {} x {} samples", GDALGetRasterXSize(dataSet), GDALGetRasterYSize(dataSet));
}

// Returns why a data set is not copied; empty if it is.
std::string refusal(GDALDatasetH dataSet, const char* file) {
    if (GDALGetRasterCount(dataSet) < 1)
        return "holds no single raster, but a group of them; expected a file with one band of heights";
    const int width = GDALGetRasterXSize(dataSet);
    const int height = GDALGetRasterYSize(dataSet);
    if (width < 1 || height < 1 || width > mostRasterSide || height > mostRasterSide)
        return fmt::format("{}; expected [1, {}] per side", sizeText(dataSet), mostRasterSide);
    const std::int64_t samples = std::int64_t{width} * height;
    if (samples > mostRasterSamples)
        return fmt::format("{}; expected at most 2^38 in all", sizeText(dataSet));
    std::error_code problem;
    const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file, problem));
    if (problem || samples <= mostSamplesIn(bytes)) return {};
    return fmt::format("{} in a file of {} bytes; expected at most {} samples in it", sizeText(dataSet),
                       bytes, mostSamplesIn(bytes));
}

// A lossless compression that is fast enough not to make the copy slower.
const char* predictorFor(GDALDataType type) {
    if (type == GDT_Float32 || type == GDT_Float64) return "PREDICTOR=3";
    return type == GDT_Byte ? "PREDICTOR=1" : "PREDICTOR=2";
}

OpenDataSet copyTo(const char* path, GDALDatasetH from) {
    const char* const predictor = predictorFor(GDALGetRasterDataType(GDALGetRasterBand(from, 1)));
    const std::array<const char*, 7> options = {"TILED=YES", "COMPRESS=ZSTD",    "ZSTD_LEVEL=1",
                                                predictor,   "BIGTIFF=IF_SAFER", "NUM_THREADS=ALL_CPUS",
                                                nullptr};
    return OpenDataSet(
        GDALCreateCopy(GDALGetDriverByName("GTiff"), path, from, FALSE, options.data(), nullptr, nullptr));
}

// GeoTIFF cannot express all reference systems, so the copy also has its text.
bool addReferenceSystem(GDALDatasetH copy, GDALDatasetH from) {
    const OGRSpatialReferenceH system = GDALGetSpatialRef(from);
    char* text = nullptr;
    const std::array<const char*, 2> options = {"FORMAT=WKT2_2018", nullptr};
    if (!system || OSRExportToWktEx(system, &text, options.data()) != OGRERR_NONE) {
        CPLFree(text);
        return true;
    }
    const CPLErr status = GDALSetMetadataItem(copy, netcdfCrsItem, text, netcdfDomain);
    CPLFree(text);
    return status == CE_None;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return fail(netcdfRefused, "expected the path of one netCDF file");
    limitProcess();
    prepareGdal();
    const char* const file = arguments[1];
    const std::array<const char*, 2> netcdfOnly = {"netCDF", nullptr};
    const OpenDataSet from(
        GDALOpenEx(file, GDAL_OF_RASTER | GDAL_OF_READONLY, netcdfOnly.data(), nullptr, nullptr));
    if (!from) return failAsGdalSays("truncated or damaged");
    const std::string refused = refusal(from.get(), file);
    if (!refused.empty()) return fail(netcdfRefused, refused);
    const auto samples = static_cast<rlim_t>(GDALGetRasterXSize(from.get())) *
                         static_cast<rlim_t>(GDALGetRasterYSize(from.get())) *
                         static_cast<rlim_t>(GDALGetRasterCount(from.get()));
    limit(RLIMIT_CPU, openingS + samples / samplesASecond);
    CPLErrorReset();
    OpenDataSet copy = copyTo(fmt::format("/proc/self/fd/{}", netcdfCopyDescriptor).c_str(), from.get());
    if (!copy || !addReferenceSystem(copy.get(), from.get())) return failAsGdalSays("cannot be copied");
    copy.reset();
    if (CPLGetLastErrorType() >= CE_Failure) return failAsGdalSays("cannot be copied");
    return 0;
}
