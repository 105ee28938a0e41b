// Fuzzes georeferenced rasters: any bytes are refused, or every height lies in the range that a survey finds. An input
// is the file. GDAL recognises most formats by their content.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "planet/raster/gdal_raster.h"
#include "planet/raster/raster_area.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace planet;
using fuzz::isRead;
using fuzz::require;

// A larger raster is only opened: its header costs nothing, its samples would take the time of many inputs.
constexpr std::int64_t mostSamples = 1 << 16;
constexpr std::int64_t mostBlockSamples = 1 << 20;

// A file in memory, because one on a disk would take most of the time.
class FileInMemory {
public:
    FileInMemory() : descriptor_(memfd_create("raster", MFD_CLOEXEC)) {
        require(descriptor_ >= 0, "there are files in memory");
    }
    void write(std::span<const std::byte> bytes) const {
        require(ftruncate(descriptor_, 0) == 0 &&
                    pwrite(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
                "files in memory can be written");
    }
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

// Another process reads netCDF, because its libraries crash on damaged files (planet/raster/netcdf_copy.h).
bool isReadElsewhere(std::string_view text) {
    return text.starts_with("CDF") || text.starts_with("\x89HDF");
}

bool isSmall(const RasterLayout& layout) {
    return std::int64_t{layout.width} * layout.height <= mostSamples &&
           std::int64_t{layout.blockWidth} * layout.blockHeight <= mostBlockSamples;
}

void checkHeights(const RasterArea& area) {
    const GridRect& bounds = area.mosaic.bounds();
    std::vector<float> heights(static_cast<std::size_t>(bounds.columns * bounds.rows));
    if (!isRead(area.mosaic.read({}, bounds, heights))) return;
    for (const float height : heights) {
        require(std::isnan(height) || (height >= area.statistics.minM && height <= area.statistics.maxM),
                "heights lie within the range");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const FileInMemory file;
    if (isReadElsewhere(fuzz::textOf(data, size))) return 0;
    file.write(fuzz::bytesOf(data, size));
    const auto raster = GdalRaster::open(file.path(), {});
    if (!isRead(raster)) return 0;
    const RasterLayout& layout = (*raster)->layout();
    require(layout.width > 0 && layout.height > 0 && layout.blockWidth > 0 && layout.blockHeight > 0,
            "a raster has samples");
    if (!isSmall(layout)) return 0;
    auto mosaics = RasterMosaic::join({*raster}, std::make_shared<MosaicCache>(1 << 20));
    if (!isRead(mosaics)) return 0;
    require(mosaics->size() == 1, "a raster is a mosaic");
    const AreaSurvey survey = surveyArea(std::move(mosaics->front()));
    for (const auto& broken : survey.broken) require(!broken.error.message.empty(), "an Error has a message");
    if (survey.broken.empty()) checkHeights(survey.area);
    return 0;
}
