#include "planet/chunk_explanation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "planet/select/lod_select.h"
#include "planet/select/screen_error.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

constexpr double smallRadiusM = 1e5;

// All that explainChunk reads, by name.
struct Scene {
    ChunkTree tree;
    View view = viewFromPose({}, smallRadiusM, 1, 1280, 720);
    LodSettings lod = suddenLod();
    Selection selection;
    std::vector<PagingRequest> pageIns;

    explicit Scene(int residentLevel) : tree(residentTree(fakePyramid(), residentLevel)) {
        lod.frustumCulling = false;
        lod.horizonCulling = false;
    }
    void select() { selectChunks(tree, view, lod, selection); }
    ChunkExplanation explain(const ChunkId& id) const {
        return explainChunk(StepFacts{tree, selection, view, lod, pageIns}, id);
    }
    ChunkNode& node(const ChunkId& id) { return tree.nodes[findNode(tree, id)]; }
    void queue(const ChunkId& parent) { pageIns.push_back({.parent = parent}); }
    double epsPx(const ChunkId& id) {
        const ChunkNode& at = node(id);
        return at.deltaCM * screenScalePx(view) / std::max(distanceM(at.bounds.box, view.eyeM), nearestM);
    }
};

constexpr ChunkId rootId{Face::PosX, 0, 0, 0};
constexpr ChunkId childId{Face::PosX, 1, 1, 0};
constexpr ChunkId grandchildId{Face::PosX, 2, 2, 1};

TEST(ChunkExplanation, OfADrawnChunkThatIsGoodEnough) {
    Scene scene(4);
    scene.lod.tauPx = 1.001 * scene.epsPx(rootId);
    scene.lod.morph = true;
    scene.select();
    const ChunkExplanation whole = scene.explain(rootId);
    EXPECT_EQ(whole.state, ChunkState::Drawn);
    EXPECT_EQ(whole.notSplit, WhyNotSplit::GoodEnough);
    EXPECT_EQ(whole.decidedBy, rootId);
    EXPECT_NEAR(whole.epsPx, scene.epsPx(rootId), 1e-9);
    EXPECT_EQ(whole.decidedByEpsPx, whole.epsPx);
    EXPECT_EQ(whole.tauPx, scene.lod.tauPx);
    EXPECT_FALSE(whole.queuePlace);
    const ChunkExplanation below = scene.explain(grandchildId);
    EXPECT_EQ(below.state, ChunkState::Resident);
    EXPECT_EQ(below.notSplit, WhyNotSplit::NotDrawn);
    EXPECT_EQ(below.decidedBy, rootId);
    EXPECT_EQ(below.decidedByNotSplit, WhyNotSplit::GoodEnough);
    EXPECT_EQ(below.decidedByEpsPx, whole.epsPx);
    EXPECT_EQ(below.node, findNode(scene.tree, grandchildId));
    // At its switching distance a chunk's eps is tau.
    EXPECT_NEAR(below.switchDistanceM * scene.lod.tauPx, below.deltaCM * screenScalePx(scene.view), 1e-6);
    EXPECT_NEAR(below.epsPx * below.distanceM, below.deltaCM * screenScalePx(scene.view), 1e-6);
}

TEST(ChunkExplanation, OfASplitChunkAndTheMorphOfItsChildren) {
    Scene scene(4);
    scene.lod.tauPx = 0.9 * scene.epsPx(rootId);
    scene.lod.morph = true;
    scene.lod.maxLevel = 1;
    scene.select();
    EXPECT_EQ(scene.explain(rootId).state, ChunkState::Split);
    EXPECT_EQ(scene.explain(rootId).notSplit, WhyNotSplit::IsSplit);
    EXPECT_EQ(scene.explain(rootId).morph, 0);
    const auto item = std::find_if(scene.selection.draw.begin(), scene.selection.draw.end(),
                                   [](const DrawItem& drawn) { return drawn.id == childId; });
    ASSERT_NE(item, scene.selection.draw.end());
    EXPECT_GT(item->morph, 0);
    EXPECT_EQ(scene.explain(childId).morph, item->morph);
}

TEST(ChunkExplanation, DeltaGIsExactWhereTheChildrenAreKnown) {
    Scene scene(1);
    float below = 0;
    for (int q = 0; q < quadrantCount; ++q) below = std::max(below, scene.node(childOf(rootId, q)).deltaCM);
    EXPECT_EQ(scene.explain(rootId).deltaGM, scene.node(rootId).deltaCM - below);
    EXPECT_FALSE(scene.explain(rootId).deltaGIsBound);
    EXPECT_EQ(scene.explain(childId).deltaGM, scene.node(childId).deltaCM);
    EXPECT_EQ(scene.explain(rootId).deltaTightM, scene.node(rootId).deltaTightM);
    EXPECT_GT(scene.explain(rootId).deltaTightM, 0);
    EXPECT_TRUE(scene.explain(childId).deltaGIsBound);
    scene.tree.exaggeration = 2;
    EXPECT_TRUE(scene.explain(rootId).deltaGIsBound);
    const ChunkExplanation leaf = Scene(4).explain({Face::PosX, 4, 3, 3});
    EXPECT_EQ(leaf.deltaGM, 0);
    EXPECT_FALSE(leaf.deltaGIsBound);
}

TEST(ChunkExplanation, OfLeavesAndOfTheLargestLevel) {
    Scene scene(4);
    scene.lod.tauPx = 1e-9;
    scene.select();
    const ChunkId bottom{Face::NegY, 4, 7, 9};
    scene.node(bottom).deltaCM = 1;  // a leaf that cannot be better
    scene.select();
    EXPECT_EQ(scene.explain(bottom).state, ChunkState::Drawn);
    EXPECT_EQ(scene.explain(bottom).notSplit, WhyNotSplit::Leaf);
    scene.lod.maxLevel = 2;
    scene.select();
    EXPECT_EQ(scene.explain(grandchildId).notSplit, WhyNotSplit::LevelLimit);
    EXPECT_EQ(scene.explain(bottom).state, ChunkState::Resident);
    EXPECT_EQ(scene.explain(bottom).decidedByNotSplit, WhyNotSplit::LevelLimit);
    EXPECT_EQ(scene.explain(bottom).decidedBy, (ChunkId{Face::NegY, 2, 1, 2}));
}

TEST(ChunkExplanation, NamesTheRegionsOfAChunkAndWhatTheyDecide) {
    Scene scene(4);
    const double epsPx = scene.epsPx(childId);
    const auto regions = [&](std::vector<Region> list) {
        setRegions(scene.tree, RegionSet::make(std::move(list), scene.tree.storedShape).value());
        scene.select();
        return scene.explain(childId);
    };
    // Between its error and half of it.
    scene.lod.tauPx = 1.5 * epsPx;
    EXPECT_EQ(regions({}).regions.size(), 0u);
    EXPECT_NE(scene.explain(childId).state, ChunkState::Split);
    const RegionCircle everywhere{{0, 0}, 1e9};
    const ChunkExplanation finer = regions({{.name = "fine", .circles = {everywhere}, .tauFactor = 0.5}});
    EXPECT_EQ(finer.state, ChunkState::Split);
    ASSERT_EQ(finer.regions.size(), 1u);
    EXPECT_EQ(finer.regions[0].name, "fine");
    EXPECT_TRUE(finer.regions[0].setsTauFactor);
    EXPECT_EQ(finer.regionTauPx(), 0.75 * epsPx);
    EXPECT_EQ(finer.tauPx, scene.lod.tauPx);
    const ChunkExplanation least = regions({{.name = "least", .circles = {everywhere}, .leastLevel = 3}});
    EXPECT_EQ(least.state, ChunkState::Split);
    EXPECT_TRUE(least.regions[0].setsLeastLevel);
    EXPECT_EQ(scene.explain({Face::PosX, 3, 4, 2}).state, ChunkState::Drawn);
    scene.lod.tauPx = 1e-9;
    const ChunkExplanation most = regions({{.name = "most", .circles = {everywhere}, .mostLevel = 1}});
    EXPECT_EQ(most.state, ChunkState::Drawn);
    EXPECT_EQ(most.notSplit, WhyNotSplit::RegionLimit);
    EXPECT_TRUE(most.regions[0].setsMostLevel);
    const ChunkExplanation tight =
        regions({{.name = "tight", .circles = {everywhere}, .metric = ErrorMetric::Tight}});
    EXPECT_EQ(tight.metric, ErrorMetric::Tight);
    EXPECT_TRUE(tight.regions[0].setsMetric);
}

TEST(ChunkExplanation, OfCulledChunksNamesTheOneThatWasCulled) {
    Scene scene(4);
    scene.lod.tauPx = 1e-9;
    scene.lod.horizonCulling = true;
    scene.lod.frustumCulling = true;
    CameraPose pose;
    pose.altitudeM = 5000;
    pose.pitchDeg = -5;
    scene.view = viewFromPose(pose, smallRadiusM, 1, 1280, 720);
    scene.select();
    std::set<ChunkState> states;
    for (const VisitedNode& visited : scene.selection.touched) {
        if (visited.fate != NodeFate::CulledFrustum && visited.fate != NodeFate::CulledHorizon) continue;
        const ChunkState expected =
            visited.fate == NodeFate::CulledFrustum ? ChunkState::CulledFrustum : ChunkState::CulledHorizon;
        const ChunkId id = scene.tree.nodes[visited.node].id;
        EXPECT_EQ(scene.explain(id).state, expected);
        EXPECT_EQ(scene.explain(id).decidedBy, id);
        EXPECT_EQ(scene.explain(id).notSplit, WhyNotSplit::NotDrawn);
        if (id.level == 4) continue;
        EXPECT_EQ(scene.explain(childOf(id, 3)).state, expected);
        EXPECT_EQ(scene.explain(childOf(id, 3)).decidedBy, id);
        states.insert(expected);
    }
    EXPECT_EQ(states.size(), 2u);
}

TEST(ChunkExplanation, OfWhatIsNotResidentUnderACulledChunk) {
    Scene scene(0);
    scene.lod.frustumCulling = true;
    scene.view.eyeM = {3e5, 0, 0};
    scene.view.back = {-1, 0, 0};  // away from the planet
    scene.view.right = {0, 1, 0};
    scene.view.up = {0, 0, -1};
    scene.select();
    ASSERT_TRUE(scene.selection.draw.empty());
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::CulledFrustum);
    EXPECT_EQ(scene.explain(grandchildId).decidedBy, rootId);
    EXPECT_EQ(scene.explain(grandchildId).node, noNode);
}

TEST(ChunkExplanation, OfAChunkThatWaitsForItsChildren) {
    Scene scene(1);
    scene.lod.tauPx = 1e-3;
    scene.select();
    EXPECT_EQ(scene.explain(childId).state, ChunkState::Drawn);
    EXPECT_EQ(scene.explain(childId).notSplit, WhyNotSplit::WaitingForBudget);
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::NotResident);
    EXPECT_EQ(scene.explain(grandchildId).decidedBy, childId);
    EXPECT_EQ(scene.explain(grandchildId).decidedByNotSplit, WhyNotSplit::WaitingForBudget);

    scene.node(childId).childrenState = ChildrenState::Requested;
    scene.queue({Face::NegZ, 1, 0, 0});
    scene.queue(childId);
    scene.queue({Face::NegZ, 1, 1, 0});
    const ChunkExplanation waiting = scene.explain(childId);
    EXPECT_EQ(waiting.notSplit, WhyNotSplit::WaitingInQueue);
    EXPECT_EQ(waiting.queuePlace, 2u);
    EXPECT_EQ(waiting.queueLength, 3u);
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::Requested);
    EXPECT_EQ(scene.explain(grandchildId).decidedBy, grandchildId);
    EXPECT_EQ(scene.explain(grandchildId).queuePlace, 2u);
    const ChunkId deeper = childOf(grandchildId, 1);
    EXPECT_EQ(scene.explain(deeper).state, ChunkState::NotResident);
    EXPECT_EQ(scene.explain(deeper).decidedBy, grandchildId);
    EXPECT_EQ(scene.explain(deeper).decidedByNotSplit, WhyNotSplit::WaitingInQueue);
    EXPECT_EQ(scene.explain(deeper).queuePlace, 2u);

    scene.pageIns.clear();  // a loader took it
    EXPECT_EQ(scene.explain(childId).notSplit, WhyNotSplit::WaitingForRead);
    EXPECT_FALSE(scene.explain(childId).queuePlace);
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::Loading);
    EXPECT_EQ(scene.explain(deeper).state, ChunkState::NotResident);
    EXPECT_EQ(scene.explain(deeper).decidedByNotSplit, WhyNotSplit::WaitingForRead);

    scene.node(childId).childrenState = ChildrenState::AwaitingRetry;
    EXPECT_EQ(scene.explain(childId).notSplit, WhyNotSplit::WaitingForRetry);
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::Failed);
    EXPECT_EQ(scene.explain(grandchildId).decidedByNotSplit, WhyNotSplit::WaitingForRetry);

    scene.node(childId).childrenState = ChildrenState::Failed;
    EXPECT_EQ(scene.explain(childId).notSplit, WhyNotSplit::ChildrenFailed);
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::Failed);
    EXPECT_EQ(scene.explain(deeper).state, ChunkState::Failed);
    EXPECT_EQ(scene.explain(deeper).decidedBy, grandchildId);
}

TEST(ChunkExplanation, OfWhatNobodyAskedFor) {
    Scene scene(1);
    scene.lod.tauPx = 1e9;
    EXPECT_EQ(scene.explain(childId).state, ChunkState::Resident);  // nothing was selected yet
    EXPECT_EQ(scene.explain(childId).decidedBy, childId);
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::NotResident);
    EXPECT_EQ(scene.explain(grandchildId).decidedBy, grandchildId);
    scene.select();
    EXPECT_EQ(scene.explain(grandchildId).state, ChunkState::NotResident);
    EXPECT_EQ(scene.explain(grandchildId).decidedBy, rootId);
    EXPECT_EQ(scene.explain(grandchildId).decidedByNotSplit, WhyNotSplit::GoodEnough);
    EXPECT_EQ(scene.explain(grandchildId).node, noNode);
    EXPECT_EQ(scene.explain(grandchildId).epsPx, 0);
}

TEST(ChunkExplanation, OfChunksThatNoFileHas) {
    const Scene scene(4);
    const ChunkId tooDeep{Face::PosX, 6, 40, 9};
    EXPECT_EQ(scene.explain(tooDeep).state, ChunkState::NotInFile);
    EXPECT_EQ(scene.explain(tooDeep).decidedBy, (ChunkId{Face::PosX, 4, 10, 2}));
    EXPECT_EQ(Scene(0).explain(tooDeep).state, ChunkState::NotInFile);
    EXPECT_EQ(Scene(0).explain(tooDeep).decidedBy, (ChunkId{Face::PosX, 4, 10, 2}));
    Scene shallow(1);  // a chunk that has no children in the file, though it could
    shallow.node(childId).childrenState = ChildrenState::None;
    EXPECT_EQ(shallow.explain(grandchildId).state, ChunkState::NotInFile);
    EXPECT_EQ(shallow.explain(grandchildId).decidedBy, childId);
}

TEST(ChunkExplanation, OfChunksHeldBackForStitchedSeams) {
    Scene scene(0);
    ChunkId id{Face::PosX, 0, 0, 0};  // one corner of a face deep, the rest not resident
    for (int level = 0; level < 4; ++level, id = childOf(id, 0))
        addFakeChildren(scene.tree, findNode(scene.tree, id));
    scene.lod.tauPx = 1e-6;
    scene.lod.seams = SeamMode::Stitched;
    scene.select();
    const ChunkId held{Face::PosX, 3, 0, 0};
    EXPECT_EQ(scene.explain(held).state, ChunkState::Drawn);
    EXPECT_EQ(scene.explain(held).notSplit, WhyNotSplit::SeamLimit);
    EXPECT_EQ(scene.explain(childOf(held, 1)).state, ChunkState::Resident);
    EXPECT_EQ(scene.explain(childOf(held, 1)).decidedByNotSplit, WhyNotSplit::SeamLimit);
}

TEST(ChunkExplanation, OfSwitchesThatWaitForAFade) {
    Scene scene(4);
    scene.lod.tauPx = 1.001 * scene.epsPx(rootId);
    scene.lod.morph = true;
    scene.lod.fadeS = 1;
    scene.select();
    scene.lod.tauPx = 1e-6;
    const auto frame = [&] { selectChunks(scene.tree, scene.view, scene.lod, scene.selection, 0.25); };
    frame();
    EXPECT_EQ(scene.explain(rootId).state, ChunkState::Split);
    EXPECT_FALSE(scene.explain(rootId).mergeWaits);
    EXPECT_EQ(scene.explain(childId).state, ChunkState::Drawn);
    EXPECT_EQ(scene.explain(childId).notSplit, WhyNotSplit::WaitingForMorph);
    EXPECT_EQ(scene.explain(childId).morph, 1);
    EXPECT_EQ(scene.explain(grandchildId).decidedByNotSplit, WhyNotSplit::WaitingForMorph);
    for (int i = 0; i < 3; ++i) frame();
    scene.lod.tauPx = 1.001 * scene.epsPx(rootId);
    frame();
    EXPECT_EQ(scene.explain(rootId).state, ChunkState::Split);
    EXPECT_TRUE(scene.explain(rootId).mergeWaits);
    for (int i = 0; i < 4; ++i) frame();
    EXPECT_EQ(scene.explain(rootId).state, ChunkState::Drawn);
    EXPECT_FALSE(scene.explain(rootId).mergeWaits);
}

TEST(ChunkExplanation, GoesByTheMetricOfTheSettings) {
    Scene scene(4);
    for (ChunkNode& node : scene.tree.nodes) node.deltaTightM = 0.25f * node.deltaCM;
    scene.lod.metric = ErrorMetric::Tight;
    scene.lod.tauPx = 0.26 * scene.epsPx(rootId);
    scene.select();
    const ChunkExplanation whole = scene.explain(rootId);
    EXPECT_EQ(whole.state, ChunkState::Drawn);
    EXPECT_EQ(whole.notSplit, WhyNotSplit::GoodEnough);
    EXPECT_NEAR(whole.epsPx, 0.25 * scene.epsPx(rootId), 1e-9);
    EXPECT_EQ(whole.deltaTightM, 0.25f * scene.node(rootId).deltaCM);
    EXPECT_EQ(whole.metric, ErrorMetric::Tight);
    scene.lod.tauPx = 0.24 * scene.epsPx(rootId);
    scene.select();
    EXPECT_EQ(scene.explain(rootId).state, ChunkState::Split);
}

// Whatever is drawn, split or culled must be explained as that, in any view.
TEST(ChunkExplanation, AgreesWithTheSelection) {
    std::mt19937 random(71);
    Scene scene(4);
    for (int i = 0; i < 40; ++i) {
        scene.view = randomView(random, smallRadiusM);
        scene.lod = suddenLod();
        scene.lod.tauPx = 1 + i % 9;
        scene.lod.hysteresis = i % 2 ? 0.4 : 0.0;
        scene.select();
        for (const VisitedNode& visited : scene.selection.touched) {
            const ChunkExplanation explained = scene.explain(scene.tree.nodes[visited.node].id);
            constexpr std::array states = {ChunkState::Drawn, ChunkState::Split, ChunkState::CulledFrustum,
                                           ChunkState::CulledHorizon};
            EXPECT_EQ(explained.state, states[static_cast<std::size_t>(visited.fate)]);
            const bool good = explained.notSplit == WhyNotSplit::GoodEnough;
            EXPECT_EQ(good, visited.fate == NodeFate::Drawn);
        }
    }
}

bool covers(const ChunkId& id, const ChunkId& above) {
    return ancestorOf(id, above.level) == above;
}

// By definition: one of two chunks has its neighbour beyond an edge in the other.
TEST(ChunkExplanation, NeighboursAreAllThatIsDrawnBeyondAnEdge) {
    std::mt19937 random(72);
    std::size_t finer = 0;
    std::size_t coarser = 0;
    for (int i = 0; i < 12; ++i) {
        Scene scene(1);
        for (NodeIndex at = 0; at < scene.tree.nodes.size(); ++at) {
            const ChunkNode& node = scene.tree.nodes[at];
            if (node.id.level == 4 || node.childrenState == ChildrenState::Resident || random() % 2) continue;
            addFakeChildren(scene.tree, at);
        }
        scene.lod.tauPx = 1e-6;
        scene.lod.frustumCulling = i % 2;
        scene.select();
        for (const DrawItem& item : scene.selection.draw) {
            const auto beside = drawnNeighbours(scene.selection, item.id);
            std::array<std::set<ChunkId>, edgeCount> expected;
            for (const DrawItem& other : scene.selection.draw) {
                for (int e = 0; e < edgeCount; ++e) {
                    const ChunkId beyond = neighbourOf(item.id, static_cast<Edge>(e));
                    bool shares = covers(beyond, other.id);
                    for (int back = 0; back < edgeCount && other.id.level > item.id.level; ++back) {
                        shares |= covers(other.id, beyond) &&
                                  covers(neighbourOf(other.id, static_cast<Edge>(back)), item.id);
                    }
                    if (shares) expected[static_cast<std::size_t>(e)].insert(other.id);
                }
            }
            for (std::size_t e = 0; e < edgeCount; ++e) {
                EXPECT_EQ(std::set<ChunkId>(beside[e].begin(), beside[e].end()), expected[e]);
                EXPECT_EQ(beside[e].size(), expected[e].size());
                finer += beside[e].size() > 1;
                coarser += !beside[e].empty() && beside[e][0].level < item.id.level;
                // What lies beside a chunk has the chunk beside it.
                for (const ChunkId& other : beside[e]) {
                    const auto back = drawnNeighbours(scene.selection, other);
                    EXPECT_TRUE(std::any_of(back.begin(), back.end(), [&](const auto& ids) {
                        return std::find(ids.begin(), ids.end(), item.id) != ids.end();
                    }));
                }
            }
        }
    }
    EXPECT_GT(finer, 20u);
    EXPECT_GT(coarser, 20u);
}

}  // namespace
}  // namespace planet
