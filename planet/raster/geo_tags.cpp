#include "planet/raster/geo_tags.h"
#include "planet/base/try.h"
#include "planet/raster/image_names.h"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace planet {

namespace {

// Tags and keys of GeoTIFF 1.1 (OGC 19-008r4), and GDAL's own tag.
constexpr std::uint32_t modelPixelScaleTag = 33550;
constexpr std::uint32_t modelTiepointTag = 33922;
constexpr std::uint32_t modelTransformationTag = 34264;
constexpr std::uint32_t geoKeyDirectoryTag = 34735;
constexpr std::uint32_t geoDoubleParamsTag = 34736;
constexpr std::uint32_t gdalMetadataTag = 42112;
constexpr std::uint32_t gdalNoDataTag = 42113;

constexpr int modelTypeKey = 1024;
constexpr int rasterTypeKey = 1025;
constexpr int angularUnitsKey = 2054;
constexpr int semiMajorAxisKey = 2057;
constexpr int projectedTypeKey = 3072;
constexpr int projectionMethodKey = 3075;
constexpr int linearUnitsKey = 3076;
constexpr int verticalUnitsKey = 4099;
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
    // These handlers apply to this file only; OpenImageIO sets those of the process.
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), ignoreMessage, nullptr);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignoreMessage, nullptr);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), tmsize_t{64} << 20);
    return {TIFFOpenExt(path.c_str(), "rm", options.get()), TIFFClose};
}

// Returns the values of a tag, valid while the file is open; empty if it is absent or of another type.
template <class T>
std::span<const T> valuesOf(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
    const TIFFField* const field = TIFFFindField(tiff, tag, TIFF_ANY);
    if (!field || TIFFFieldDataType(field) != type) return {};
    const void* data = nullptr;
    if (!TIFFFieldPassCount(field)) {
        // Once GDAL is in use, libtiff knows the tags with a text, which it returns without their length.
        const char* text = nullptr;
        if (type != TIFF_ASCII || !TIFFGetField(tiff, tag, &text) || !text) return {};
        data = text;
        return {static_cast<const T*>(data), std::char_traits<char>::length(text)};
    }
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
    // Returns key, location, count and value; the first four numbers of the directory are its header.
    std::span<const std::uint16_t> entryOf(int key) const {
        for (std::size_t at = 4; at + 4 <= directory_.size(); at += 4) {
            if (directory_[at] == key) return directory_.subspan(at, 4);
        }
        return {};
    }

    std::span<const std::uint16_t> directory_;
    std::span<const double> doubles_;
};

// Sets the coordinates of the raster's origin and steps; returns false if the tags lack them.
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

// Returns the radius in metres of the equirectangular projection with an EPSG code, 0 for any other code.
// These projections are centred on longitude 0. Files with a code often omit the projection's own keys.
double knownRadiusM(std::optional<int> code) {
    if (code == 4087 || code == 32662) return 6378137;  // WGS 84
    return code == 4088 ? 6371007 : 0;
}

// Accepts equirectangular projections with true scale along the equator, in metres, on a sphere or ellipsoid
// of known size: their degrees have the scale of the equator.
void setProjectedModel(const GeoKeys& keys, GeoPlacement& placement) {
    placement.model = GeoModel::Other;
    placement.modelText = projectionText(keys);
    if (const double radiusM = knownRadiusM(keys.code(projectedTypeKey)); radiusM > 0) {
        placement.model = GeoModel::Metres;
        placement.metresPerDegree = radiusM * std::numbers::pi / 180;
        return;
    }
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

std::string verticalUnit(std::optional<int> code) {
    if (!code || code == 0 || code == linearMetre || code == userDefined) return {};
    if (code == 9002) return "ft";
    return code == 9003 ? "us-ft" : fmt::format("EPSG {}", *code);
}

std::optional<double> numberIn(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
}

// Returns the text of the first element of a name whose start tag passes a test; empty if there is none.
template <class Test>
std::string elementText(const std::string& xml, const std::string& name, const Test& test) {
    for (std::size_t at = xml.find('<' + name); at != std::string::npos; at = xml.find('<' + name, at + 1)) {
        const std::size_t end = xml.find('>', at);
        const std::size_t close = xml.find("</" + name, at);
        if (end == std::string::npos || close == std::string::npos || close < end) return {};
        const char after = xml[at + 1 + name.size()];
        if (after != '>' && after != ' ') continue;
        if (test(xml.substr(at, end - at))) return trimmed(xml.substr(end + 1, close - end - 1));
    }
    return {};
}

// Reads scale, offset and unit of the first band from GDAL_METADATA:
//     <Item name="SCALE" sample="0" role="scale">0.1</Item>.
void takeBandItems(const std::string& xml, GeoTags& tags) {
    const auto item = [&](const char* role) {
        return elementText(xml, "Item", [&](const std::string& start) {
            return start.find(fmt::format("role=\"{}\"", role)) != std::string::npos &&
                   (start.find("sample=") == std::string::npos ||
                    start.find("sample=\"0\"") != std::string::npos);
        });
    };
    tags.scale = numberIn(item("scale"));
    tags.offset = numberIn(item("offset"));
    tags.unit = item("unittype");
}

constexpr std::size_t mostSidecarBytes = std::size_t{1} << 20;

std::string contentOf(const std::filesystem::path& file) {
    std::string content(mostSidecarBytes, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
    content.resize(static_cast<std::size_t>(stream.gcount()));
    return content;
}

// Returns the numbers at the beginning of a text, separated by commas or spaces.
std::vector<double> numbersIn(std::string text) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream stream(text);
    std::vector<double> numbers;
    for (double number = 0; stream >> number;) numbers.push_back(number);
    return numbers;
}

// Reads the six lines of an ESRI world file: x by column, y by column, x by row, y by row, and the first sample's
// centre.
Result<std::optional<GeoPlacement>> worldFilePlacement(const std::filesystem::path& image) {
    const std::filesystem::path file = worldFileBeside(image);
    if (file.empty()) return std::nullopt;
    const std::vector<double> n = numbersIn(contentOf(file));
    GeoPlacement placement;
    if (n.size() == 6) {
        placement.x = {n[4], n[0], n[2]};
        placement.y = {n[5], n[1], n[3]};
    }
    if (n.size() != 6 || !isFinite(placement)) {
        return badInput(
            fmt::format("{}: is an ESRI world file beside {} without six numbers; expected six, "
                        "or none",
                        file.string(), image.filename().string()));
    }
    placement.modelText = "longitude and latitude";
    placement.from = file.filename().string();
    return placement;
}

// Reads GDAL's sidecar, whose placement counts from the corner of the first sample.
Result<void> takeAuxiliary(const std::filesystem::path& image, GeoTags& tags) {
    const std::filesystem::path file = image.string() + ".aux.xml";
    std::error_code status;
    if (!std::filesystem::is_regular_file(file, status)) return {};
    const std::string xml = contentOf(file);
    const auto text = [&](const char* name) {
        return elementText(xml, name, [](const std::string&) { return true; });
    };
    if (!tags.scale) tags.scale = numberIn(text("Scale"));
    if (!tags.offset) tags.offset = numberIn(text("Offset"));
    if (tags.unit.empty()) tags.unit = text("UnitType");
    if (tags.placement) return {};
    if (const std::vector<double> n = numbersIn(text("GeoTransform")); n.size() == 6) {
        GeoPlacement placement;
        placement.x = {n[0] + (n[1] + n[2]) / 2, n[1], n[2]};
        placement.y = {n[3] + (n[4] + n[5]) / 2, n[4], n[5]};
        placement.modelText = "longitude and latitude";
        placement.from = file.filename().string();
        if (isFinite(placement)) tags.placement = std::move(placement);
    }
    if (tags.placement || xml.find("<GeoTransform") == xml.npos) return {};
    return badInput(fmt::format(
        "{}: its GeoTransform has no six numbers; expected a sidecar of GDAL, or none", file.string()));
}

}  // namespace

Result<GeoTags> geoTagsOf(const std::filesystem::path& image, bool isTiff) {
    Result<GeoTags> tags = isTiff ? readGeoTags(image) : GeoTags();
    if (!tags) return tags;
    if (!tags->placement) {
        TRY_ASSIGN(tags->placement, worldFilePlacement(image));
    }
    TRY(takeAuxiliary(image, *tags));
    return tags;
}

Result<GeoTags> readGeoTags(const std::filesystem::path& path) {
    const TiffPtr tiff = openTiff(path);
    if (!tiff) return badInput(fmt::format("{}: its TIFF directory cannot be read", path.string()));
    GeoTags tags;
    tags.noDataValue = noDataOf(tiff.get());
    const auto metadata = valuesOf<char>(tiff.get(), gdalMetadataTag, TIFF_ASCII);
    takeBandItems(std::string(metadata.begin(), metadata.end()), tags);
    const GeoKeys keys(tiff.get());
    if (tags.unit.empty()) tags.unit = verticalUnit(keys.code(verticalUnitsKey));
    GeoPlacement placement;
    if (!setCoordinates(tiff.get(), placement)) return tags;
    if (keys.code(rasterTypeKey) != rasterPixelIsPoint) {
        // The raster coordinates are then those of a pixel's corner.
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
