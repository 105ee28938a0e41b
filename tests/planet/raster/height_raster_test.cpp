#include "planet/raster/height_raster.h"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <thread>
#include <vector>

namespace planet {
namespace {

HeightBlockKey keyOf(int block) {
    return {1, block, 2};
}

Result<std::vector<float>> blockOf(float value) {
    return std::vector<float>(256, value);  // 1 kB
}

TEST(HeightRaster, CacheNeverHoldsMoreThanItsLimit) {
    HeightBlockCache cache(10 << 10);
    for (int key = 0; key < 100; ++key) {
        const auto block = cache.get(keyOf(key), [&] { return blockOf(static_cast<float>(key)); });
        ASSERT_TRUE(block);
        EXPECT_EQ((**block)[0], static_cast<float>(key));
        EXPECT_LE(cache.bytes(), std::size_t{10} << 10);
    }
    EXPECT_EQ(cache.bytes(), std::size_t{10} << 10);
}

TEST(HeightRaster, CacheTellsRastersAndBlocksApart) {
    HeightBlockCache cache(64 << 10);
    float next = 0;
    for (const HeightBlockKey& key : {HeightBlockKey{1, 2, 3}, {2, 2, 3}, {1, 3, 2}, {1, 3, 3}}) {
        const auto block = cache.get(key, [&] { return blockOf(++next); });
        ASSERT_TRUE(block);
        EXPECT_EQ((**block)[0], next);
    }
    EXPECT_EQ(next, 4);
}

TEST(HeightRaster, CacheKeepsWhatWasUsedLast) {
    HeightBlockCache cache(4 << 10);
    int loads = 0;
    const auto get = [&](int key) {
        return cache.get(keyOf(key), [&] {
            ++loads;
            return blockOf(0);
        });
    };
    for (const int key : {1, 2, 3, 4}) EXPECT_TRUE(get(key));
    EXPECT_TRUE(get(1));
    EXPECT_TRUE(get(5));  // drops 2
    EXPECT_EQ(loads, 5);
    EXPECT_TRUE(get(1));
    EXPECT_EQ(loads, 5);
    EXPECT_TRUE(get(2));
    EXPECT_EQ(loads, 6);
}

TEST(HeightRaster, CacheHandsOnWhyALoadFailedAndTriesAgain) {
    HeightBlockCache cache(4 << 10);
    const auto failed =
        cache.get(keyOf(1), []() -> Result<std::vector<float>> { return ioError("no disk"); });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "no disk");
    EXPECT_TRUE(cache.get(keyOf(1), [] { return blockOf(0); }));
}

TEST(HeightRaster, CacheServesSeveralThreads) {
    HeightBlockCache cache(8 << 10);
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread) {
        threads.emplace_back([&, thread] {
            for (int i = 0; i < 2000; ++i) {
                const int key = (i * 7 + thread * 3) % 16;
                const auto block = cache.get(keyOf(key), [&] { return blockOf(static_cast<float>(key)); });
                if (!block || (**block)[0] != static_cast<float>(key)) ++wrong;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
}

TEST(HeightRaster, BlocksThatStickOutAreCutAtTheEdges) {
    constexpr int width = 10;
    constexpr int height = 7;
    HeightConversion conversion;
    conversion.type = SampleType::Uint8;
    HeightRaster::Blocks blocks;
    blocks.width = 4;
    blocks.height = 4;
    blocks.cache = std::make_shared<StoredBlockCache>(1 << 10);
    blocks.read = [](int blockX, int blockY, std::span<std::byte> native) -> Result<void> {
        for (int i = 0; i < 16; ++i) {
            const int x = blockX * 4 + i % 4;
            const int y = blockY * 4 + i / 4;
            // Outside the grid a value that nobody may see.
            const int value = x < width && y < height ? 10 * y + x : 255;
            native[static_cast<std::size_t>(i)] = static_cast<std::byte>(value);
        }
        return {};
    };
    const HeightRaster raster = HeightRaster::inBlocks(width, height, conversion, blocks);
    std::vector<float> out(width * height);
    ASSERT_TRUE(raster.read({0, 0, width, height}, out.data(), width));
    for (int i = 0; i < width * height; ++i) EXPECT_EQ(out[static_cast<std::size_t>(i)], float(i));
    const Result<HeightStatistics> statistics = raster.statistics();
    ASSERT_TRUE(statistics);
    EXPECT_EQ(statistics->minM, 0);
    EXPECT_EQ(statistics->maxM, 69);
}

TEST(HeightRaster, ACacheHoldsSamplesAsTheFileStoresThem) {
    constexpr int side = 16;
    constexpr std::size_t blockBytes = side * side * sizeof(std::int16_t);
    HeightConversion conversion;
    conversion.type = SampleType::Int16;
    int reads = 0;
    HeightRaster::Blocks blocks;
    blocks.width = side;
    blocks.height = side;
    blocks.cache = std::make_shared<StoredBlockCache>(2 * blockBytes);
    blocks.read = [&](int, int, std::span<std::byte>) -> Result<void> {
        ++reads;
        return {};
    };
    const HeightRaster raster = HeightRaster::inBlocks(2 * side, side, conversion, blocks);
    std::vector<float> out(side * side);
    for (const int x : {0, side, 0, side}) ASSERT_TRUE(raster.read({x, 0, side, side}, out.data(), side));
    EXPECT_EQ(reads, 2);
    EXPECT_EQ(blocks.cache->bytes(), 2 * blockBytes);
}

TEST(HeightRaster, BytesAreSwappedBeforeTheyBecomeMetres) {
    const std::vector<std::byte> native = {std::byte{0xFF}, std::byte{0xFE}, std::byte{1}, std::byte{2}};
    HeightConversion conversion;
    conversion.type = SampleType::Int16;
    conversion.metresPerUnit = 0.5;
    conversion.offsetM = 10;
    std::vector<float> out(2);
    conversion.swapBytes = std::endian::native == std::endian::little;  // so big endian bytes
    convertToMetres(conversion, native, out);
    EXPECT_EQ(out, (std::vector<float>{9, 139}));
}

}  // namespace
}  // namespace planet
