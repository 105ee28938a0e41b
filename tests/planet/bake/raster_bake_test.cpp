// Bakes rasters of a known surface in five projections, and compares the heights of the files with it.
#include <fmt/format.h>
#include <gdal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "planet/bake/bake.h"
#include "planet/bake/file_report.h"
#include "planet/format/chunk_file.h"
#include "planet/source/height_source.h"
#include "tests/planet/source/analytic_surface.h"
#include "tests/planet/source/raster_fixture.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::radPerDeg;
using test::SampleGrid;
using ::tests::TemporaryFolder;

constexpr int rasterColumns = 120;  // samples of a raster
constexpr int rasterRows = 90;
constexpr int rimSamples = 8;  // samples from the rim of the raster to the places that are compared
constexpr int placesPerBake = ::tests::sanitized ? 20 : 225;
constexpr int placesOfARealTile = ::tests::sanitized ? 100 : 1000;
constexpr double allowedM = 0.05;  // for the conversion of places on a lattice

ChunkFile baked(const std::string& files, const TemporaryFolder& folder) {
    const HeightSource source = openHeightSource(files, {}).value();
    EXPECT_TRUE(bake(source, {.chunkSize = 33}, folder / "a.chk"));
    return ChunkFile::open(folder / "a.chk").value();
}

// The height of a file at a vertex of its finest chunk near a place, and where the vertex lies.
struct Vertex {
    double heightM = 0;
    double longitudeDeg = 0;
    double latitudeDeg = 0;
};
Vertex vertexNear(const ChunkFile& file, double longitudeDeg, double latitudeDeg) {
    const auto at = [&](double longitude, double latitude) {
        return probeFile(file, {latitude * radPerDeg, longitude * radPerDeg}).value();
    };
    const int faceCells = chunkCells(file.info().shape)
                          << at(longitudeDeg, latitudeDeg).chain.back().id.level;
    const test::Probe vertex = test::probeAt(longitudeDeg, latitudeDeg, faceCells);
    return {at(vertex.longitudeDeg, vertex.latitudeDeg).heightM, vertex.longitudeDeg, vertex.latitudeDeg};
}

// Returns how far the heights of a file lie beyond what the quantum and the interpolation of the samples allow, at random
// places of the raster; 0 if they do not.
double mostBeyond(const ChunkFile& file, const test::Projected& projection, const SampleGrid& grid,
                  std::span<const float> samples, std::mt19937& random) {
    const test::Crs crs(projection.epsg);
    const auto surface = test::terrainAround(projection.longitudeDeg, projection.latitudeDeg);
    const double halfQuantumM = fileQuantumM(file.info().shape) / 2;
    const auto [low, high] = std::ranges::minmax(samples);
    std::uniform_real_distribution<double> column(rimSamples, grid.width - rimSamples);
    std::uniform_real_distribution<double> row(rimSamples, grid.height - rimSamples);
    double most = 0;
    for (int i = 0; i < placesPerBake; ++i) {
        double x = grid.x + column(random) * grid.step;
        double y = grid.y - row(random) * grid.step;
        crs.toDegrees(x, y);
        const Vertex vertex = vertexNear(file, x, y);
        const test::Interpolated expected =
            test::interpolated(grid, crs, samples, vertex.longitudeDeg, vertex.latitudeDeg);
        // No height exceeds those of the samples.
        const double exact = std::clamp(surface(vertex.longitudeDeg, vertex.latitudeDeg),
                                        static_cast<double>(low), static_cast<double>(high));
        most = std::max(most, std::abs(vertex.heightM - exact) - halfQuantumM - expected.bound);
    }
    return most;
}

TEST(RasterBake, heightsOfFiveProjectionsAreThoseOfTheSurface) {
    const TemporaryFolder folder;
    std::mt19937 random(3);
    for (const test::Projected& projection : test::projections) {
        for (const double spacingM : {1500.0, 400.0, 90.0}) {
            const SampleGrid grid =
                test::gridAround(projection.epsg, projection.longitudeDeg, projection.latitudeDeg,
                                 rasterColumns, rasterRows, spacingM / projection.metresPerUnit);
            const std::vector<float> samples =
                test::samplesOf(grid, test::terrainAround(projection.longitudeDeg, projection.latitudeDeg));
            for (const bool isPoint : {false, true}) {
                SCOPED_TRACE(
                    fmt::format("{}, {}, {} m", projection.name, isPoint ? "points" : "areas", spacingM));
                test::writeRaster(folder / "raster.tif", grid, samples, {.isPoint = isPoint});
                EXPECT_LE(mostBeyond(baked(folder / "raster.tif", folder), projection, grid, samples, random),
                          allowedM);
            }
            std::filesystem::create_directory(folder / "tiles");
            for (const int left : {0, 50}) {
                for (const int top : {0, 40}) {
                    const int columns = left == 0 ? 50 : rasterColumns - 50;
                    const int rows = top == 0 ? 40 : rasterRows - 40;
                    test::writeRaster(folder / "tiles" / fmt::format("{}_{}.tif", left, top),
                                      test::partOf(grid, left, top, columns, rows),
                                      test::samplesOfPart(grid, samples, left, top, columns, rows));
                }
            }
            SCOPED_TRACE(fmt::format("{}, tiles, {} m", projection.name, spacingM));
            EXPECT_LE(mostBeyond(baked(folder / "tiles/*.tif", folder), projection, grid, samples, random),
                      allowedM);
        }
    }
}

// The test above must see the smallest mistake of a registration.
TEST(RasterBake, samplesHalfAStepOffAreNoticed) {
    const TemporaryFolder folder;
    std::mt19937 random(3);
    const test::Projected& utm = test::projections[1];
    const SampleGrid grid =
        test::gridAround(utm.epsg, utm.longitudeDeg, utm.latitudeDeg, rasterColumns, rasterRows, 400);
    const std::vector<float> samples =
        test::samplesOf(grid, test::terrainAround(utm.longitudeDeg, utm.latitudeDeg));
    SampleGrid shifted = grid;
    shifted.x += grid.step / 2;
    test::writeRaster(folder / "raster.tif", shifted, samples);
    EXPECT_GT(mostBeyond(baked(folder / "raster.tif", folder), utm, grid, samples, random), 1);
}

// probeFile is what worldy probe prints.
TEST(RasterBake, probedHeightsOfRealTilesAreThoseThatGdalReads) {
    const std::filesystem::path regions = std::filesystem::path(WORLDY_SOURCE_DIR) / "data/regions";
    const TemporaryFolder folder;
    std::mt19937 random(5);
    for (const char* const name : {"S33W071.tif", "N49W123.tif", "N49W124.tif"}) {
        const ChunkFile file = baked(regions / name, folder);
        const GDALDatasetH dataSet = GDALOpen((regions / name).c_str(), GA_ReadOnly);
        ASSERT_TRUE(dataSet);
        std::array<double, 6> transform{};
        GDALGetGeoTransform(dataSet, transform.data());
        std::uniform_real_distribution<double> index(rimSamples, 1200 - rimSamples);
        int compared = 0;
        for (int i = 0; i < placesOfARealTile; ++i) {
            const Vertex vertex = vertexNear(file, transform[0] + index(random) * transform[1],
                                             transform[3] + index(random) * transform[5]);
            const double x = (vertex.longitudeDeg - transform[0]) / transform[1] - 0.5;
            const double y = (vertex.latitudeDeg - transform[3]) / transform[5] - 0.5;
            const int column = static_cast<int>(std::floor(x));
            const int row = static_cast<int>(std::floor(y));
            // Columns stand up to 1.6 times closer than rows, and the filter is as much wider: six samples by four.
            std::array<std::int16_t, 24> around{};
            ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataSet, 1), GF_Read, column - 2, row - 1, 6, 4,
                                   around.data(), 6, 4, GDT_Int16, 0, 0),
                      CE_None);
            if (std::ranges::count(around, -32767) > 0) continue;
            ++compared;
            const auto [low, high] = std::ranges::minmax(around);
            const double bilinear = std::lerp(std::lerp(around[8], around[9], x - column),
                                              std::lerp(around[14], around[15], x - column), y - row);
            ASSERT_NEAR(vertex.heightM, bilinear, 0.51 + (high - low) * 0.15)
                << name << " " << column << " " << row;
        }
        EXPECT_GT(compared, placesOfARealTile / 2) << name;
        GDALClose(dataSet);
    }
}

}  // namespace
}  // namespace planet
