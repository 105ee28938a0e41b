// Writes georeferenced rasters for tests, with GDAL. Positions come from GDAL's own transformations, not from the
// code that is tested.
#pragma once

#include <gdal.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace planet::test {

inline constexpr int finest = 1 << 22;  // cells along a face of the finest grid
inline constexpr double radPerDeg = std::numbers::pi / 180;

// A reference system and what leads from its coordinates to degrees of longitude and latitude of WGS 84.
class Crs {
public:
    explicit Crs(int epsg)
        : system_(OSRNewSpatialReference(nullptr)), wgs84_(OSRNewSpatialReference(nullptr)) {
        if (OSRImportFromEPSG(system_, epsg) != OGRERR_NONE || OSRImportFromEPSG(wgs84_, 4326) != OGRERR_NONE)
            throw std::runtime_error("unknown EPSG code");
        OSRSetAxisMappingStrategy(system_, OAMS_TRADITIONAL_GIS_ORDER);
        OSRSetAxisMappingStrategy(wgs84_, OAMS_TRADITIONAL_GIS_ORDER);
        toDegrees_ = OCTNewCoordinateTransformation(system_, wgs84_);
        fromDegrees_ = OCTNewCoordinateTransformation(wgs84_, system_);
    }
    ~Crs() {
        OCTDestroyCoordinateTransformation(toDegrees_);
        OCTDestroyCoordinateTransformation(fromDegrees_);
        OSRRelease(system_);
        OSRRelease(wgs84_);
    }
    Crs(const Crs&) = delete;
    Crs& operator=(const Crs&) = delete;

    OGRSpatialReferenceH system() const { return system_; }
    void toDegrees(double& x, double& y) const { OCTTransform(toDegrees_, 1, &x, &y, nullptr); }
    void fromDegrees(double& x, double& y) const { OCTTransform(fromDegrees_, 1, &x, &y, nullptr); }

private:
    OGRSpatialReferenceH system_;
    OGRSpatialReferenceH wgs84_;
    OGRCoordinateTransformationH toDegrees_ = nullptr;
    OGRCoordinateTransformationH fromDegrees_ = nullptr;
};

// A grid of samples in a reference system. x and y are the coordinates of the middle of the first sample.
struct SampleGrid {
    int epsg = 4326;
    int width = 0;
    int height = 0;
    double x = 0;
    double y = 0;
    double step = 0;  // eastwards and southwards
};

// Returns the grid whose middle lies at a place.
inline SampleGrid gridAround(int epsg, double longitudeDeg, double latitudeDeg, int width, int height,
                             double step) {
    double x = longitudeDeg;
    double y = latitudeDeg;
    Crs(epsg).fromDegrees(x, y);
    return {epsg, width, height, x - step * (width - 1) / 2, y + step * (height - 1) / 2, step};
}

struct RasterFile {
    std::string format = "GTiff";
    GDALDataType type = GDT_Float32;
    bool isPoint = false;  // AREA_OR_POINT
    bool hasCrs = true;
    int bands = 1;
    std::optional<double> noData{};
    std::optional<double> scale{};
    std::optional<double> offset{};
    std::string unit{};
    std::vector<std::uint8_t> mask{};               // 0: hidden; empty: no mask
    std::vector<std::vector<float>> bandSamples{};  // of each band; empty: all bands have the same
    std::vector<GDALColorEntry> palette{};          // empty: no colour table
    std::vector<GDALColorInterp> meanings{};        // of the bands; empty: as GDAL chooses
    std::vector<const char*> options{};
};

using Heights = std::function<double(double longitudeDeg, double latitudeDeg)>;

// Returns the samples of a grid, row-major.
inline std::vector<float> samplesOf(const SampleGrid& grid, const Heights& height) {
    const Crs crs(grid.epsg);
    std::vector<float> samples;
    for (int row = 0; row < grid.height; ++row) {
        for (int column = 0; column < grid.width; ++column) {
            double x = grid.x + column * grid.step;
            double y = grid.y - row * grid.step;
            crs.toDegrees(x, y);
            samples.push_back(static_cast<float>(height(x, y)));
        }
    }
    return samples;
}

inline void require(bool done) {
    if (!done) throw std::runtime_error(CPLGetLastErrorMsg());
}

inline void writeRaster(const std::filesystem::path& path, const SampleGrid& grid, std::vector<float> samples,
                        const RasterFile& file = {}) {
    GDALAllRegister();
    const GDALDriverH memory = GDALGetDriverByName("MEM");
    const GDALDatasetH dataSet =
        GDALCreate(memory, "", grid.width, grid.height, file.bands, file.type, nullptr);
    require(dataSet != nullptr);
    double transform[] = {grid.x - grid.step / 2, grid.step, 0, grid.y + grid.step / 2, 0, -grid.step};
    require(GDALSetGeoTransform(dataSet, transform) == CE_None);
    const Crs crs(grid.epsg);
    if (file.hasCrs) require(GDALSetSpatialRef(dataSet, crs.system()) == CE_None);
    GDALSetMetadataItem(dataSet, "AREA_OR_POINT", file.isPoint ? "Point" : "Area", nullptr);
    for (int i = 1; i <= file.bands; ++i) {
        const GDALRasterBandH band = GDALGetRasterBand(dataSet, i);
        if (!file.bandSamples.empty()) samples = file.bandSamples[static_cast<std::size_t>(i - 1)];
        require(GDALRasterIO(band, GF_Write, 0, 0, grid.width, grid.height, samples.data(), grid.width,
                             grid.height, GDT_Float32, 0, 0) == CE_None);
        if (!file.palette.empty()) {
            const GDALColorTableH table = GDALCreateColorTable(GPI_RGB);
            for (std::size_t k = 0; k < file.palette.size(); ++k)
                GDALSetColorEntry(table, static_cast<int>(k), &file.palette[k]);
            require(GDALSetRasterColorTable(band, table) == CE_None);
            GDALDestroyColorTable(table);
        }
        if (!file.meanings.empty())
            GDALSetRasterColorInterpretation(band, file.meanings[static_cast<std::size_t>(i - 1)]);
        if (file.noData) GDALSetRasterNoDataValue(band, *file.noData);
        if (file.scale) GDALSetRasterScale(band, *file.scale);
        if (file.offset) GDALSetRasterOffset(band, *file.offset);
        if (!file.unit.empty()) GDALSetRasterUnitType(band, file.unit.c_str());
    }
    if (!file.mask.empty()) {
        std::vector<std::uint8_t> mask = file.mask;
        require(GDALCreateDatasetMaskBand(dataSet, GMF_PER_DATASET) == CE_None);
        require(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(dataSet, 1)), GF_Write, 0, 0, grid.width,
                             grid.height, mask.data(), grid.width, grid.height, GDT_Byte, 0, 0) == CE_None);
    }
    std::vector<const char*> options = file.options;
    options.push_back(nullptr);
    const GDALDatasetH copy = GDALCreateCopy(GDALGetDriverByName(file.format.c_str()), path.c_str(), dataSet,
                                             FALSE, options.data(), nullptr, nullptr);
    require(copy != nullptr);
    GDALClose(copy);
    GDALClose(dataSet);
}

inline void writeRaster(const std::filesystem::path& path, const SampleGrid& grid, const Heights& height,
                        const RasterFile& file = {}) {
    writeRaster(path, grid, samplesOf(grid, height), file);
}

}  // namespace planet::test
