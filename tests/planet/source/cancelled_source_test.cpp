#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stop_token>

#include "planet/source/height_source.h"
#include "tests/planet/source/raster_fixture.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

// Opens a source whose reading was asked to stop.
ErrorKind kindOfStopped(const fs::path& path) {
    std::stop_source stop;
    stop.request_stop();
    HeightSourceSettings settings;
    settings.stop = stop.get_token();
    const Result<HeightSource> source = openHeightSource(path, settings);
    return source ? ErrorKind::BadInput : source.error().kind;
}

class CancelledSource : public testing::Test {
protected:
    fs::path raster(const std::string& name) const {
        const fs::path file = folder_.path() / name;
        test::writeRaster(file, test::gridAround(4326, 10, 40, 64, 64, 0.01),
                          [](double longitude, double latitude) { return longitude + latitude; });
        return file;
    }

    const TemporaryFolder folder_;
};

TEST_F(CancelledSource, RasterEndsAsCancelled) {
    const fs::path file = raster("a.tif");
    EXPECT_TRUE(openHeightSource(file, {}));
    EXPECT_EQ(kindOfStopped(file), ErrorKind::Cancelled);
}

TEST_F(CancelledSource, WorldEndsAsCancelled) {
    raster("a.tif");
    const fs::path world = folder_.path() / "world.toml";
    std::ofstream(world) << "[[elevation]]\nfiles = \"a.tif\"\n";
    EXPECT_TRUE(openHeightSource(world, {}));
    EXPECT_EQ(kindOfStopped(world), ErrorKind::Cancelled);
}

TEST_F(CancelledSource, ImageOfThePlanetWhoseRangeMustBeReadEndsAsCancelled) {
    const fs::path file = fs::path(WORLDY_SOURCE_DIR) / "data/earth/elevation.tif";
    HeightSourceSettings small;
    small.noDataValue = -32768;  // which is looked for in every sample
    EXPECT_TRUE(openHeightSource(file, small));
    std::stop_source stop;
    stop.request_stop();
    small.stop = stop.get_token();
    small.cacheBytes = 1u << 20;  // the image is read block by block
    const Result<HeightSource> source = openHeightSource(file, small);
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace planet
