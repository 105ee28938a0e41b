#include "planet/bake/job/job_bytes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <span>
#include <vector>

namespace planet {
namespace {

constexpr PlanetShape jobShape{.faceCellsLog2 = 10, .chunkCellsLog2 = 4};

Subtree someSubtree() {
    Subtree subtree;
    subtree.root.id = {Face::NegY, 3, 5, 2};
    subtree.root.entry = {12.5F, 7.25F, -300, 4000, {provisionalOrigin + 99, 1234}};
    for (int i = 0; i < chunkVertexCount(jobShape); ++i) subtree.root.heights.push_back(i - 100);
    subtree.bytes = 1333;
    subtree.deepestUnitLevel = 5;
    subtree.offAboveM = {1.5, 0.25};
    subtree.firstTile = 17;
    subtree.lastTile = 23;
    return subtree;
}

std::vector<std::byte> bytesOf(const Subtree& subtree) {
    std::vector<std::byte> bytes;
    putSubtree(bytes, subtree);
    return bytes;
}

TEST(JobBytes, ASubtreeComesBackAsItWas) {
    const Subtree subtree = someSubtree();
    std::vector<std::byte> bytes = bytesOf(subtree);
    bytes.push_back(std::byte{7});
    std::span<const std::byte> rest = bytes;
    const auto taken = takeSubtree(rest, jobShape);
    ASSERT_TRUE(taken) << taken.error().message;
    EXPECT_EQ(rest.size(), 1u);
    EXPECT_EQ(taken->root.id, subtree.root.id);
    EXPECT_EQ(taken->root.entry.deltaCM, subtree.root.entry.deltaCM);
    EXPECT_EQ(taken->root.entry.deltaTightM, subtree.root.entry.deltaTightM);
    EXPECT_EQ(taken->root.entry.children, subtree.root.entry.children);
    EXPECT_EQ(taken->root.heights, subtree.root.heights);
    EXPECT_EQ(taken->bytes, subtree.bytes);
    EXPECT_EQ(taken->deepestUnitLevel, subtree.deepestUnitLevel);
    EXPECT_EQ(taken->offAboveM, subtree.offAboveM);
    EXPECT_EQ(taken->firstTile, subtree.firstTile);
    EXPECT_EQ(taken->lastTile, subtree.lastTile);
}

TEST(JobBytes, TruncatedBytesAreRefused) {
    const std::vector<std::byte> bytes = bytesOf(someSubtree());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        std::span<const std::byte> part = std::span(bytes).first(size);
        EXPECT_FALSE(takeSubtree(part, jobShape)) << size;
    }
}

TEST(JobBytes, ChunksThatCannotBeAreRefused) {
    const auto refused = [](auto change) {
        Subtree subtree = someSubtree();
        change(subtree);
        const std::vector<std::byte> bytes = bytesOf(subtree);
        std::span<const std::byte> rest = bytes;
        return !takeSubtree(rest, jobShape);
    };
    EXPECT_FALSE(refused([](Subtree&) {}));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.id.level = 25; }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.id.x = 8; }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.entry.deltaCM = -1; }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.entry.deltaTightM = 13; }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.entry.minStep = 5000; }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.heights[3] = 40000; }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.heights.pop_back(); }));
    EXPECT_TRUE(refused([](Subtree& s) { s.root.heights.clear(); }));
    EXPECT_TRUE(refused([](Subtree& s) { s.isLater = true; }));
}

TEST(JobBytes, ChangedBytesNeverReadPastTheEnd) {
    std::minstd_rand random(1);
    const std::vector<std::byte> good = bytesOf(someSubtree());
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::byte> bytes = good;
        for (int change = 0; change < 3; ++change) bytes[random() % 120] = static_cast<std::byte>(random());
        std::span<const std::byte> rest = bytes;
        const auto taken = takeSubtree(rest, jobShape);
        EXPECT_LE(rest.size(), bytes.size());
        EXPECT_TRUE(!taken || taken->offAboveM.size() <= bytes.size() / sizeof(double));
    }
}

}  // namespace
}  // namespace planet
