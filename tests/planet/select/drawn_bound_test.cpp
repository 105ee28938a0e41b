#include "planet/select/drawn_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "planet/measure/true_error.h"
#include "planet/select/drawn_surface.h"
#include "planet/select/screen_error.h"
#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"

namespace planet {
namespace {

LodSettings settingsOf(ErrorMetric metric, bool morph) {
    LodSettings settings = withoutCulling(4);
    settings.metric = metric;
    settings.morph = morph;
    return settings;
}

TrueErrorReport measuredIn(const ChunkTree& tree, std::span<const DrawItem> items, const View& view) {
    FinestHeights heights([](const ChunkId& parent, BlockLocation location, StepsView parentHeights) {
        return fakePyramid().load(parent, location, parentHeights);
    });
    return measureTrueError(snapshotOf(tree, items, view, false), heights).value();
}

constexpr double unknownM = std::numeric_limits<double>::infinity();

std::vector<double> spansOf(std::span<const DrawItem> items) {
    std::vector<double> spansM;
    for (const DrawItem& item : items)
        spansM.push_back(cellSpanM(wholeTree().shape, wholeTree().nodes[item.node]));
    return spansM;
}

void expectWithinBounds(const TrueErrorReport& report) {
    for (const ChunkError& chunk : report.chunks) {
        EXPECT_FALSE(isViolation(chunk))
            << toString(chunk.id) << ": " << chunk.facingPx << " px over " << chunk.drawnBoundPx << " px";
    }
}

TEST(DrawnBound, withoutMorphIsEps) {
    std::mt19937 random(31);
    for (int i = 0; i < 60; ++i) {
        LodSettings settings = settingsOf(i % 2 == 0 ? ErrorMetric::Additive : ErrorMetric::Tight, false);
        settings.seams = i % 3 == 0 ? SeamMode::None : SeamMode::Skirts;
        const Selection selection =
            select(wholeTree(), randomView(random, fakePyramid().shape.radiusM), settings);
        for (const DrawItem& item : selection.draw) EXPECT_EQ(item.drawnBoundPx, item.epsPx);
        EXPECT_EQ(selection.counters.worstDrawnBoundPx, selection.counters.worstEpsPx);
    }
}

TEST(DrawnBound, ofAChunkAtMorphOneIsItsParents) {
    const View view = viewFromPose({.latitudeDeg = 12, .longitudeDeg = 31, .altitudeM = 9000, .pitchDeg = -8},
                                   fakePyramid().shape.radiusM, 1.2, 1280, 720);
    LodSettings settings = settingsOf(ErrorMetric::Additive, true);
    settings.maxLevel = 3;
    settings.tauPx = 1e-3;
    Selection selection = select(wholeTree(), view, settings);
    for (DrawItem& item : selection.draw) {
        item.morph = 1;
        item.edgeMorph.fill(1);
    }
    for (const ErrorMetric metric : {ErrorMetric::Additive, ErrorMetric::Tight}) {
        fillDrawnBounds(selection.draw, spansOf(selection.draw), screenScalePx(view), metric, false);
        for (const DrawItem& item : selection.draw) {
            ASSERT_GT(item.parentEpsPx, 0);
            const double seenPx = static_cast<double>(item.parentDeltaM) * screenScalePx(view) /
                                  static_cast<double>(std::max(item.distanceM, item.nearestSampleM));
            const float parentPx = std::min(item.parentEpsPx, static_cast<float>(seenPx));
            EXPECT_EQ(item.drawnBoundPx, std::max(parentPx, item.epsPx)) << toString(item.id);
        }
    }
}

TEST(DrawnBound, ofAChunkHalfWayLiesHalfWay) {
    DrawItem item;
    item.id = {Face::PosX, 3, 2, 2};
    item.distanceM = 1000;
    item.epsPx = item.deltaCM = 1;
    item.parentEpsPx = item.parentDeltaM = 5;
    item.morph = 0.5f;
    item.edgeMorph.fill(0.5f);
    fillDrawnBounds(std::span(&item, 1), std::vector{unknownM}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(item.drawnBoundPx, 3);
}

TEST(DrawnBound, ofAChunkWhoseParentHoldsTheEyeCountsItsOwnDistance) {
    DrawItem item;
    item.id = {Face::PosX, 3, 2, 2};
    item.distanceM = 1000;
    item.epsPx = item.deltaCM = 1;
    item.parentDeltaM = 5;
    item.parentEpsPx = 5e6f;  // the eye is in the parent's box
    item.morph = 1;
    item.edgeMorph.fill(1);
    fillDrawnBounds(std::span(&item, 1), std::vector{unknownM}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(item.drawnBoundPx, 5);
    item.distanceM = static_cast<float>(nearestM);  // and in its own
    item.nearestSampleM = 500;
    item.deltaCM = item.epsPx = 0;
    fillDrawnBounds(std::span(&item, 1), std::vector{unknownM}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(item.drawnBoundPx, 10);
}

TEST(DrawnBound, noSampleOfAChunkIsNearerThanItsNearestSample) {
    std::mt19937 random(35);
    const ChunkTree& tree = wholeTree();
    std::size_t known = 0;
    for (int i = 0; i < 200; ++i) {
        const View view = randomView(random, tree.shape.radiusM);
        const ChunkNode& node = tree.nodes[random() % tree.nodes.size()];
        const double boundM = nearestSampleM(tree.shape, node, view.eyeM);
        DrawItem item;
        item.id = node.id;
        for (const glm::dvec3& vertexM : drawnGrid(tree.shape, item, *node.heights, false).positionM)
            EXPECT_LE(boundM, glm::distance(vertexM, view.eyeM) * (1 + 1e-12)) << toString(node.id);
        known += boundM > 0;
    }
    EXPECT_GT(known, 100u);
}

// In the middle of a leaf's box, which reaches above its ground, while everything slides.
TEST(DrawnBound, ofALeafThatHoldsTheEyeIsAsLargeAsItsNearestSampleShowsIt) {
    const ChunkTree& tree = wholeTree();
    std::size_t held = 0;
    for (NodeIndex index = 0; index < tree.nodes.size(); index += 23) {
        const ChunkNode& leaf = tree.nodes[index];
        if (leaf.childrenState != ChildrenState::None) continue;
        View view = viewFromPose({.altitudeM = 9000}, tree.shape.radiusM, 1.2, 1280, 720);
        view.eyeM = leaf.bounds.box.centreM;
        LodSettings settings = settingsOf(ErrorMetric::Additive, true);
        settings.tauPx = 1e-3;
        Selection selection = select(tree, view, settings);
        for (DrawItem& item : selection.draw) {
            if (item.id.level == 0) continue;
            item.morph = 0.7f;
            item.edgeMorph.fill(0.7f);
            item.nearestSampleM =
                static_cast<float>(nearestSampleM(tree.shape, tree.nodes[item.node], view.eyeM));
        }
        fillDrawnBounds(selection.draw, spansOf(selection.draw), screenScalePx(view), settings.metric, false);
        if (held < 10) expectWithinBounds(measuredIn(tree, selection.draw, view));
        const auto item = std::find_if(selection.draw.begin(), selection.draw.end(),
                                       [&](const DrawItem& drawn) { return drawn.id == leaf.id; });
        ASSERT_NE(item, selection.draw.end());
        ASSERT_LE(item->distanceM, static_cast<float>(nearestM));
        double sampleM = unknownM;
        for (const glm::dvec3& vertexM :
             drawnGrid(tree.shape, {.id = leaf.id}, *leaf.heights, false).positionM)
            sampleM = std::min(sampleM, glm::distance(vertexM, view.eyeM));
        const double parentM = static_cast<double>(item->parentDeltaM);
        EXPECT_LE(static_cast<double>(item->drawnBoundPx), parentM * screenScalePx(view) / sampleM * 1.0001)
            << toString(leaf.id);
        ++held;
    }
    EXPECT_GT(held, 10u);
}

// Two chunks side by side, the eastern one coarser; a metre covers a pixel on the finer one.
std::array<DrawItem, 2> finerAndCoarser() {
    std::array<DrawItem, 2> items;
    DrawItem& finer = items[0];
    finer.id = {Face::PosX, 3, 3, 2};
    finer.distanceM = 1000;
    finer.epsPx = finer.deltaCM = 1;
    finer.parentEpsPx = finer.parentDeltaM = 100;
    finer.coarserBy[static_cast<std::size_t>(Edge::East)] = 1;
    DrawItem& coarser = items[1];
    coarser.id = {Face::PosX, 2, 2, 1};
    coarser.distanceM = 2000;
    coarser.deltaCM = 4;
    coarser.epsPx = 2;
    return items;
}

TEST(DrawnBound, alongAnEdgeThatShowsACoarserChunkAddsThatOnesError) {
    std::array<DrawItem, 2> items = finerAndCoarser();
    items[0].edgeMorph[static_cast<std::size_t>(Edge::East)] = 1;
    fillDrawnBounds(items, std::vector{unknownM, unknownM}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(items[0].drawnBoundPx, 5);  // 1 + 4, far below the parent's 100
    EXPECT_EQ(items[1].drawnBoundPx, 2);
    items[0].edgeMorph[static_cast<std::size_t>(Edge::East)] = 0.5f;
    fillDrawnBounds(items, std::vector{unknownM, unknownM}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(items[0].drawnBoundPx, 3);
}

TEST(DrawnBound, alongAnEdgeFarAwayIsAsSmallAsItIsSeen) {
    std::array<DrawItem, 2> items = finerAndCoarser();
    items[0].edgeMorph[static_cast<std::size_t>(Edge::East)] = 1;
    items[1].distanceM = 2500;
    fillDrawnBounds(items, std::vector{500.0, 1000.0}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(items[0].drawnBoundPx, 2.5f);  // (1 + 4) m, 2500 m - 500 m away
    items[1].distanceM = 20000;
    fillDrawnBounds(items, std::vector{500.0, 1000.0}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(items[0].drawnBoundPx, 1);  // the inside, 1000 m away
}

TEST(DrawnBound, noTwoPointsOfACellAreFartherApartThanItsSpan) {
    for (NodeIndex index = 0; index < wholeTree().nodes.size(); index += 7) {
        const ChunkNode& node = wholeTree().nodes[index];
        DrawItem item;
        item.id = node.id;
        const DrawnGrid grid = drawnGrid(wholeTree().shape, item, *node.heights, false);
        const auto side = static_cast<std::size_t>(grid.cells) + 1;
        for (std::size_t i = 0; i + side + 1 < grid.positionM.size(); ++i) {
            if (i % side == side - 1) continue;
            EXPECT_LE(glm::length(grid.positionM[i + side + 1] - grid.positionM[i]),
                      cellSpanM(wholeTree().shape, node));
            EXPECT_LE(glm::length(grid.positionM[i + side] - grid.positionM[i + 1]),
                      cellSpanM(wholeTree().shape, node));
        }
    }
}

TEST(DrawnBound, alongAnEdgeWithoutANeighbourAddsTheWholeSlide) {
    std::array<DrawItem, 2> items = finerAndCoarser();
    items[0].edgeMorph[static_cast<std::size_t>(Edge::West)] = 0.5f;
    fillDrawnBounds(items, std::vector{unknownM, unknownM}, 1000, ErrorMetric::Tight, false);
    EXPECT_EQ(items[0].drawnBoundPx, 51);
    fillDrawnBounds(items, std::vector{unknownM, unknownM}, 1000, ErrorMetric::Additive, false);
    EXPECT_EQ(items[0].drawnBoundPx, 50.5f);
}

TEST(DrawnBound, isNeverExceededOnRandomViews) {
    std::mt19937 random(32);
    std::size_t morphed = 0;
    for (int i = 0; i < 40; ++i) {
        LodSettings settings = settingsOf(i % 2 == 0 ? ErrorMetric::Additive : ErrorMetric::Tight, true);
        settings.tauPx = i % 3 == 0 ? 20 : 4;
        const View view = randomView(random, fakePyramid().shape.radiusM);
        const Selection selection = select(wholeTree(), view, settings);
        expectWithinBounds(measuredIn(wholeTree(), selection.draw, view));
        for (const DrawItem& item : selection.draw) morphed += item.drawnBoundPx > item.epsPx;
    }
    EXPECT_GT(morphed, 500u);
}

TEST(DrawnBound, isNeverExceededWhileChunksAndTheirEdgesFade) {
    std::mt19937 random(33);
    std::size_t edges = 0;
    for (int flight = 0; flight < 10; ++flight) {
        LodSettings settings = settingsOf(flight % 2 == 0 ? ErrorMetric::Additive : ErrorMetric::Tight, true);
        settings.fadeS = 1;
        Selection selection;
        for (int frame = 0; frame < 8; ++frame) {
            if (frame % 3 == 0) settings.tauPx = settings.tauPx > 10 ? 3 : 30;
            const View view = viewFromPose({.latitudeDeg = 11.0 * flight,
                                            .longitudeDeg = 31 + 0.2 * frame,
                                            .altitudeM = 12000,
                                            .pitchDeg = -20},
                                           fakePyramid().shape.radiusM, 1.2, 1280, 720);
            selectChunks(wholeTree(), view, settings, selection, 0.3);
            expectWithinBounds(measuredIn(wholeTree(), selection.draw, view));
            for (const DrawItem& item : selection.draw) {
                edges += std::any_of(item.edgeMorph.begin(), item.edgeMorph.end(),
                                     [&](float morph) { return morph != item.morph; });
            }
        }
    }
    EXPECT_GT(edges, 200u);
}

// Not as any selection has them: each chunk and each of its edges slid as far as chance says.
TEST(DrawnBound, isNeverExceededByPlantedMorphs) {
    std::mt19937 random(34);
    std::uniform_real_distribution<float> anyMorph(0, 1);
    for (int i = 0; i < 20; ++i) {
        const ErrorMetric metric = i % 2 == 0 ? ErrorMetric::Additive : ErrorMetric::Tight;
        const View view = randomView(random, fakePyramid().shape.radiusM);
        Selection selection = select(wholeTree(), view, settingsOf(metric, true));
        for (DrawItem& item : selection.draw) {
            if (item.id.level == 0) continue;
            item.morph = random() % 4 == 0 ? 1 : anyMorph(random);
            for (float& morph : item.edgeMorph) morph = random() % 4 == 0 ? 1 : anyMorph(random);
        }
        fillDrawnBounds(selection.draw, spansOf(selection.draw), screenScalePx(view), metric, false);
        expectWithinBounds(measuredIn(wholeTree(), selection.draw, view));
    }
}

}  // namespace
}  // namespace planet
