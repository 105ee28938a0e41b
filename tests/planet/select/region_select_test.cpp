// Selection with regions: what it draws, and that nothing pops or cracks at their borders.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "planet/measure/pop_meter.h"
#include "planet/select/lod_select.h"
#include "planet/select/screen_error.h"
#include "tests/support/fake_selection.h"
#include "tests/support/random_regions.h"
#include "tests/support/random_view.h"

namespace planet {
namespace {

ChunkTree withRegions(std::vector<Region> regions) {
    ChunkTree tree = wholeTree();
    setRegions(tree, RegionSet::make(std::move(regions), tree.storedShape).value());
    return tree;
}

bool sameItem(const DrawItem& a, const DrawItem& b) {
    return a.id == b.id && a.node == b.node && a.epsPx == b.epsPx && a.morph == b.morph &&
           a.edgeMorph == b.edgeMorph && a.drawnBoundPx == b.drawnBoundPx && a.skirtDepthM == b.skirtDepthM &&
           a.coarserBy == b.coarserBy && a.distanceM == b.distanceM;
}

void expectSame(const Selection& a, const Selection& b) {
    ASSERT_EQ(a.draw.size(), b.draw.size());
    for (std::size_t i = 0; i < a.draw.size(); ++i) ASSERT_TRUE(sameItem(a.draw[i], b.draw[i])) << i;
    ASSERT_EQ(a.touched, b.touched);
    ASSERT_EQ(a.requests.size(), b.requests.size());
    for (std::size_t i = 0; i < a.requests.size(); ++i)
        ASSERT_EQ(a.requests[i].priority, b.requests[i].priority);
}

TEST(RegionSelect, RegionsThatDemandNothingChangeNothing) {
    std::mt19937 random(71);
    const ChunkTree none =
        withRegions({{.name = "one", .circles = {{{0, 0}, 1e9}}, .tauFactor = 1.0},
                     {.name = "off", .on = false, .circles = {{{0, 0}, 1e9}}, .tauFactor = 0.1}});
    for (int i = 0; i < 50; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings settings;
        settings.tauPx = 1 + i % 7;
        settings.seams = i % 2 ? SeamMode::Stitched : SeamMode::Skirts;
        expectSame(select(wholeTree(), view, settings), select(none, view, settings));
    }
}

TEST(RegionSelect, AFactorOverTheWholePlanetIsAnotherTolerance) {
    std::mt19937 random(72);
    const ChunkTree half = withRegions({{.name = "all", .circles = {{{0, 0}, 1e9}}, .tauFactor = 0.5}});
    for (int i = 0; i < 50; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings twice;
        twice.tauPx = 8;
        LodSettings plain;
        plain.tauPx = 4;
        expectSame(select(wholeTree(), view, plain), select(half, view, twice));
    }
}

TEST(RegionSelect, ChunksKeepToTheFactorAndTheLevelsOfTheirRegions) {
    std::mt19937 random(73);
    std::size_t forced = 0;
    std::size_t limited = 0;
    for (int i = 0; i < 120; ++i) {
        const ChunkTree tree = withRegions(randomRegions(random, 1e5));
        const View view = randomView(random, 1e5);
        const LodSettings settings = withoutCulling(3);
        const Selection selection = select(tree, view, settings);
        for (const DrawItem& item : selection.draw) {
            const ChunkNode& node = tree.nodes[item.node];
            const bool isLeaf = node.childrenState == ChildrenState::None;
            EXPECT_EQ(item.tauFactor, node.demand.tauFactor);
            ASSERT_TRUE(isLeaf || !isTooCoarse(item, settings)) << toString(item.id);
            forced +=
                item.id.level > 0 && item.id.level >= node.demand.leastLevel && node.demand.leastLevel > 0;
            limited += item.limit == RegionLimit::Most;
        }
        for (const ChildrenRequest& split : selection.splits) {
            const ChunkNode& node = tree.nodes[split.parent];
            const double eps = epsPxOf(node, view.eyeM, screenScalePx(view), settings.metric);
            ASSERT_TRUE(
                node.id.level < node.demand.leastLevel ||
                (node.id.level < node.demand.mostLevel && eps > 3 * (1 - 1e-9) * node.demand.tauFactor));
        }
    }
    EXPECT_GT(forced, 100u);
    EXPECT_GT(limited, 100u);
}

TEST(RegionSelect, AMissingLeastLevelIsRequested) {
    ChunkTree tree = residentTree(fakePyramid(), 1);
    setRegions(tree, RegionSet::make({{.name = "spot", .circles = {{{0, 0}, 500}}, .leastLevel = 3}},
                                     tree.storedShape)
                         .value());
    const View view = viewFromPose({.latitudeDeg = 0, .longitudeDeg = 0, .altitudeM = 3e5}, 1e5, 1, 640, 400);
    const Selection selection = select(tree, view, withoutCulling(1e6));
    ASSERT_FALSE(selection.requests.empty());
    for (const ChildrenRequest& request : selection.requests) {
        EXPECT_EQ(request.parentId.level, 1);
        EXPECT_GE(request.priority, leastLevelPriority);
    }
    EXPECT_EQ(selection.counters.waiting, selection.requests.size());
}

// Chunks that a least level splits show their own surface, not their parent's.
TEST(RegionSelect, AForcedChunkIsNotMorphedOntoItsParent) {
    const ChunkTree tree = withRegions({{.name = "all", .circles = {{{0, 0}, 1e9}}, .leastLevel = 3}});
    LodSettings settings = withoutCulling(1e6);
    settings.morph = true;
    const View view = viewFromPose({.altitudeM = 3e5}, 1e5, 1, 640, 400);
    for (const DrawItem& item : select(tree, view, settings).draw) {
        EXPECT_EQ(item.id.level, 3);
        EXPECT_EQ(item.morph, 0);
    }
}

// Descents over the borders of regions of every kind.

struct Flown {
    PopTotals pops;
    std::size_t bordersSeen = 0;  // neighbours of different factors in a frame
};

Flown descents(const ChunkTree& tree, const LodSettings& settings) {
    constexpr double stepS = 1.0 / 60;
    PopMeter meter;
    double timeS = 0;
    Flown flown;
    for (const double longitudeDeg : {20.0, 110.0, 200.0, 290.0}) {
        const auto viewAt = [&](int i) {
            return viewFromPose({.latitudeDeg = 30,
                                 .longitudeDeg = longitudeDeg + 1e-4 * i,
                                 .altitudeM = 150'000 * std::pow(0.9975, i),
                                 .pitchDeg = -60},
                                1e5, 1, 1280, 720);
        };
        Selection selection;
        for (int i = 0; i < 900; ++i) {
            selectChunks(tree, viewAt(i), settings, selection, stepS);
            meter.add(tree, selection, viewAt(i), settings, timeS += stepS, {.cameraJumped = i == 0});
            float least = 1e9f;
            float most = 0;
            for (const DrawItem& item : selection.draw) {
                least = std::min(least, item.tauFactor);
                most = std::max(most, item.tauFactor);
            }
            flown.bordersSeen += least < most;
        }
    }
    flown.pops = meter.totals();
    return flown;
}

std::vector<Region> borderRegions() {
    const auto at = [](double longitudeDeg) { return RegionPoint{30, longitudeDeg}; };
    return {
        {.name = "hard", .circles = {{at(22), 8'000}}, .tauFactor = 0.25},
        {.name = "soft", .circles = {{at(112), 6'000}}, .borderM = 20'000, .tauFactor = 0.2},
        {.name = "lenient", .polygons = {{{20, -170}, {20, -155}, {40, -155}, {40, -170}}}, .tauFactor = 8.0},
        {.name = "levels", .circles = {{at(-68), 10'000}}, .leastLevel = 3, .mostLevel = 3},
        {.name = "peaks", .heights = HeightBand{1000, 9000, 500}, .tauFactor = 0.5},
        {.name = "tight", .circles = {{at(25), 15'000}}, .metric = ErrorMetric::Tight}};
}

TEST(RegionSelect, WithAFadeNothingPopsAcrossBorders) {
    const ChunkTree tree = withRegions(borderRegions());
    for (const SeamMode seams : {SeamMode::Stitched, SeamMode::Skirts}) {
        for (const double tauPx : {0.5, 3.0}) {
            LodSettings settings;
            settings.tauPx = tauPx;
            settings.seams = seams;
            const Flown smooth = descents(tree, settings);
            EXPECT_GT(smooth.pops.switches, 40u);
            EXPECT_GT(smooth.bordersSeen, 1000u);
            EXPECT_LT(smooth.pops.worstPx, 1e-6) << tauPx;
            EXPECT_LT(smooth.pops.worstBesidePx, 1e-6) << tauPx;
            settings.morph = false;
            EXPECT_GT(descents(tree, settings).pops.worstPx, 0.3 * tauPx);
        }
    }
}

// A planted fault: a child that demands more than its parent. It is split without having been morphed onto.
TEST(RegionSelect, ThePopMeterSeesADemandThatGrowsStricterFromParentToChild) {
    ChunkTree tree = withRegions(borderRegions());
    const LodSettings settings{.fadeS = 0};
    const double soundPx = descents(tree, settings).pops.worstPx;
    for (ChunkNode& node : tree.nodes)
        if (node.id.level == 3) node.demand.tauFactor *= 0.02f;
    EXPECT_GT(descents(tree, settings).pops.worstPx, std::max(3 * soundPx, 0.5));
}

}  // namespace
}  // namespace planet
