#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "planet/raster/vertical_datum.h"
#include "planet/source/source_layers.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::finest;
using test::radPerDeg;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// Geoids that two planted grids hold: linear between the grids' points, which lie 15 degrees apart.
double egm96At(double, double latitude) {
    return 20 + latitude / 3;
}
double egm2008At(double longitude, double latitude) {
    return -30 + latitude / 5 + std::abs(longitude) / 10;
}

double shiftAt(const DatumShift& shift, double longitudeDeg, double latitudeDeg) {
    const double longitude = longitudeDeg * radPerDeg;
    const double latitude = latitudeDeg * radPerDeg;
    double found = 0;
    shift.at(std::span(&longitude, 1), std::span(&latitude, 1), std::span(&found, 1));
    return found;
}

DatumShift mustMake(VerticalDatum from, VerticalDatum to) {
    Result<DatumShift> shift = DatumShift::make(from, to);
    if (!shift) throw std::runtime_error(shift.error().message);
    return *shift;
}

// A folder of grids in which PROJ looks first, and a world of a plain at 300 m.
class VerticalDatums : public testing::Test {
protected:
    VerticalDatums() {
        setenv("PROJ_USER_WRITABLE_DIRECTORY", (folder / "grids").c_str(), 1);
        std::filesystem::create_directory(folder / "grids");
        test::writeRaster(folder / "plain.tif", test::gridAround(4326, 10, 45, 201, 201, 0.01),
                          [](double, double) { return 300; });
    }
    ~VerticalDatums() override { unsetenv("PROJ_USER_WRITABLE_DIRECTORY"); }

    static test::SampleGrid wholePlanet() { return {4326, 24, 13, -180, 90, 15}; }
    void plantEgm96() {
        test::writeRaster(folder / "grids/us_nga_egm96_15.tif", wholePlanet(), egm96At, {.isPoint = true});
    }
    void plantEgm2008(const test::SampleGrid& grid = wholePlanet()) {
        test::writeRaster(folder / "grids/egm08_25.gtx", grid, egm2008At, {.format = "GTX"});
    }

    std::filesystem::path write(const std::string& planet, const std::string& layer) {
        writeBytes(folder / "world.toml", fmt::format("{}\n[[elevation]]\n{}\n", planet, layer));
        return folder / "world.toml";
    }

    const TemporaryFolder folder;
};

TEST_F(VerticalDatums, HeightAboveAGeoidIsThatAboveTheEllipsoidLessTheGeoids) {
    plantEgm96();
    plantEgm2008();
    constexpr double h = 300;
    for (const auto& [longitude, latitude] :
         {std::pair(10.0, 45.0), std::pair(-70.3, -32.1), std::pair(0.0, 90.0), std::pair(151.0, -90.0)}) {
        const double aboveEgm96 = h - egm96At(longitude, latitude);
        EXPECT_NEAR(
            h + shiftAt(mustMake(VerticalDatum::Ellipsoid, VerticalDatum::Egm96), longitude, latitude),
            aboveEgm96, 1e-4);
        EXPECT_NEAR(aboveEgm96 + shiftAt(mustMake(VerticalDatum::Egm96, VerticalDatum::Ellipsoid), longitude,
                                         latitude),
                    h, 1e-4);
        EXPECT_NEAR(
            aboveEgm96 + shiftAt(mustMake(VerticalDatum::Egm96, VerticalDatum::Egm2008), longitude, latitude),
            h - egm2008At(longitude, latitude), 1e-4);
    }
    EXPECT_EQ(shiftAt(mustMake(VerticalDatum::Egm96, VerticalDatum::Egm96), 10, 45), 0);
}

TEST_F(VerticalDatums, GridGoesOnAcrossTheDateLine) {
    plantEgm2008();
    const DatumShift shift = mustMake(VerticalDatum::Egm2008, VerticalDatum::Ellipsoid);
    for (const double longitude : {170.0, 179.9, 180.0, -180.0, -179.9})
        EXPECT_NEAR(shiftAt(shift, longitude, 20), egm2008At(longitude, 20), 1e-4) << longitude;
}

TEST_F(VerticalDatums, RangeHoldsAllShifts) {
    plantEgm96();
    const DatumShift shift = mustMake(VerticalDatum::Egm96, VerticalDatum::Ellipsoid);
    EXPECT_LE(shift.minM(), egm96At(0, -90));
    EXPECT_GE(shift.maxM(), egm96At(0, 90));
    EXPECT_GE(shift.minM(), egm96At(0, -90) - 20);
    EXPECT_LE(shift.maxM(), egm96At(0, 90) + 20);
}

TEST_F(VerticalDatums, TheRealGridOfEgm96HasTheHeightOfItsTestPoint) {
    const Result<DatumShift> shift = DatumShift::make(VerticalDatum::Egm96, VerticalDatum::Ellipsoid);
    if (!shift) GTEST_SKIP() << shift.error().message;
    // From the file OUTINTPT.DAT of NGA's program INTPT for this grid.
    EXPECT_NEAR(shiftAt(*shift, 269.7791550, 38.6281550), -31.628, 0.05);
}

TEST_F(VerticalDatums, LayerOfAnotherDatumIsConverted) {
    plantEgm96();
    const HeightSource world =
        mustOpen(write("datum = \"ellipsoid\"\nfill_m = -5", "files = \"plain.tif\"\ndatum = \"egm96\""));
    EXPECT_NEAR(sampledNear(world, finest, 45.3, 10), 300 + egm96At(10, 45.3), 1e-3);
    EXPECT_NEAR(sampledNear(world, finest, 44.2, 10), 300 + egm96At(10, 44.2), 1e-3);
    EXPECT_EQ(sampledNear(world, finest, 50, 10), -5) << "the height without a layer is the planet's";
    EXPECT_GE(world.maxM, 300 + egm96At(10, 90));
    const HeightSource back =
        mustOpen(write("datum = \"egm96\"", "files = \"plain.tif\"\ndatum = \"ellipsoid\"\nscale = 2"));
    EXPECT_NEAR(sampledNear(back, finest, 45.3, 10), 600 - egm96At(10, 45.3), 1e-3);
}

TEST_F(VerticalDatums, ReadingOfALayerIsConverted) {
    plantEgm96();
    const HeightSource world =
        mustOpen(write("datum = \"ellipsoid\"", "files = \"plain.tif\"\ndatum = \"egm96\"\nscale = 2"));
    const auto readings = world.layers->at({45.3 * radPerDeg, 10 * radPerDeg});
    ASSERT_TRUE(readings) << readings.error().message;
    EXPECT_NEAR((*readings)[0].heightM.value(), 600 + egm96At(10, 45.3), 1e-3);
}

TEST_F(VerticalDatums, ImageOfThePlanetIsConvertedToo) {
    plantEgm96();
    writeImage(folder / "earth.tif", Image<float>(64, 32, [](int, int) { return 100; }));
    const HeightSource world =
        mustOpen(write("datum = \"ellipsoid\"", "files = \"earth.tif\"\ndatum = \"egm96\""));
    for (const double latitude : {-89.0, -30.0, 0.0, 77.0})
        EXPECT_NEAR(sampledNear(world, finest, latitude, 100), 100 + egm96At(100, latitude), 1e-3);
}

TEST_F(VerticalDatums, SameDatumNeedsNoGrid) {
    const HeightSource world =
        mustOpen(write("datum = \"egm2008\"", "files = \"plain.tif\"\ndatum = \"egm2008\""));
    EXPECT_FLOAT_EQ(sampledNear(world, finest, 45.3, 10), 300);
}

TEST_F(VerticalDatums, MissingGridIsNamedWithWherePROJLooks) {
    const auto path = write("datum = \"ellipsoid\"", "files = \"plain.tif\"\ndatum = \"egm2008\"");
    // PROJ does not look again for a grid that a process has opened once, so the test runs in a process of its own.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto tell = [&] {
        std::fprintf(stderr, "%s\n", errorOf(path).c_str());
        std::exit(0);
    };
    EXPECT_EXIT(tell(), testing::ExitedWithCode(0),
                AnyOf(HasSubstr("opened"),  // the grid is installed
                      AllOf(HasSubstr("us_nga_egm08_25.tif: PROJ has no such grid for datum egm2008 in "),
                            HasSubstr("/grids"), HasSubstr("projsync --file us_nga_egm08_25.tif"),
                            HasSubstr("or offset_m in the layer"), HasSubstr("layer \"plain.tif\""))));
}

TEST_F(VerticalDatums, OffsetTakesThePlaceOfTheGridEvenIfThereIsOne) {
    const std::string layer = "files = \"plain.tif\"\ndatum = \"egm96\"\noffset_m = 50";
    for (int i = 0; i < 2; ++i) {
        EXPECT_FLOAT_EQ(sampledNear(mustOpen(write("datum = \"ellipsoid\"", layer)), finest, 45.3, 10), 350);
        plantEgm96();
    }
}

TEST_F(VerticalDatums, PlaceOutsideOfTheGridIsNamed) {
    plantEgm2008({4326, 3, 3, 60, 60, 15});
    const HeightSource world =
        mustOpen(write("datum = \"egm2008\"", "files = \"plain.tif\"\ndatum = \"ellipsoid\""));
    std::array<float, 1> out{};
    const FacePoint point = facePointFromDirection(directionFromGeographic({45 * radPerDeg, 10 * radPerDeg}));
    const auto at = [&](double u) { return static_cast<int>(std::lround((u + 1) / 2 * finest)); };
    const Result<void> done = world.sample({point.face, finest, at(point.u), at(point.v), 1, 1}, out);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, AllOf(HasSubstr("layer \"plain.tif\""), HasSubstr("has no value at 45"),
                                            HasSubstr("expected a grid of the whole planet")));
}

TEST_F(VerticalDatums, DatumOnOneSideOnlyIsAContradiction) {
    const auto error = [&](const std::string& planet, const std::string& layer) {
        return errorOf(write(planet, layer));
    };
    EXPECT_THAT(error("", "files = \"plain.tif\"\ndatum = \"egm96\""),
                AllOf(HasSubstr("the layer's datum is egm96"), HasSubstr("expected datum at its top too")));
    EXPECT_THAT(error("datum = \"egm96\"", "files = \"plain.tif\""),
                AllOf(HasSubstr("line 2: the planet's datum is egm96"),
                      HasSubstr("expected datum in the layer too")));
    EXPECT_THAT(error("datum = \"egm96\"", "terrain = \"noise:fbm\"\ndatum = \"egm96\""),
                HasSubstr("have no datum"));
    EXPECT_THAT(error("datum = \"egm96\"", "files = \"plain.tif\"\njoin = \"add\"\ndatum = \"egm96\""),
                HasSubstr("have no datum"));
    EXPECT_THAT(error("datum = \"msl\"", "files = \"plain.tif\"\n"),
                AllOf(HasSubstr("line 1: datum is 'msl'"),
                      HasSubstr("expected \"ellipsoid\", \"egm96\" or \"egm2008\"")));
    EXPECT_EQ(error("datum = \"egm96\"", "terrain = \"noise:fbm\""), "opened");
    EXPECT_EQ(error("datum = \"egm96\"", "files = \"plain.tif\"\njoin = \"add\""), "opened");
}

}  // namespace
}  // namespace planet
