#include "planet/select/lod_select.h"
#include "planet/select/screen_error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

// The drawn chunks that a chunk of the finest level lies in.
std::vector<ChunkId> drawnOver(const std::unordered_set<ChunkId>& drawn, ChunkId id) {
    std::vector<ChunkId> over;
    while (true) {
        if (drawn.contains(id)) over.push_back(id);
        if (id.level == 0) return over;
        id = parentOf(id);
    }
}

std::vector<ChunkId> leaves() {
    std::vector<ChunkId> ids;
    for (const auto& [id, chunk] : fakePyramid().chunks) {
        if (!chunk.children.exists()) ids.push_back(id);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

TEST(LodSelect, DrawsEveryPlaceOnceWithoutCulling) {
    std::mt19937 random(11);
    const std::vector<ChunkId> finest = leaves();
    std::set<int> levels;
    for (int i = 0; i < 60; ++i) {
        const ChunkTree tree = i % 2 ? patchyTree(random, 0, 4) : wholeTree();
        const Selection selection = select(tree, randomView(random, 1e5), withoutCulling(1 + i % 30));
        const auto drawn = drawnIds(selection);
        EXPECT_EQ(drawn.size(), selection.draw.size());
        for (const ChunkId& leaf : finest) ASSERT_EQ(drawnOver(drawn, leaf).size(), 1u) << toString(leaf);
        for (const ChunkId& id : drawn) levels.insert(id.level);
    }
    EXPECT_EQ(levels.size(), 5u);
}

TEST(LodSelect, CullingTakesChunksAwayAndChangesNoOther) {
    std::mt19937 random(12);
    for (int i = 0; i < 200; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings settings = suddenLod();
        settings.tauPx = 4;
        const Selection culled = select(wholeTree(), view, settings);
        const auto all = drawnIds(select(wholeTree(), view, withoutCulling(4)));
        for (const DrawItem& item : culled.draw) EXPECT_TRUE(all.contains(item.id));
    }
}

bool insideFrustum(const Frustum& frustum, const glm::dvec3& point) {
    return std::all_of(frustum.begin(), frustum.end(), [&](const Plane& plane) {
        return glm::dot(plane.normal, point) + plane.offsetM >= 0;
    });
}

TEST(LodSelect, CulledChunksHoldNoVertexThatCanBeSeen) {
    struct Place {
        ChunkId leaf;
        std::array<glm::dvec3, 9> verticesM;
    };
    const FakePyramid& pyramid = fakePyramid();
    std::vector<Place> places;
    for (const ChunkId& leaf : leaves()) {
        Place place{leaf, {}};
        for (int k = 0; k < 9; ++k) {
            place.verticesM[std::size_t(k)] = vertexM(pyramid.shape, pyramid.at(leaf), k % 3 * 8, k / 3 * 8);
        }
        places.push_back(place);
    }
    std::mt19937 random(13);
    std::size_t culledLeaves = 0;
    std::size_t hiddenLeaves = 0;
    constexpr int views = 2500;
    for (int i = 0; i < views; ++i) {
        const View view = randomView(random, pyramid.shape.radiusM);
        LodSettings settings = suddenLod();
        settings.tauPx = 0.5 + i % 7 * 4;
        const auto drawn = drawnIds(select(wholeTree(), view, settings));
        const Frustum frustum = frustumOf(view);
        for (const Place& place : places) {
            if (!drawnOver(drawn, place.leaf).empty()) continue;
            ++culledLeaves;
            bool beside = true;
            for (const glm::dvec3& vertex : place.verticesM) {
                if (!insideFrustum(frustum, vertex)) continue;
                beside = false;
                ASSERT_TRUE(sphereHides(view.eyeM, vertex, wholeTree().occluderRadiusM))
                    << toString(place.leaf) << " in view " << i;
            }
            hiddenLeaves += !beside;
        }
    }
    EXPECT_GT(culledLeaves, places.size() * views / 2);
    EXPECT_GT(hiddenLeaves, places.size() * views / 50);
}

TEST(LodSelect, EachCullingCullsOnItsOwn) {
    CameraPose pose;
    pose.altitudeM = 5000;
    pose.pitchDeg = -5;
    const View view = viewFromPose(pose, 1e5, 1, 1280, 720);
    LodSettings both = suddenLod();
    LodSettings frustumOnly = suddenLod();
    frustumOnly.horizonCulling = false;
    LodSettings horizonOnly = suddenLod();
    horizonOnly.frustumCulling = false;
    const Selection none = select(wholeTree(), view, withoutCulling(2));
    const Selection byFrustum = select(wholeTree(), view, frustumOnly);
    const Selection byHorizon = select(wholeTree(), view, horizonOnly);
    const Selection byBoth = select(wholeTree(), view, both);
    EXPECT_EQ(none.counters.culledFrustum + none.counters.culledHorizon, 0u);
    EXPECT_EQ(byFrustum.counters.culledHorizon, 0u);
    EXPECT_EQ(byHorizon.counters.culledFrustum, 0u);
    EXPECT_GT(byBoth.counters.culledFrustum, 0u);
    EXPECT_GT(byBoth.counters.culledHorizon, 0u);
    EXPECT_LT(byFrustum.draw.size(), none.draw.size() / 2);
    EXPECT_LT(byHorizon.draw.size(), none.draw.size());
    EXPECT_LT(byBoth.draw.size(), byFrustum.draw.size());
    EXPECT_LT(byBoth.draw.size(), byHorizon.draw.size());
}

TEST(LodSelect, ChunksAreWithinToleranceWhereEverythingIsResident) {
    std::mt19937 random(14);
    for (int i = 0; i < 300; ++i) {
        LodSettings settings = suddenLod();
        settings.tauPx = 0.25 * (1 + i % 40);
        const View view = randomView(random, 1e5);
        const Selection selection = select(wholeTree(), view, settings);
        float worst = 0;
        for (const DrawItem& item : selection.draw) {
            const ChunkNode& node = wholeTree().nodes[item.node];
            EXPECT_LE(item.epsPx, settings.tauPx * (1 + 1e-6));
            const double distance = std::max(distanceM(node.bounds.box, view.eyeM), nearestM);
            EXPECT_FLOAT_EQ(item.epsPx, static_cast<float>(node.deltaCM * screenScalePx(view) / distance));
            EXPECT_FLOAT_EQ(item.distanceM, static_cast<float>(distance));
            EXPECT_EQ(item.id, node.id);
            EXPECT_EQ(item.slot, node.slot);
            worst = std::max(worst, item.epsPx);
        }
        EXPECT_EQ(selection.counters.worstEpsPx, worst);
        EXPECT_EQ(selection.counters.waiting, 0u);
        EXPECT_TRUE(selection.requests.empty());
    }
}

TEST(LodSelect, NoChunkIsSplitThatIsGoodEnough) {
    std::mt19937 random(15);
    for (int i = 0; i < 100; ++i) {
        const View view = randomView(random, 1e5);
        const Selection selection = select(wholeTree(), view, withoutCulling(3));
        for (const DrawItem& item : selection.draw) {
            if (item.id.level == 0) continue;
            const ChunkNode& parent = wholeTree().nodes[wholeTree().nodes[item.node].parent];
            const double eps = parent.deltaCM * screenScalePx(view) /
                               std::max(distanceM(parent.bounds.box, view.eyeM), nearestM);
            EXPECT_GT(eps, 3);
        }
    }
}

TEST(LodSelect, ASmallerToleranceIsNowhereCoarser) {
    std::mt19937 random(16);
    const std::vector<ChunkId> finest = leaves();
    for (int i = 0; i < 40; ++i) {
        const View view = randomView(random, 1e5);
        const auto coarse = drawnIds(select(wholeTree(), view, withoutCulling(6)));
        const auto fine = drawnIds(select(wholeTree(), view, withoutCulling(2.5)));
        EXPECT_GE(fine.size(), coarse.size());
        for (const ChunkId& leaf : finest) {
            EXPECT_GE(drawnOver(fine, leaf).front().level, drawnOver(coarse, leaf).front().level);
        }
    }
}

TEST(LodSelect, TheDeepestLevelIsRespected) {
    std::mt19937 random(17);
    for (int level = 0; level <= 4; ++level) {
        LodSettings settings = withoutCulling(0.001);
        settings.maxLevel = level;
        const Selection selection = select(wholeTree(), randomView(random, 1e5), settings);
        EXPECT_EQ(selection.draw.size(), 6u << (2 * level));
        EXPECT_EQ(selection.counters.deepestLevel, static_cast<std::uint32_t>(level));
        EXPECT_EQ(selection.counters.waiting, 0u);
        EXPECT_TRUE(selection.requests.empty());
    }
}

bool same(const Selection& a, const Selection& b) {
    return std::equal(a.draw.begin(), a.draw.end(), b.draw.begin(), b.draw.end(),
                      [](const DrawItem& p, const DrawItem& q) {
                          return p.node == q.node && p.epsPx == q.epsPx && p.skirtDepthM == q.skirtDepthM &&
                                 p.morph == q.morph && p.coarserBy == q.coarserBy &&
                                 p.edgeMorph == q.edgeMorph;
                      }) &&
           std::equal(a.seams.begin(), a.seams.end(), b.seams.begin(), b.seams.end(),
                      [](const LevelSeam& p, const LevelSeam& q) {
                          return p.finer == q.finer && p.coarser == q.coarser && p.edge == q.edge;
                      }) &&
           std::equal(a.requests.begin(), a.requests.end(), b.requests.begin(), b.requests.end(),
                      [](const ChildrenRequest& p, const ChildrenRequest& q) {
                          return p.parent == q.parent && p.priority == q.priority;
                      }) &&
           a.touched == b.touched;
}

TEST(LodSelect, TheSameInputGivesTheSameAnswer) {
    std::mt19937 random(18);
    Selection reused;
    for (int i = 0; i < 50; ++i) {
        const ChunkTree tree = patchyTree(random, 0, 4);
        const View view = randomView(random, 1e5);
        LodSettings settings = suddenLod();
        settings.tauPx = 3;
        settings.morph = i % 2;
        settings.seams = i % 3 ? SeamMode::Skirts : SeamMode::Stitched;
        selectChunks(tree, view, settings, reused);
        EXPECT_TRUE(same(reused, select(tree, view, settings)));
    }
}

TEST(LodSelect, ListsAreSortedAndTiesAreInOrderOfIds) {
    std::mt19937 random(19);
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    std::size_t most = 0;
    for (int i = 0; i < 50; ++i) {
        const Selection selection =
            select(patchyTree(random, 0, 4), randomView(random, 1e5), withoutCulling(1));
        fewest = std::min(fewest, selection.draw.size());
        most = std::max(most, selection.draw.size());
        for (std::size_t k = 1; k < selection.draw.size(); ++k) {
            const DrawItem& a = selection.draw[k - 1];
            const DrawItem& b = selection.draw[k];
            EXPECT_TRUE(a.distanceM < b.distanceM || (a.distanceM == b.distanceM && a.id < b.id));
        }
        for (std::size_t k = 1; k < selection.requests.size(); ++k) {
            const ChildrenRequest& a = selection.requests[k - 1];
            const ChildrenRequest& b = selection.requests[k];
            EXPECT_TRUE(a.priority > b.priority || (a.priority == b.priority && a.parentId < b.parentId));
        }
    }
    // Few and many items are sorted in different ways.
    EXPECT_LT(fewest, 200u);
    EXPECT_GT(most, 300u);
}

TEST(LodSelect, AParentWaitsForItsChildrenAndIsDrawnMeanwhile) {
    ChunkTree tree = residentTree(fakePyramid(), 1);
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    for (const ChildrenState state :
         {ChildrenState::Absent, ChildrenState::Requested, ChildrenState::Failed, ChildrenState::None}) {
        for (ChunkNode& node : tree.nodes) {
            if (node.id.level == 1) node.childrenState = state;
        }
        const Selection selection = select(tree, view, withoutCulling(1e-4));
        EXPECT_EQ(selection.draw.size(), 24u);
        EXPECT_EQ(selection.counters.waiting, state == ChildrenState::None ? 0u : 24u);
        const bool asked = state == ChildrenState::Absent || state == ChildrenState::Requested;
        EXPECT_EQ(selection.requests.size(), asked ? 24u : 0u);
        for (const ChildrenRequest& request : selection.requests) {
            const auto item =
                std::find_if(selection.draw.begin(), selection.draw.end(),
                             [&](const DrawItem& drawn) { return drawn.node == request.parent; });
            ASSERT_NE(item, selection.draw.end());
            EXPECT_EQ(request.parentId, item->id);
            EXPECT_FLOAT_EQ(request.priority, item->epsPx / 1e-4f);
        }
    }
}

TEST(LodSelect, AnEyeInsideABoxGivesNumbersThatEnd) {
    const ChunkTree tree = residentTree(fakePyramid(), 0);
    View view = viewFromPose({}, 1e5, 1, 1280, 720);
    view.eyeM = tree.nodes[0].bounds.box.centreM;
    const Selection selection = select(tree, view, withoutCulling(2));
    EXPECT_EQ(selection.draw.size(), 6u);
    EXPECT_EQ(selection.draw[0].node, 0u);
    EXPECT_TRUE(std::isfinite(selection.counters.worstEpsPx));
    EXPECT_TRUE(std::isfinite(selection.requests[0].priority));
}

TEST(LodSelect, WhatIsTouchedIsAllThatTheViewNeeds) {
    std::mt19937 random(20);
    for (int i = 0; i < 100; ++i) {
        LodSettings settings = suddenLod();
        settings.tauPx = 3;
        const Selection selection = select(wholeTree(), randomView(random, 1e5), settings);
        std::set<NodeIndex> touched;
        for (const VisitedNode& visited : selection.touched) touched.insert(visited.node);
        EXPECT_EQ(touched.size(), selection.touched.size());
        EXPECT_EQ(touched.size(), selection.counters.visited);
        for (const DrawItem& item : selection.draw) {
            for (NodeIndex at = item.node; at != noNode; at = wholeTree().nodes[at].parent) {
                EXPECT_TRUE(touched.contains(at));
            }
        }
        for (const NodeIndex index : touched) {  // whole blocks
            const ChunkNode& node = wholeTree().nodes[index];
            if (node.id.level == 0) continue;
            const NodeIndex first = wholeTree().nodes[node.parent].firstChild;
            for (NodeIndex q = 0; q < 4; ++q) EXPECT_TRUE(touched.contains(first + q));
        }
    }
}

// Two drawn chunks side by side, found by their corners in space: the edge of the finer one, or of either of
// two of one level, lies within the other's.
struct SharedEdge {
    std::size_t finer;
    std::size_t other;
    Edge edge;       // of the finer one
    Edge otherEdge;  // of the other
};

std::array<glm::dvec3, 2> edgeEnds(const ChunkId& id, Edge edge) {
    const FaceSquare square = faceSquareOf(id);
    const double east = square.u + square.side;
    const double north = square.v + square.side;
    const auto at = [&](double u, double v) { return cubePoint(id.face, u, v); };
    switch (edge) {
        case Edge::West:
            return {at(square.u, square.v), at(square.u, north)};
        case Edge::East:
            return {at(east, square.v), at(east, north)};
        case Edge::South:
            return {at(square.u, square.v), at(east, square.v)};
        case Edge::North:
            break;
    }
    return {at(square.u, north), at(east, north)};
}

// Exact: all edges of the cube's grids run along an axis, at coordinates without rounding.
bool liesOn(const glm::dvec3& point, const std::array<glm::dvec3, 2>& edge) {
    return glm::all(glm::lessThanEqual(glm::min(edge[0], edge[1]), point)) &&
           glm::all(glm::lessThanEqual(point, glm::max(edge[0], edge[1])));
}

std::vector<SharedEdge> sharedEdges(const std::vector<ChunkId>& ids) {
    std::vector<SharedEdge> shared;
    for (std::size_t a = 0; a < ids.size(); ++a) {
        for (std::size_t b = 0; b < ids.size(); ++b) {
            if (a == b || ids[a].level < ids[b].level) continue;
            for (int e = 0; e < edgeCount * edgeCount; ++e) {
                const auto edge = static_cast<Edge>(e / edgeCount);
                const auto otherEdge = static_cast<Edge>(e % edgeCount);
                const auto [from, to] = edgeEnds(ids[a], edge);
                const auto otherEnds = edgeEnds(ids[b], otherEdge);
                if (liesOn(from, otherEnds) && liesOn(to, otherEnds))
                    shared.push_back({a, b, edge, otherEdge});
            }
        }
    }
    return shared;
}

std::vector<SharedEdge> sharedEdges(const Selection& selection) {
    std::vector<ChunkId> ids;
    for (const DrawItem& item : selection.draw) ids.push_back(item.id);
    return sharedEdges(ids);
}

std::size_t at(Edge edge) {
    return static_cast<std::size_t>(edge);
}

TEST(LodSelect, EdgesKnowWhatLiesBeyondThem) {
    std::mt19937 random(31);
    std::size_t acrossFaces = 0;
    std::uint32_t widest = 0;
    for (int i = 0; i < 16; ++i) {
        LodSettings settings = withoutCulling(6);
        settings.frustumCulling = i % 2;
        settings.morph = i % 4 < 2;
        settings.morphRange = 2;
        settings.seams = i % 3 ? SeamMode::Skirts : SeamMode::Stitched;
        const Selection selection = select(patchyTree(random, 0, 4), randomView(random, 1e5), settings);
        std::map<std::pair<ChunkId, Edge>, std::pair<int, float>> expected;
        std::set<std::tuple<ChunkId, ChunkId, Edge>> seams;
        for (const SharedEdge& shared : sharedEdges(selection)) {
            const DrawItem& finer = selection.draw[shared.finer];
            const DrawItem& other = selection.draw[shared.other];
            const int levels = finer.id.level - other.id.level;
            const bool stitched = settings.seams == SeamMode::Stitched;
            const float morph = levels == 0 ? std::max(finer.morph, other.morph)
                                : stitched  ? other.morph
                                            : finer.morph;
            expected[{finer.id, shared.edge}] = {levels, morph};
            if (levels > 0) seams.insert({finer.id, other.id, shared.edge});
            acrossFaces += levels > 0 && finer.id.face != other.id.face;
            widest = std::max(widest, static_cast<std::uint32_t>(levels));
            // Both sides say the same of the edge they share.
            if (levels == 0 || stitched) {
                EXPECT_EQ(finer.edgeMorph[at(shared.edge)], other.edgeMorph[at(shared.otherEdge)]);
            }
        }
        for (const DrawItem& item : selection.draw) {
            for (int e = 0; e < edgeCount; ++e) {
                const auto found = expected.find({item.id, static_cast<Edge>(e)});
                const std::size_t edge = static_cast<std::size_t>(e);
                EXPECT_EQ(item.coarserBy[edge], found == expected.end() ? 0 : found->second.first);
                EXPECT_EQ(item.edgeMorph[edge], found == expected.end() ? item.morph : found->second.second);
            }
        }
        std::set<std::tuple<ChunkId, ChunkId, Edge>> got;
        std::uint32_t widestHere = 0;
        for (const LevelSeam& seam : selection.seams) {
            got.insert({seam.finer, seam.coarser, seam.edge});
            widestHere = std::max<std::uint32_t>(widestHere, seam.finer.level - seam.coarser.level);
        }
        EXPECT_EQ(got, seams);
        EXPECT_EQ(selection.seams.size(), seams.size());
        EXPECT_EQ(selection.counters.widestSeam, widestHere);
    }
    EXPECT_GT(acrossFaces, 10u);
    EXPECT_GE(widest, 3u);
}

double parentDeltaCM(const ChunkTree& tree, const DrawItem& item) {
    return item.id.level == 0 ? item.deltaCM : tree.nodes[tree.nodes[item.node].parent].deltaCM;
}

// Between a chunk's own bound and its parent's.
double slidBoundM(const ChunkTree& tree, const DrawItem& item, double morph) {
    return item.deltaCM + morph * (parentDeltaCM(tree, item) - item.deltaCM);
}

std::map<ChunkId, double> skirtDepthsByTryingAllPairs(const ChunkTree& tree, const Selection& selection,
                                                      double factor) {
    std::map<ChunkId, double> depths;
    for (const DrawItem& item : selection.draw) {
        depths[item.id] = std::max(2 * tree.shape.quantumM, 1e-6 * item.distanceM);
    }
    for (const SharedEdge& shared : sharedEdges(selection)) {
        const DrawItem& finer = selection.draw[shared.finer];
        const DrawItem& other = selection.draw[shared.other];
        // Two of one level share the larger morph there.
        const bool level = finer.id.level == other.id.level;
        const double both = std::max(finer.morph, other.morph);
        const double depth = factor * (slidBoundM(tree, finer, level ? both : finer.morph) +
                                       slidBoundM(tree, other, level ? both : other.morph));
        depths[finer.id] = std::max(depths[finer.id], depth);
        depths[other.id] = std::max(depths[other.id], depth);
    }
    return depths;
}

TEST(LodSelect, SkirtsCoverTheErrorsOnBothSidesOfEveryEdge) {
    std::mt19937 random(21);
    for (int i = 0; i < 24; ++i) {
        LodSettings settings = withoutCulling(8);
        settings.frustumCulling = i % 2;
        settings.skirtFactor = i % 3 ? 1 : 2.5;
        settings.morph = i % 8 < 4;
        settings.morphRange = 1;
        const ChunkTree tree = i % 4 ? patchyTree(random, 0, 4) : wholeTree();
        const Selection selection = select(tree, randomView(random, 1e5), settings);
        const auto expected = skirtDepthsByTryingAllPairs(tree, selection, settings.skirtFactor);
        for (const DrawItem& item : selection.draw) {
            EXPECT_NEAR(item.skirtDepthM, expected.at(item.id), 1e-5 * expected.at(item.id))
                << toString(item.id);
        }
    }
}

TEST(LodSelect, ASkirtFactorOfZeroMeansNoSkirts) {
    LodSettings settings = suddenLod();
    settings.skirtFactor = 0;
    const Selection selection = select(wholeTree(), viewFromPose({}, 1e5, 1, 1280, 720), settings);
    ASSERT_FALSE(selection.draw.empty());
    for (const DrawItem& item : selection.draw) EXPECT_EQ(item.skirtDepthM, 0);
}

TEST(LodSelect, SkirtsAreAsDeepAsTheSettingsSay) {
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    LodSettings settings = suddenLod();
    settings.skirtDepth = SkirtDepth::Fixed;
    settings.skirtDepthM = 123.5;
    settings.skirtFactor = 0;
    for (const SeamMode mode : {SeamMode::None, SeamMode::Skirts, SeamMode::Stitched}) {
        settings.seams = mode;
        const Selection selection = select(wholeTree(), view, settings);
        ASSERT_FALSE(selection.draw.empty());
        for (const DrawItem& item : selection.draw) {
            EXPECT_EQ(item.skirtDepthM, mode == SeamMode::Skirts ? 123.5f : 0.f);
        }
    }
}

double epsPxOf(const ChunkTree& tree, const View& view, NodeIndex index) {
    const ChunkNode& node = tree.nodes[index];
    return node.deltaCM * screenScalePx(view) / std::max(distanceM(node.bounds.box, view.eyeM), nearestM);
}

// What hysteresis should keep, by its definition.
void expectedSplits(const ChunkTree& tree, const View& view, const LodSettings& settings,
                    const std::set<ChunkId>& before, NodeIndex index, std::set<ChunkId>& splits) {
    const ChunkNode& node = tree.nodes[index];
    if (node.childrenState != ChildrenState::Resident) return;
    const double eps = epsPxOf(tree, view, index);
    const bool stays = before.contains(node.id) && eps > settings.tauPx * (1 - settings.hysteresis);
    if (eps <= settings.tauPx && !stays) return;
    splits.insert(node.id);
    for (NodeIndex q = 0; q < quadrantCount; ++q) {
        expectedSplits(tree, view, settings, before, node.firstChild + q, splits);
    }
}

TEST(LodSelect, WhatWasSplitStaysSplitWithinTheHysteresis) {
    std::mt19937 random(32);
    std::size_t kept = 0;
    std::size_t letGo = 0;
    for (int i = 0; i < 60; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings settings = withoutCulling(2);
        settings.hysteresis = 0.3;
        Selection selection = select(wholeTree(), view, settings);
        for (const double tauPx : {2.4, 3.0, 5.0}) {
            settings.tauPx = tauPx;
            const std::set<ChunkId> before = splitIds(selection);
            std::set<ChunkId> expected;
            for (NodeIndex root = 0; root < faceCount; ++root) {
                expectedSplits(wholeTree(), view, settings, before, root, expected);
            }
            selectChunks(wholeTree(), view, settings, selection);
            EXPECT_EQ(splitIds(selection), expected);
            kept += expected.size() - splitIds(select(wholeTree(), view, settings)).size();
            letGo += before.size() - expected.size();
        }
    }
    EXPECT_GT(kept, 100u);
    EXPECT_GT(letGo, 100u);
}

TEST(LodSelect, HysteresisLetsGoAtTheRightEps) {
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    const double eps = epsPxOf(wholeTree(), view, 0);
    LodSettings settings = withoutCulling(eps * 0.999);
    settings.hysteresis = 0.25;
    settings.maxLevel = 1;
    Selection selection = select(wholeTree(), view, settings);
    const auto rootIsSplit = [&] { return splitIds(selection).contains(ChunkId{Face::PosX, 0, 0, 0}); };
    ASSERT_TRUE(rootIsSplit());
    settings.tauPx = eps / 0.75 * 0.999;
    selectChunks(wholeTree(), view, settings, selection);
    EXPECT_TRUE(rootIsSplit());
    settings.tauPx = eps / 0.75 * 1.001;
    selectChunks(wholeTree(), view, settings, selection);
    EXPECT_FALSE(rootIsSplit());
    settings.tauPx = eps * 1.001;  // and what has merged stays so until eps is over tau
    selectChunks(wholeTree(), view, settings, selection);
    EXPECT_FALSE(rootIsSplit());
}

TEST(LodSelect, HysteresisGoesByIdsAndNotByNodes) {
    const FakePyramid& pyramid = fakePyramid();
    ChunkTree other = makeChunkTree(pyramid.shape, pyramid.minStep, pyramid.maxStep, pyramid.roots()).value();
    std::vector<NodeIndex> open = {5, 4, 3, 2, 1, 0};  // depth first, from the other end
    while (!open.empty()) {
        const NodeIndex index = open.back();
        open.pop_back();
        if (other.nodes[index].childrenState == ChildrenState::None) continue;
        const auto next = static_cast<NodeIndex>(other.nodes.size());
        addFakeChildren(other, index, pyramid);
        for (NodeIndex q = 0; q < quadrantCount; ++q) open.push_back(next + q);
    }
    std::mt19937 random(33);
    for (int i = 0; i < 20; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings settings = withoutCulling(3);
        settings.hysteresis = 0.5;
        Selection stayed = select(wholeTree(), view, settings);
        Selection moved = stayed;
        settings.tauPx = 5;
        selectChunks(wholeTree(), view, settings, stayed);
        selectChunks(other, view, settings, moved);
        EXPECT_EQ(drawnIds(moved), drawnIds(stayed));
    }
}

TEST(LodSelect, HysteresisAsksForNothingThatIsGoodEnough) {
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    LodSettings settings = withoutCulling(2);
    settings.hysteresis = 0.5;
    Selection selection = select(residentTree(fakePyramid(), 2), view, settings);
    settings.tauPx = 3;
    selectChunks(residentTree(fakePyramid(), 1), view, settings, selection);
    for (const ChildrenRequest& request : selection.requests) EXPECT_GT(request.priority, 1);
    EXPECT_EQ(selection.counters.waiting, selection.requests.size());
}

TEST(LodSelect, MorphGoesFromTheChunksOwnSurfaceToItsParents) {
    std::mt19937 random(34);
    std::size_t whole = 0;
    std::size_t between = 0;
    for (int i = 0; i < 100; ++i) {
        LodSettings settings = withoutCulling(3);
        settings.morph = i % 5 != 0;
        settings.morphRange = 0.1 + 0.1 * (i % 9);
        settings.hysteresis = i % 2 ? 0.3 : 0.0;
        const View view = randomView(random, 1e5);
        Selection selection = select(wholeTree(), view, settings);
        settings.tauPx = 3.5;  // so that hysteresis keeps some whose parent is good enough
        selectChunks(wholeTree(), view, settings, selection);
        for (const DrawItem& item : selection.draw) {
            const NodeIndex parent = wholeTree().nodes[item.node].parent;
            const double parentEps = parent == noNode ? 0 : epsPxOf(wholeTree(), view, parent);
            EXPECT_FLOAT_EQ(item.parentEpsPx, static_cast<float>(parentEps));
            if (!settings.morph || parent == noNode) {
                EXPECT_EQ(item.morph, 0);
                continue;
            }
            EXPECT_GE(item.morph, 0);
            EXPECT_LE(item.morph, 1);
            const double over = parentEps / settings.tauPx;
            EXPECT_TRUE(over > 1 || item.morph == 1);
            EXPECT_TRUE(over < 1 + settings.morphRange || item.morph == 0);
            whole += item.morph == 1;
            between += item.morph > 0 && item.morph < 1;
        }
    }
    EXPECT_GT(whole, 50u);
    EXPECT_GT(between, 500u);
}

// What is drawn just before and just after a chunk takes the place of its children.
std::array<ItemsById, 2> aroundAMerge(const View& view, NodeIndex index, double hysteresis) {
    const double eps = epsPxOf(wholeTree(), view, index);
    LodSettings settings = withoutCulling(eps * (1 - 1e-9));
    settings.morph = true;
    settings.morphRange = 4;
    settings.hysteresis = hysteresis;
    Selection selection = select(wholeTree(), view, settings);
    settings.tauPx = eps / (1 - hysteresis) * (1 - 1e-9);
    selectChunks(wholeTree(), view, settings, selection);
    ItemsById before = itemsOf(selection);
    settings.tauPx = eps / (1 - hysteresis) * (1 + 1e-9);
    selectChunks(wholeTree(), view, settings, selection);
    return {std::move(before), itemsOf(selection)};
}

TEST(LodSelect, AChunkAndItsChildrenShowTheSameSurfaceWhereTheySwitch) {
    std::mt19937 random(35);
    constexpr std::array hysteresis = {0.0, 0.2};
    std::array<int, 2> looked{};
    for (std::size_t i = 0; i < 1200; ++i) {
        const double kept = hysteresis[i % 2];
        const View view = randomView(random, 1e5);
        const auto index = static_cast<NodeIndex>(random() % wholeTree().nodes.size());
        const ChunkNode& node = wholeTree().nodes[index];
        if (node.childrenState != ChildrenState::Resident) continue;
        const auto [split, merged] = aroundAMerge(view, index, kept);
        const auto found = merged.find(node.id);
        if (found == merged.end()) continue;  // a chunk above it is good enough
        const DrawItem& chunk = found->second;
        if (node.parent != noNode) {
            const double deltaRatio = wholeTree().nodes[node.parent].deltaCM / node.deltaCM;
            const double ratio = std::min(deltaRatio, static_cast<double>(chunk.parentEpsPx) / chunk.epsPx);
            // Hysteresis is too much for errors that differ that little.
            if (kept > 0 && ratio * (1 - kept) - 1 < (ratio - 1) / 4) continue;
        }
        ++looked[i % 2];
        // Near to nothing, unless the parent has as good as the same surface.
        const double toParentPx = chunk.parentEpsPx - chunk.epsPx;
        EXPECT_LE(chunk.morph * toParentPx, 1e-6 * chunk.epsPx) << toString(node.id);
        for (int q = 0; q < quadrantCount; ++q) {
            const auto child = split.find(childOf(node.id, q));
            if (child == split.end()) continue;  // itself split
            EXPECT_GE(child->second.morph, 1 - 1e-5) << toString(child->first);
        }
    }
    EXPECT_GT(looked[0], 60);
    EXPECT_GT(looked[1], 40);
}

View flightView(double altitudeM) {
    CameraPose pose;
    pose.latitudeDeg = 20 + 5e-6 * altitudeM;
    pose.altitudeM = altitudeM;
    pose.pitchDeg = -60;
    return viewFromPose(pose, 1e5, 1, 1280, 720);
}

// On screen: how far a chunk's surface moves from one frame to the next, for what its errors allow.
TEST(LodSelect, MorphMovesNoSurfaceFasterThanTheCameraDoes) {
    LodSettings settings = withoutCulling(5);
    settings.morph = true;
    settings.morphRange = 4;
    ItemsById before;
    std::size_t switches = 0;
    std::size_t slid = 0;
    constexpr double step = 1e-3;  // the share by which the camera comes nearer
    for (double altitudeM = 1e7; altitudeM > 12'000; altitudeM *= 1 - step) {
        const View view = flightView(altitudeM);
        ItemsById now = itemsOf(select(wholeTree(), view, settings));
        for (const auto& [id, item] : now) {
            if (id.level == 0 || before.empty()) continue;
            const double slidePx =
                (parentDeltaCM(wholeTree(), item) - item.deltaCM) * screenScalePx(view) / item.distanceM;
            const auto last = before.find(id);
            const auto parent = before.find(parentOf(id));
            if (last != before.end()) {
                EXPECT_LE(std::abs(item.morph - last->second.morph) * slidePx, 0.05) << toString(id);
                slid += item.morph != last->second.morph;
            } else if (parent != before.end()) {
                EXPECT_LE((1 - item.morph) * slidePx, 0.05) << toString(id);
                const double aboveThat = parent->second.parentEpsPx - parent->second.epsPx;
                EXPECT_LE(parent->second.morph * aboveThat, 0.05) << toString(id);
                ++switches;
            }
        }
        before = std::move(now);
    }
    EXPECT_GT(switches, 100u);
    EXPECT_GT(slid, 2000u);
}

// A flat planet of thirteen levels, resident only above some of its finest chunks.
ChunkTree deepTree(const std::vector<ChunkId>& deepest) {
    PlanetShape shape;
    shape.radiusM = 1e6;
    shape.chunkCellsLog2 = 4;
    shape.faceCellsLog2 = 16;
    const auto chunk = [&](const ChunkId& id) {
        ChunkData data;
        data.id = id;
        data.deltaCM = static_cast<float>(std::ldexp(1e5, -id.level));
        if (id.level < deepestLevelOf(shape)) data.children = {keyOf(id) + 1, 100};
        data.heights = std::vector<std::int16_t>(static_cast<std::size_t>(chunkVertexCount(shape)));
        return data;
    };
    std::array<ChunkData, faceCount> roots;
    for (const Face face : allFaces) roots[static_cast<std::size_t>(face)] = chunk({face, 0, 0, 0});
    ChunkTree tree = makeChunkTree(shape, 0, 0, std::move(roots)).value();
    for (const ChunkId& target : deepest) {
        for (int level = 0; level < target.level; ++level) {
            const int below = target.level - level;
            const ChunkId id{target.face, static_cast<std::uint8_t>(level), target.x >> below,
                             target.y >> below};
            const NodeIndex index = findNode(tree, id);
            if (tree.nodes[index].childrenState == ChildrenState::Resident) continue;
            std::array<ChunkData, quadrantCount> children;
            for (int q = 0; q < quadrantCount; ++q) {
                children[static_cast<std::size_t>(q)] = chunk(childOf(id, q));
            }
            const auto next = static_cast<std::uint32_t>(tree.nodes.size());
            addChildren(tree, index, std::move(children), {next, next + 1, next + 2, next + 3});
        }
    }
    return tree;
}

// The finest drawing without too wide a seam, by trying all pairs until none is left.
std::set<ChunkId> limitedByTryingAllPairs(std::set<ChunkId> drawn, int widest) {
    while (true) {
        const std::vector<ChunkId> ids(drawn.begin(), drawn.end());
        ChunkId tooFine;
        for (const SharedEdge& shared : sharedEdges(ids)) {
            if (ids[shared.finer].level - ids[shared.other].level > widest) tooFine = ids[shared.finer];
        }
        if (tooFine == ChunkId{}) return drawn;
        const ChunkId parent = parentOf(tooFine);
        std::erase_if(drawn, [&](const ChunkId& id) { return ancestorOf(id, parent.level) == parent; });
        drawn.insert(parent);
    }
}

void expectConsistent(const ChunkTree& tree, const Selection& selection) {
    std::set<ChunkId> splits;
    std::set<ChunkId> drawn;
    for (const VisitedNode& visited : selection.touched) {
        if (visited.fate == NodeFate::Split) splits.insert(tree.nodes[visited.node].id);
        if (visited.fate == NodeFate::Drawn) drawn.insert(tree.nodes[visited.node].id);
    }
    const auto ids = drawnIds(selection);
    EXPECT_EQ(drawn, std::set<ChunkId>(ids.begin(), ids.end()));
    EXPECT_EQ(splits, splitIds(selection));
    EXPECT_EQ(selection.counters.drawn, selection.draw.size());
    EXPECT_EQ(selection.counters.visited, selection.touched.size());
    std::uint32_t deepest = 0;
    for (const DrawItem& item : selection.draw) deepest = std::max<std::uint32_t>(deepest, item.id.level);
    EXPECT_EQ(selection.counters.deepestLevel, deepest);
    for (const ChildrenRequest& request : selection.requests) EXPECT_TRUE(ids.contains(request.parentId));
    EXPECT_EQ(selection.counters.waiting, selection.requests.size());
}

TEST(LodSelect, StitchedSeamsAreNoWiderThanCanBeStitched) {
    // At a corner of the cube, within a face, and on an edge of the cube.
    const std::vector<ChunkId> targets = {
        {Face::PosX, 12, 4095, 4095}, {Face::NegY, 9, 100, 300}, {Face::PosZ, 7, 127, 50}};
    const ChunkTree tree = deepTree(targets);
    const int widest = tree.shape.chunkCellsLog2 - 1;
    LodSettings settings = withoutCulling(1e-3);
    const View view = viewFromPose({}, 1e6, 1, 1280, 720);
    const Selection free = select(tree, view, settings);
    EXPECT_EQ(free.counters.widestSeam, 12u);
    settings.seams = SeamMode::Stitched;
    const Selection limited = select(tree, view, settings);
    EXPECT_EQ(limited.counters.widestSeam, static_cast<std::uint32_t>(widest));
    expectConsistent(tree, free);
    expectConsistent(tree, limited);
    const auto freeIds = drawnIds(free);
    const auto limitedIds = drawnIds(limited);
    const std::set<ChunkId> expected = limitedByTryingAllPairs({freeIds.begin(), freeIds.end()}, widest);
    EXPECT_EQ(std::set<ChunkId>(limitedIds.begin(), limitedIds.end()), expected);
    EXPECT_LT(limited.draw.size(), free.draw.size());
    EXPECT_LT(limited.requests.size(), free.requests.size());
    EXPECT_GT(limited.counters.deepestLevel, 3u);
}

TEST(LodSelect, StitchingChangesNothingWhereSeamsAreNarrow) {
    std::mt19937 random(36);
    for (int i = 0; i < 50; ++i) {
        LodSettings settings = suddenLod();
        settings.tauPx = 3;
        const View view = randomView(random, 1e5);
        const Selection skirts = select(wholeTree(), view, settings);
        if (skirts.counters.widestSeam > 3) continue;
        settings.seams = SeamMode::Stitched;
        const Selection stitched = select(wholeTree(), view, settings);
        EXPECT_EQ(drawnIds(stitched), drawnIds(skirts));
        EXPECT_EQ(stitched.touched, skirts.touched);
    }
}

// Prints what selection costs; asserts only that there was much to select.
TEST(LodSelect, SelectsThousandsOfChunks) {
    const FakePyramid pyramid = makeFakePyramid(5);
    const ChunkTree tree = residentTree(pyramid, 5);
    CameraPose pose;
    pose.altitudeM = 300000;
    pose.pitchDeg = -90;
    const View view = viewFromPose(pose, 1e5, 1.2, 1920, 1080);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.001;
    for (const double fadeS : {0.0, 0.25}) {
        settings.morph = fadeS > 0;
        settings.fadeS = fadeS;
        Selection selection;
        constexpr int repeats = 20;
        double bestUs = 1e300;
        for (int i = 0; i < repeats; ++i) {
            const auto start = std::chrono::steady_clock::now();
            selectChunks(tree, view, settings, selection, 0.01);
            const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
            bestUs = std::min(bestUs, taken.count());
        }
        const SelectionCounters& counters = selection.counters;
        fmt::print("fade {} s: {} drawn, {} visited, {} culled: {:.0f} us, {:.3f} us a visited node\n", fadeS,
                   counters.drawn, counters.visited, counters.culledFrustum + counters.culledHorizon, bestUs,
                   bestUs / counters.visited);
        EXPECT_GT(counters.drawn, 1500u);
    }
}

}  // namespace
}  // namespace planet
