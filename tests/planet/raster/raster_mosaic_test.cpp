#include "planet/raster/raster_mosaic.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace planet {
namespace {

// A raster of blocks of 64 x 64 samples that counts how many of them are read. Its eastern half has no heights.
class CountingRaster : public Raster {
public:
    explicit CountingRaster(int side) {
        path_ = "counted.tif";
        layout_.width = layout_.height = side;
        layout_.blockWidth = layout_.blockHeight = blockSide;
        layout_.crs = "EPSG:4326";
        layout_.x = {10, 0.001, 0};
        layout_.y = {45, 0, -0.001};
    }

    Result<std::vector<float>> readBlock(int blockX, int) const override {
        ++reads_;
        const bool isVoid = blockX * blockSide >= layout_.width / 2;
        return std::vector<float>(blockSide * blockSide,
                                  isVoid ? std::numeric_limits<float>::quiet_NaN() : 7.0f);
    }

    int reads() const { return reads_; }
    int blocks() const { return (layout_.width / blockSide) * (layout_.height / blockSide); }

private:
    static constexpr int blockSide = 64;
    mutable std::atomic<int> reads_ = 0;
};

TEST(RasterMosaic, ScanBesideCoarseReadingsReadsEachBlockAboutOnce) {
    const auto raster = std::make_shared<CountingRaster>(2048);
    // The cache holds a sixteenth of the raster.
    const auto mosaics = RasterMosaic::join({raster}, std::make_shared<MosaicCache>(2048 * 2048 * 4 / 16));
    ASSERT_TRUE(mosaics) << mosaics.error().message;
    const RasterMosaic& mosaic = (*mosaics)[0];
    std::vector<float> fine(64 * 64);
    std::vector<float> coarse(1);
    for (int row = 0; row < 2048; row += 64) {
        for (int column = 0; column < 2048; column += 64) {
            ASSERT_TRUE(mosaic.read({}, {column, row, 64, 64}, fine));
            EXPECT_EQ(std::isnan(fine[0]), column >= 1024);
            ASSERT_TRUE(mosaic.read({11, 11}, {0, 0, 1, 1}, coarse));
            EXPECT_EQ(coarse[0], 7) << "samples without heights have no weight";
        }
    }
    EXPECT_LE(raster->reads(), 2 * raster->blocks() + raster->blocks() / 16) << raster->blocks() << " blocks";
}

}  // namespace
}  // namespace planet
