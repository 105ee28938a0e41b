#include "planet/measure/true_error.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <set>

#include "planet/select/drawn_surface.h"
#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

TrueErrorReport measured(const DrawnSnapshot& snapshot) {
    FinestHeights heights(pyramidLoader());
    return measureTrueError(snapshot, heights).value();
}

// What a view of the whole, resident down to a level, draws.
DrawnSnapshot drawnFrom(const ChunkTree& tree, const View& view, const LodSettings& settings) {
    return snapshotOf(tree, select(tree, view, settings).draw, view, settings.seams == SeamMode::Stitched);
}

// Coarse chunks are drawn, and what lies under them has to be read.
const ChunkTree& coarseTree() {
    static const ChunkTree tree = residentTree(fakePyramid(), 2);
    return tree;
}
// Low over the ground and level, so that errors in height are seen from the side.
View levelView(double latitudeDeg = 12, double longitudeDeg = 31) {
    CameraPose pose;
    pose.latitudeDeg = latitudeDeg;
    pose.longitudeDeg = longitudeDeg;
    pose.altitudeM = 9000;
    pose.pitchDeg = -8;
    return viewFromPose(pose, fakePyramid().shape.radiusM, 1.2, 1280, 720);
}

// The definition, word for word, with no thought of speed.
struct Direct {
    const View& view;
    double facingPx = 0;
    double screenPx = 0;
    double errorM = 0;
    double sumPx = 0;
    std::uint64_t samples = 0;

    void compare(const glm::dvec3& trueM, const glm::dvec3& drawnM) {
        const glm::dvec3 a = trueM - view.eyeM;
        const glm::dvec3 b = drawnM - view.eyeM;
        const double facing = screenScalePx(view) * glm::length(glm::normalize(a) - glm::normalize(b));
        if (facing > facingPx) {
            facingPx = facing;
            errorM = glm::length(a - b);
        }
        sumPx += facing;
        ++samples;
        const std::optional<glm::dvec2> from = pixelOf(a);
        const std::optional<glm::dvec2> to = pixelOf(b);
        if (!from || !to || std::abs(from->x) > view.widthPx / 2.0 || std::abs(from->y) > view.heightPx / 2.0)
            return;
        screenPx = std::max(screenPx, glm::length(*from - *to));
    }
    std::optional<glm::dvec2> pixelOf(const glm::dvec3& fromEye) const {
        const double ahead = -glm::dot(view.back, fromEye);
        if (ahead <= 0) return std::nullopt;
        return screenScalePx(view) / ahead *
               glm::dvec2(glm::dot(view.right, fromEye), glm::dot(view.up, fromEye));
    }
};

Direct directly(const DrawnSnapshot& snapshot, std::size_t item) {
    const FakePyramid& pyramid = fakePyramid();
    Direct direct{snapshot.view};
    const ChunkId& id = snapshot.items[item].id;
    const DrawnGrid grid =
        drawnGrid(snapshot.shape, snapshot.items[item], *snapshot.chunks[item].heights, snapshot.stitched);
    const int perCell = 1 << (deepestLevelOf(pyramid.shape) - id.level);
    const int cells = chunkCells(pyramid.shape);
    for (int y = 0; y <= cells * perCell; ++y) {
        for (int x = 0; x <= cells * perCell; ++x) {
            const int leafX = std::min(x / cells, perCell - 1);
            const int leafY = std::min(y / cells, perCell - 1);
            const ChunkId leaf{id.face, static_cast<std::uint8_t>(deepestLevelOf(pyramid.shape)),
                               id.x * static_cast<unsigned>(perCell) + static_cast<unsigned>(leafX),
                               id.y * static_cast<unsigned>(perCell) + static_cast<unsigned>(leafY)};
            direct.compare(vertexM(snapshot.shape, pyramid.at(leaf), x - leafX * cells, y - leafY * cells),
                           pointOn(grid, static_cast<double>(x) / perCell, static_cast<double>(y) / perCell));
        }
    }
    return direct;
}

void expectSame(const ChunkError& error, const Direct& direct) {
    EXPECT_NEAR(error.facingPx, direct.facingPx, 1e-6 + 1e-6 * direct.facingPx) << toString(error.id);
    EXPECT_NEAR(error.screenPx, direct.screenPx, 1e-6 + 1e-6 * direct.screenPx) << toString(error.id);
    EXPECT_NEAR(error.errorM, direct.errorM, 1e-4 + 1e-6 * direct.errorM) << toString(error.id);
    EXPECT_EQ(error.samples, direct.samples) << toString(error.id);
    EXPECT_NEAR(error.meanPx, direct.sumPx / static_cast<double>(direct.samples), 1e-6 + 1e-6 * error.meanPx);
}

TEST(TrueError, isWhatTheDefinitionSaysOfEverySample) {
    std::mt19937 random(3);
    std::size_t compared = 0;
    bool screenDiffers = false;
    for (int i = 0; i < 12; ++i) {
        LodSettings settings = suddenLod();
        settings.tauPx = 3;
        settings.morph = i % 2 == 0;
        settings.morphRange = 1;
        settings.seams = i % 3 == 0 ? SeamMode::Stitched : SeamMode::Skirts;
        settings.frustumCulling = i % 4 != 0;
        const DrawnSnapshot snapshot = drawnFrom(i % 4 == 1 ? coarseTree() : wholeTree(),
                                                 randomView(random, fakePyramid().shape.radiusM), settings);
        const TrueErrorReport report = measured(snapshot);
        ASSERT_EQ(report.chunks.size(), snapshot.items.size());
        for (std::size_t item = 0; item < snapshot.items.size(); item += 1 + snapshot.items.size() / 12) {
            expectSame(report.chunks[item], directly(snapshot, item));
            screenDiffers |= report.chunks[item].screenPx > 1.05 * report.chunks[item].facingPx;
            ++compared;
        }
    }
    EXPECT_GT(compared, 40u);
    EXPECT_TRUE(screenDiffers) << "nothing near a corner of the picture";
}

TEST(TrueError, ofAHalfMorphedChunkIsWhatTheDefinitionSays) {
    LodSettings settings = suddenLod();
    settings.maxLevel = 3;
    settings.tauPx = 1e-3;
    DrawnSnapshot snapshot = drawnFrom(wholeTree(), levelView(), settings);
    const TrueErrorReport before = measured(snapshot);
    snapshot.items[2].morph = 0.5f;
    snapshot.items[2].edgeMorph = {0.5f, 0.5f, 0.5f, 0.5f};
    const TrueErrorReport after = measured(snapshot);
    expectSame(after.chunks[2], directly(snapshot, 2));
    EXPECT_NE(after.chunks[2].facingPx, before.chunks[2].facingPx);
    for (std::size_t i = 0; i < after.chunks.size(); ++i) {
        if (i != 2) {
            EXPECT_EQ(after.chunks[i], before.chunks[i]);
        }
    }
}

// A vertex of a drawn chunk is raised: by so much it must be off there, and only there.
TEST(TrueError, findsAMovedVertexOnItsChunkAndItsSize) {
    LodSettings settings = suddenLod();
    settings.maxLevel = 3;
    settings.tauPx = 1e-3;
    DrawnSnapshot snapshot = drawnFrom(wholeTree(), levelView(), settings);
    const TrueErrorReport before = measured(snapshot);
    const std::size_t item = snapshot.items.size() / 2;
    const ChunkData& chunk = fakePyramid().at(snapshot.items[item].id);
    constexpr int column = 6;
    constexpr int row = 9;
    constexpr int raisedSteps = 12000;
    std::vector<std::int32_t> heights = chunk.heights.view().toVector();
    heights[row * 17 + column] += raisedSteps;
    snapshot.chunks[item].heights = std::make_shared<const Steps>(std::span<const std::int32_t>(heights));

    const TrueErrorReport after = measured(snapshot);
    const double raisedM = raisedSteps * snapshot.shape.quantumM;
    const glm::dvec3 trueM = vertexM(snapshot.shape, chunk, column, row);
    Direct expected{snapshot.view};
    expected.compare(trueM, trueM + raisedM * glm::normalize(trueM));
    ASSERT_GT(expected.facingPx, 5 * before.chunks[item].facingPx);
    EXPECT_NEAR(after.chunks[item].facingPx, expected.facingPx, 1e-6 * expected.facingPx);
    EXPECT_NEAR(after.chunks[item].errorM, raisedM, 1e-6 * raisedM);
    EXPECT_LT(glm::length(after.chunks[item].worstM - trueM), 1e-3);
    EXPECT_TRUE(isViolation(after.chunks[item]));
    EXPECT_EQ(after.violations, 1u);
    for (std::size_t i = 0; i < after.chunks.size(); ++i) {
        if (i != item) {
            EXPECT_EQ(after.chunks[i], before.chunks[i]);
        }
    }
}

// One level above the leaves delta_c is just the largest error, so half of it is too little wherever that is
// seen from the side and from afar.
TEST(TrueError, findsADeltaThatIsHalfOfWhatItShouldBe) {
    LodSettings settings = suddenLod();
    settings.maxLevel = 3;
    settings.tauPx = 1e-3;
    const DrawnSnapshot clean = drawnFrom(wholeTree(), levelView(), settings);
    const TrueErrorReport before = measured(clean);
    EXPECT_EQ(before.violations, 0u);
    const auto tightest = std::max_element(
        before.chunks.begin(), before.chunks.end(), [](const ChunkError& a, const ChunkError& b) {
            return a.facingPx / (a.drawnBoundPx + 1e-9) < b.facingPx / (b.drawnBoundPx + 1e-9);
        });
    ASSERT_GT(tightest->facingPx, 0.6 * tightest->drawnBoundPx);

    // As a file would have it that says so: its tree is made of what it was told.
    FakePyramid wrong = fakePyramid();
    wrong.chunks.at(tightest->id).deltaCM /= 2;
    wrong.chunks.at(tightest->id).deltaTightM /= 2;
    const ChunkTree tree = residentTree(wrong, deepestLevelOf(wrong.shape));
    const TrueErrorReport after = measured(drawnFrom(tree, levelView(), settings));
    EXPECT_EQ(after.violations, 1u);
    for (const ChunkError& chunk : after.chunks) {
        if (chunk.id != tightest->id) continue;
        EXPECT_TRUE(isViolation(chunk));
        EXPECT_NEAR(chunk.facingPx - chunk.drawnBoundPx, tightest->facingPx - tightest->drawnBoundPx / 2,
                    1e-4 * tightest->facingPx);
        EXPECT_EQ(chunk.facingPx, tightest->facingPx);
    }
}

TEST(TrueError, ofLeavesAloneIsNothing) {
    LodSettings settings = suddenLod();
    settings.tauPx = 1e-6;
    const DrawnSnapshot snapshot = drawnFrom(wholeTree(), levelView(), settings);
    const TrueErrorReport report = measured(snapshot);
    ASSERT_GT(report.chunks.size(), 10u);
    EXPECT_EQ(report.worstFacingPx, 0);
    EXPECT_EQ(report.worstScreenPx, 0);
    EXPECT_EQ(report.violations, 0u);
    EXPECT_EQ(report.samples, snapshot.items.size() * 17 * 17);
}

// Of each chunk the largest distance from the finest, its own and those of the chunks under it.
void useTightMetric(ChunkTree& tree, NodeIndex node) {
    const ChunkNode& chunk = tree.nodes[node];
    DrawItem item;
    item.id = chunk.id;
    const DrawnGrid grid = drawnGrid(tree.shape, item, *chunk.heights, false);
    const int perCell = 1 << (deepestLevelOf(tree.shape) - chunk.id.level);
    double largest = 0;
    for (int y = 0; y <= 16 * perCell; ++y) {
        for (int x = 0; x <= 16 * perCell; ++x) {
            const int leafX = std::min(x / 16, perCell - 1);
            const int leafY = std::min(y / 16, perCell - 1);
            const ChunkId leaf{chunk.id.face, static_cast<std::uint8_t>(deepestLevelOf(tree.shape)),
                               chunk.id.x * static_cast<unsigned>(perCell) + static_cast<unsigned>(leafX),
                               chunk.id.y * static_cast<unsigned>(perCell) + static_cast<unsigned>(leafY)};
            const glm::dvec3 a = vertexM(tree.shape, fakePyramid().at(leaf), x - leafX * 16, y - leafY * 16);
            const glm::dvec3 b =
                pointOn(grid, static_cast<double>(x) / perCell, static_cast<double>(y) / perCell);
            largest = std::max(largest, glm::length(a - b));
        }
    }
    for (NodeIndex child = chunk.firstChild;
         chunk.childrenState == ChildrenState::Resident && child < chunk.firstChild + quadrantCount;
         ++child) {
        useTightMetric(tree, child);
        largest = std::max(largest, static_cast<double>(tree.nodes[child].deltaTightM));
    }
    // Both, so that it is this that is predicted whichever the selection looks at.
    tree.nodes[node].deltaCM = tree.nodes[node].deltaTightM =
        std::nextafter(static_cast<float>(largest), 1e9f);
}

ChunkTree tightTree() {
    ChunkTree tree = wholeTree();
    for (NodeIndex root = 0; root < faceCount; ++root) useTightMetric(tree, root);
    return tree;
}

// The worst share of its prediction that a chunk needs over random views.
double worstShare(const ChunkTree& tree, ErrorMetric metric, SeamMode seams, bool morph) {
    std::mt19937 random(8);
    double worst = 0;
    int inexact = 0;
    int seamEdges = 0;
    for (int i = 0; i < 50; ++i) {
        LodSettings settings = suddenLod();
        settings.metric = metric;
        settings.tauPx = i % 2 == 0 ? 4 : 20;
        settings.morph = morph;
        settings.seams = seams;
        settings.frustumCulling = settings.horizonCulling = i % 3 == 0;
        const DrawnSnapshot snapshot =
            drawnFrom(tree, randomView(random, fakePyramid().shape.radiusM), settings);
        const TrueErrorReport report = measured(snapshot);
        EXPECT_EQ(report.violations, 0u) << i;
        for (const DrawItem& item : snapshot.items)
            seamEdges +=
                static_cast<int>(edgeCount - std::count(item.coarserBy.begin(), item.coarserBy.end(), 0));
        for (const ChunkError& chunk : report.chunks) {
            inexact += chunk.facingPx > 0.1;
            if (chunk.drawnBoundPx > 0.01) worst = std::max(worst, chunk.facingPx / chunk.drawnBoundPx);
            if (isViolation(chunk))
                ADD_FAILURE() << toString(chunk.id) << " " << chunk.facingPx << " over " << chunk.drawnBoundPx
                              << " in seam " << chunk.worstInSeam;
        }
    }
    EXPECT_GT(inexact, 500);
    EXPECT_GT(seamEdges, 300);
    return worst;
}

TEST(TrueError, ofACleanPlanetStaysUnderTheAdditivePrediction) {
    EXPECT_GT(worstShare(wholeTree(), ErrorMetric::Additive, SeamMode::Skirts, false), 0.3);
    EXPECT_GT(worstShare(wholeTree(), ErrorMetric::Additive, SeamMode::Skirts, true), 0.3);
    EXPECT_GT(worstShare(wholeTree(), ErrorMetric::Additive, SeamMode::Stitched, true), 0.3);
}

TEST(TrueError, ofACleanPlanetStaysUnderTheTightPrediction) {
    const ChunkTree tree = tightTree();
    EXPECT_GT(worstShare(tree, ErrorMetric::Tight, SeamMode::Skirts, false), 0.5);
    EXPECT_GT(worstShare(tree, ErrorMetric::Tight, SeamMode::Skirts, true), 0.5);
    EXPECT_GT(worstShare(tree, ErrorMetric::Tight, SeamMode::Stitched, true), 0.5);
}

TEST(TrueError, isTheSameByOneThreadAndByMany) {
    LodSettings settings = suddenLod();
    settings.tauPx = 20;
    const DrawnSnapshot snapshot = drawnFrom(wholeTree(), levelView(), settings);
    const TrueErrorReport many = measured(snapshot);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(measured(snapshot), many);
}

TEST(TrueError, countsExaggerationIn) {
    LodSettings settings = suddenLod();
    settings.maxLevel = 2;
    settings.tauPx = 1e-3;
    ChunkTree tree = wholeTree();
    const TrueErrorReport before = measured(drawnFrom(tree, levelView(), settings));
    setExaggeration(tree, 3);
    const DrawnSnapshot snapshot = drawnFrom(tree, levelView(), settings);
    const TrueErrorReport after = measured(snapshot);
    EXPECT_EQ(after.violations, 0u);
    EXPECT_GT(after.worstFacingPx, 1.5 * before.worstFacingPx);
    expectSame(after.chunks[1], directly(snapshot, 1));
}

TEST(TrueError, saysWhatCouldNotBeRead) {
    FinestHeights heights([](const ChunkId& parent, BlockLocation, StepsView) {
        return Result<SiblingBlock>(
            badInput("a.chk: the block of chunk " + toString(parent) + " is damaged"));
    });
    const auto report = measureTrueError(drawnFrom(coarseTree(), levelView(), suddenLod()), heights);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, ErrorKind::BadInput);
    EXPECT_NE(report.error().message.find("a.chk: the block of chunk"), std::string::npos);
}

TEST(TrueError, canBeCancelled) {
    FinestHeights heights(pyramidLoader());
    const auto report = measureTrueError(drawnFrom(coarseTree(), levelView(), suddenLod()), heights,
                                         [](std::uint64_t, std::uint64_t) { return false; });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, ErrorKind::Cancelled);
}

HeldChunk heldRoot(Face face) {
    const ChunkData& root = fakePyramid().at({face, 0, 0, 0});
    return {root.id, std::make_shared<const Steps>(root.heights), root.children};
}

TEST(FinestHeights, areThoseOfEveryLeafInTheirOrder) {
    FinestHeights heights(pyramidLoader());
    std::vector<ChunkId> seen;
    const auto visited = heights.forEachLeaf(heldRoot(Face::NegY), {}, [&](const HeldChunk& leaf) {
        EXPECT_EQ(*leaf.heights, fakePyramid().at(leaf.id).heights);
        seen.push_back(leaf.id);
        return true;
    });
    ASSERT_TRUE(visited);
    EXPECT_EQ(seen.size(), 256u);
    EXPECT_EQ(std::set<ChunkId>(seen.begin(), seen.end()).size(), 256u);
    EXPECT_EQ(heights.blocksRead(), 1u + 4 + 16 + 64);
    const ChunkId deep{Face::NegY, 4, 11, 6};
    EXPECT_EQ(*heights.chunkUnder(heldRoot(Face::NegY), deep, {})->heights, fakePyramid().at(deep).heights);
    EXPECT_EQ(heights.blocksRead(), 85u) << "what is kept is not read again";
}

TEST(FinestHeights, keepNoMoreThanTheyMay) {
    constexpr std::size_t most = 40'000;
    FinestHeights heights(pyramidLoader(), most);
    const auto noticeNothing = [](const HeldChunk&) { return true; };
    ASSERT_TRUE(heights.forEachLeaf(heldRoot(Face::PosX), {}, noticeNothing));
    EXPECT_LE(heights.cachedBytes(), most);
    EXPECT_GT(heights.cachedBytes(), most / 2);
    FinestHeights none(pyramidLoader(), 0);
    ASSERT_TRUE(none.forEachLeaf(heldRoot(Face::PosX), {}, noticeNothing));
    EXPECT_EQ(none.cachedBytes(), 0u);
}

TEST(FinestHeights, ofResidentLeavesNeedNoReading) {
    std::atomic<int> loads = 0;
    FinestHeights heights([&](const ChunkId& parent, BlockLocation location, StepsView parentHeights) {
        ++loads;
        return fakePyramid().load(parent, location, parentHeights);
    });
    LodSettings settings = suddenLod();
    settings.tauPx = 50;
    const auto whole = measureTrueError(drawnFrom(wholeTree(), levelView(), settings), heights);
    ASSERT_TRUE(whole);
    EXPECT_EQ(loads, 0);
    const auto coarse = measureTrueError(drawnFrom(coarseTree(), levelView(), settings), heights);
    ASSERT_TRUE(coarse);
    EXPECT_GT(loads, 0);
}

}  // namespace
}  // namespace planet
