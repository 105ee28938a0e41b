#include "planet/raster/netcdf_copy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <stop_token>
#include <string>
#include <utility>

#include "tests/planet/source/height_source_fixture.h"
#include "tests/planet/source/raster_fixture.h"
#include "tests/support/sanitized.h"

namespace planet {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class NetcdfFiles : public testing::Test {
protected:
    void writeGrid(const char* name, double heightM, const char* format = "NC") const {
        const std::string option = std::string("FORMAT=") + format;
        test::writeRaster(folder / name, test::gridAround(4326, 10, 45, 40, 40, 0.01),
                          [&](double, double) { return heightM; },
                          {.format = "netCDF", .type = GDT_Int16, .options = {option.c_str()}});
    }
    std::string copyError(const char* name, const char* program) const {
        const auto copy = copyOfNetcdf(folder / name, {}, program);
        return copy ? "" : copy.error().message;
    }

    const TemporaryFolder folder;
};

// A header that claims 2^31 - 1 dimensions. libnetcdf 4.9.0 crashes on it, or fails where memory is limited.
constexpr char tooManyDimensions[] = "CDF\x01\0\0\0\0\0\0\0\x0a\x7f\xff\xff\xff\0\0\0\x03lat\0\0\0\0\x09";

TEST_F(NetcdfFiles, aHeaderThatCrashesItsReaderIsRefused) {
    writeBytes(folder / "hostile.nc", std::string(tooManyDimensions, sizeof(tooManyDimensions) - 1));
    const std::string error = errorOf(folder / "hostile.nc");
    EXPECT_THAT(error, StartsWith((folder / "hostile.nc").string()));
    // The address sanitizer ends the reader with words of its own.
    if (!tests::sanitized) {
        EXPECT_THAT(error, HasSubstr("is not a readable raster"));
    }
}

TEST_F(NetcdfFiles, aCrashOfTheReaderIsAnError) {
    writeGrid("grid.nc", 1);
    for (const auto& [signal, why] : {std::pair("SEGV", "truncated or damaged, so that its reader crashed"),
                                      std::pair("XCPU", "it keeps its reader busy for too long")}) {
        const auto program = folder / signal;
        writeBytes(program, std::string("#!/bin/sh\nkill -") + signal + " $$\n");
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        EXPECT_THAT(copyError("grid.nc", program.c_str()), AllOf(HasSubstr("grid.nc: "), HasSubstr(why)));
    }
}

TEST_F(NetcdfFiles, aCopyCanBeCancelled) {
    writeGrid("grid.nc", 1);
    writeBytes(folder / "endless", "#!/bin/sh\nexec sleep 1000\n");
    std::filesystem::permissions(folder / "endless", std::filesystem::perms::owner_all);
    std::stop_source stop;
    stop.request_stop();
    const auto copy = copyOfNetcdf(folder / "grid.nc", stop.get_token(), folder / "endless");
    ASSERT_FALSE(copy);
    EXPECT_EQ(copy.error().kind, ErrorKind::Cancelled);
}

TEST_F(NetcdfFiles, classicAndHdf5FilesHaveTheirHeights) {
    for (const char* const format : {"NC", "NC2", "NC4"}) {
        writeGrid("grid.nc", 321, format);
        EXPECT_TRUE(isNetcdf(folder / "grid.nc")) << format;
        EXPECT_NEAR(sampledNear(mustOpen(folder / "grid.nc"), 1 << 20, 45, 10), 321, 1e-3) << format;
    }
}

TEST_F(NetcdfFiles, aVrtMayNameThem) {
    writeGrid("grid.nc", 77);
    writeBytes(
        folder / "all.vrt",
        "<VRTDataset rasterXSize=\"40\" rasterYSize=\"40\"><SRS>EPSG:4326</SRS><GeoTransform>9.8, 0.01, 0, "
        "45.2, 0, -0.01</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\"><SimpleSource>"
        "<SourceFilename relativeToVRT=\"1\">grid.nc</SourceFilename><SourceBand>1</SourceBand>"
        "</SimpleSource></VRTRasterBand></VRTDataset>");
    EXPECT_NEAR(sampledNear(mustOpen(folder / "all.vrt"), 1 << 20, 45, 10), 77, 1e-3);
}

TEST_F(NetcdfFiles, aCopyIsSharedUntilTheFileChanges) {
    writeGrid("grid.nc", 1);
    const auto first = copyOfNetcdf(folder / "grid.nc").value();
    EXPECT_EQ(copyOfNetcdf(folder / "grid.nc").value(), first);
    writeGrid("grid.nc", 2, "NC4");
    EXPECT_NE(copyOfNetcdf(folder / "grid.nc").value(), first);
    EXPECT_NEAR(sampledNear(mustOpen(folder / "grid.nc"), 1 << 20, 45, 10), 2, 1e-3);
}

TEST_F(NetcdfFiles, copiesHaveNoName) {
    writeGrid("grid.nc", 1);
    struct stat status {};
    ASSERT_EQ(::stat(copyOfNetcdf(folder / "grid.nc").value()->name.c_str(), &status), 0);
    EXPECT_EQ(status.st_nlink, 0u);
}

TEST_F(NetcdfFiles, aReaderThatCannotRunOrFailsIsAnError) {
    writeGrid("grid.nc", 1);
    const std::string file = (folder / "grid.nc").string();
    EXPECT_THAT(copyError("grid.nc", "/nowhere/reader"),
                AllOf(StartsWith(file), HasSubstr("/nowhere/reader cannot be started")));
    EXPECT_THAT(copyError("grid.nc", "/bin/false"), StartsWith(file + ": "));
}

TEST_F(NetcdfFiles, whatIsRefusedIsNamed) {
    EXPECT_FALSE(isNetcdf(folder / "none.nc"));
    EXPECT_FALSE(isNetcdf(folder.path()));
    writeBytes(folder / "short.nc", "CD");
    EXPECT_FALSE(isNetcdf(folder / "short.nc"));
    writeGrid("grid.nc", 1, "NC4");
    std::filesystem::resize_file(folder / "grid.nc", 3000);
    EXPECT_THAT(errorOf(folder / "grid.nc"), HasSubstr("grid.nc: is not a readable raster ("));
}

}  // namespace
}  // namespace planet
