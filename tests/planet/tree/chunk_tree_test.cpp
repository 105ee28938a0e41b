#include "planet/tree/chunk_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "tests/support/fake_pyramid.h"

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
    const ChunkTree tree = residentTree(fakePyramid(), deepestLevelOf(fakePyramid().shape));
    forEachNode(tree, [&](NodeIndex, const ChunkNode& node) {
        const bool leaf = node.id.level == deepestLevelOf(tree.shape);
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

void setHeight(ChunkData& chunk, std::size_t at, std::int32_t step) {
    std::vector<std::int32_t> steps = chunk.heights.view().toVector();
    steps[at] = step;
    chunk.heights = Steps(std::span<const std::int32_t>(steps));
}

struct TreeDamage {
    const char* message;
    void (*apply)(ChunkData&);
};

const TreeDamage damages[] = {
    {"is wrong; expected",
     [](ChunkData& chunk) {
         chunk.id = {Face::NegY, 1, 0, 0};
     }},
    {"heights; expected 289",
     [](ChunkData& chunk) { chunk.heights = Steps(chunk.heights.view().narrow().subspan(1)); }},
    {"delta_c", [](ChunkData& chunk) { chunk.deltaCM = -1; }},
    {"delta_c", [](ChunkData& chunk) { chunk.deltaCM = std::numeric_limits<float>::quiet_NaN(); }},
    {"delta_c", [](ChunkData& chunk) { chunk.deltaCM = std::numeric_limits<float>::infinity(); }},
    {"tight metric", [](ChunkData& chunk) { chunk.deltaTightM = -1; }},
    {"tight metric", [](ChunkData& chunk) { chunk.deltaTightM = std::numeric_limits<float>::quiet_NaN(); }},
    {"tight metric", [](ChunkData& chunk) { chunk.deltaTightM = std::nextafter(chunk.deltaCM, 1e9f); }},
    {"are out of range; expected [", [](ChunkData& chunk) { std::swap(chunk.minStep, chunk.maxStep); }},
    {"are out of range; expected [", [](ChunkData& chunk) { chunk.maxStep = 32767; }},
    {"are out of range; expected [", [](ChunkData& chunk) { chunk.minStep = -32768; }},
    {"expected its extremes", [](ChunkData& chunk) { setHeight(chunk, 5, 32767); }},
    {"expected its extremes", [](ChunkData& chunk) { setHeight(chunk, 6, -32768); }},
};

// Checks all that a planet checks of a block.
Result<void> checkBlock(const ChunkTree& tree, NodeIndex parent, const SiblingBlock& block) {
    if (auto checked = checkChildren(tree, parent, block); !checked) return checked;
    for (const ChunkData& child : block) {
        if (auto checked = checkHeights(tree.shape, child); !checked) return checked;
    }
    return {};
}

TEST(ChunkTree, ChildrenThatWouldBreakItsPromisesAreRefused) {
    const ChunkTree tree = residentTree(fakePyramid(), 0);
    const SiblingBlock good = fakePyramid().childrenOf({Face::PosX, 0, 0, 0});
    EXPECT_TRUE(checkBlock(tree, 0, good));
    for (const TreeDamage& damage : damages) {
        SiblingBlock bad = good;
        damage.apply(bad[2]);
        const Result<void> checked = checkBlock(tree, 0, bad);
        ASSERT_FALSE(checked) << damage.message;
        EXPECT_THAT(checked.error().message, HasSubstr(damage.message));
        EXPECT_THAT(checked.error().message, HasSubstr("x_pos/1/0/1"));
    }
    SiblingBlock coarser = good;
    coarser[1].deltaCM = std::nextafter(tree.nodes[0].deltaCM, 1e9f);
    EXPECT_FALSE(checkBlock(tree, 0, coarser));
    SiblingBlock looser = good;
    looser[3].deltaCM = tree.nodes[0].deltaCM;
    looser[3].deltaTightM = std::nextafter(tree.nodes[0].deltaTightM, 1e9f);
    ASSERT_LE(looser[3].deltaTightM, looser[3].deltaCM);
    EXPECT_FALSE(checkBlock(tree, 0, looser));
}

TEST(ChunkTree, ChildrenBelowTheFinestLevelAreRefused) {
    const ChunkTree tree = residentTree(fakePyramid(), 3);
    const NodeIndex parent = findNode(tree, {Face::PosX, 3, 1, 1});
    SiblingBlock block = fakePyramid().childrenOf({Face::PosX, 3, 1, 1});
    EXPECT_TRUE(checkBlock(tree, parent, block));
    block[0].children = {1000, 10};
    EXPECT_FALSE(checkBlock(tree, parent, block));
}

TEST(ChunkTree, RootsThatWouldBreakItsPromisesAreRefused) {
    for (const TreeDamage& damage : damages) {
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

TEST(ChunkTree, SampledHeightIsExactAtVerticesAndBilinearBetweenThem) {
    ChunkTree tree = residentTree(fakePyramid(), 2);
    setExaggeration(tree, 1.5);
    for (const ChunkNode& node : tree.nodes) {
        if (node.id.level != 2) continue;
        const FaceSquare square = faceSquareOf(node.id);
        const auto sampleM = [&](int i, int j) {
            return heightM(tree.shape, (*node.heights)[static_cast<std::size_t>(j * 17 + i)]);
        };
        const auto at = [&](double column, double row) {
            const double cell = square.side / 16;
            return sampledHeightM(tree, 3.0 * sphereFromCube(cubePoint(node.id.face, square.u + column * cell,
                                                                       square.v + row * cell)));
        };
        EXPECT_NEAR(at(5, 9), sampleM(5, 9), 1e-6);
        EXPECT_NEAR(at(5.25, 9), 0.75 * sampleM(5, 9) + 0.25 * sampleM(6, 9), 1e-6);
        const double cornersM = sampleM(5, 9) + sampleM(6, 9) + sampleM(5, 10) + sampleM(6, 10);
        EXPECT_NEAR(at(5.5, 9.5), cornersM / 4, 1e-6);
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

// The point of a chunk's triangles at a place given in its cells.
glm::dvec3 surfacePointM(const PlanetShape& shape, const ChunkData& chunk, double column, double row) {
    const int cells = chunkCells(shape);
    const int i = std::min(static_cast<int>(column), cells - 1);
    const int j = std::min(static_cast<int>(row), cells - 1);
    const double s = column - i;
    const double t = row - j;
    const glm::dvec3 southWest = vertexM(shape, chunk, i, j);
    const glm::dvec3 northEast = vertexM(shape, chunk, i + 1, j + 1);
    if (s >= t) {
        return southWest * (1 - s) + vertexM(shape, chunk, i + 1, j) * (s - t) + northEast * t;
    }
    return southWest * (1 - t) + vertexM(shape, chunk, i, j + 1) * (t - s) + northEast * s;
}

// The largest distance of the finest samples under a chunk from its surface at the same place.
double measuredDeltaM(const FakePyramid& pyramid, const PlanetShape& shape, const ChunkData& chunk) {
    const int levels = deepestLevelOf(shape) - chunk.id.level;
    const int cells = chunkCells(shape);
    double most = 0;
    for (std::uint32_t leafY = 0; leafY < 1u << levels; ++leafY) {
        for (std::uint32_t leafX = 0; leafX < 1u << levels; ++leafX) {
            const ChunkData& leaf =
                pyramid.at({chunk.id.face, static_cast<std::uint8_t>(chunk.id.level + levels),
                            (chunk.id.x << levels) + leafX, (chunk.id.y << levels) + leafY});
            for (int j = 0; j <= cells; ++j) {
                for (int i = 0; i <= cells; ++i) {
                    const glm::dvec3 drawn =
                        surfacePointM(shape, chunk, std::ldexp(i + cells * static_cast<int>(leafX), -levels),
                                      std::ldexp(j + cells * static_cast<int>(leafY), -levels));
                    most = std::max(most, glm::length(drawn - vertexM(shape, leaf, i, j)));
                }
            }
        }
    }
    return most;
}

const FakePyramid& smallPyramid() {
    static const FakePyramid pyramid = makeFakePyramid(3);
    return pyramid;
}

TEST(ChunkTree, ExaggeratedDeltaBoundsWhatIsMeasured) {
    ChunkTree tree = residentTree(smallPyramid(), 3);
    int needsMoreThanScaling = 0;
    for (const double factor : {0.2, 1.0, 5.0, 20.0}) {
        setExaggeration(tree, factor);
        double tightest = 0;
        for (const ChunkNode& node : tree.nodes) {
            if (node.id.face != Face::PosX && node.id.face != Face::NegZ) continue;
            const double measured = measuredDeltaM(smallPyramid(), tree.shape, smallPyramid().at(node.id));
            ASSERT_LE(measured, node.deltaCM * (1 + 1e-6)) << factor << ' ' << toString(node.id);
            ASSERT_LE(measured, node.deltaTightM * (1 + 1e-6)) << factor << ' ' << toString(node.id);
            ASSERT_LE(node.deltaTightM, node.deltaCM);
            if (node.id.level < deepestLevelOf(tree.shape))
                tightest = std::max(tightest, measured / node.deltaCM);
            needsMoreThanScaling += measured > 1.01 * factor * node.storedDeltaCM;
        }
        EXPECT_GT(tightest, 0.4) << factor;
    }
    EXPECT_GT(needsMoreThanScaling, 10);
}

TEST(ChunkTree, AtExaggerationOneDeltaIsTheStoredOne) {
    ChunkTree tree = residentTree(fakePyramid(), 4);
    setExaggeration(tree, 3.7);
    setExaggeration(tree, 1);
    const ChunkTree untouched = residentTree(fakePyramid(), 4);
    EXPECT_EQ(tree.shape.quantumM, untouched.shape.quantumM);
    EXPECT_EQ(tree.occluderRadiusM, untouched.occluderRadiusM);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        EXPECT_EQ(tree.nodes[i].deltaCM, fakePyramid().at(tree.nodes[i].id).deltaCM);
        EXPECT_EQ(tree.nodes[i].storedDeltaCM, tree.nodes[i].deltaCM);
        EXPECT_EQ(tree.nodes[i].deltaTightM, fakePyramid().at(tree.nodes[i].id).deltaTightM);
        EXPECT_EQ(tree.nodes[i].maxHeightM, untouched.nodes[i].maxHeightM);
        EXPECT_EQ(tree.nodes[i].bounds.box.centreM, untouched.nodes[i].bounds.box.centreM);
        EXPECT_EQ(tree.nodes[i].bounds.box.halfSizeM, untouched.nodes[i].bounds.box.halfSizeM);
    }
}

TEST(ChunkTree, ExaggeratedDeltaNeverGrowsFromParentToChild) {
    ChunkTree tree = residentTree(fakePyramid(), 4);
    for (const double factor : {0.01, 0.2, 0.999, 1.001, 5.0, 40.0}) {
        setExaggeration(tree, factor);
        for (const ChunkNode& node : tree.nodes) {
            if (node.parent != noNode) {
                ASSERT_LE(node.deltaCM, tree.nodes[node.parent].deltaCM);
                ASSERT_LE(node.deltaTightM, tree.nodes[node.parent].deltaTightM);
            }
            if (node.childrenState == ChildrenState::None) {
                EXPECT_EQ(node.deltaCM, 0);
                EXPECT_EQ(node.deltaTightM, 0);
            }
        }
    }
}

TEST(ChunkTree, ExaggeratedBoundsHoldTheSurface) {
    ChunkTree tree = residentTree(smallPyramid(), 3);
    for (const double factor : {0.2, 20.0}) {
        setExaggeration(tree, factor);
        EXPECT_EQ(tree.shape.quantumM, factor * smallPyramid().shape.quantumM);
        for (const ChunkNode& node : tree.nodes) {
            const ChunkData& chunk = smallPyramid().at(node.id);
            EXPECT_FLOAT_EQ(node.maxHeightM,
                            static_cast<float>(factor * heightM(smallPyramid().shape, chunk.maxStep)));
            for (int j = 0; j <= 16; j += 4) {
                for (int i = 0; i <= 16; i += 4) {
                    const glm::dvec3 vertex = vertexM(tree.shape, chunk, i, j);
                    EXPECT_LT(distanceM(node.bounds.box, vertex), 1e-6);
                    EXPECT_GT(glm::length(vertex), tree.occluderRadiusM);
                    EXPECT_LT(glm::length(vertex), node.bounds.maxRadiusM + 1e-6);
                }
            }
        }
    }
}

TEST(ChunkTree, NodesAddedLaterAreExaggeratedToo) {
    ChunkTree before = residentTree(fakePyramid(), 2);
    setExaggeration(before, 6.5);
    ChunkTree after = residentTree(fakePyramid(), 1);
    setExaggeration(after, 6.5);
    for (NodeIndex i = 6; i < 6 + 24; ++i) {
        const SiblingBlock block = fakePyramid().childrenOf(after.nodes[i].id);
        ASSERT_TRUE(checkBlock(after, i, block));
        const auto next = static_cast<std::uint32_t>(after.nodes.size());
        addChildren(after, i, SiblingBlock(block), {next, next + 1, next + 2, next + 3});
    }
    forEachNode(before, [&](NodeIndex, const ChunkNode& node) {
        const ChunkNode& same = after.nodes[findNode(after, node.id)];
        EXPECT_EQ(same.deltaCM, node.deltaCM);
        EXPECT_EQ(same.minHeightM, node.minHeightM);
        EXPECT_EQ(same.bounds.box.centreM, node.bounds.box.centreM);
        EXPECT_EQ(same.bounds.maxRadiusM, node.bounds.maxRadiusM);
    });
}

TEST(ChunkTree, ExaggerationEndsBeforeThePlanetsCentre) {
    ChunkTree tree = residentTree(fakePyramid(), 1);
    const double most = largestExaggeration(tree);
    EXPECT_LT(most, 100);  // its valleys are 2% deep
    setExaggeration(tree, most);
    EXPECT_NEAR(tree.shape.radiusM + heightM(tree.shape, tree.minStep), 0.01 * tree.shape.radiusM, 1);
    EXPECT_EQ(largestExaggeration(tree), most);
    EXPECT_GT(tree.occluderRadiusM, 0);
    tree.storedShape.baseHeightM = 1e5;
    EXPECT_EQ(largestExaggeration(tree), 100);
    tree.storedShape.baseHeightM = -0.999 * tree.shape.radiusM - heightM(fakePyramid().shape, tree.minStep);
    EXPECT_EQ(largestExaggeration(tree), 1);
}

TEST(ChunkTree, CurvatureErrorBoundsTheBareSphere) {
    const PlanetShape shape = fakePyramid().shape;
    for (int level = 0; level < 4; ++level) {
        const int vertices = 2 * chunkCells(shape) << level;  // of the next level, along a face
        const auto at = [&](int i, int j) {
            return shape.radiusM *
                   sphereFromCube(cubePoint(Face::PosY, 2.0 * i / vertices - 1, 2.0 * j / vertices - 1));
        };
        double most = 0;
        for (int j = 1; j < vertices; ++j) {
            for (int i = 1; i < vertices; ++i) {
                const int di = i % 2;
                const int dj = j % 2;
                if (di + dj == 0) continue;
                most =
                    std::max(most, glm::length((at(i - di, j - dj) + at(i + di, j + dj)) / 2.0 - at(i, j)));
            }
        }
        EXPECT_LE(most, curvatureErrorM(shape, level));
        EXPECT_GT(most, 0.7 * curvatureErrorM(shape, level));
    }
}

TEST(ChunkTree, exaggeratedErrorsOfAHostileFileStayFinite) {
    std::array<ChunkData, faceCount> roots = fakePyramid().roots();
    roots[0].deltaCM = roots[0].deltaTightM = std::numeric_limits<float>::max();
    ChunkTree tree =
        makeChunkTree(fakePyramid().shape, fakePyramid().minStep, fakePyramid().maxStep, std::move(roots))
            .value();
    setExaggeration(tree, 2);
    EXPECT_TRUE(std::isfinite(tree.nodes[0].deltaCM));
    EXPECT_TRUE(std::isfinite(tree.nodes[0].deltaTightM));
}

}  // namespace
}  // namespace planet
