#include "planet/chunk_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "tests/fake_pyramid.h"

namespace planet {
namespace {

using testing::HasSubstr;

Result<ChunkTree> rootsOnly(std::array<ChunkData, faceCount> roots) {
    const FakePyramid& pyramid = fakePyramid();
    return makeChunkTree(pyramid.shape, pyramid.minStep, pyramid.maxStep, std::move(roots));
}

TEST(ChunkTree, StartsWithItsSixRootsInSlotsOfTheirOwn) {
    const ChunkTree tree = rootsOnly(fakePyramid().roots()).value();
    ASSERT_EQ(tree.nodes.size(), 6u);
    EXPECT_EQ(tree.residentChunks, 6u);
    for (std::uint32_t i = 0; i < 6; ++i) {
        EXPECT_EQ(tree.nodes[i].id, (ChunkId{allFaces[i], 0, 0, 0}));
        EXPECT_EQ(tree.nodes[i].slot, i);
        EXPECT_EQ(tree.nodes[i].childrenState, ChildrenState::Absent);
        EXPECT_EQ(*tree.nodes[i].heights, fakePyramid().at(tree.nodes[i].id).heights);
    }
    EXPECT_LT(tree.occluderRadiusM, tree.shape.radiusM + heightM(tree.shape, tree.minStep));
}

TEST(ChunkTree, FindsWhatIsResidentAndNothingElse) {
    const ChunkTree tree = residentTree(fakePyramid(), 2);
    std::size_t found = 0;
    for (const auto& [id, data] : fakePyramid().chunks) {
        const NodeIndex index = findNode(tree, id);
        EXPECT_EQ(index != noNode, id.level <= 2) << toString(id);
        if (index == noNode) continue;
        EXPECT_EQ(tree.nodes[index].id, id);
        EXPECT_EQ(tree.nodes[index].deltaCM, data.deltaCM);
        ++found;
    }
    EXPECT_EQ(found, tree.residentChunks);
}

TEST(ChunkTree, VisitsEachResidentNodeOnceAndParentsFirst) {
    const ChunkTree tree = residentTree(fakePyramid(), 3);
    std::set<ChunkId> seen;
    forEachNode(tree, [&](NodeIndex index, const ChunkNode& node) {
        EXPECT_EQ(&tree.nodes[index], &node);
        EXPECT_TRUE(node.id.level == 0 || seen.contains(parentOf(node.id)));
        EXPECT_TRUE(seen.insert(node.id).second);
    });
    EXPECT_EQ(seen.size(), tree.residentChunks);
}

TEST(ChunkTree, LeavesHaveNoChildrenToAskFor) {
    const ChunkTree tree = residentTree(fakePyramid(), leafLevel(fakePyramid().shape));
    forEachNode(tree, [&](NodeIndex, const ChunkNode& node) {
        const bool leaf = node.id.level == leafLevel(tree.shape);
        EXPECT_EQ(node.childrenState, leaf ? ChildrenState::None : ChildrenState::Resident);
    });
}

TEST(ChunkTree, RemovedChildrenLeaveRoomThatIsTakenAgain) {
    ChunkTree tree = residentTree(fakePyramid(), 1);
    const std::size_t nodes = tree.nodes.size();
    const SharedHeights kept = tree.nodes[findNode(tree, {Face::PosY, 1, 0, 0})].heights;
    const NodeIndex root = findNode(tree, {Face::PosY, 0, 0, 0});
    removeChildren(tree, root);
    EXPECT_EQ(tree.nodes[root].childrenState, ChildrenState::Absent);
    EXPECT_EQ(findNode(tree, {Face::PosY, 1, 0, 0}), noNode);
    EXPECT_EQ(tree.residentChunks, 6u + 5 * 4);
    EXPECT_EQ(kept.use_count(), 1);  // the tree let go, who shares the heights keeps them

    const NodeIndex other = findNode(tree, {Face::NegZ, 1, 1, 1});
    const NodeIndex first =
        addChildren(tree, other, fakePyramid().childrenOf({Face::NegZ, 1, 1, 1}), {6, 7, 8, 9});
    EXPECT_EQ(tree.nodes.size(), nodes);
    EXPECT_EQ(tree.nodes[first].slot, 6u);
    EXPECT_EQ(tree.nodes[first + 3].slot, 9u);
    EXPECT_EQ(findNode(tree, {Face::NegZ, 2, 3, 3}), first + 3);
}

struct Damage {
    const char* message;
    void (*apply)(ChunkData&);
};

const Damage damages[] = {
    {"got chunk",
     [](ChunkData& chunk) {
         chunk.id = {Face::NegY, 1, 0, 0};
     }},
    {"heights, not 289", [](ChunkData& chunk) { chunk.heights.pop_back(); }},
    {"delta_c", [](ChunkData& chunk) { chunk.deltaCM = -1; }},
    {"delta_c", [](ChunkData& chunk) { chunk.deltaCM = std::numeric_limits<float>::quiet_NaN(); }},
    {"delta_c", [](ChunkData& chunk) { chunk.deltaCM = std::numeric_limits<float>::infinity(); }},
    {"are not within", [](ChunkData& chunk) { std::swap(chunk.minStep, chunk.maxStep); }},
    {"are not within", [](ChunkData& chunk) { chunk.maxStep = 32767; }},
    {"are not within", [](ChunkData& chunk) { chunk.minStep = -32768; }},
    {"are not within its", [](ChunkData& chunk) { chunk.heights[5] = 32767; }},
    {"are not within its", [](ChunkData& chunk) { chunk.heights[6] = -32768; }},
};

TEST(ChunkTree, ChildrenThatWouldBreakItsPromisesAreRefused) {
    const ChunkTree tree = residentTree(fakePyramid(), 0);
    const SiblingBlock good = fakePyramid().childrenOf({Face::PosX, 0, 0, 0});
    EXPECT_TRUE(checkChildren(tree, 0, good));
    for (const Damage& damage : damages) {
        SiblingBlock bad = good;
        damage.apply(bad[2]);
        const Result<void> checked = checkChildren(tree, 0, bad);
        ASSERT_FALSE(checked) << damage.message;
        EXPECT_THAT(checked.error().message, HasSubstr(damage.message));
        EXPECT_THAT(checked.error().message, HasSubstr("x_pos/1/0/1"));
    }
    SiblingBlock coarser = good;
    coarser[1].deltaCM = std::nextafter(tree.nodes[0].deltaCM, 1e9f);
    EXPECT_FALSE(checkChildren(tree, 0, coarser));
}

TEST(ChunkTree, ChildrenBelowTheFinestLevelAreRefused) {
    const ChunkTree tree = residentTree(fakePyramid(), 3);
    const NodeIndex parent = findNode(tree, {Face::PosX, 3, 1, 1});
    SiblingBlock block = fakePyramid().childrenOf({Face::PosX, 3, 1, 1});
    EXPECT_TRUE(checkChildren(tree, parent, block));
    block[0].children = {1000, 10};
    EXPECT_FALSE(checkChildren(tree, parent, block));
}

TEST(ChunkTree, RootsThatWouldBreakItsPromisesAreRefused) {
    for (const Damage& damage : damages) {
        auto roots = fakePyramid().roots();
        damage.apply(roots[4]);
        EXPECT_FALSE(rootsOnly(roots)) << damage.message;
    }
    PlanetShape shape = fakePyramid().shape;
    shape.baseHeightM = -shape.radiusM;
    EXPECT_FALSE(makeChunkTree(shape, -10, 10, fakePyramid().roots()));
}

TEST(ChunkTree, ResidentHeightIsExactAtVertices) {
    const ChunkTree tree = residentTree(fakePyramid(), 2);
    for (const ChunkNode& node : tree.nodes) {
        if (node.id.level != 2) continue;
        const ChunkData& chunk = fakePyramid().at(node.id);
        for (const auto& [column, row] : {std::pair{3, 5}, {8, 8}, {15, 1}, {0, 0}, {16, 16}}) {
            const glm::dvec3 vertex = vertexM(tree.shape, chunk, column, row);
            EXPECT_NEAR(residentHeightM(tree, vertex), glm::length(vertex) - tree.shape.radiusM, 1e-6);
        }
    }
}

// The height at which a ray from the centre leaves the finest triangles, found by trying all of them.
double heightByTryingAll(const ChunkTree& tree, const glm::dvec3& direction) {
    double highest = -1e300;
    const int cells = chunkCells(tree.shape);
    forEachNode(tree, [&](NodeIndex, const ChunkNode& node) {
        if (node.childrenState == ChildrenState::Resident) return;
        const DirectionCone& cone = node.bounds.cone;
        if (glm::dot(cone.axis, direction) < std::cos(cone.halfAngleRad)) return;
        const ChunkData& chunk = fakePyramid().at(node.id);
        for (int t = 0; t < 2 * cells * cells; ++t) {
            const int i = t / 2 % cells;
            const int j = t / 2 / cells;
            const glm::dvec3 a = vertexM(tree.shape, chunk, i, j);
            const glm::dvec3 b =
                t % 2 ? vertexM(tree.shape, chunk, i + 1, j) : vertexM(tree.shape, chunk, i + 1, j + 1);
            const glm::dvec3 c =
                t % 2 ? vertexM(tree.shape, chunk, i + 1, j + 1) : vertexM(tree.shape, chunk, i, j + 1);
            const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
                return glm::dot(glm::normalize(glm::cross(p, q)), direction);
            };
            if (side(a, b) < -1e-12 || side(b, c) < -1e-12 || side(c, a) < -1e-12) continue;
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            highest =
                std::max(highest, glm::dot(normal, a) / glm::dot(normal, direction) - tree.shape.radiusM);
        }
    });
    return highest;
}

TEST(ChunkTree, ResidentHeightIsThatOfTheTrianglesDrawn) {
    const ChunkTree tree = residentTree(fakePyramid(), 1);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 1500; ++i) {
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        EXPECT_NEAR(residentHeightM(tree, 17.0 * direction), heightByTryingAll(tree, direction), 1e-6);
    }
}

TEST(ChunkTree, ResidentHeightFollowsTheFinestLevelThere) {
    ChunkTree tree = residentTree(fakePyramid(), 3);
    const ChunkId leaf{Face::PosZ, 4, 9, 3};
    const glm::dvec3 place = vertexM(tree.shape, fakePyramid().at(leaf), 7, 5);
    const double truth = glm::length(place) - tree.shape.radiusM;
    const double coarse = residentHeightM(tree, place);
    EXPECT_GT(std::abs(coarse - truth), 0.1);
    EXPECT_LE(std::abs(coarse - truth), fakePyramid().at(parentOf(leaf)).deltaCM);
    const NodeIndex parent = findNode(tree, parentOf(leaf));
    addChildren(tree, parent, fakePyramid().childrenOf(parentOf(leaf)), {900, 901, 902, 903});
    EXPECT_NEAR(residentHeightM(tree, place), truth, 1e-6);
}

}  // namespace
}  // namespace planet
