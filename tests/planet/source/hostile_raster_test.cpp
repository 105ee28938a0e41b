// Rasters that are empty, cut off, or whose headers lie: they are refused with a message, in bounded time and memory.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "planet/raster/raster_placement.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class HostileRaster : public testing::Test {
protected:
    static test::SampleGrid grid() { return test::gridAround(4326, 10, 45, 40, 40, 0.01); }
    static double height(double longitude, double latitude) { return std::round(longitude * latitude); }

    const TemporaryFolder folder;
};

TEST_F(HostileRaster, EmptyFilesAreRefused) {
    for (const char* const name : {"a.tif", "a.hgt", "a.asc", "a.nc", "a.jp2", "a.img", "a.bil", "a.dt1",
                                   "a.vrt", "a.png", "N45E010.hgt", "a"}) {
        writeBytes(folder / name, "");
        EXPECT_THAT(errorOf(folder / name), HasSubstr(std::string(name) + ": is ")) << name;
    }
}

TEST_F(HostileRaster, EveryTruncationIsRefusedOrReadWithinItsRange) {
    struct Format {
        const char* driver;
        const char* name;
        std::vector<const char*> options;
    };
    const std::vector<Format> formats = {
        {"GTiff", "rows.tif", {}},
        {"GTiff", "tiled.tif", {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=DEFLATE"}},
        {"AAIGrid", "grid.asc", {}},
        {"ENVI", "envi.img", {}},
        {"HFA", "erdas.img", {}},
        {"netCDF", "grid.nc", {}},
        {"JP2OpenJPEG", "grid.jp2", {"REVERSIBLE=YES", "QUALITY=100"}}};
    for (const Format& format : formats) {
        const std::filesystem::path path = folder / format.name;
        test::writeRaster(path, grid(), height,
                          {.format = format.driver, .type = GDT_Int16, .options = format.options});
        const auto whole = std::filesystem::file_size(path);
        int refused = 0;
        for (auto bytes = whole; bytes > 0; bytes -= std::min(bytes, whole / 40 + 1)) {
            std::filesystem::resize_file(path, bytes);
            const Result<HeightSource> source = openHeightSource(path, {});
            if (!source) {
                ++refused;
                ASSERT_THAT(source.error().message, HasSubstr(format.name));
                continue;
            }
            const float found = sampledNear(*source, 1 << 20, 45, 10);
            ASSERT_TRUE(found >= source->minM && found <= source->maxM) << format.name << " " << bytes;
        }
        EXPECT_GT(refused, 3) << format.name;
    }
}

TEST_F(HostileRaster, DimensionsThatAFileCannotHoldAreRefused) {
    const auto asciiGrid = [&](const std::string& columns, const std::string& rows) {
        writeBytes(folder / "a.asc",
                   fmt::format("ncols {}\nnrows {}\nxllcorner 10\nyllcorner 45\ncellsize 0.00001\n1 2 3\n",
                               columns, rows));
        writeBytes(folder / "a.prj", "EPSG:4326");
        return errorOf(folder / "a.asc");
    };
    EXPECT_THAT(asciiGrid("4000000", "4000000"),
                HasSubstr("is 4000000 x 4000000 samples; expected at most 2^38"));
    EXPECT_THAT(asciiGrid("5000000", "2"), HasSubstr("expected [1, 4194304] per side"));
    EXPECT_THAT(asciiGrid("2000000000", "2"), HasSubstr("is not a readable raster"));
    for (const auto& [columns, rows] :
         {std::pair("-5", "7"), std::pair("0", "0"), std::pair("99999999999", "3"), std::pair("x", "y")})
        EXPECT_THAT(asciiGrid(columns, rows),
                    AnyOf(HasSubstr("is not a readable raster"), HasSubstr("samples")));

    writeBytes(folder / "b.bil", "12");
    writeBytes(folder / "b.hdr",
               "NCOLS 4000000\nNROWS 4000000\nNBITS 16\nULXMAP 10\nULYMAP 45\nXDIM 0.00001\nYDIM 0.00001\n");
    EXPECT_THAT(errorOf(folder / "b.bil"), HasSubstr("b.bil"));

    // A sparse file of some hundred bytes.
    GDALAllRegister();
    const std::string name = (folder / "sparse.tif").string();
    const std::vector<const char*> options = {"SPARSE_OK=TRUE",   "TILED=YES",   "BLOCKXSIZE=16384",
                                              "BLOCKYSIZE=16384", "BIGTIFF=YES", nullptr};
    const GDALDatasetH sparse =
        GDALCreate(GDALGetDriverByName("GTiff"), name.c_str(), 1 << 21, 1 << 18, 1, GDT_Byte, options.data());
    ASSERT_TRUE(sparse);
    double transform[] = {10, 1e-5, 0, 45, 0, -1e-5};
    GDALSetGeoTransform(sparse, transform);
    GDALSetSpatialRef(sparse, test::Crs(4326).system());
    GDALClose(sparse);
    EXPECT_THAT(errorOf(folder / "spars*.tif"), HasSubstr("2097152 x 262144 samples; expected at most 2^38"));
}

// Creates a sparse file with blocks of 1024 x 1024 samples, of which one has a height of 500 m.
void writeSparse(const std::filesystem::path& path, int width, int height, bool hasNoData,
                 GDALDataType type = GDT_Int16) {
    GDALAllRegister();
    const std::vector<const char*> options = {"SPARSE_OK=TRUE",  "TILED=YES",   "BLOCKXSIZE=1024",
                                              "BLOCKYSIZE=1024", "BIGTIFF=YES", nullptr};
    const GDALDatasetH sparse = GDALCreate(GDALGetDriverByName("GTiff"), path.string().c_str(), width, height,
                                           1, type, options.data());
    ASSERT_TRUE(sparse);
    double transform[] = {10, 1e-4, 0, 45, 0, -1e-4};
    GDALSetGeoTransform(sparse, transform);
    GDALSetSpatialRef(sparse, test::Crs(4326).system());
    if (hasNoData) GDALSetRasterNoDataValue(GDALGetRasterBand(sparse, 1), -9999);
    std::vector<std::int16_t> block(1024 * 1024, 500);
    ASSERT_EQ(GDALRasterIO(GDALGetRasterBand(sparse, 1), GF_Write, 1024, 2048, 1024, 1024, block.data(), 1024,
                           1024, GDT_Int16, 0, 0),
              CE_None);
    GDALClose(sparse);
}

TEST_F(HostileRaster, EmptyBlocksAreNotRead) {
    constexpr int side = 1 << 14;
    writeSparse(folder / "sparse.tif", side, side, true);
    const HeightSource source = mustOpen(folder / "sparse.tif");
    EXPECT_EQ(source.sampleCount, std::uint64_t{side} * side);
    EXPECT_EQ(source.missingCount, source.sampleCount - 1024 * 1024);
    EXPECT_FLOAT_EQ(sampledNear(source, test::finest, 45 - 0.25, 10 + 0.15), 500);
    EXPECT_EQ(sampledNear(source, test::finest, 45 - 0.25, 10 + 0.3), 0);
    EXPECT_LE(source.reads().read, 10u * 1024 * 1024);
}

// GDAL reads 0 where such a file stores nothing.
TEST_F(HostileRaster, ANoDataValueThatSamplesCannotHaveMarksNone) {
    constexpr int side = 1 << 13;
    writeSparse(folder / "unsigned.tif", side, side, true, GDT_UInt16);
    const HeightSource source = mustOpen(folder / "unsigned.tif");
    EXPECT_EQ(source.missingCount, 0u);
    EXPECT_EQ(source.minM, 0);
    EXPECT_EQ(source.maxM, 500);
}

TEST_F(HostileRaster, MoreSamplesThanAFileCanHoldAreRefused) {
    // 2^35 samples would be read for minutes.
    writeSparse(folder / "zeros.tif", 1 << 18, 1 << 17, false);
    EXPECT_THAT(errorOf(folder / "zeros.tif"),
                AllOf(HasSubstr("zeros.tif: is 262144 x 131072 samples in files of "),
                      HasSubstr("expected at most")));
    writeSparse(folder / "sparse.tif", 1 << 18, 1 << 17, true);
    const HeightSource source = mustOpen(folder / "sparse.tif");
    EXPECT_FLOAT_EQ(sampledNear(source, test::finest, 45 - 0.25, 10 + 0.15), 500);
    EXPECT_LE(source.reads().read, 10u * 1024 * 1024);
}

TEST_F(HostileRaster, BlocksThatDoNotFitInMemoryAreRefused) {
    GDALAllRegister();
    const std::string name = (folder / "block.tif").string();
    const std::vector<const char*> options = {"SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=32768",
                                              "BLOCKYSIZE=32768", nullptr};
    const GDALDatasetH made =
        GDALCreate(GDALGetDriverByName("GTiff"), name.c_str(), 40000, 40000, 1, GDT_Byte, options.data());
    ASSERT_TRUE(made);
    double transform[] = {10, 1e-5, 0, 45, 0, -1e-5};
    GDALSetGeoTransform(made, transform);
    GDALSetSpatialRef(made, test::Crs(4326).system());
    GDALClose(made);
    EXPECT_THAT(errorOf(folder / "bloc*.tif"), HasSubstr("has blocks of 32768 x 32768 samples"));
}

TEST_F(HostileRaster, VrtThatClaimsMoreThanItsSourcesIsRefused) {
    test::writeRaster(folder / "a.tif", grid(), height);
    writeBytes(
        folder / "a.vrt",
        "<VRTDataset rasterXSize=\"4000000\" rasterYSize=\"4000000\"><SRS>EPSG:4326</SRS><GeoTransform>10, "
        "1e-5, 0, 45, 0, -1e-5</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
        "<SourceFilename relativeToVRT=\"1\">a.tif</SourceFilename><SourceBand>1</SourceBand>"
        "</SimpleSource></VRTRasterBand></VRTDataset>");
    EXPECT_THAT(errorOf(folder / "a.vrt"), HasSubstr("expected at most 2^38"));
}

TEST_F(HostileRaster, ACodeOfAnotherKindOfReferenceSystemIsRefused) {
    // EPSG:4342 is geocentric. PROJ 9.1 crashed on the transformation to it.
    const std::string crs =
        "GEOGCRS[\"a\",DATUM[\"b\",ELLIPSOID[\"GRS 1980\",6378137,298.257222101]],CS[ellipsoidal,2],"
        "AXIS[\"latitude\",north],AXIS[\"longitude\",east],ANGLEUNIT[\"degree\",0.0174532925199433],"
        "ID[\"EPSG\",4342]]";
    const auto placement = RasterPlacement::make("a.tif", {{10, 1, 0}, {45, 0, 1}, crs});
    ASSERT_FALSE(placement);
    EXPECT_THAT(placement.error().message, HasSubstr("a.tif: "));
}

}  // namespace
}  // namespace planet
