#include "planet/raster/spilled_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace planet {
namespace {

using testing::HasSubstr;

using RowsHeightAt = std::function<float(int column, int row)>;

// A raster of blocks of whole rows that counts how often each is read.
class RowsRaster : public Raster {
public:
    RowsRaster(int width, int height, int blockHeight, RowsHeightAt heightAt)
        : heightAt_(std::move(heightAt)) {
        path_ = "rows.tif";
        layout_.width = layout_.blockWidth = width;
        layout_.height = height;
        layout_.blockHeight = blockHeight;
        reads_ =
            std::vector<std::atomic<int>>(static_cast<std::size_t>((height + blockHeight - 1) / blockHeight));
    }

    Result<std::vector<float>> readBlock(int, int blockY) const override {
        ++reads_[static_cast<std::size_t>(blockY)];
        if (blockY == brokenBlock) return ioError("rows.tif: cannot be read");
        std::vector<float> heights;
        const int firstRow = blockY * layout_.blockHeight;
        for (int row = firstRow; row < std::min(firstRow + layout_.blockHeight, layout_.height); ++row) {
            for (int column = 0; column < layout_.width; ++column) heights.push_back(heightAt_(column, row));
        }
        return heights;
    }
    bool isEmpty(int, int blockY) const override { return blockY == emptyBlock; }

    std::vector<int> reads() const { return {reads_.begin(), reads_.end()}; }

    int brokenBlock = -1;
    int emptyBlock = -1;

private:
    RowsHeightAt heightAt_;
    mutable std::vector<std::atomic<int>> reads_;
};

float integerRowsAt(int column, int row) {
    return (column + row) % 7 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>((column * 31 + row * 17) % 9000 - 500);
}

float fractionRowsAt(int column, int row) {
    if ((column + row) % 5 == 0) return -0.0f;
    return static_cast<float>(column) / 3 + 40'000.0f * static_cast<float>(row % 2);
}

std::shared_ptr<const Raster> mustSpillRows(const std::shared_ptr<const Raster>& raster) {
    TemporarySpace space(systemFileCalls());
    auto spilled = inSmallBlocks(raster, 1, space);
    EXPECT_TRUE(spilled) << spilled.error().message;
    EXPECT_NE(*spilled, raster);
    return spilled.value();
}

// Expects the very bits of all heights.
void expectRowHeights(const Raster& raster, const RowsHeightAt& heightAt) {
    const RasterLayout& layout = raster.layout();
    int differences = 0;
    for (int y = 0; y * layout.blockHeight < layout.height; ++y) {
        for (int x = 0; x * layout.blockWidth < layout.width; ++x) {
            const Result<std::vector<float>> heights = raster.readBlock(x, y);
            ASSERT_TRUE(heights) << heights.error().message;
            const int columns = std::min(layout.blockWidth, layout.width - x * layout.blockWidth);
            const int rows = std::min(layout.blockHeight, layout.height - y * layout.blockHeight);
            ASSERT_EQ(heights->size(), static_cast<std::size_t>(columns * rows));
            for (int i = 0; i < columns * rows; ++i) {
                const float expected =
                    heightAt(x * layout.blockWidth + i % columns, y * layout.blockHeight + i / columns);
                const float found = (*heights)[static_cast<std::size_t>(i)];
                const bool same = std::isnan(expected) ? std::isnan(found)
                                                       : std::bit_cast<std::uint32_t>(expected) ==
                                                             std::bit_cast<std::uint32_t>(found);
                if (!same) ++differences;
            }
        }
    }
    EXPECT_EQ(differences, 0);
}

TEST(SpilledRaster, hasTheSameHeights) {
    for (const RowsHeightAt& heightAt : {RowsHeightAt(integerRowsAt), RowsHeightAt(fractionRowsAt)}) {
        // Blocks as high as a piece, higher ones that can be divided and that cannot, and one for the whole raster.
        for (const auto& [height, blockHeight] : {std::pair(300, 128), {2000, 1024}, {1100, 541}, {700, 700}})
            expectRowHeights(*mustSpillRows(std::make_shared<RowsRaster>(700, height, blockHeight, heightAt)),
                             heightAt);
    }
}

TEST(SpilledRaster, hasSmallBlocks) {
    for (const auto& [height, blockHeight] : {std::pair(300, 128), {2000, 1024}, {700, 700}}) {
        const RasterLayout layout =
            mustSpillRows(std::make_shared<RowsRaster>(700, height, blockHeight, integerRowsAt))->layout();
        EXPECT_EQ(layout.blockWidth, 256);
        EXPECT_LE(layout.blockHeight, 512);
    }
}

TEST(SpilledRaster, readsEachBlockOnce) {
    const auto raster = std::make_shared<RowsRaster>(3000, 1000, 128, integerRowsAt);
    const auto spilled = mustSpillRows(raster);
    EXPECT_THAT(raster->reads(), testing::Each(0)) << "nothing is copied before it is asked for";
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i) threads.emplace_back([&] { expectRowHeights(*spilled, integerRowsAt); });
    }
    EXPECT_THAT(raster->reads(), testing::Each(1));
    EXPECT_EQ(spilled->samplesRead(), 3'000'000u);
}

TEST(SpilledRaster, rastersThatAreReadWellStayAsTheyAre) {
    const auto small = std::make_shared<const RowsRaster>(700, 300, 128, integerRowsAt);
    TemporarySpace space(systemFileCalls());
    EXPECT_EQ(inSmallBlocks(small, 700 * 300 * 2, space).value(), small);
    const auto narrow = std::make_shared<const RowsRaster>(512, 3000, 128, integerRowsAt);
    EXPECT_EQ(inSmallBlocks(narrow, 1, space).value(), narrow);
}

TEST(SpilledRaster, rastersShareOneFile) {
    int opened = 0;
    FileCalls counting = systemFileCalls();
    counting.open = [&, open = counting.open](const char* path, int flags, mode_t mode) {
        ++opened;
        return open(path, flags, mode);
    };
    TemporarySpace space(counting);
    const auto integers = std::make_shared<RowsRaster>(700, 300, 128, integerRowsAt);
    const auto fractions = std::make_shared<RowsRaster>(900, 500, 128, fractionRowsAt);
    const auto first = inSmallBlocks(integers, 1, space).value();
    const auto second = inSmallBlocks(fractions, 1, space).value();
    for (int i = 0; i < 2; ++i) {
        expectRowHeights(*first, integerRowsAt);
        expectRowHeights(*second, fractionRowsAt);
    }
    EXPECT_EQ(opened, 1);
}

TEST(SpilledRaster, emptyBlocksStayEmpty) {
    const auto raster = std::make_shared<RowsRaster>(700, 2048, 1024, integerRowsAt);
    raster->emptyBlock = 1;
    const auto spilled = mustSpillRows(raster);
    ASSERT_EQ(spilled->layout().blockHeight, 512);
    EXPECT_FALSE(spilled->isEmpty(0, 1));
    EXPECT_TRUE(spilled->isEmpty(2, 2));
    EXPECT_TRUE(spilled->isEmpty(0, 3));
}

TEST(SpilledRaster, errorsNameTheFileOrTheFolder) {
    const auto raster = std::make_shared<RowsRaster>(700, 300, 128, integerRowsAt);
    raster->brokenBlock = 1;
    const auto spilled = mustSpillRows(raster);
    EXPECT_TRUE(spilled->readBlock(1, 0));
    EXPECT_EQ(spilled->readBlock(1, 1).error().message, "rows.tif: cannot be read");

    FileCalls full = systemFileCalls();
    full.pwrite = [](int, const void*, std::size_t, off_t) -> ssize_t {
        errno = ENOSPC;
        return -1;
    };
    const auto rows = std::make_shared<RowsRaster>(700, 300, 128, integerRowsAt);
    TemporarySpace onFullDisk(full);
    EXPECT_THAT(inSmallBlocks(rows, 1, onFullDisk).value()->readBlock(0, 0).error().message,
                AllOf(HasSubstr("temporary file in "), HasSubstr("No space left on device")));

    FileCalls refused = systemFileCalls();
    refused.open = [](const char*, int, mode_t) {
        errno = EACCES;
        return -1;
    };
    TemporarySpace nowhere(refused);
    EXPECT_THAT(inSmallBlocks(rows, 1, nowhere).error().message, HasSubstr("cannot be created"));
}

}  // namespace
}  // namespace planet
