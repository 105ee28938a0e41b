#include "planet/measure/crack_spots.h"

#include <gtest/gtest.h>

namespace planet {
namespace {

CrackPixel at(int x, int y, std::uint32_t pair = 3, bool leaks = false) {
    CrackPixel pixel;
    pixel.x = x;
    pixel.y = y;
    pixel.pair = pair;
    pixel.leaks = leaks;
    pixel.placeM = glm::dvec3(x, y, 0);
    return pixel;
}

TEST(CrackSpots, NoPixelsAreNoSpots) {
    EXPECT_TRUE(crackSpots({}, 10, 10).empty());
}

TEST(CrackSpots, PixelsThatTouchAtCornersAreOneSpot) {
    const std::vector<CrackPixel> pixels = {at(2, 1), at(3, 2), at(4, 1), at(4, 3, 3, true)};
    const std::vector<CrackSpot> spots = crackSpots(pixels, 10, 10);
    ASSERT_EQ(spots.size(), 1u);
    EXPECT_EQ(spots[0].pixels, 4);
    EXPECT_EQ(spots[0].leaking, 1);
    EXPECT_EQ(spots[0].pair, 3u);
    EXPECT_EQ(spots[0].from, glm::ivec2(2, 1));
    EXPECT_EQ(spots[0].to, glm::ivec2(4, 3));
    EXPECT_DOUBLE_EQ(spots[0].centre.x, 3.75);
    EXPECT_DOUBLE_EQ(spots[0].centre.y, 2.25);
    EXPECT_EQ(spots[0].placeM, glm::dvec3(3, 2, 0));
}

TEST(CrackSpots, ApartOrOfOtherChunksAreOtherSpotsTheLargestFirst) {
    const std::vector<CrackPixel> pixels = {at(0, 0, 1), at(1, 0, 2), at(2, 0, 2), at(4, 0, 2),
                                            at(9, 9, noPair)};
    const std::vector<CrackSpot> spots = crackSpots(pixels, 10, 10);
    ASSERT_EQ(spots.size(), 4u);
    EXPECT_EQ(spots[0].pixels, 2);
    EXPECT_EQ(spots[0].pair, 2u);
    EXPECT_EQ(spots[1].pair, 1u);
    EXPECT_EQ(spots[2].from.x, 4);
    EXPECT_EQ(spots[3].pair, noPair);
}

TEST(CrackSpots, OnThePicturesBorderNothingWrapsAround) {
    const std::vector<CrackPixel> pixels = {at(9, 0), at(0, 1)};
    EXPECT_EQ(crackSpots(pixels, 10, 2).size(), 2u);
}

}  // namespace
}  // namespace planet
