#include "planet/raster/placed_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <system_error>
#include <utility>

#include "planet/base/try.h"
#include "planet/raster/gdal_formats.h"
#include "planet/raster/gdal_raster.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/image_names.h"

namespace planet {

namespace {

constexpr int placedBlockSide = 256;  // samples, unless the file has tiles
constexpr int mostRawSide = 1 << 22;  // samples
constexpr std::uintmax_t rawSampleBytes = 2;

// The samples of an image, before it is placed.
struct Samples {
    HeightRaster heights;
    HeightConversion conversion;
    int blockWidth = placedBlockSide;
    int blockHeight = placedBlockSide;
    std::string typeName;
};

class PlacedImage : public Raster {
public:
    PlacedImage(const std::filesystem::path& path, RasterLayout layout, HeightRaster heights)
        : heights_(std::move(heights)) {
        path_ = path;
        layout_ = std::move(layout);
    }

    Result<std::vector<float>> readBlock(int blockX, int blockY) const override {
        const int x = blockX * layout_.blockWidth;
        const int y = blockY * layout_.blockHeight;
        const RasterRect rect{x, y, std::min(layout_.blockWidth, layout_.width - x),
                              std::min(layout_.blockHeight, layout_.height - y)};
        const auto width = static_cast<std::size_t>(rect.width);
        std::vector<float> heights(width * static_cast<std::size_t>(rect.height));
        TRY(heights_.read(rect, heights.data(), width));
        return heights;
    }

private:
    HeightRaster heights_;
};

// Blocks are cached by the mosaic, so the image itself needs no cache.
RasterMemory memoryOf(const HeightSourceSettings& settings) {
    return {std::make_shared<StoredBlockCache>(0), 0, settings.cacheBytes / 2};
}

struct RawSize {
    int columns = 0;
    int rows = 0;
};

Result<RawSize> rawSizeOf(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    std::error_code problem;
    const std::uintmax_t bytes = std::filesystem::file_size(path, problem);
    if (problem) return ioError(fmt::format("{}: {}", path.string(), problem.message()));
    const auto squareSide = static_cast<std::uintmax_t>(
        std::llround(std::sqrt(static_cast<double>(bytes) / static_cast<double>(rawSampleBytes))));
    const auto given = [](int size) { return static_cast<std::uintmax_t>(size); };
    const std::uintmax_t columns = settings.rawSize ? given(*settings.rawSize) : squareSide;
    const std::uintmax_t rows = settings.rawRows ? given(*settings.rawRows) : columns;
    if (columns < 2 || columns > mostRawSide || rows < 1 || rows > mostRawSide) {
        return badInput(fmt::format("{}: is {} x {} samples; expected [2, {}] samples of 16 bits per side",
                                    path.string(), columns, rows, mostRawSide));
    }
    if (columns * rows * rawSampleBytes == bytes)
        return RawSize{static_cast<int>(columns), static_cast<int>(rows)};
    if (!settings.rawSize) {
        return badInput(
            fmt::format("{}: has {} bytes, which is no square of 16-bit samples; expected raw_size squared "
                        "times 2 bytes, or raw_size = [columns, rows], without a header",
                        path.string(), bytes));
    }
    const std::string size =
        settings.rawRows ? fmt::format("[{}, {}]", columns, rows) : std::to_string(columns);
    return badInput(fmt::format("{}: has {} bytes; expected {} for raw_size = {} and 16-bit samples",
                                path.string(), bytes, columns * rows * rawSampleBytes, size));
}

Result<Samples> openRawSamples(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    TRY_ASSIGN(const auto size, rawSizeOf(path, settings));
    Samples samples;
    const SampleType type = settings.rawSigned ? SampleType::Int16 : SampleType::Uint16;
    TRY_ASSIGN(samples.conversion, conversionFor(path.string(), settings, type, {}));
    samples.conversion.swapBytes = settings.rawBigEndian != (std::endian::native == std::endian::big);
    samples.conversion.fillM = std::numeric_limits<float>::quiet_NaN();
    samples.typeName = settings.rawSigned ? "int16" : "uint16";
    TRY_ASSIGN(samples.heights, openRawRaster(path, size.columns, size.rows, samples.conversion,
                                              memoryOf(settings), settings.fileCalls));
    return samples;
}

tl::unexpected<Error> placedTwice(const std::filesystem::path& path, const std::string& from) {
    return badInput(fmt::format(
        "{}: has a position of its own in {}; expected a layer without place, or an image without "
        "a position",
        path.string(), from));
}

Result<Samples> openImageSamples(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    const auto image = ImageFile::open(path, std::nullopt);
    if (!image) {
        if (isGdalRaster(path) && GdalRaster::open(path, settings)) return placedTwice(path, "its header");
        return tl::unexpected(image.error());
    }
    const ImageLayout& layout = (*image)->layout();
    if (layout.geoTags.placement) return placedTwice(path, layout.geoTags.placement->from);
    Samples samples;
    TRY_ASSIGN(samples.conversion, conversionFor(path.string(), settings, layout.type, layout.geoTags));
    samples.conversion.fillM = std::numeric_limits<float>::quiet_NaN();
    if (layout.tileWidth > 0) {
        samples.blockWidth = std::min(layout.tileWidth, layout.width);
        samples.blockHeight = std::min(layout.tileHeight, layout.height);
    }
    samples.typeName = layout.typeName;
    TRY_ASSIGN(samples.heights,
               openImageRaster(*image, samples.conversion, memoryOf(settings), settings.fileCalls));
    return samples;
}

// Sets the grid whose middle lies at the origin of the projection.
Result<void> setGrid(const std::string& file, const ImagePlace& place, double radiusM, RasterLayout& layout) {
    if (layout.width < 2) {
        return badInput(
            fmt::format("{}: is {} x {} samples; expected at least 2 in a row, between which "
                        "width_m lies",
                        file, layout.width, layout.height));
    }
    const double stepM = place.widthM / (layout.width - 1);
    const double right = (layout.width - 1) / 2.0;
    const double down = (layout.height - 1) / 2.0;
    // A hemisphere becomes a disc of this radius.
    const double mostM = std::numbers::sqrt2 * radiusM;
    if (std::hypot(right, down) * stepM > mostM) {
        return badInput(fmt::format(
            "{}: reaches {:.6g} m from its middle with width_m = {}; expected at most {:.6g} m, a hemisphere "
            "of radius {} m",
            file, std::hypot(right, down) * stepM, place.widthM, mostM, radiusM));
    }
    const double heading = place.headingDeg * std::numbers::pi / 180;
    const double cosM = stepM * std::cos(heading);
    const double sinM = stepM * std::sin(heading);
    // Columns go to the right, heading + 90 degrees; rows go down, heading + 180 degrees.
    layout.x = {-right * cosM + down * sinM, cosM, -sinM};
    layout.y = {right * sinM + down * cosM, -sinM, -cosM};
    layout.crs = fmt::format("+proj=laea +lat_0={} +lon_0={} +R={} +units=m +no_defs +type=crs",
                             place.latitudeDeg, place.longitudeDeg, radiusM);
    layout.crsName = fmt::format("placed at {} N, {} E", place.latitudeDeg, place.longitudeDeg);
    return {};
}

}  // namespace

Result<std::shared_ptr<const Raster>> openPlacedImage(const std::filesystem::path& path,
                                                      const ImagePlace& place, double radiusM,
                                                      const HeightSourceSettings& settings) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem))
        return ioError(fmt::format("{}: no such file", path.string()));
    TRY_ASSIGN(auto samples,
               isRawImage(path) ? openRawSamples(path, settings) : openImageSamples(path, settings));
    RasterLayout layout;
    layout.width = samples.heights.width();
    layout.height = samples.heights.height();
    layout.blockWidth = std::min(samples.blockWidth, layout.width);
    layout.blockHeight = std::min(samples.blockHeight, layout.height);
    layout.typeName = samples.typeName;
    layout.conversion = samples.conversion;
    const SampleType type = samples.conversion.type;
    if (type != SampleType::Float && type != SampleType::Double)
        layout.stepM = std::abs(samples.conversion.metresPerUnit);
    TRY(setGrid(path.string(), place, radiusM, layout));
    return std::make_shared<const PlacedImage>(path, std::move(layout), std::move(samples.heights));
}

}  // namespace planet
