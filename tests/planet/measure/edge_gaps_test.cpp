#include "planet/measure/edge_gaps.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"

namespace planet {
namespace {

LodSettings wholePlanet(SeamMode seams, bool morph) {
    LodSettings settings = withoutCulling(2);
    settings.seams = seams;
    settings.morph = morph;
    return settings;
}

std::vector<DrawItem> drawnBy(const ChunkTree& tree, const View& view, const LodSettings& settings) {
    return select(tree, view, settings).draw;
}

class EdgeGaps : public testing::Test {
protected:
    std::mt19937 treeRandom_{1};
    ChunkTree tree_ = patchyTree(treeRandom_, 1, 3);
    std::mt19937 random_{2};
    View view_ = randomView(random_, 1e5);
};

TEST_F(EdgeGaps, PairsAreThoseOfTheSelectionAndThoseOfOneLevel) {
    const Selection selection = select(tree_, view_, wholePlanet(SeamMode::None, false));
    std::set<std::pair<ChunkId, ChunkId>> seams;
    for (const LevelSeam& seam : selection.seams) seams.insert({seam.finer, seam.coarser});
    std::set<std::pair<ChunkId, ChunkId>> found;
    std::size_t edges = 0;
    for (const DrawnPair& pair : drawnPairs(selection.draw)) {
        const ChunkId& finer = selection.draw[pair.finer].id;
        const ChunkId& coarser = selection.draw[pair.coarser].id;
        edges += finer.level == coarser.level ? 2 : 1;
        if (finer.level == coarser.level) continue;
        EXPECT_TRUE(found.insert({finer, coarser}).second) << "once only";
    }
    EXPECT_EQ(found, seams);
    // Of the whole planet every edge has something beside it: its equal, a coarser one, or finer ones.
    std::size_t withFinerBeside = 0;
    std::set<std::pair<std::uint32_t, Edge>> coarserEdges;
    for (const DrawnPair& pair : drawnPairs(selection.draw)) {
        if (selection.draw[pair.finer].id.level != selection.draw[pair.coarser].id.level)
            coarserEdges.insert({pair.coarser, pair.coarserEdge});
    }
    withFinerBeside = coarserEdges.size();
    EXPECT_EQ(edges + withFinerBeside, 4 * selection.draw.size());
}

TEST_F(EdgeGaps, TheFinerEdgesOfACoarserOneFillIt) {
    const std::vector<DrawItem> items = drawnBy(tree_, view_, wholePlanet(SeamMode::None, false));
    std::map<std::pair<std::uint32_t, Edge>, double> covered;
    bool reversed = false;
    for (const DrawnPair& pair : drawnPairs(items)) {
        covered[{pair.coarser, pair.coarserEdge}] += std::abs(pair.span[1] - pair.span[0]);
        reversed = reversed || pair.span[1] < pair.span[0];
        EXPECT_EQ(std::abs(pair.span[1] - pair.span[0]),
                  std::ldexp(1.0, items[pair.coarser].id.level - items[pair.finer].id.level));
    }
    for (const auto& [edge, share] : covered) EXPECT_EQ(share, 1);
    EXPECT_TRUE(reversed) << "some faces' axes run against each other";
}

TEST_F(EdgeGaps, OneLevelAndOneMorphHaveNoGap) {
    LodSettings settings = wholePlanet(SeamMode::None, false);
    settings.maxLevel = 1;
    settings.tauPx = 1e-9;
    std::vector<DrawItem> items = drawnBy(tree_, view_, settings);
    for (const float morph : {0.0f, 0.3f, 1.0f}) {
        for (DrawItem& item : items) {
            item.morph = morph;
            item.edgeMorph.fill(morph);
        }
        const auto gaps = edgeGaps({tree_.shape, items, heightsIn(tree_), false}, view_);
        EXPECT_EQ(gaps.size(), 48u);
        EXPECT_EQ(gaps[0].gapM, 0);
        EXPECT_EQ(gaps[0].facingPx, 0);
    }
}

TEST_F(EdgeGaps, StitchedHasNoGapAtAnyDifferenceAndMorph) {
    std::set<std::pair<int, bool>> met;
    for (int i = 0; i < 6; ++i) {
        const View view = randomView(random_, 1e5);
        const auto items = drawnBy(tree_, view, wholePlanet(SeamMode::Stitched, i % 2 == 0));
        for (const EdgeGap& gap : edgeGaps({tree_.shape, items, heightsIn(tree_), true}, view)) {
            EXPECT_LT(gap.gapM, 1e-9) << toString(gap.finer) << " " << toString(gap.coarser);
            met.insert({gap.finer.level - gap.coarser.level, gap.finer.face != gap.coarser.face});
        }
    }
    EXPECT_TRUE(met.contains({3, true}));
}

class EdgeGapsByMetric : public EdgeGaps, public testing::WithParamInterface<ErrorMetric> {};

TEST_P(EdgeGapsByMetric, GapsStayWithinWhatBothErrorsAllow) {
    for (int i = 0; i < 6; ++i) {
        const View view = randomView(random_, 1e5);
        LodSettings settings = wholePlanet(SeamMode::Skirts, i % 2 == 0);
        settings.metric = GetParam();
        const auto items = drawnBy(tree_, view, settings);
        const auto pairs = drawnPairs(items);
        const auto gaps = edgeGaps({tree_.shape, items, heightsIn(tree_), false}, pairs, view);
        ASSERT_GT(gaps[0].gapM, 100);
        for (const EdgeGap& gap : gaps) {
            EXPECT_LE(gap.finerAboveM, gap.finerSkirtM);
            EXPECT_LE(gap.coarserAboveM, gap.coarserSkirtM);
            EXPECT_LE(gap.radialM, gap.gapM * (1 + 1e-9) + 1e-6);
        }
        const RequiredSkirts required = requiredSkirts(tree_, settings.metric, items, pairs, gaps);
        EXPECT_GT(required.factor, 0.1);
        EXPECT_LE(required.factor, 1);
        EXPECT_LE(required.depthM, gaps[0].gapM);
    }
}

TEST_F(EdgeGaps, OfTheSameGroundSkirtsHangLessDeepByTheTightMetric) {
    // All of one level, so that both metrics draw the same.
    LodSettings settings = wholePlanet(SeamMode::Skirts, false);
    settings.maxLevel = 1;
    settings.tauPx = 1e-9;
    const auto additive = drawnBy(tree_, view_, settings);
    settings.metric = ErrorMetric::Tight;
    const auto tight = drawnBy(tree_, view_, settings);
    ASSERT_EQ(tight.size(), additive.size());
    for (std::size_t i = 0; i < tight.size(); ++i) {
        ASSERT_EQ(tight[i].id, additive[i].id);
        EXPECT_LT(tight[i].skirtDepthM, 0.95f * additive[i].skirtDepthM) << toString(tight[i].id);
        EXPECT_GT(tight[i].skirtDepthM, fakePyramid().at(tight[i].id).deltaTightM);
    }
}

TEST_P(EdgeGapsByMetric, AutomaticDepthsAreThoseOfTheSelection) {
    for (const double factor : {0.0, 0.3, 1.0, 4.0}) {
        for (const bool morph : {false, true}) {
            LodSettings settings = wholePlanet(SeamMode::Skirts, morph);
            settings.metric = GetParam();
            settings.skirtFactor = factor;
            const auto items = drawnBy(tree_, view_, settings);
            const auto depths =
                automaticSkirtDepthsM(tree_, settings.metric, items, drawnPairs(items), factor);
            for (std::size_t i = 0; i < items.size(); ++i)
                EXPECT_FLOAT_EQ(depths[i], items[i].skirtDepthM) << toString(items[i].id) << " " << factor;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AdditiveAndTight, EdgeGapsByMetric,
                         testing::Values(ErrorMetric::Additive, ErrorMetric::Tight), [](const auto& given) {
                             return given.param == ErrorMetric::Tight ? "Tight" : "Additive";
                         });

TEST_F(EdgeGaps, AMovedVertexIsAGapOfItsHeight) {
    const View view = randomView(random_, 1e5);
    const auto items = drawnBy(tree_, view, wholePlanet(SeamMode::Stitched, false));
    const auto pairs = drawnPairs(items);
    int tried = 0;
    for (const DrawnPair& pair : pairs) {
        const DrawItem& finer = items[pair.finer];
        if (finer.id.level == items[pair.coarser].id.level || ++tried > 20) continue;
        const Edge edge = pair.finerEdge;
        const int column = edge == Edge::West ? 0 : edge == Edge::East ? 16 : 8;
        const int row = edge == Edge::South ? 0 : edge == Edge::North ? 16 : 8;
        const SharedHeights whole = tree_.nodes[finer.node].heights;
        std::vector<std::int32_t> moved = whole->view().toVector();
        moved[static_cast<std::size_t>(17 * row + column)] -= 400;
        tree_.nodes[finer.node].heights = std::make_shared<const Steps>(std::span<const std::int32_t>(moved));
        const auto gaps = edgeGaps({tree_.shape, items, heightsIn(tree_), true}, pairs, view);
        EXPECT_NEAR(gaps[0].gapM, 100, 1e-6);
        EXPECT_NEAR(gaps[0].radialM, 100, 1e-6);
        EXPECT_NEAR(gaps[0].coarserAboveM, 100, 1e-6);
        EXPECT_LT(gaps[0].finerAboveM, 1e-9);
        EXPECT_EQ(gaps[0].finer, finer.id);
        EXPECT_EQ(gaps[0].coarser, items[pair.coarser].id);
        EXPECT_LT(gaps[1].gapM, 1e-9);
        const auto needed = requiredSkirtDepthsM(gaps, items.size());
        EXPECT_NEAR(needed[pair.coarser], 100, 1e-6);
        EXPECT_LT(needed[pair.finer], 1e-9);
        tree_.nodes[finer.node].heights = whole;
    }
    EXPECT_GT(tried, 10);
}

}  // namespace
}  // namespace planet
