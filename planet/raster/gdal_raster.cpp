#include "planet/raster/gdal_raster.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include "planet/base/try.h"
#include "planet/raster/gdal_formats.h"
#include "planet/raster/geo_tags.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/netcdf_copy.h"
#include "planet/raster/raster_limits.h"
#include "planet/raster/vrt_file.h"

namespace planet {

namespace {

constexpr int leastBlockSide = 128;                    // samples; smaller blocks of a file are read together
constexpr std::int64_t mostBlockSamples = 16LL << 20;  // a larger block could not be read in bounded memory
constexpr std::size_t mostIdle = 64;                   // data sets

struct SpatialReferenceReleaser {
    void operator()(OGRSpatialReferenceH reference) const { OSRRelease(reference); }
};
using SpatialReference = std::unique_ptr<void, SpatialReferenceReleaser>;

// The data sets that no thread is reading, the most recently used first.
class IdleDataSets {
public:
    DataSet borrow(const GdalRaster* raster) {
        {
            const std::lock_guard lock(mutex_);
            const auto found = std::ranges::find(idle_, raster, &Entry::raster);
            if (found != idle_.end()) {
                DataSet dataSet = std::move(found->dataSet);
                idle_.erase(found);
                return dataSet;
            }
        }
        return openDataSet(raster->gdalName(), raster->isVrt());
    }
    void giveBack(const GdalRaster* raster, DataSet dataSet) {
        DataSet oldest;  // closed without the lock
        const std::lock_guard lock(mutex_);
        idle_.push_front({raster, std::move(dataSet)});
        if (idle_.size() <= mostIdle) return;
        oldest = std::move(idle_.back().dataSet);
        idle_.pop_back();
    }
    void close(const GdalRaster* raster) {
        const std::lock_guard lock(mutex_);
        idle_.remove_if([&](const Entry& entry) { return entry.raster == raster; });
    }

private:
    struct Entry {
        const GdalRaster* raster;
        DataSet dataSet;
    };
    std::mutex mutex_;
    std::list<Entry> idle_;
};

IdleDataSets& idleDataSets() {
    static IdleDataSets sets;
    return sets;
}

// A type of samples that is read.
struct ReadType {
    GDALDataType gdal;
    SampleType type;
    const char* name;
};
constexpr std::array<ReadType, 7> readTypes = {{{GDT_Byte, SampleType::Uint8, "uint8"},
                                                {GDT_UInt16, SampleType::Uint16, "uint16"},
                                                {GDT_Int16, SampleType::Int16, "int16"},
                                                {GDT_UInt32, SampleType::Uint32, "uint32"},
                                                {GDT_Int32, SampleType::Int32, "int32"},
                                                {GDT_Float32, SampleType::Float, "float"},
                                                {GDT_Float64, SampleType::Double, "double"}}};

bool isInteger(SampleType type) {
    return type != SampleType::Float && type != SampleType::Double;
}

// Returns whether a sample of a type can have a value. GDAL returns 0 where a file stores nothing if its no-data value is
// none of its type, such as -9999 of unsigned samples.
bool canHold(SampleType type, std::optional<double> value) {
    if (!value || !isInteger(type)) return true;
    const auto bits = static_cast<int>(8 * bytesOf(type));
    const bool isSigned = type == SampleType::Int8 || type == SampleType::Int16 || type == SampleType::Int32;
    const double least = isSigned ? -std::ldexp(1.0, bits - 1) : 0;
    return *value >= least && *value < least + std::ldexp(1.0, bits);
}

// Returns the bands of a picture in the order red, green and blue; one if it is grey or has a colour table. A file that
// does not say what its bands are has them in that order.
std::vector<int> colourBands(GDALDatasetH dataSet) {
    constexpr std::array channels = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand};
    std::vector<int> bands;
    const int count = GDALGetRasterCount(dataSet);
    for (const GDALColorInterp channel : channels) {
        for (int band = 1; band <= count; ++band) {
            if (GDALGetRasterColorInterpretation(GDALGetRasterBand(dataSet, band)) != channel) continue;
            bands.push_back(band);
            break;
        }
    }
    if (bands.size() == channels.size()) return bands;
    return count >= 3 ? std::vector<int>{1, 2, 3} : std::vector<int>{1};
}

// Checks that the bands of a file are heights.
Result<void> checkHeightBands(const std::string& file, GDALDatasetH dataSet) {
    const int bands = GDALGetRasterCount(dataSet);
    const bool alphaFollows =
        bands == 2 && GDALGetRasterColorInterpretation(GDALGetRasterBand(dataSet, 2)) == GCI_AlphaBand;
    if (bands > 1 && !alphaFollows) {
        return badInput(fmt::format("{}: has {} bands; expected one band of heights", file, bands));
    }
    if (GDALGetRasterColorTable(GDALGetRasterBand(dataSet, 1))) {
        return badInput(fmt::format("{}: holds indices of a colour table; expected heights", file));
    }
    return {};
}

GeoTags bandTags(GDALRasterBandH band) {
    GeoTags tags;
    int given = 0;
    const double noData = GDALGetRasterNoDataValue(band, &given);
    if (given != 0 && !std::isnan(noData)) tags.noDataValue = noData;
    const double scale = GDALGetRasterScale(band, &given);
    if (given != 0) tags.scale = scale;
    const double offset = GDALGetRasterOffset(band, &given);
    if (given != 0) tags.offset = offset;
    tags.unit = GDALGetRasterUnitType(band);
    return tags;
}

Result<void> setPlace(const std::string& file, GDALDatasetH dataSet, RasterLayout& layout) {
    std::array<double, 6> corner{};
    if (GDALGetGeoTransform(dataSet, corner.data()) != CE_None) {
        const char* const instead =
            GDALGetGCPCount(dataSet) > 0 ? "has only ground control points" : "has no position";
        return badInput(
            fmt::format("{}: {}; expected a raster with the coordinates of its samples, such as a GeoTIFF",
                        file, instead));
    }
    // GDAL's coordinates count from the corner of the first sample.
    layout.x = {corner[0] + (corner[1] + corner[2]) / 2, corner[1], corner[2]};
    layout.y = {corner[3] + (corner[4] + corner[5]) / 2, corner[4], corner[5]};
    const bool finite = std::ranges::all_of(corner, [](double n) { return std::isfinite(n); });
    const double area = corner[1] * corner[5] - corner[2] * corner[4];
    if (finite && area != 0 && std::isfinite(1 / area)) return {};
    return badInput(
        fmt::format("{}: the coordinates of its samples lie on one line or are not finite; expected a "
                    "raster with an area",
                    file));
}

// Says which datum the heights of a file have by its reference system.
void setDatum(OGRSpatialReferenceH reference, RasterLayout& layout) {
    if (OSRIsCompound(reference) == 0) {
        if (OSRGetAxesCount(reference) < 3) return;
        layout.verticalName = "ellipsoidal height";
        layout.datum = VerticalDatum::Ellipsoid;
        return;
    }
    const char* const name = OSRGetAttrValue(reference, "VERT_CS", 0);
    layout.verticalName = name && *name != 0 ? name : "an unnamed vertical datum";
    if (layout.verticalName.find("EGM96") != std::string::npos) layout.datum = VerticalDatum::Egm96;
    if (layout.verticalName.find("EGM2008") != std::string::npos) layout.datum = VerticalDatum::Egm2008;
    if (layout.verticalName.find("llipsoid") != std::string::npos) layout.datum = VerticalDatum::Ellipsoid;
}

// Returns the reference system that a copy of a netCDF file keeps as text; null for any other data set.
SpatialReference ownReferenceSystem(GDALDatasetH dataSet) {
    const std::string text = netcdfReferenceSystem(dataSet);
    if (text.empty()) return nullptr;
    SpatialReference system(OSRNewSpatialReference(text.c_str()));
    if (system) OSRSetAxisMappingStrategy(system.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return system;
}

Result<void> setReferenceSystem(const std::string& file, GDALDatasetH dataSet, RasterLayout& layout) {
    const SpatialReference own = ownReferenceSystem(dataSet);
    const OGRSpatialReferenceH found = own ? own.get() : GDALGetSpatialRef(dataSet);
    if (!found || OSRIsLocal(found) != 0) {
        return badInput(
            fmt::format("{}: has no coordinate reference system; expected one in the file or in a .prj file "
                        "beside it",
                        file));
    }
    const SpatialReference reference(OSRClone(found));
    setDatum(reference.get(), layout);
    if (OSRIsCompound(reference.get()) != 0) OSRStripVertical(reference.get());
    const char* const name = OSRGetName(reference.get());
    layout.crsName = name ? name : "unnamed";
    char* text = nullptr;
    const std::array<const char*, 2> options = {"FORMAT=WKT2_2018", nullptr};
    const OGRErr failed = OSRExportToWktEx(reference.get(), &text, options.data());
    if (text) layout.crs = text;
    CPLFree(text);
    if (failed == OGRERR_NONE && !layout.crs.empty()) return {};
    return badInput(
        fmt::format("{}: its coordinate reference system, {}, cannot be understood; expected one that PROJ "
                    "knows",
                    file, layout.crsName));
}

// Returns a multiple of a file's block that has at least the smallest side.
int readTogether(int block, int size) {
    const int several = (leastBlockSide + block - 1) / block * block;
    return std::min(several, size);
}

Result<void> setBlocks(const std::string& file, GDALRasterBandH band, RasterLayout& layout) {
    int width = 0;
    int height = 0;
    GDALGetBlockSize(band, &width, &height);
    layout.blockWidth = readTogether(std::max(width, 1), layout.width);
    layout.blockHeight = readTogether(std::max(height, 1), layout.height);
    const std::int64_t samples = std::int64_t{layout.blockWidth} * layout.blockHeight;
    if (samples <= mostBlockSamples) return {};
    return badInput(fmt::format("{}: has blocks of {} x {} samples; expected at most {} samples in a block",
                                file, width, height, mostBlockSamples));
}

// Returns the bytes of all files of a data set.
std::int64_t fileBytesOf(GDALDatasetH dataSet) {
    std::int64_t bytes = 0;
    char** const files = GDALGetFileList(dataSet);
    for (char** file = files; file && *file; ++file) {
        std::error_code problem;
        const std::uintmax_t size = std::filesystem::file_size(*file, problem);
        if (!problem) bytes += static_cast<std::int64_t>(size);
    }
    CSLDestroy(files);
    return bytes;
}

// Refuses a raster that claims far more samples than its files can hold. Those that a file stores nothing for count only
// if they have a height.
Result<void> checkSampleCount(const std::string& file, GDALDatasetH dataSet, GDALRasterBandH band,
                              const RasterLayout& layout) {
    const std::int64_t samples = std::int64_t{layout.width} * layout.height;
    if (samples <= alwaysRead) return {};
    const std::int64_t bytes = fileBytesOf(dataSet);
    const std::int64_t most = mostSamplesIn(bytes);
    if (samples <= most) return {};
    double storedPercent = 100;
    if (layout.conversion.noDataValue)
        GDALGetDataCoverageStatus(band, 0, 0, layout.width, layout.height, 0, &storedPercent);
    if (storedPercent / 100 * static_cast<double>(samples) <= static_cast<double>(most)) return {};
    return badInput(fmt::format(
        "{}: is {} x {} samples in files of {} bytes; expected at most {} samples in them, besides "
        "empty blocks of a raster with a no-data value",
        file, layout.width, layout.height, bytes, most));
}

Result<RasterLayout> rasterLayoutOf(const std::filesystem::path& path, GDALDatasetH dataSet, int bandNumber,
                                    const HeightSourceSettings& settings) {
    const std::string file = path.string();
    RasterLayout layout;
    layout.width = GDALGetRasterXSize(dataSet);
    layout.height = GDALGetRasterYSize(dataSet);
    const int bands = GDALGetRasterCount(dataSet);
    if (bands < 1) {
        return badInput(
            fmt::format("{}: holds no single raster, but a group of them; expected a file with one band of "
                        "heights",
                        file));
    }
    if (layout.width < 1 || layout.height < 1 || layout.width > mostRasterSide ||
        layout.height > mostRasterSide) {
        return badInput(fmt::format("{}: is {} x {} samples; expected [1, {}] per side", file, layout.width,
                                    layout.height, mostRasterSide));
    }
    if (std::int64_t{layout.width} * layout.height > mostRasterSamples) {
        return badInput(fmt::format("{}: is {} x {} samples; expected at most 2^38 in all", file,
                                    layout.width, layout.height));
    }
    if (!settings.colourChannel) TRY(checkHeightBands(file, dataSet));
    GDALRasterBandH const band = GDALGetRasterBand(dataSet, bandNumber);
    const GDALDataType found = GDALGetRasterDataType(band);
    const auto* const known = std::ranges::find(readTypes, found, &ReadType::gdal);
    if (known == readTypes.end()) {
        return badInput(
            fmt::format("{}: has samples of type {}; expected integers of 8 to 32 bits, float or double",
                        file, GDALGetDataTypeName(found)));
    }
    layout.typeName = known->name;
    TRY(setPlace(file, dataSet, layout));
    TRY(setReferenceSystem(file, dataSet, layout));
    TRY(setBlocks(file, band, layout));
    // GDAL returns floats. The colours of a picture depend on the type in the file, and those of a colour table have 8
    // bits.
    SampleType type = SampleType::Float;
    if (settings.colourChannel) type = GDALGetRasterColorTable(band) ? SampleType::Uint8 : known->type;
    TRY_ASSIGN(layout.conversion, conversionFor(file, settings, type, bandTags(band)));
    if (!canHold(known->type, layout.conversion.noDataValue)) layout.conversion.noDataValue.reset();
    layout.conversion.type = SampleType::Float;
    layout.conversion.fillM = std::numeric_limits<float>::quiet_NaN();
    TRY(checkSampleCount(file, dataSet, band, layout));
    if (isInteger(known->type)) layout.stepM = std::abs(layout.conversion.metresPerUnit);
    return layout;
}

// Returns the number of the band that says how opaque samples are; 0 if there is none.
int alphaBandOf(GDALDatasetH dataSet) {
    for (int band = 1; band <= GDALGetRasterCount(dataSet); ++band) {
        if (GDALGetRasterColorInterpretation(GDALGetRasterBand(dataSet, band)) == GCI_AlphaBand) return band;
    }
    return 0;
}

bool hasMaskBand(GDALDatasetH dataSet, int band) {
    const int flags = GDALGetMaskFlags(GDALGetRasterBand(dataSet, band));
    return (flags & (GMF_ALL_VALID | GMF_NODATA)) == 0;
}

}  // namespace

Result<std::shared_ptr<const GdalRaster>> GdalRaster::open(const std::filesystem::path& path,
                                                           const HeightSourceSettings& settings) {
    std::error_code problem;
    if (!std::filesystem::exists(path, problem))
        return ioError(fmt::format("{}: no such file", path.string()));
    if (!std::filesystem::is_regular_file(path, problem)) {
        return badInput(fmt::format("{}: is not a file", path.string()));
    }
    const QuietErrors quiet;
    const std::shared_ptr<GdalRaster> raster(new GdalRaster);
    raster->path_ = path;
    raster->gdalName_ = path.string();
    if (isNetcdf(path)) {
        TRY_ASSIGN(auto copy, copyOfNetcdf(path, settings.stop));
        raster->gdalName_ = copy->name;
        raster->copies_.push_back(std::move(copy));
    } else if (isVrtFile(path)) {
        TRY_ASSIGN(auto vrt, checkedVrt(path));
        raster->isVrt_ = true;
        raster->gdalName_ = std::move(vrt.xml);
        raster->copies_ = std::move(vrt.copies);
    }
    DataSet dataSet = openDataSet(raster->gdalName_, raster->isVrt_);
    if (!dataSet) {
        return badInput(fmt::format(
            "{}: is not a readable raster ({}); expected GeoTIFF, HGT, DTED, an ASCII grid, netCDF, "
            "JPEG 2000, ENVI, VRT or a similar format",
            path.string(), QuietErrors::lastMessage()));
    }
    if (GDALGetRasterCount(dataSet.get()) > 0 && settings.colourChannel)
        raster->chooseBands(dataSet.get(), *settings.colourChannel);
    TRY_ASSIGN(raster->layout_, rasterLayoutOf(path, dataSet.get(), raster->band_, settings));
    raster->hasMask_ = hasMaskBand(dataSet.get(), raster->band_);
    raster->hasNoData_ = !settings.colourChannel && raster->layout_.conversion.noDataValue.has_value();
    // GDAL makes a mask only of alpha with 8 or 16 bits.
    if (!raster->hasMask_) raster->alphaBand_ = alphaBandOf(dataSet.get());
    idleDataSets().giveBack(raster.get(), std::move(dataSet));
    return raster;
}

GdalRaster::~GdalRaster() {
    idleDataSets().close(this);
}

void GdalRaster::chooseBands(void* dataSet, int channel) {
    const std::vector<int> bands = colourBands(dataSet);
    band_ = bands[bands.size() == 1 ? 0 : static_cast<std::size_t>(channel)];
    GDALRasterBandH const band = GDALGetRasterBand(dataSet, band_);
    isPalette_ = GDALGetRasterColorTable(band) != nullptr;
    channel_ = channel;
    int given = 0;
    voidValue_ = GDALGetRasterNoDataValue(band, &given);
    if (given != 0) voidBands_ = bands;
}

// Reads what a mask or alpha shows; 0: hidden.
bool GdalRaster::readMask(void* dataSet, int x, int y, int width, int height,
                          std::vector<std::uint8_t>& mask) const {
    if (hasMask_) {
        GDALRasterBandH const band = GDALGetMaskBand(GDALGetRasterBand(dataSet, band_));
        return GDALRasterIO(band, GF_Read, x, y, width, height, mask.data(), width, height, GDT_Byte, 0, 0) ==
               CE_None;
    }
    GDALRasterBandH const band = GDALGetRasterBand(dataSet, alphaBand_);
    std::vector<float> alpha(mask.size());
    if (!band || GDALRasterIO(band, GF_Read, x, y, width, height, alpha.data(), width, height, GDT_Float32, 0,
                              0) != CE_None)
        return false;
    std::ranges::transform(alpha, mask.begin(), [](float a) -> std::uint8_t { return a > 0 ? 1 : 0; });
    return true;
}

// Replaces indices by their colours, [0, 255]; those that the table does not have become NaN.
bool GdalRaster::readPalette(void* dataSet, std::vector<float>& values) const {
    const GDALColorTableH table = GDALGetRasterColorTable(GDALGetRasterBand(dataSet, band_));
    if (!table) return false;
    const int count = GDALGetColorEntryCount(table);
    for (float& value : values) {
        const GDALColorEntry* const entry = value >= 0 && value < static_cast<float>(count)
                                                ? GDALGetColorEntry(table, static_cast<int>(value))
                                                : nullptr;
        const bool isSeen = entry && entry->c4 > 0;
        const std::array<short, 3> colour =
            isSeen ? std::array{entry->c1, entry->c2, entry->c3} : std::array<short, 3>{};
        value = isSeen ? static_cast<float>(colour[static_cast<std::size_t>(channel_)])
                       : std::numeric_limits<float>::quiet_NaN();
    }
    return true;
}

// Clears the mask where all bands have the no-data value.
bool GdalRaster::readVoids(void* dataSet, int x, int y, int width, int height,
                           std::vector<std::uint8_t>& mask) const {
    std::vector<std::uint8_t> hasColour(mask.size());
    std::vector<double> values(mask.size());
    for (const int number : voidBands_) {
        GDALRasterBandH const band = GDALGetRasterBand(dataSet, number);
        if (!band || GDALRasterIO(band, GF_Read, x, y, width, height, values.data(), width, height,
                                  GDT_Float64, 0, 0) != CE_None)
            return false;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool isVoid = std::isnan(voidValue_) ? std::isnan(values[i]) : values[i] == voidValue_;
            if (!isVoid) hasColour[i] = 1;
        }
    }
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = mask[i] != 0 && hasColour[i] != 0 ? 1 : 0;
    return true;
}

bool GdalRaster::isEmpty(int blockX, int blockY) const {
    if (!hasNoData_) return false;
    const int x = blockX * layout_.blockWidth;
    const int y = blockY * layout_.blockHeight;
    DataSet dataSet = idleDataSets().borrow(this);
    if (!dataSet) return false;
    const QuietErrors quiet;
    GDALRasterBandH const band = GDALGetRasterBand(dataSet.get(), band_);
    const int status = GDALGetDataCoverageStatus(band, x, y, std::min(layout_.blockWidth, layout_.width - x),
                                                 std::min(layout_.blockHeight, layout_.height - y),
                                                 GDAL_DATA_COVERAGE_STATUS_DATA, nullptr);
    idleDataSets().giveBack(this, std::move(dataSet));
    return status == GDAL_DATA_COVERAGE_STATUS_EMPTY;
}

Result<std::vector<float>> GdalRaster::readBlock(int blockX, int blockY) const {
    const int x = blockX * layout_.blockWidth;
    const int y = blockY * layout_.blockHeight;
    const int width = std::min(layout_.blockWidth, layout_.width - x);
    const int height = std::min(layout_.blockHeight, layout_.height - y);
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const QuietErrors quiet;
    const auto unreadable = [&] {
        return ioError(fmt::format("{}: the block at column {}, row {} cannot be read: {}", path_.string(), x,
                                   y, QuietErrors::lastMessage()));
    };
    DataSet dataSet = idleDataSets().borrow(this);
    if (!dataSet) return unreadable();
    GDALRasterBandH const band = GDALGetRasterBand(dataSet.get(), band_);
    // A file that was replaced by a smaller one since it was opened must not be read beyond its end.
    if (!band || GDALGetRasterXSize(dataSet.get()) != layout_.width ||
        GDALGetRasterYSize(dataSet.get()) != layout_.height) {
        return ioError(fmt::format("{}: was replaced while it was being read", path_.string()));
    }
    std::vector<float> values(count);
    if (GDALRasterIO(band, GF_Read, x, y, width, height, values.data(), width, height, GDT_Float32, 0, 0) !=
        CE_None)
        return unreadable();
    std::vector<std::uint8_t> mask;
    if (hidesSamples()) {
        mask.resize(count);
        if (!readMask(dataSet.get(), x, y, width, height, mask)) return unreadable();
    }
    if (!voidBands_.empty()) {
        mask.resize(count, 1);
        if (!readVoids(dataSet.get(), x, y, width, height, mask)) return unreadable();
    }
    if (isPalette_ && !readPalette(dataSet.get(), values)) return unreadable();
    idleDataSets().giveBack(this, std::move(dataSet));
    std::vector<float> heights(count);
    convertToMetres(layout_.conversion, std::as_bytes(std::span(values)), heights);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0) heights[i] = std::numeric_limits<float>::quiet_NaN();
    }
    return heights;
}

}  // namespace planet
