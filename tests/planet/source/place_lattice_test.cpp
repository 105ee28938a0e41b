#include "planet/source/place_lattice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "planet/raster/raster_area.h"
#include "planet/raster/raster_mosaic.h"
#include "planet/source/raster_sampling.h"
#include "planet/source/sample_tiles.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::gridAround;

// A flat raster of 256 x 256 samples around a place.
class FlatLatticeRaster : public Raster {
public:
    FlatLatticeRaster(int epsg, double longitudeDeg, double latitudeDeg, double step) {
        const test::SampleGrid grid = gridAround(epsg, longitudeDeg, latitudeDeg, side, side, step);
        path_ = "flat.tif";
        layout_.width = layout_.height = layout_.blockWidth = layout_.blockHeight = side;
        layout_.crs = fmt::format("EPSG:{}", epsg);
        layout_.x = {grid.x, step, 0};
        layout_.y = {grid.y, 0, -step};
    }
    Result<std::vector<float>> readBlock(int, int) const override {
        return std::vector<float>(side * side, 100);
    }

    static constexpr int side = 256;
};

RasterArea flatAreaAround(int epsg, double longitudeDeg, double latitudeDeg, double step) {
    auto mosaics =
        RasterMosaic::join({std::make_shared<FlatLatticeRaster>(epsg, longitudeDeg, latitudeDeg, step)},
                           std::make_shared<MosaicCache>(1 << 20));
    return surveyArea(std::move(mosaics.value()[0])).area;
}

SampleTile latticePieceAround(double longitudeDeg, double latitudeDeg, int faceCells, int side) {
    SampleTile piece = tileNear(faceCells, latitudeDeg, longitudeDeg);
    piece.firstColumn = std::clamp(piece.firstColumn - side / 2, 0, faceCells + 1 - side);
    piece.firstRow = std::clamp(piece.firstRow - side / 2, 0, faceCells + 1 - side);
    piece.columns = piece.rows = side;
    return piece;
}

struct LatticePlace {
    const char* name;
    int epsg;
    double longitudeDeg;
    double latitudeDeg;
};
constexpr LatticePlace latticePlaces[] = {{"UTM", 32719, -70.3, -32.6},
                                          {"UTM, far from its meridian", 32632, 24, 60},
                                          {"Mercator", 3857, 11.2, 46.4},
                                          {"Mercator, far north", 3857, 11.2, 82},
                                          {"Mercator, date line", 3857, 180, -17},
                                          {"polar stereographic", 3413, -40, 78},
                                          {"north pole", 3413, 0, 90},
                                          {"equal area", 3035, 14, 47.2},
                                          {"Albers", 5070, -100, 40},
                                          {"cylindrical equal area", 6933, 100, 55}};

TEST(PlaceLattice, PlacesAreWithinAFiveHundredthOfASample) {
    for (const LatticePlace& place : latticePlaces) {
        for (const double step : {1.0, 30.0, 1000.0}) {
            const RasterArea area = flatAreaAround(place.epsg, place.longitudeDeg, place.latitudeDeg, step);
            // The finest grid that a raster needs, and one twice as fine.
            for (const int faceCells : {area.faceCells, std::min(2 * area.faceCells, test::finest)}) {
                const PiecePlaces piece(
                    latticePieceAround(place.longitudeDeg, place.latitudeDeg, faceCells, 65));
                const PlacesOnGrid found = placesOnGrid(area, piece);
                ASSERT_GT(found.index.size(), 200u) << place.name << " " << step;
                EXPECT_GT(latticeCellsFor(faceCells, area.samplesPerRad), 0) << place.name << " " << step;
                std::vector<double> columns(piece.count());
                std::vector<double> rows(columns.size());
                area.mosaic.placement().toGrid(piece.geographic().longitudeRad,
                                               piece.geographic().latitudeRad, columns, rows);
                double most = 0;
                for (std::size_t i = 0; i < found.index.size(); ++i) {
                    const double around = area.mosaic.placement().columnsAround();
                    const double off = found.column[i] - columns[found.index[i]];
                    most = std::max({most, std::abs(around > 0 ? std::remainder(off, around) : off),
                                     std::abs(found.row[i] - rows[found.index[i]])});
                }
                EXPECT_LT(most, 0.002) << place.name << " " << step << " " << faceCells;
                EXPECT_GT(most, 0) << place.name << " " << step << ": nothing was interpolated";
            }
        }
    }
}

TEST(PlaceLattice, PlaceIsTheSameInEveryPieceAndOnEveryGrid) {
    // Three faces meet at 45 E, 35.26 N.
    const RasterArea area = flatAreaAround(32638, 44.9, 35.2, 90);
    constexpr int filterCells = 1 << 17;
    ASSERT_GT(latticeCellsFor(filterCells, area.samplesPerRad), 0);
    SampleTile whole = latticePieceAround(44.9, 35.2, filterCells, 129);
    whole.firstColumn = whole.firstColumn / 8 * 8;
    whole.firstRow = whole.firstRow / 8 * 8;
    const PlacesOnGrid all = placesOnGrid(area, PiecePlaces(whole));
    ASSERT_EQ(all.index.size(), samplesIn(whole));
    const auto expectSame = [&](const SampleTile& part, int apart) {
        const PlacesOnGrid found = placesOnGrid(area, PiecePlaces(part));
        ASSERT_EQ(found.index.size(), samplesIn(part));
        for (std::size_t i = 0; i < found.index.size(); ++i) {
            const int column = static_cast<int>(i) % part.columns + part.firstColumn;
            const int row = static_cast<int>(i) / part.columns + part.firstRow;
            const std::size_t at = indexIn(whole, column * apart, row * apart);
            ASSERT_EQ(found.column[i], all.column[at]) << column << " " << row;
            ASSERT_EQ(found.row[i], all.row[at]) << column << " " << row;
        }
    };
    for (const int side : {1, 17, 65}) {
        SampleTile part = whole;
        part.firstColumn += 23;
        part.firstRow += 41;
        part.columns = part.rows = side;
        expectSame(part, 1);
    }
    for (const int apart : {2, 4, 8}) {
        SampleTile coarse{whole.face,
                          filterCells / apart,
                          whole.firstColumn / apart,
                          whole.firstRow / apart,
                          128 / apart + 1,
                          128 / apart + 1,
                          filterCells};
        expectSame(coarse, apart);
    }
}

TEST(PlaceLattice, SharedEdgesHaveTheSameBits) {
    const tests::TemporaryFolder folder;
    // At this resolution a lattice is used even on a grid of 256 cells, whose edges are all compared.
    writeRaster(folder / "coarse.tif", gridAround(32638, 45, 35.264, 12, 12, 640'000),
                [](double longitude, double latitude) { return 100 * std::sin(longitude) + 50 * latitude; });
    const HeightSource source = mustOpen(folder / "coarse.tif");
    ASSERT_GT(latticeCellsFor(256, flatAreaAround(32638, 45, 35.264, 640'000).samplesPerRad), 0);
    const SharedPoints points = sharedPoints(source, 256);
    EXPECT_EQ(points.shared, pointsOnEdges(256));
    EXPECT_EQ(points.different, 0);
    expectTilesAgree(source, 256, 6);
}

}  // namespace
}  // namespace planet
