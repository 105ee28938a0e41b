#include "ui/panels/lod/chunk_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/support/fake_pyramid.h"

namespace worldy::ui {
namespace {

using planet::ChunkId;
using planet::Face;

// A tree whose first root has the heights of a function of (column, row).
planet::ChunkTree treeWith(int (*height)(int column, int row)) {
    planet::ChunkTree tree = planet::residentTree(planet::fakePyramid(), 0);
    std::vector<std::int16_t> heights;
    for (int row = 0; row <= 16; ++row) {
        for (int column = 0; column <= 16; ++column) {
            heights.push_back(static_cast<std::int16_t>(height(column, row)));
        }
    }
    tree.nodes[0].heights = std::make_shared<const planet::Steps>(heights);
    return tree;
}

int brightness(std::uint32_t colour) {
    return static_cast<int>((colour & 0xFFu) + ((colour >> 8) & 0xFFu) + ((colour >> 16) & 0xFFu));
}

TEST(ChunkHeights, ThePictureHasItsNorthOnTopAndHighGroundLight) {
    const planet::ChunkTree tree = treeWith([](int, int row) { return row * 20; });
    const ChunkPicture picture = chunkPicture(tree, tree.nodes[0], 64);
    ASSERT_EQ(picture.side, 17);
    ASSERT_EQ(picture.cells.size(), 17u * 17);
    EXPECT_GT(brightness(picture.cells[17 * 1 + 8]), brightness(picture.cells[17 * 15 + 8]) + 50);
}

TEST(ChunkHeights, SlopesThatFaceTheLightAreBrighter) {
    const planet::ChunkTree tree = treeWith([](int column, int) { return 100 - 40 * std::abs(column - 8); });
    const ChunkPicture picture = chunkPicture(tree, tree.nodes[0], 64);
    // The ridge's west side is lit, its east side not; at the same height on both.
    EXPECT_GT(brightness(picture.cells[8 * 17 + 4]), brightness(picture.cells[8 * 17 + 12]) + 50);
}

TEST(ChunkHeights, ThePictureIsNoLargerThanAskedForAndFlatGroundIsNoTrouble) {
    const planet::ChunkTree tree = treeWith([](int, int) { return 7; });
    const ChunkPicture picture = chunkPicture(tree, tree.nodes[0], 9);
    EXPECT_EQ(picture.side, 9);
    EXPECT_EQ(std::count(picture.cells.begin(), picture.cells.end(), picture.cells.front()), 81);
}

TEST(ChunkHeights, ProfilesRunThroughTheMiddle) {
    const planet::ChunkTree tree = treeWith([](int column, int row) { return 4 * column + 400 * row; });
    const auto across = chunkProfile(tree, tree.nodes[0], ProfileWay::WestEast);
    const auto up = chunkProfile(tree, tree.nodes[0], ProfileWay::SouthNorth);
    ASSERT_EQ(across.size(), 17u);
    EXPECT_FLOAT_EQ(across[0], 800);  // row 8, a quarter of a metre a step
    EXPECT_FLOAT_EQ(across[16], 816);
    EXPECT_FLOAT_EQ(up[0], 8);
    EXPECT_FLOAT_EQ(up[16], 1608);
    EXPECT_FLOAT_EQ(across[8], up[8]);
}

TEST(ChunkHeights, AFaceSpansAQuarterOfThePlanet) {
    planet::PlanetShape shape;
    shape.radiusM = 1000;
    for (const ProfileWay way : {ProfileWay::WestEast, ProfileWay::SouthNorth}) {
        EXPECT_NEAR(groundSizeM(shape, {Face::PosX, 0, 0, 0}, way), 1000 * 3.14159265 / 2, 10);
    }
    EXPECT_NEAR(groundSizeM(shape, {Face::PosX, 1, 0, 0}, ProfileWay::WestEast), 1000 * 3.14159265 / 4, 100);
}

TEST(ChunkHeights, PlacesAreThoseOfTheMiddle) {
    EXPECT_EQ(middlePlaceText({Face::PosX, 0, 0, 0}), "0.0000° N, 0.0000° E");
    EXPECT_EQ(middlePlaceText({Face::PosY, 0, 0, 0}), "0.0000° N, 90.0000° E");
    EXPECT_EQ(middlePlaceText({Face::NegZ, 0, 0, 0}).substr(0, 11), "90.0000° S");
}

TEST(ChunkHeights, AWrongIdIsToldWhatWouldBeRight) {
    EXPECT_EQ(chunkIdProblem("z_pos/3/5/2", 7), "");
    EXPECT_NE(chunkIdProblem("z_pos/3/8/2", 7).find("z_pos/3/5/2"), std::string::npos);
    EXPECT_NE(chunkIdProblem("up/3", 7).find("a level in [0, 7]"), std::string::npos);
    EXPECT_EQ(chunkIdProblem("z_pos/9/5/2", 7), "This planet has levels 0 to 7; there is no level 9.");
}

}  // namespace
}  // namespace worldy::ui
