#include "app/data/leaf_depths.h"

#include <gtest/gtest.h>

#include "tests/support/sparse_planet.h"

namespace worldy {
namespace {

TEST(LeafDepthsTest, DepthIsThatOfTheDeepestLeafUnderAChunk) {
    const planet::test::SparsePlanet sparse;
    const planet::Result<LeafDepths> depths = leafDepthsOf(*sparse.file);
    ASSERT_TRUE(depths) << depths.error().message;
    EXPECT_EQ(depths->everywhere, -1);
    // The whole tree in memory says what is right.
    const planet::ChunkTree tree = sparse.wholeTree();
    std::vector<int> deepest(tree.nodes.size());
    int different = 0;
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const planet::ChunkNode& node = tree.nodes[i];
        deepest[i] = std::max(deepest[i], int{node.id.level});
        const bool isLeaf = node.firstChild == planet::noNode;
        EXPECT_EQ(deepestLeaf(*depths, node.id, isLeaf), deepest[i]) << toString(node.id);
        different += deepest[i] > node.id.level + 1 ? 1 : 0;
        if (node.parent != planet::noNode) deepest[node.parent] = std::max(deepest[node.parent], deepest[i]);
    }
    EXPECT_GT(different, 10);
}

TEST(LeafDepthsTest, WalkCanBeCancelled) {
    const planet::test::SparsePlanet sparse;
    int blocks = 0;
    const auto depths = leafDepthsOf(*sparse.file, [&] { return ++blocks < 3; });
    ASSERT_FALSE(depths);
    EXPECT_EQ(depths.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(blocks, 3);
}

TEST(LeafDepthsTest, ChunksOverTheLimitCountAsThoseWithoutGrandchildren) {
    const planet::test::SparsePlanet sparse;
    const auto depths = leafDepthsOf(*sparse.file, {}, 2);
    ASSERT_TRUE(depths);
    EXPECT_EQ(depths->below.size(), 2u);
    EXPECT_EQ(deepestLeaf(*depths, {planet::Face::PosX, 0, 0, 0}, false), 1);
}

TEST(LeafDepthsTest, DenseFileHasOneDepth) {
    LeafDepths dense{.everywhere = 7};
    EXPECT_EQ(deepestLeaf(dense, {planet::Face::PosX, 2, 0, 0}, false), 7);
    EXPECT_EQ(deepestLeaf(dense, {planet::Face::PosX, 7, 0, 0}, true), 7);
}

}  // namespace
}  // namespace worldy
