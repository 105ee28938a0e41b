#include <cpl_conv.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "planet/raster/gdal_formats.h"
#include "planet/raster/gdal_raster.h"
#include "planet/raster/vrt_file.h"
#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet {
namespace {

using test::finest;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A folder with two rasters of 20 x 20 samples beside each other, at 100 m and 200 m, and one of them outside of it.
class Vrt : public testing::Test {
protected:
    Vrt() {
        std::filesystem::create_directories(in / "tiles");
        const test::SampleGrid west{4326, 20, 20, 10, 45, 0.01};
        test::SampleGrid east = west;
        east.x += 0.2;
        test::writeRaster(in / "tiles/west.tif", west, [](double, double) { return 100; });
        test::writeRaster(in / "tiles/east.tif", east, [](double, double) { return 200; });
        test::writeRaster(folder / "outside.tif", west, [](double, double) { return 300; });
    }

    static std::string source(const std::string& name, int column, const std::string& kind = "SimpleSource",
                              const std::string& more = {}) {
        return fmt::format(
            "<{}><SourceFilename relativeToVRT=\"1\">{}</SourceFilename><SourceBand>1</SourceBand>"
            "<SrcRect xOff=\"0\" yOff=\"0\" xSize=\"20\" ySize=\"20\"/>"
            "<DstRect xOff=\"{}\" yOff=\"0\" xSize=\"20\" ySize=\"20\"/>{}</{}>",
            kind, name, column, more, kind);
    }
    static std::string dataSet(const std::string& sources, const std::string& bandAttribute = {},
                               const std::string& more = {}, const std::string& attribute = {}) {
        return fmt::format(
            "<VRTDataset rasterXSize=\"40\" rasterYSize=\"20\"{}><SRS>EPSG:4326</SRS><GeoTransform>9.995, "
            "0.01, 0, "
            "45.005, 0, -0.01</GeoTransform>{}<VRTRasterBand dataType=\"Float32\" "
            "band=\"1\"{}>{}</VRTRasterBand></VRTDataset>\n",
            attribute, more, bandAttribute, sources);
    }
    std::filesystem::path write(const std::string& xml) {
        writeBytes(in / "mosaic.vrt", xml);
        return in / "mosaic.vrt";
    }
    std::string errorOfXml(const std::string& xml) { return errorOf(write(xml)); }
    std::string errorOfSource(const std::string& name) { return errorOfXml(dataSet(source(name, 0))); }

    const TemporaryFolder folder;
    const std::filesystem::path in = folder / "in";
};

TEST_F(Vrt, MosaicOfFilesBesideItIsRead) {
    const HeightSource mosaic =
        mustOpen(write(dataSet(source("tiles/west.tif", 0) +
                               source("tiles/east.tif", 20, "ComplexSource", "<ScaleRatio>2</ScaleRatio>"))));
    EXPECT_FLOAT_EQ(sampledNear(mosaic, finest, 44.9, 10.05), 100);
    EXPECT_FLOAT_EQ(sampledNear(mosaic, finest, 44.9, 10.3), 400);
    EXPECT_THAT(mosaic.description, HasSubstr("mosaic.vrt, 40 x 20 float"));
}

TEST_F(Vrt, AbsolutePathAndLinkIntoTheFolderAreRead) {
    std::filesystem::create_symlink(in / "tiles/west.tif", in / "link.tif");
    std::string xml = dataSet(source((in / "tiles/west.tif").string(), 0) + source("link.tif", 20));
    EXPECT_FLOAT_EQ(sampledNear(mustOpen(write(xml)), finest, 44.9, 10.3), 100);
}

TEST_F(Vrt, WhatWasCheckedIsWhatIsRead) {
    // A read after the check does not look at the file again.
    const auto raster = GdalRaster::open(write(dataSet(source("tiles/west.tif", 0))), HeightSourceSettings{});
    ASSERT_TRUE(raster);
    write(dataSet(source("../outside.tif", 0)));
    const auto block = (*raster)->readBlock(0, 0);
    ASSERT_TRUE(block);
    EXPECT_EQ(block->at(0), 100);
}

TEST_F(Vrt, FilesOfAMosaicAreItselfAndItsSources) {
    const HeightSourceFiles files =
        heightSourceFiles(write(dataSet(source("tiles/west.tif", 0) + source("tiles/east.tif", 20))));
    ASSERT_EQ(files.files.size(), 3u);
    EXPECT_EQ(files.files[1].filename(), "east.tif");
    EXPECT_EQ(files.files[2].filename(), "west.tif");
}

TEST_F(Vrt, SourcesElsewhereAreRefused) {
    const std::string right = fmt::format("expected a raster file in {} or below it", in.string());
    std::filesystem::create_symlink(folder / "outside.tif", in / "link.tif");
    for (const std::string& name : {std::string("../outside.tif"), (folder / "outside.tif").string(),
                                    std::string("link.tif"), std::string("tiles/../../outside.tif")}) {
        EXPECT_THAT(errorOfSource(name), AllOf(HasSubstr("mosaic.vrt: its source \"" + name +
                                                         "\" lies outside of the VRT's folder"),
                                               HasSubstr(right)));
    }
    const std::string zipped = "/vsizip/" + (in / "a.zip").string() + "/a.tif";
    for (const std::string& name :
         {std::string("none.tif"), std::string("/vsicurl/http://localhost/a.tif"), zipped,
          std::string("http://localhost/a.tif"), std::string("tiles"), std::string(),
          std::string("MEM:::DATAPOINTER=4096,PIXELS=9,LINES=9"), std::string("NETCDF:tiles/west.tif:Band1"),
          std::string("PG:dbname=x"), std::string("/dev/zero")}) {
        EXPECT_THAT(errorOfSource(name), AllOf(HasSubstr("\"" + name + "\" is no file"), HasSubstr(right)));
    }
    writeBytes(in / "text.txt", "This is no raster, only text.");
    EXPECT_THAT(errorOfSource("text.txt"), HasSubstr("is no raster in one of the formats that are read"));
}

TEST_F(Vrt, NestedVrtIsRefused) {
    EXPECT_THAT(errorOfSource("mosaic.vrt"), HasSubstr("its source \"mosaic.vrt\" is a VRT"));
    // The name says nothing: GDAL goes by the content.
    std::filesystem::copy_file(write(dataSet(source("tiles/west.tif", 0))), in / "other.tif");
    EXPECT_THAT(errorOfSource("other.tif"), HasSubstr("its source \"other.tif\" is a VRT"));
}

TEST_F(Vrt, AnythingButAPlainMosaicIsRefused) {
    const std::string good = source("tiles/west.tif", 0);
    const auto refused = [](const std::string& what, const std::string& element) {
        return AllOf(HasSubstr(fmt::format("has an {} in {}; expected a plain mosaic", what, element)),
                     HasSubstr("gdalbuildvrt"));
    };
    EXPECT_THAT(errorOfXml(dataSet(good, "", "", " subClass=\"VRTWarpedDataset\"")),
                refused("attribute \"subClass\"", "VRTDataset"));
    EXPECT_THAT(errorOfXml(dataSet(good, " subClass=\"VRTRawRasterBand\"")),
                refused("attribute \"subClass\"", "VRTRasterBand"));
    EXPECT_THAT(errorOfXml(dataSet("<PixelFunctionType>add</PixelFunctionType>" + good)),
                refused("element \"PixelFunctionType\"", "VRTRasterBand"));
    EXPECT_THAT(errorOfXml(dataSet(source("tiles/west.tif", 0, "KernelFilteredSource"))),
                refused("element \"KernelFilteredSource\"", "VRTRasterBand"));
    EXPECT_THAT(errorOfXml(dataSet(source("tiles/west.tif", 0, "SimpleSource",
                                          "<OpenOptions><OOI key=\"X\">Y</OOI></OpenOptions>"))),
                refused("element \"OpenOptions\"", "SimpleSource"));
    EXPECT_THAT(errorOfXml(dataSet(good, "", "<GDALWarpOptions/>")),
                refused("element \"GDALWarpOptions\"", "VRTDataset"));
    EXPECT_THAT(errorOfXml(dataSet(good, "",
                                   "<Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">/etc/a</MDI>"
                                   "</Metadata>")),
                refused("element \"Metadata\"", "VRTDataset"));
    EXPECT_THAT(errorOfXml(dataSet("<SimpleSource><SourceBand>1</SourceBand></SimpleSource>")),
                HasSubstr("a source has 0 elements SourceFilename; expected one"));
    EXPECT_THAT(errorOfXml(dataSet(good, "", "<Metadata><MDI key=\"a\">b</MDI></Metadata>")), "opened");
    EXPECT_THAT(errorOfXml(dataSet(good, "",
                                   "<MaskBand><VRTRasterBand dataType=\"Byte\">" +
                                       source("../outside.tif", 0) + "</VRTRasterBand></MaskBand>")),
                HasSubstr("lies outside"));
}

TEST_F(Vrt, DamagedXmlIsRefused) {
    const std::string whole = dataSet(source("tiles/west.tif", 0));
    EXPECT_THAT(errorOfXml(whole.substr(0, whole.size() / 2)),
                HasSubstr("mosaic.vrt: is no valid XML with one element VRTDataset"));
    std::string deep;
    for (int i = 0; i < 200; ++i) deep += "<SRS>";
    for (int i = 0; i < 200; ++i) deep += "</SRS>";
    EXPECT_THAT(errorOfXml(dataSet("", "", deep)), HasSubstr("is no valid XML"));
    EXPECT_THAT(errorOfXml(dataSet("", "", "<!--" + std::string(17 << 20, 'x') + "-->")),
                HasSubstr("expected at most 16777216 for a VRT"));
}

TEST_F(Vrt, OnlyDriversOnTheListAreLeft) {
    // The tests register others to write their files, so this needs a process of its own.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto tell = [&] {
        isGdalRaster(in / "tiles/west.tif");
        for (int i = 0; i < GDALGetDriverCount(); ++i)
            std::fprintf(stderr, "%s,", GDALGetDriverShortName(GDALGetDriver(i)));
        std::exit(0);
    };
    EXPECT_EXIT(tell(), testing::ExitedWithCode(0),
                AllOf(HasSubstr("GTiff,"), HasSubstr("VRT,"), Not(HasSubstr("HTTP,")), Not(HasSubstr("MEM,")),
                      Not(HasSubstr("PostGISRaster,")), Not(HasSubstr("WMS,")), Not(HasSubstr("DERIVED,"))));
}

TEST_F(Vrt, NetworkFileSystemsAreOff) {
    isGdalRaster(in / "tiles/west.tif");
    EXPECT_STREQ(CPLGetConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", ""), "none");
}

}  // namespace
}  // namespace planet
