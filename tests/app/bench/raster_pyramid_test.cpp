#include "app/bench/raster_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/bench/square_formats.h"
#include "planet/format/chunk_file_types.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

HeightSquare levelSquare(int side, std::int16_t step) {
    return {side, std::vector<std::int16_t>(static_cast<std::size_t>(side * side), step)};
}

HeightSquare hillySquare(int side) {
    HeightSquare hills{side, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            hills.steps.push_back(static_cast<std::int16_t>(
                std::lround(300 * std::sin(0.11 * x) * std::cos(0.07 * y)) + (x * y) % 7));
    return hills;
}

// A block of level ground takes a byte each for its mask and its storage, and 8 for its checksum. An entry takes 8 bytes for
// its errors, 2 for its extremes of 0, 1 for the size of a block below 128 bytes, and 6 for the distance.
TEST(RasterPyramid, EveryByteOfLevelGroundIsCounted) {
    const RasterPyramid pyramid = codePyramid(levelSquare(129, 0), 32, 3);
    ASSERT_EQ(pyramid.blocks.size(), 5u);  // four deepest ones and that above
    std::size_t coded = 0;
    for (const PyramidBlock& block : pyramid.blocks) coded += block.coded.size();
    EXPECT_EQ(coded, 5u);
    constexpr std::size_t entry = 8 + 2 + 1 + 6;
    constexpr std::size_t blocks = 5 * (1 + 1 + 8) + 4 * entry;
    // The root has a mask, an entry, four corners of 2 bytes, five refinements of a byte after a length of 4, and a checksum.
    constexpr std::size_t root = 1 + entry + 4 * 2 + 5 * (4 + 1) + 8;
    EXPECT_EQ(pyramid.fileBytes, planet::chunkFileHeaderBytes + blocks + root);
}

TEST(RasterPyramid, APyramidDecodesUnlessAByteIsMissing) {
    RasterPyramid pyramid = codePyramid(hillySquare(129), 32, 3);
    EXPECT_TRUE(decodePyramid(pyramid));
    pyramid.blocks[2].coded.pop_back();
    EXPECT_FALSE(decodePyramid(pyramid));
}

TEST(SquareFormats, EachFormatOfTheLibrariesIsTimedInEachRound) {
    const tests::TemporaryFolder folder;
    const HeightSquare hills = hillySquare(65);
    for (const SquareFormat format : {SquareFormat::Zstd, SquareFormat::ShuffledDeltas, SquareFormat::Png}) {
        const auto stored = storeSquare(format, hills, folder.path(), 3);
        ASSERT_TRUE(stored) << nameOf(format);
        EXPECT_GT(stored->bytes, 100u) << nameOf(format);
        EXPECT_LT(stored->bytes, 2 * hills.steps.size() + 100) << nameOf(format);
        EXPECT_EQ(stored->decodingCpuS.size(), 3u) << nameOf(format);
    }
}

TEST(SquareFormats, LevelGroundTakesFewBytesInAllFormatsOfTheLibraries) {
    const tests::TemporaryFolder folder;
    for (const SquareFormat format : {SquareFormat::Zstd, SquareFormat::ShuffledDeltas, SquareFormat::Png}) {
        const auto stored = storeSquare(format, levelSquare(257, 12), folder.path(), 0);
        ASSERT_TRUE(stored) << nameOf(format);
        EXPECT_LT(stored->bytes, 1000u) << nameOf(format);
    }
}

}  // namespace
}  // namespace worldy
