// Makes an elevation raster that is too large for memory, to try bakes with: the Earth, enlarged, with a relief of many
// octaves added, so that it is as rough as land at every scale.
// Usage: large_source ELEVATION.tif OUT.tif [WIDTH]; WIDTH is 86400 samples if not given, twice the height.
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

constexpr int side = 4096;  // of the relief, which repeats
constexpr int octaves = 11;

// Returns noise that repeats after `side` samples, of standard deviation 1: each octave has half the wavelength and 0.72
// times the amplitude of the one before.
std::vector<float> relief() {
    std::vector<float> sum(std::size_t{side} * side);
    std::minstd_rand random(1);
    std::normal_distribution<float> normal;
    for (int octave = 0; octave < octaves; ++octave) {
        const int cells = 4 << octave;
        const int step = side / cells;
        std::vector<float> grid(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
        for (float& value : grid) value = normal(random);
        const float amplitude = std::pow(0.72F, static_cast<float>(octave));
        const auto at = [&](int column, int row) {
            return grid[static_cast<std::size_t>(row % cells) * static_cast<std::size_t>(cells) +
                        static_cast<std::size_t>(column % cells)];
        };
        for (int row = 0; row < side; ++row) {
            const float v = static_cast<float>(row % step) / static_cast<float>(step);
            for (int column = 0; column < side; ++column) {
                const float u = static_cast<float>(column % step) / static_cast<float>(step);
                const int x = column / step;
                const int y = row / step;
                const float south = std::lerp(at(x, y), at(x + 1, y), u);
                const float north = std::lerp(at(x, y + 1), at(x + 1, y + 1), u);
                sum[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)] +=
                    amplitude * std::lerp(south, north, v);
            }
        }
    }
    double squares = 0;
    for (const float value : sum) squares += static_cast<double>(value) * static_cast<double>(value);
    const auto deviation = static_cast<float>(std::sqrt(squares / static_cast<double>(sum.size())));
    for (float& value : sum) value /= deviation;
    return sum;
}

bool write(GDALDataset& from, GDALDataset& to, int width) {
    const std::vector<float> added = relief();
    constexpr int rows = 512;
    std::vector<float> heights(static_cast<std::size_t>(width) * rows);
    std::vector<std::int16_t> samples(heights.size());
    GDALRasterIOExtraArg cubic;
    INIT_RASTERIO_EXTRA_ARG(cubic);
    cubic.eResampleAlg = GRIORA_Cubic;
    cubic.bFloatingPointWindowValidity = TRUE;
    const double scale = static_cast<double>(from.GetRasterXSize()) / width;
    for (int first = 0; first < width / 2; first += rows) {
        const int now = std::min(rows, width / 2 - first);
        cubic.dfXOff = 0;
        cubic.dfXSize = from.GetRasterXSize();
        cubic.dfYOff = first * scale;
        cubic.dfYSize = now * scale;
        const int top = static_cast<int>(cubic.dfYOff);
        const int bottom =
            std::min(from.GetRasterYSize(), static_cast<int>(std::ceil(cubic.dfYOff + cubic.dfYSize)));
        if (from.GetRasterBand(1)->RasterIO(GF_Read, 0, top, from.GetRasterXSize(), bottom - top,
                                            heights.data(), width, now, GDT_Float32, 0, 0, &cubic) != CE_None)
            return false;
        for (int row = 0; row < now; ++row) {
            for (int column = 0; column < width; ++column) {
                const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(column);
                // Two periods, so that the repetition is far apart.
                const auto one = static_cast<std::size_t>((first + row) % side) * side +
                                 static_cast<std::size_t>(column % side);
                const auto other = static_cast<std::size_t>((7 * (first + row) / 5) % side) * side +
                                   static_cast<std::size_t>((9 * column / 7) % side);
                // Land is as rough as the Andes, where neighbours 450 m apart differ by 109 m. The sea bed is smoother.
                const float roughM = 20 + (heights[i] > 0 ? 0.3F * heights[i] : -0.03F * heights[i]);
                const float heightM = heights[i] + roughM * (added[one] + added[other]);
                samples[i] = static_cast<std::int16_t>(std::lrint(std::clamp(heightM, -11000.0F, 9000.0F)));
            }
        }
        if (to.GetRasterBand(1)->RasterIO(GF_Write, 0, first, width, now, samples.data(), width, now,
                                          GDT_Int16, 0, 0) != CE_None)
            return false;
    }
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    const int width = count > 3 ? std::atoi(arguments[3]) : 86400;
    if (count < 3 || width < 512 || width % 2 != 0) {
        fmt::print(stderr, "Usage: large_source ELEVATION.tif OUT.tif [WIDTH]\n");
        return 2;
    }
    GDALAllRegister();
    const GDALDatasetUniquePtr from(GDALDataset::Open(arguments[1], GDAL_OF_RASTER));
    const char* const options[] = {"TILED=YES",    "BLOCKXSIZE=512", "BLOCKYSIZE=512",       "COMPRESS=ZSTD",
                                   "ZSTD_LEVEL=1", "PREDICTOR=2",    "NUM_THREADS=ALL_CPUS", "BIGTIFF=YES",
                                   nullptr};
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const GDALDatasetUniquePtr to(
        from ? driver->Create(arguments[2], width, width / 2, 1, GDT_Int16, const_cast<char**>(options))
             : nullptr);
    if (!from || !to) return 2;
    const double degrees = 360.0 / width;
    double place[] = {-180, degrees, 0, 90, 0, -degrees};
    to->SetGeoTransform(place);
    OGRSpatialReference wgs84;
    wgs84.SetWellKnownGeogCS("WGS84");
    to->SetSpatialRef(&wgs84);
    return write(*from, *to, width) ? 0 : 2;
}
