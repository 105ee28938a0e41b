#include "planet/source/geo_tags.h"

#include <fmt/format.h>
#include <tiffio.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <span>

namespace planet {

namespace {

// Tags and keys of GeoTIFF 1.1 (OGC 19-008r4), and GDAL's own tag.
constexpr std::uint32_t modelPixelScaleTag = 33550;
constexpr std::uint32_t modelTiepointTag = 33922;
constexpr std::uint32_t modelTransformationTag = 34264;
constexpr std::uint32_t geoKeyDirectoryTag = 34735;
constexpr std::uint32_t geoDoubleParamsTag = 34736;
constexpr std::uint32_t gdalNoDataTag = 42113;

constexpr int modelTypeKey = 1024;
constexpr int rasterTypeKey = 1025;
constexpr int angularUnitsKey = 2054;
constexpr int semiMajorAxisKey = 2057;
constexpr int projectedTypeKey = 3072;
constexpr int projectionMethodKey = 3075;
constexpr int linearUnitsKey = 3076;
constexpr int standardParallelKey = 3078;
constexpr int originLongitudeKey = 3080;
constexpr int centreLongitudeKey = 3088;

constexpr int modelTypeProjected = 1;
constexpr int modelTypeGeographic = 2;
constexpr int rasterPixelIsPoint = 2;
constexpr int angularDegree = 9102;
constexpr int linearMetre = 9001;
constexpr int methodEquirectangular = 17;
constexpr int userDefined = 32767;

using TiffPtr = std::unique_ptr<TIFF, void (*)(TIFF*)>;

int ignoreMessage(TIFF*, void*, const char*, const char*, va_list) {
    return 1;
}

TiffPtr openTiff(const std::filesystem::path& path) {
    // Handlers of this file alone: those of the process are OpenImageIO's.
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), ignoreMessage, nullptr);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignoreMessage, nullptr);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), tmsize_t{64} << 20);
    return {TIFFOpenExt(path.c_str(), "rm", options.get()), TIFFClose};
}

// The values of a tag, valid while the file is open; none where it is absent or of another type.
template <class T>
std::span<const T> valuesOf(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
    const TIFFField* const field = TIFFFindField(tiff, tag, TIFF_ANY);
    if (!field || TIFFFieldDataType(field) != type || !TIFFFieldPassCount(field)) return {};
    const void* data = nullptr;
    if (TIFFFieldReadCount(field) == TIFF_VARIABLE2) {
        std::uint32_t count = 0;
        if (!TIFFGetField(tiff, tag, &count, &data) || !data) return {};
        return {static_cast<const T*>(data), count};
    }
    std::uint16_t count = 0;
    if (!TIFFGetField(tiff, tag, &count, &data) || !data) return {};
    return {static_cast<const T*>(data), count};
}

class GeoKeys {
public:
    explicit GeoKeys(TIFF* tiff)
        : directory_(valuesOf<std::uint16_t>(tiff, geoKeyDirectoryTag, TIFF_SHORT)),
          doubles_(valuesOf<double>(tiff, geoDoubleParamsTag, TIFF_DOUBLE)) {}

    std::optional<int> code(int key) const {
        const auto entry = entryOf(key);
        if (entry.empty() || entry[1] != 0) return std::nullopt;
        return entry[3];
    }
    std::optional<double> number(int key) const {
        const auto entry = entryOf(key);
        if (entry.empty() || entry[1] != geoDoubleParamsTag || entry[3] >= doubles_.size())
            return std::nullopt;
        return doubles_[entry[3]];
    }

private:
    // Key, location, count, value; the first four numbers of the directory are its header.
    std::span<const std::uint16_t> entryOf(int key) const {
        for (std::size_t at = 4; at + 4 <= directory_.size(); at += 4) {
            if (directory_[at] == key) return directory_.subspan(at, 4);
        }
        return {};
    }

    std::span<const std::uint16_t> directory_;
    std::span<const double> doubles_;
};

// Sets the coordinates of the raster's origin and steps; false where the tags are of no use.
bool setCoordinates(TIFF* tiff, GeoPlacement& placement) {
    const auto matrix = valuesOf<double>(tiff, modelTransformationTag, TIFF_DOUBLE);
    if (matrix.size() >= 16) {
        placement.x = {matrix[3], matrix[0], matrix[1]};
        placement.y = {matrix[7], matrix[4], matrix[5]};
        return true;
    }
    const auto scale = valuesOf<double>(tiff, modelPixelScaleTag, TIFF_DOUBLE);
    const auto tie = valuesOf<double>(tiff, modelTiepointTag, TIFF_DOUBLE);
    if (scale.size() < 2 || tie.size() < 6) return false;
    placement.x = {tie[3] - tie[0] * scale[0], scale[0], 0};
    placement.y = {tie[4] + tie[1] * scale[1], 0, -scale[1]};
    return true;
}

bool isFinite(const GeoPlacement& placement) {
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (!std::isfinite(placement.x[at]) || !std::isfinite(placement.y[at])) return false;
    }
    return true;
}

std::string projectionText(const GeoKeys& keys) {
    const int code = keys.code(projectedTypeKey).value_or(userDefined);
    return code == userDefined ? std::string("projected coordinates")
                               : fmt::format("projected coordinates, EPSG {}", code);
}

// Equirectangular with its true scale along the equator, in metres, on a sphere or ellipsoid whose size the
// file tells: the scale of its degrees is that of the equator.
void setProjectedModel(const GeoKeys& keys, GeoPlacement& placement) {
    placement.model = GeoModel::Other;
    placement.modelText = projectionText(keys);
    if (keys.code(projectionMethodKey) != methodEquirectangular) return;
    if (keys.code(linearUnitsKey).value_or(linearMetre) != linearMetre) return;
    if (keys.number(standardParallelKey).value_or(0) != 0) return;
    const double radiusM = keys.number(semiMajorAxisKey).value_or(0);
    if (!(radiusM > 0) || !std::isfinite(radiusM)) return;
    placement.model = GeoModel::Metres;
    placement.metresPerDegree = radiusM * std::numbers::pi / 180;
    const double centreDeg =
        keys.number(centreLongitudeKey).value_or(keys.number(originLongitudeKey).value_or(0));
    placement.x[0] += centreDeg * placement.metresPerDegree;
}

void setModel(const GeoKeys& keys, GeoPlacement& placement) {
    const int modelType = keys.code(modelTypeKey).value_or(modelTypeGeographic);
    if (modelType == modelTypeProjected) return setProjectedModel(keys, placement);
    const int unit = keys.code(angularUnitsKey).value_or(angularDegree);
    placement.modelText = "longitude and latitude";
    if (modelType == modelTypeGeographic && unit == angularDegree) return;
    placement.model = GeoModel::Other;
    placement.modelText = modelType == modelTypeGeographic
                              ? fmt::format("angles in the unit of EPSG {}", unit)
                              : fmt::format("coordinates of GeoTIFF model type {}", modelType);
}

std::optional<double> noDataOf(TIFF* tiff) {
    const auto text = valuesOf<char>(tiff, gdalNoDataTag, TIFF_ASCII);
    const std::string copy(text.begin(), text.end());
    char* end = nullptr;
    const double value = std::strtod(copy.c_str(), &end);
    if (end == copy.c_str() || std::isnan(value)) return std::nullopt;
    return value;
}

}  // namespace

Result<GeoTags> readGeoTags(const std::filesystem::path& path) {
    const TiffPtr tiff = openTiff(path);
    if (!tiff) return badInput(fmt::format("{}: its TIFF directory cannot be read", path.string()));
    GeoTags tags;
    tags.noDataValue = noDataOf(tiff.get());
    GeoPlacement placement;
    if (!setCoordinates(tiff.get(), placement)) return tags;
    const GeoKeys keys(tiff.get());
    if (keys.code(rasterTypeKey) != rasterPixelIsPoint) {
        // Raster coordinates are then those of a pixel's corner.
        placement.x[0] += (placement.x[1] + placement.x[2]) / 2;
        placement.y[0] += (placement.y[1] + placement.y[2]) / 2;
    }
    setModel(keys, placement);
    if (!isFinite(placement))
        return badInput(fmt::format("{}: its GeoTIFF tags hold numbers that are not finite", path.string()));
    tags.placement = std::move(placement);
    return tags;
}

}  // namespace planet
