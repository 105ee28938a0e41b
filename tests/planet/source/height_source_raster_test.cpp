#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "planet/source/height_filter.h"
#include "planet/source/height_geographic.h"
#include "tests/planet/source/analytic_surface.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::Crs;
using test::finest;
using test::gridAround;
using test::Interpolated;
using test::interpolated;
using test::partOf;
using test::Probe;
using test::probeAt;
using test::Projected;
using test::projections;
using test::radPerDeg;
using test::RasterFile;
using test::SampleGrid;
using test::samplesOf;
using test::samplesOfPart;
using test::terrainAround;
using test::writeRaster;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::filesystem::path regions = std::filesystem::path(WORLDY_SOURCE_DIR) / "data/regions";

TEST(RasterSource, HeightsOfFiveProjectionsAreThoseOfTheSurface) {
    const TemporaryFolder folder;
    std::mt19937 random(11);
    int probes = 0;
    for (const Projected& projection : projections) {
        const auto surface = terrainAround(projection.longitudeDeg, projection.latitudeDeg);
        const Crs crs(projection.epsg);
        for (const double spacingM : {1500.0, 400.0, 90.0}) {
            const SampleGrid grid =
                gridAround(projection.epsg, projection.longitudeDeg, projection.latitudeDeg, 120, 90,
                           spacingM / projection.metresPerUnit);
            const std::vector<float> samples = samplesOf(grid, surface);
            for (const bool isPoint : {false, true}) {
                const auto path = folder / "raster.tif";
                writeRaster(path, grid, samples, {.isPoint = isPoint});
                const HeightSource source = mustOpen(path);
                std::uniform_real_distribution<double> column(2, grid.width - 4);
                std::uniform_real_distribution<double> row(2, grid.height - 4);
                for (int i = 0; i < 350; ++i, ++probes) {
                    double x = grid.x + column(random) * grid.step;
                    double y = grid.y - row(random) * grid.step;
                    crs.toDegrees(x, y);
                    const Probe probe = probeAt(x, y);
                    const double height = static_cast<double>(sampled(source, probe.tile)[0]);
                    const Interpolated expected =
                        interpolated(grid, crs, samples, probe.longitudeDeg, probe.latitudeDeg);
                    // No height exceeds those of the samples.
                    const auto limited = [&](double exact) {
                        return std::clamp(exact, source.minM, source.maxM);
                    };
                    ASSERT_NEAR(height, limited(expected.height), 0.01)
                        << projection.name << " " << spacingM << " m " << isPoint << " at " << x << " " << y;
                    ASSERT_NEAR(height, limited(surface(probe.longitudeDeg, probe.latitudeDeg)),
                                0.01 + expected.bound)
                        << projection.name << " " << spacingM << " m";
                }
            }
        }
    }
    EXPECT_GE(probes, 10'000);
}

TEST(RasterSource, SamplesHalfAStepOffAreNoticed) {
    // The test above must see the smallest mistake of a registration.
    const Projected& utm = projections[1];
    const auto surface = terrainAround(utm.longitudeDeg, utm.latitudeDeg);
    const Crs crs(utm.epsg);
    const SampleGrid grid = gridAround(utm.epsg, utm.longitudeDeg, utm.latitudeDeg, 120, 90, 200);
    SampleGrid shifted = grid;
    shifted.x += grid.step / 2;
    const TemporaryFolder folder;
    const std::vector<float> samples = samplesOf(grid, surface);
    writeRaster(folder / "shifted.tif", shifted, samples);
    const HeightSource source = mustOpen(folder / "shifted.tif");
    const Probe probe = probeAt(utm.longitudeDeg + 0.1, utm.latitudeDeg);
    const Interpolated expected = interpolated(grid, crs, samples, probe.longitudeDeg, probe.latitudeDeg);
    EXPECT_GT(std::abs(static_cast<double>(sampled(source, probe.tile)[0]) - expected.height), 1);
}

// The heights of tiles of all faces around a place, at three resolutions, one of which is coarser than the raster.
std::vector<float> heightsAround(const HeightSource& source, double longitudeDeg, double latitudeDeg) {
    std::vector<float> heights;
    for (const int faceCells : {1 << 9, 1 << 12, 1 << 15}) {
        const SampleTile middle = probeAt(longitudeDeg, latitudeDeg, faceCells).tile;
        const int column = std::clamp(middle.firstColumn - 40, 0, faceCells - 80);
        const int row = std::clamp(middle.firstRow - 40, 0, faceCells - 80);
        const std::vector<float> part = sampled(source, {middle.face, faceCells, column, row, 81, 81});
        heights.insert(heights.end(), part.begin(), part.end());
    }
    return heights;
}

TEST(RasterSource, FortyTilesAreTheWholeRasterToTheBit) {
    const TemporaryFolder folder;
    for (const Projected& projection : {projections[0], projections[1]}) {
        const SampleGrid grid = gridAround(projection.epsg, projection.longitudeDeg, projection.latitudeDeg,
                                           400, 250, 200 / projection.metresPerUnit);
        const std::vector<float> samples =
            samplesOf(grid, terrainAround(projection.longitudeDeg, projection.latitudeDeg));
        writeRaster(folder / "whole.tif", grid, samples);
        // 8 x 5 tiles share no samples; their names order them by column.
        for (int tile = 0; tile < 40; ++tile) {
            const int column = tile / 5 * 50;
            const int row = tile % 5 * 50;
            writeRaster(folder / fmt::format("tile{:02}.tif", tile), partOf(grid, column, row, 50, 50),
                        samplesOfPart(grid, samples, column, row, 50, 50));
        }
        const auto whole =
            heightsAround(mustOpen(folder / "whole.tif"), projection.longitudeDeg, projection.latitudeDeg);
        const auto tiles =
            heightsAround(mustOpen(folder / "tile*.tif"), projection.longitudeDeg, projection.latitudeDeg);
        EXPECT_EQ(whole, tiles) << projection.name;
        EXPECT_NE(std::ranges::count(whole, 0.0f), static_cast<std::ptrdiff_t>(whole.size()));
    }
}

// A cache that drops rows before the next piece needs their other columns would have them read again and again.
TEST(RasterSource, LargeFileInStripsIsReadOnce) {
    const TemporaryFolder folder;
    const Projected& projection = projections[1];
    const SampleGrid grid = gridAround(projection.epsg, projection.longitudeDeg, projection.latitudeDeg, 1000,
                                       900, 200 / projection.metresPerUnit);
    const std::vector<float> samples =
        samplesOf(grid, terrainAround(projection.longitudeDeg, projection.latitudeDeg));
    for (const GDALDataType type : {GDT_Float32, GDT_Int16}) {
        writeRaster(folder / "tiles.tif", grid, samples, {.type = type, .options = {"TILED=YES"}});
        writeRaster(folder / "strips.tif", grid, samples, {.type = type, .options = {"COMPRESS=DEFLATE"}});
        HeightSourceSettings settings;
        settings.cacheBytes = 1 << 19;
        const HeightSource strips = mustOpen(folder / "strips.tif", settings);
        EXPECT_EQ(
            heightsAround(strips, projection.longitudeDeg, projection.latitudeDeg),
            heightsAround(mustOpen(folder / "tiles.tif"), projection.longitudeDeg, projection.latitudeDeg));
        EXPECT_EQ(strips.reads().read, 1000u * 900u);
    }
}

TEST(RasterSource, OrderOfTilesThatAgreeDoesNotMatter) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(4326, 10, 45, 120, 60, 0.002);
    const std::vector<float> samples = samplesOf(grid, terrainAround(10, 45));
    const auto write = [&](const char* name, int column) {
        writeRaster(folder / name, partOf(grid, column, 0, 61, 60),
                    samplesOfPart(grid, samples, column, 0, 61, 60));
    };
    write("a1.tif", 0);  // both hold column 60
    write("a2.tif", 59);
    write("b2.tif", 0);
    write("b1.tif", 59);
    EXPECT_EQ(heightsAround(mustOpen(folder / "a*.tif"), 10, 45),
              heightsAround(mustOpen(folder / "b*.tif"), 10, 45));
}

TEST(RasterSource, FinerRasterLiesOnTopWhateverItsName) {
    const TemporaryFolder folder;
    writeRaster(folder / "a.tif", gridAround(4326, 10, 45, 41, 41, 0.001),
                [](double, double) { return 700; });
    writeRaster(folder / "b.tif", gridAround(32632, 10, 45, 100, 100, 200),
                [](double, double) { return 300; });
    const HeightSource source = mustOpen(folder / "?.tif");
    EXPECT_FLOAT_EQ(sampledNear(source, finest, 45, 10), 700);
    EXPECT_FLOAT_EQ(sampledNear(source, finest, 45.05, 10), 300);
    EXPECT_FLOAT_EQ(sampledNear(source, finest, 46, 10), 0);
    EXPECT_EQ(source.minM, 0);
    EXPECT_EQ(source.maxM, 700);
}

// A grid of a face, and a raster so fine that the kernel is stretched to `stretch` of its samples. Heights further than
// `reach` samples from a void do not depend on it.
struct Stretched {
    int faceCells;
    double stepM;
    double stretch;
    int reach;
};
// At 5, the kernel is applied to means of two samples.
constexpr std::array<Stretched, 3> stretchedKernels = {
    {{finest, 100, 1, 2}, {1 << 15, 145.4, 2.1, 5}, {1 << 15, 61.1, 5, 12}}};

// The heights with and without voids agree in every bit outside of the kernel's footprint.
void expectNoBleeding(const Stretched& kernel) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(32632, 10, 45, 200, 150, kernel.stepM);
    const std::vector<float> samples = samplesOf(grid, terrainAround(10, 45));
    writeRaster(folder / "whole.tif", grid, samples);
    const HeightSource whole = mustOpen(folder / "whole.tif");
    const Crs crs(grid.epsg);
    const auto isVoid = [](int kind, int column, int row) {
        if (kind == 0) return column == 90 && row == 70;  // one sample
        if (kind == 1) return column < 100;               // a half-plane
        return column >= 40 && column < 104 && row >= 40 && row < 104;
    };
    for (int kind = 0; kind < 3; ++kind) {
        std::vector<float> holed = samples;
        for (int i = 0; i < grid.width * grid.height; ++i) {
            if (isVoid(kind, i % grid.width, i / grid.width)) holed[static_cast<std::size_t>(i)] = -32768;
        }
        writeRaster(folder / "holed.tif", grid, holed, {.noData = -32768});
        const HeightSource source = mustOpen(folder / "holed.tif");
        std::mt19937 random(3);
        std::uniform_real_distribution<double> at(3, 146);
        int same = 0;
        int filled = 0;
        for (int i = 0; i < 3000; ++i) {
            double x = grid.x + at(random) * grid.step;
            double y = grid.y - at(random) * grid.step;
            crs.toDegrees(x, y);
            const Probe probe = probeAt(x, y, kernel.faceCells);
            x = probe.longitudeDeg;
            y = probe.latitudeDeg;
            crs.fromDegrees(x, y);
            const double column = (x - grid.x) / grid.step;
            const double row = (grid.y - y) / grid.step;
            bool near = false;
            for (int v = -kernel.reach; v <= kernel.reach; ++v) {
                for (int u = -kernel.reach; u <= kernel.reach; ++u)
                    near = near || isVoid(kind, static_cast<int>(std::floor(column)) + u,
                                          static_cast<int>(std::floor(row)) + v);
            }
            const float with = sampled(source, probe.tile)[0];
            const float without = sampled(whole, probe.tile)[0];
            if (isVoid(kind, static_cast<int>(std::lround(column)), static_cast<int>(std::lround(row)))) {
                // A mean of samples has a height if one of them has.
                if (kernel.stretch < 4) {
                    ASSERT_EQ(with, 0.0f) << kind << " at " << column << " " << row;
                }
                ++filled;
            } else if (near) {
                ASSERT_NEAR(with, without, 60 * kernel.stretch) << kind << " at " << column << " " << row;
            } else {
                ASSERT_EQ(with, without) << kind << " at " << column << " " << row;
                ++same;
            }
        }
        EXPECT_GT(same, 500);
        if (kind > 0) {
            EXPECT_GT(filled, 300);
        }
    }
}

TEST(RasterSource, VoidsNeverBleed) {
    for (const Stretched& kernel : stretchedKernels) {
        SCOPED_TRACE(kernel.stretch);
        expectNoBleeding(kernel);
    }
}

TEST(RasterSource, MasksAndAlphaHideSamples) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(4326, 10, 45, 40, 40, 0.01);
    std::vector<std::uint8_t> mask(1600, 255);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (i % 40 < 20) mask[i] = 0;
    }
    writeRaster(folder / "masked.tif", grid, std::vector<float>(1600, 500), {.mask = mask});
    const HeightSource source = mustOpen(folder / "masked.tif");
    EXPECT_EQ(source.missingCount, 800u);
    EXPECT_FLOAT_EQ(sampledNear(source, finest, 45, 10.1), 500);
    EXPECT_EQ(sampledNear(source, finest, 45, 9.9), 0);
    for (const GDALDataType type : {GDT_Byte, GDT_UInt16, GDT_Int16, GDT_Float32}) {
        std::vector<float> alpha(mask.begin(), mask.end());
        writeRaster(folder / "alpha.tif", grid, std::vector<float>(),
                    {.type = type,
                     .bands = 2,
                     .bandSamples = {std::vector<float>(1600, 200), alpha},
                     .meanings = {GCI_GrayIndex, GCI_AlphaBand},
                     .options = {"ALPHA=YES"}});
        const HeightSource seen = mustOpen(folder / "alpha.tif");
        EXPECT_EQ(seen.missingCount, 800u) << GDALGetDataTypeName(type);
        EXPECT_FLOAT_EQ(sampledNear(seen, finest, 45, 10.1), 200) << GDALGetDataTypeName(type);
        EXPECT_EQ(sampledNear(seen, finest, 45, 9.9), 0) << GDALGetDataTypeName(type);
    }
}

TEST(RasterSource, MasksAndAlphaHideSamplesOfTheWholePlanet) {
    const TemporaryFolder folder;
    const SampleGrid grid = {4326, 72, 36, -177.5, 87.5, 5};
    const std::vector<float> samples(72 * 36, 200);
    std::vector<std::uint8_t> mask(samples.size(), 255);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (i % 72 < 36) mask[i] = 0;
    }
    writeRaster(folder / "masked.tif", grid, samples, {.mask = mask});
    for (const GDALDataType type : {GDT_UInt16, GDT_Float32}) {
        writeRaster(folder / fmt::format("alpha{}.tif", static_cast<int>(type)), grid, std::vector<float>(),
                    {.type = type,
                     .bands = 2,
                     .bandSamples = {samples, std::vector<float>(mask.begin(), mask.end())},
                     .meanings = {GCI_GrayIndex, GCI_AlphaBand},
                     .options = {"ALPHA=YES"}});
    }
    for (const char* const name : {"masked.tif", "alpha2.tif", "alpha6.tif"}) {
        const HeightSource source = mustOpen(folder / name);
        EXPECT_EQ(source.missingCount, mask.size() / 2) << name;
        EXPECT_FLOAT_EQ(sampledNear(source, 64, 10, 90), 200) << name;
        EXPECT_EQ(sampledNear(source, 64, 10, -90), 0) << name;
    }
}

TEST(RasterSource, MercatorOfTheWholePlanetHasNoTrenchAtTheDateLine) {
    const TemporaryFolder folder;
    const double halfM = 20037508.342789244;
    const double step = 2 * halfM / 256;
    const auto surface = [](double longitude, double latitude) {
        return 1000 + 500 * std::sin(longitude * radPerDeg) * std::cos(latitude * radPerDeg);
    };
    writeRaster(folder / "mercator.tif", {3857, 256, 256, -halfM + step / 2, halfM - step / 2, step},
                surface);
    const HeightSource source = mustOpen(folder / "mercator.tif");
    for (const double longitude : {179.3, 179.9, 180.0, -179.9, -179.3}) {
        for (double latitude = -60; latitude <= 60; latitude += 7.3) {
            const Probe probe = probeAt(longitude, latitude);
            ASSERT_NEAR(sampled(source, probe.tile)[0], surface(probe.longitudeDeg, probe.latitudeDeg), 0.05)
                << longitude << " " << latitude;
        }
    }
    EXPECT_EQ(sharedPoints(source, 64).different, 0);
}

TEST(RasterSource, PlaceOnTheFarEdgeOfARasterHasItsHeight) {
    const TemporaryFolder folder;
    // The raster ends at 45 E, where two faces meet.
    writeRaster(folder / "west.tif", {4326, 90, 90, 0.25, 44.75, 0.5}, std::vector<float>(90 * 90, 500));
    const HeightSource source = mustOpen(folder / "west.tif");
    EXPECT_FLOAT_EQ(sampledNear(source, 64, 20, 45), 500);
    EXPECT_EQ(sampledNear(source, 64, 20, 47), 0);
}

TEST(RasterSource, RastersThatLieNowhereAreRefused) {
    const TemporaryFolder folder;
    const std::vector<float> samples(1600, 5);
    writeRaster(folder / "north.tif", {4326, 40, 40, 10, 146, 0.01}, samples);
    writeRaster(folder / "far.tif", {32632, 40, 40, 1e9, 1e9, 100}, samples);
    for (const char* const name : {"north.tif", "far.tif"}) {
        EXPECT_THAT(errorOf(folder / name),
                    AllOf(HasSubstr(fmt::format("{}: lies nowhere on the planet", name)),
                          HasSubstr("expected longitude and latitude in")))
            << name;
    }
}

TEST(RasterSource, RawFileAloneIsToldOfPlaces) {
    const TemporaryFolder folder;
    writeBytes(folder / "island.r16", std::string(std::size_t{2} * 65 * 65, 'a'));
    EXPECT_THAT(errorOf(folder / "island.r16"),
                AllOf(HasSubstr("island.r16: "), HasSubstr("expected"), HasSubstr("place = {lat")));
}

TEST(RasterSource, ScaleOffsetAndFeetBecomeMetres) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(4326, 10, 45, 40, 40, 0.01);
    writeRaster(folder / "scaled.tif", grid, std::vector<float>(1600, 500),
                {.type = GDT_Int16, .scale = 0.1, .offset = 20, .unit = "ft"});
    const HeightSource source = mustOpen(folder / "scaled.tif");
    EXPECT_NEAR(sampledNear(source, finest, 45, 10), (20 + 0.1 * 500) * 0.3048, 1e-4);
    EXPECT_NEAR(source.stepM, 0.03048, 1e-9);
    HeightSourceSettings settings;
    settings.metresPerUnit = 2;
    EXPECT_NEAR(sampledNear(mustOpen(folder / "scaled.tif", settings), finest, 45, 10), 1000, 1e-3);
}

TEST(RasterSource, LongitudesFrom0To360AreTheSamePlaces) {
    const TemporaryFolder folder;
    SampleGrid grid = gridAround(4326, -70, -32, 60, 60, 0.01);
    const auto surface = terrainAround(-70, -32);
    const std::vector<float> samples = samplesOf(grid, surface);
    writeRaster(folder / "west.tif", grid, samples);
    grid.x += 360;
    writeRaster(folder / "east.tif", grid, samples);
    const HeightSource west = mustOpen(folder / "west.tif");
    const HeightSource east = mustOpen(folder / "east.tif");
    for (int i = 0; i < 20; ++i) {
        const double latitude = -32 + 0.02 * (i - 10);
        EXPECT_NEAR(sampledNear(west, finest, latitude, -70.05), sampledNear(east, finest, latitude, -70.05),
                    1e-2);
        EXPECT_NE(sampledNear(west, finest, latitude, -70.05), 0);
    }
}

TEST(RasterSource, DateLineHasNoStep) {
    const TemporaryFolder folder;
    const auto surface = terrainAround(180, -17);
    // One raster goes across, and two meet there.
    const SampleGrid grid = gridAround(4326, 180, -17, 200, 100, 0.005);
    const std::vector<float> samples = samplesOf(grid, surface);
    writeRaster(folder / "across.tif", grid, samples);
    writeRaster(folder / "tile1.tif", partOf(grid, 0, 0, 100, 100),
                samplesOfPart(grid, samples, 0, 0, 100, 100));
    SampleGrid beyond = partOf(grid, 100, 0, 100, 100);
    beyond.x -= 360;
    writeRaster(folder / "tile2.tif", beyond, samplesOfPart(grid, samples, 100, 0, 100, 100));
    const HeightSource across = mustOpen(folder / "across.tif");
    const HeightSource tiles = mustOpen(folder / "tile*.tif");
    for (double longitude = 179.7; longitude < 180.3; longitude += 0.0013) {
        const Probe probe = probeAt(longitude, -17.03);
        const double exact = surface(probe.longitudeDeg, probe.latitudeDeg);
        ASSERT_NEAR(sampled(across, probe.tile)[0], exact, 0.5) << longitude;
        ASSERT_EQ(sampled(across, probe.tile)[0], sampled(tiles, probe.tile)[0]) << longitude;
    }
}

TEST(RasterSource, PoleIsAPlaceLikeAnyOther) {
    const TemporaryFolder folder;
    const auto surface = [](double longitude, double latitude) {
        const double x = (90 - latitude) * std::cos(longitude * radPerDeg);
        const double y = (90 - latitude) * std::sin(longitude * radPerDeg);
        return 1500 + 100 * x - 60 * y + 15 * x * y;
    };
    writeRaster(folder / "stereographic.tif", gridAround(3413, 0, 90, 301, 301, 2000), surface);
    writeRaster(folder / "cap.tif", {4326, 720, 20, -179.75, 89.75, 0.5}, surface);
    for (const char* const name : {"stereographic.tif", "cap.tif"}) {
        const HeightSource source = mustOpen(folder / name);
        for (double latitude = 88.2; latitude <= 90; latitude += 0.05) {
            for (double longitude = -180; longitude < 180; longitude += 17) {
                const Probe probe = probeAt(longitude, latitude, 1 << 15);
                ASSERT_NEAR(sampled(source, probe.tile)[0], surface(probe.longitudeDeg, probe.latitudeDeg),
                            1.5)
                    << name << " " << latitude << " " << longitude;
            }
        }
        EXPECT_EQ(sharedPoints(source, 64).different, 0);
    }
}

TEST(RasterSource, TilesOfAGridHaveTheBitsOfItsFace) {
    const TemporaryFolder folder;
    // The corner of three faces lies at 45 E, 35.26 N.
    for (const int epsg : {4326, 32638}) {
        writeRaster(folder / "corner.tif",
                    gridAround(epsg, 45, 35.264, 150, 150, epsg == 4326 ? 0.1 : 11'000),
                    terrainAround(45, 35.264));
        const HeightSource source = mustOpen(folder / "corner.tif");
        for (const int faceCells : {32, 256}) {
            const SharedPoints points = sharedPoints(source, faceCells);
            EXPECT_EQ(points.shared, pointsOnEdges(faceCells));
            EXPECT_EQ(points.different, 0);
        }
        expectTilesAgree(source, 256, 6);
    }
}

// Several places are filtered at once, and those that are left over one by one: at the end of a piece, and where a finer
// raster has given heights to some of them.
TEST(RasterSource, PiecesHaveTheBitsOfTheirPlacesOneByOne) {
    const TemporaryFolder folder;
    writeRaster(folder / "a.tif", gridAround(32632, 10, 46, 200, 200, 400), terrainAround(10, 46));
    for (const bool hasInset : {false, true}) {
        if (hasInset)
            writeRaster(folder / "b.tif", gridAround(32632, 10, 46, 20, 20, 100), terrainAround(10, 46));
        const HeightSource source = mustOpen(folder / "*.tif");
        const SampleTile middle = probeAt(10, 46, 1 << 15).tile;
        for (const int columns : {1, 4, 7, 33}) {
            const SampleTile piece{middle.face,         middle.faceCells, middle.firstColumn - columns / 2,
                                   middle.firstRow - 1, columns,          3};
            const std::vector<float> heights = sampled(source, piece);
            std::vector<float> oneByOne;
            for (int row = 0; row < piece.rows; ++row) {
                for (int column = 0; column < piece.columns; ++column) {
                    oneByOne.push_back(
                        sampled(source, {piece.face, piece.faceCells, piece.firstColumn + column,
                                         piece.firstRow + row, 1, 1})[0]);
                }
            }
            EXPECT_EQ(heights, oneByOne) << columns;
            EXPECT_NE(std::ranges::count(heights, 0.0f), static_cast<std::ptrdiff_t>(heights.size()));
        }
    }
}

TEST(RasterSource, EveryFormatGivesTheSameHeights) {
    const TemporaryFolder folder;
    const SampleGrid grid = {4326, 121, 121, 10, 46, 1.0 / 120};
    const auto surface = [](double longitude, double latitude) {
        return std::round(900 + 700 * std::sin(longitude * 3) * std::cos(latitude * 2));
    };
    writeRaster(folder / "reference.tif", grid, surface, {.type = GDT_Int16});
    const HeightSource reference = mustOpen(folder / "reference.tif");
    struct Format {
        const char* driver;
        const char* name;
        std::vector<const char*> options;
    };
    const std::vector<Format> formats = {
        {"AAIGrid", "grid.asc", {}}, {"ENVI", "grid.img", {}},
        {"EHdr", "grid.bil", {}},    {"netCDF", "grid.nc", {}},
        {"HFA", "erdas.img", {}},    {"JP2OpenJPEG", "grid.jp2", {"REVERSIBLE=YES", "QUALITY=100"}}};
    for (const Format& format : formats) {
        writeRaster(folder / format.name, grid, surface,
                    {.format = format.driver, .type = GDT_Int16, .options = format.options});
        const HeightSource source = mustOpen(folder / format.name);
        for (double latitude = 45.1; latitude < 45.9; latitude += 0.07)
            ASSERT_NEAR(sampledNear(source, finest, latitude, 10.45),
                        sampledNear(reference, finest, latitude, 10.45), 1e-3)
                << format.name;
    }
    // These two formats prescribe the size and the place of a tile.
    const SampleGrid degree = {4326, 1201, 1201, 10, 46, 1.0 / 1200};
    writeRaster(folder / "N45E010.hgt", degree, surface, {.format = "SRTMHGT", .type = GDT_Int16});
    writeRaster(folder / "grid.dt1", degree, surface, {.format = "DTED", .type = GDT_Int16});
    for (const char* const name : {"N45E010.hgt", "grid.dt1"}) {
        const HeightSource source = mustOpen(folder / name);
        for (double latitude = 45.1; latitude < 45.9; latitude += 0.07)
            ASSERT_NEAR(sampledNear(source, finest, latitude, 10.45), surface(10.45, latitude), 2) << name;
    }
}

TEST(RasterSource, RealTilesHaveNoStepWhereTheyMeet) {
    const HeightSource both = mustOpen(regions / "N49W12[34].tif");
    EXPECT_THAT(both.description, AllOf(HasSubstr("2 rasters on 1 grid"), HasSubstr("WGS 84")));
    const HeightSource west = mustOpen(regions / "N49W124.tif");
    const HeightSource east = mustOpen(regions / "N49W123.tif");
    // On either side of the shared column the pair is one of the tiles, and there its heights go on smoothly: a
    // step would show against the larger of the slopes beside it.
    int places = 0;
    for (double latitude = 49.02; latitude < 49.98; latitude += 0.003) {
        const auto at = [&](const HeightSource& source, double longitude) {
            return sampled(source, probeAt(longitude, latitude).tile)[0];
        };
        ASSERT_EQ(at(both, -123.01), at(west, -123.01));
        ASSERT_EQ(at(both, -122.99), at(east, -122.99));
        if (at(both, -123.0) == 0) continue;   // the sea, or a void
        constexpr double step = 1.0 / 12'000;  // a tenth of a sample
        float slope = 0;
        for (int i = -20; i < 20; ++i) {
            if (i != -1 && i != 0)
                slope =
                    std::max(slope, std::abs(at(both, -123 + (i + 1) * step) - at(both, -123 + i * step)));
        }
        for (const int i : {-1, 0}) {
            ASSERT_LE(std::abs(at(both, -123 + (i + 1) * step) - at(both, -123 + i * step)),
                      1.5f * slope + 0.5f)
                << latitude;
            ++places;
        }
    }
    EXPECT_GT(places, 300);
}

TEST(RasterSource, HeightsOfRealTilesAreThoseThatGdalReads) {
    std::mt19937 random(5);
    for (const char* const name : {"S33W071.tif", "N49W123.tif", "N49W124.tif"}) {
        const HeightSource source = mustOpen(regions / name);
        const GDALDatasetH dataSet = GDALOpen((regions / name).c_str(), GA_ReadOnly);
        ASSERT_TRUE(dataSet);
        std::array<double, 6> transform{};
        GDALGetGeoTransform(dataSet, transform.data());
        std::uniform_int_distribution<int> index(2, 1198);
        for (int i = 0; i < 1000; ++i) {
            const int column = index(random);
            const int row = index(random);
            const Probe probe = probeAt(transform[0] + (column + 0.5) * transform[1],
                                        transform[3] + (row + 0.5) * transform[5]);
            std::array<std::int16_t, 9> around{};
            ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(dataSet, 1), GF_Read, column - 1, row - 1, 3, 3,
                                   around.data(), 3, 3, GDT_Int16, 0, 0),
                      CE_None);
            if (std::ranges::count(around, -32767) > 0) continue;
            const auto [low, high] = std::ranges::minmax(around);
            // The finest grid is 2 m apart, so a sample of it lies up to 1 m from the raster's.
            ASSERT_NEAR(sampled(source, probe.tile)[0], around[4], 0.05 + (high - low) * 0.05)
                << name << " " << column << " " << row;
        }
        GDALClose(dataSet);
    }
}

TEST(RasterSource, FilesThatCannotBePlacedAreRefused) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(32632, 10, 45, 40, 40, 100);
    const auto flat = [](double, double) { return 5; };
    writeRaster(folder / "nocrs.tif", grid, flat, {.hasCrs = false});
    EXPECT_THAT(errorOf(folder / "nocrs.tif"),
                AllOf(HasSubstr("nocrs.tif: has no coordinate reference system"), HasSubstr("expected")));
    writeRaster(folder / "bands.tif", grid, flat, {.bands = 3});
    EXPECT_THAT(errorOf(folder / "bands.tif"), HasSubstr("has 3 channels"));
    writeRaster(folder / "bands.img", grid, flat, {.format = "HFA", .bands = 3});
    EXPECT_THAT(errorOf(folder / "bands.img"),
                HasSubstr("bands.img: has 3 bands; expected one band of heights"));
    writeRaster(folder / "void.tif", grid, std::vector<float>(1600, -9999), {.noData = -9999});
    EXPECT_THAT(errorOf(folder / "void.tif"),
                HasSubstr("void.tif: has no heights, because all 1600 samples are missing"));
    writeRaster(folder / "fathoms.tif", grid, std::vector<float>(1600, 1), {.unit = "fathom"});
    EXPECT_THAT(errorOf(folder / "fathoms.tif"), HasSubstr("its heights are in fathom"));
    EXPECT_THAT(errorOf(folder / "none*.tif"), HasSubstr("no file matches this pattern"));
    writeBytes(folder / "text.hgt", "no raster");
    EXPECT_THAT(errorOf(folder / "text.hgt"), HasSubstr("text.hgt: is not a readable"));
}

TEST(RasterSource, TruncatedFileIsNamedWithItsBlock) {
    const TemporaryFolder folder;
    writeRaster(folder / "a.tif", gridAround(32632, 10, 45, 600, 600, 100), terrainAround(10, 45),
                {.options = {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256"}});
    const auto bytes = std::filesystem::file_size(folder / "a.tif");
    std::filesystem::resize_file(folder / "a.tif", bytes / 2);
    EXPECT_THAT(errorOf(folder / "a.tif"), AllOf(HasSubstr("a.tif"), HasSubstr("cannot be read")));
}

TEST(RasterSource, TruncatedPicturesAreStillNoticedOnceGdalIsInUse) {
    const TemporaryFolder folder;
    writeRaster(folder / "a.tif", gridAround(32632, 10, 45, 60, 60, 100), terrainAround(10, 45));
    mustOpen(folder / "a.tif");
    writeImage(folder / "world.tif", Image<float>(512, 256, [](int x, int y) { return noise(x, y, 1000); }));
    std::filesystem::resize_file(folder / "world.tif",
                                 std::filesystem::file_size(folder / "world.tif") - 1000);
    EXPECT_THAT(errorOf(folder / "world.tif"), HasSubstr("world.tif"));
}

TEST(RasterSource, FilesOfAPatternAreFoundInOrder) {
    const TemporaryFolder folder;
    const SampleGrid grid = gridAround(4326, 10, 45, 20, 20, 0.01);
    for (const char* const name : {"b2.tif", "a1.tif", "c.txt"}) writeBytes(folder / name, "x");
    writeRaster(folder / "b1.tif", grid, [](double, double) { return 1; });
    const HeightSourceFiles files = heightSourceFiles(folder / "*.tif");
    ASSERT_EQ(files.files.size(), 3u);
    EXPECT_EQ(files.files[0].filename(), "a1.tif");
    EXPECT_EQ(files.files[2].filename(), "b2.tif");
    EXPECT_EQ(files.stem, std::filesystem::path(folder / "*.tif").parent_path().filename());
    EXPECT_EQ(heightSourceFiles(folder / "b*.tif").stem, "b");
    EXPECT_TRUE(heightSourceExists(folder / "*.tif"));
    EXPECT_FALSE(heightSourceExists(folder / "*.png"));
    // One file that is no raster names itself.
    EXPECT_THAT(errorOf(folder / "*.tif"), HasSubstr("a1.tif: is not a readable raster"));
}

}  // namespace
}  // namespace planet
