#include "planet/gl/store/height_pool.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"

namespace planet::gl {
namespace {

PlanetShape ofSize(int chunkSize) {
    PlanetShape shape;
    shape.chunkCellsLog2 = std::countr_zero(static_cast<unsigned>(chunkSize - 1));
    return shape;
}

TEST(PoolLayout, FiftyThousandChunksFitTheSmallestContext) {
    const Result<PoolLayout> layout = poolLayout(50'000, ofSize(33), 2048, 256);
    ASSERT_TRUE(layout);
    EXPECT_LE(layout->pageSize, 2048);
    EXPECT_LE(layout->bytes(), 50'000u * 33 * 33 * 2 * 11 / 10);
}

TEST(PoolLayout, SlotsDoNotOverlap) {
    const Result<PoolLayout> layout = poolLayout(500, ofSize(129), 2048, 256);
    ASSERT_TRUE(layout);
    std::set<std::tuple<int, int, int>> places;
    for (std::uint32_t slot = 0; slot < 500; ++slot) {
        const SlotPlace place = placeOf(*layout, slot);
        EXPECT_EQ(place.x % 129, 0);
        EXPECT_EQ(place.y % 129, 0);
        EXPECT_LE(place.x + 129, layout->pageSize);
        EXPECT_LE(place.y + 129, layout->pageSize);
        EXPECT_LT(place.page, layout->pages);
        places.insert({place.x, place.y, place.page});
        const std::uint32_t packed = packedPlace(*layout, slot);
        EXPECT_EQ(static_cast<int>(packed & 1023) * 129, place.x);
        EXPECT_EQ(static_cast<int>((packed >> 10) & 1023) * 129, place.y);
        EXPECT_EQ(static_cast<int>(packed >> 20), place.page);
    }
    EXPECT_EQ(places.size(), 500u);
}

TEST(PoolLayout, LargerPagesAreTakenOnlyWhereLayersRunOut) {
    EXPECT_LE(poolLayout(5000, ofSize(129), 16384, 64)->pageSize, 2048);
    const Result<PoolLayout> layout = poolLayout(100'000, ofSize(129), 16384, 64);
    ASSERT_TRUE(layout);
    EXPECT_GT(layout->pageSize, 2048);
    EXPECT_LE(layout->pages, 64);
}

TEST(PoolLayout, TooManyChunksAreAnErrorThatNamesTheLimits) {
    const Result<PoolLayout> layout = poolLayout(1'000'000, ofSize(129), 2048, 256);
    ASSERT_FALSE(layout);
    EXPECT_THAT(layout.error().message, testing::HasSubstr("GL_MAX_TEXTURE_SIZE is 2048"));
    EXPECT_THAT(layout.error().message, testing::HasSubstr("GL_MAX_ARRAY_TEXTURE_LAYERS 256"));
    EXPECT_FALSE(poolLayout(0, ofSize(33), 2048, 256));
}

using HeightPoolTest = GlTest;

TEST_F(HeightPoolTest, UploadsLandInTheirOwnSlots) {
    HeightPool pool = valueOf(HeightPool::create(10, ofSize(17)));
    const PoolLayout& layout = pool.layout();
    const auto value = [](std::uint32_t slot, int i) {
        return static_cast<std::int16_t>(static_cast<int>(slot) * 1000 + i - 5000);
    };
    // Backwards, so that a slot that wrote too far would spoil a neighbour already there.
    for (std::uint32_t slot = 10; slot-- > 0;) {
        std::vector<std::int16_t> heights;
        for (int i = 0; i < 17 * 17; ++i) heights.push_back(value(slot, i));
        pool.upload(slot, heights);
    }
    std::vector<std::int16_t> all(layout.bytes() / 2);
    glBindTexture(GL_TEXTURE_2D_ARRAY, pool.texture());
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RED_INTEGER, GL_SHORT, all.data());
    for (std::uint32_t slot = 0; slot < 10; ++slot) {
        const SlotPlace place = placeOf(layout, slot);
        for (int i = 0; i < 17 * 17; ++i) {
            const int texel =
                (place.page * layout.pageSize + place.y + i / 17) * layout.pageSize + place.x + i % 17;
            ASSERT_EQ(all[static_cast<std::size_t>(texel)], value(slot, i)) << slot << " " << i;
        }
    }
}

TEST_F(HeightPoolTest, FractionsOfTheQuantumTakeThirtyTwoBits) {
    PlanetShape shape = ofSize(17);
    shape.fractionBits = 6;
    HeightPool pool = valueOf(HeightPool::create(3, shape));
    const PoolLayout& layout = pool.layout();
    EXPECT_EQ(layout.texelBytes, 4u);
    const auto value = [](std::uint32_t slot, int i) {
        return slot == 0 ? 1'000'000 + i : slot == 1 ? -64 * 20'000 + 64 * i : 30'000 * i - 4'000'000;
    };
    for (std::uint32_t slot = 3; slot-- > 0;) {
        std::vector<std::int32_t> heights;
        for (int i = 0; i < 17 * 17; ++i) heights.push_back(value(slot, i));
        pool.upload(slot, Steps(std::span<const std::int32_t>(heights)));
    }
    std::vector<std::int32_t> all(layout.bytes() / 4);
    glBindTexture(GL_TEXTURE_2D_ARRAY, pool.texture());
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RED_INTEGER, GL_INT, all.data());
    for (std::uint32_t slot = 0; slot < 3; ++slot) {
        const SlotPlace place = placeOf(layout, slot);
        for (int i = 0; i < 17 * 17; ++i) {
            const int texel =
                (place.page * layout.pageSize + place.y + i / 17) * layout.pageSize + place.x + i % 17;
            ASSERT_EQ(all[static_cast<std::size_t>(texel)], value(slot, i)) << slot << " " << i;
        }
    }
}

}  // namespace
}  // namespace planet::gl
