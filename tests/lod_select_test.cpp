#include "planet/lod_select.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>
#include <unordered_set>

#include "tests/fake_pyramid.h"
#include "tests/random_view.h"

namespace planet {
namespace {

const ChunkTree& wholeTree() {
    static const ChunkTree tree = residentTree(fakePyramid(), leafLevel(fakePyramid().shape));
    return tree;
}

// Whole but for holes in what is resident, at random.
ChunkTree patchyTree(std::mt19937& random) {
    ChunkTree tree = residentTree(fakePyramid(), 0);
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
        const ChunkId id = tree.nodes[i].id;
        if (tree.nodes[i].childrenState == ChildrenState::None || random() % 4 == 0) continue;
        const auto next = static_cast<std::uint32_t>(tree.nodes.size());
        addChildren(tree, i, fakePyramid().childrenOf(id), {next, next + 1, next + 2, next + 3});
    }
    return tree;
}

LodSettings withoutCulling(double tauPx) {
    LodSettings settings;
    settings.tauPx = tauPx;
    settings.frustumCulling = false;
    settings.horizonCulling = false;
    return settings;
}

Selection select(const ChunkTree& tree, const View& view, const LodSettings& settings) {
    Selection selection;
    selectChunks(tree, view, settings, selection);
    return selection;
}

std::unordered_set<ChunkId> drawnIds(const Selection& selection) {
    std::unordered_set<ChunkId> ids;
    for (const DrawItem& item : selection.draw) ids.insert(item.id);
    return ids;
}

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
        const ChunkTree tree = i % 2 ? patchyTree(random) : wholeTree();
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
        LodSettings settings;
        settings.tauPx = 4;
        const Selection culled = select(wholeTree(), view, settings);
        const auto all = drawnIds(select(wholeTree(), view, withoutCulling(4)));
        for (const DrawItem& item : culled.draw) EXPECT_TRUE(all.contains(item.id));
    }
}

// Whether the line from the eye to a point meets the sphere.
bool sphereHides(const glm::dvec3& eye, const glm::dvec3& point, double radius) {
    const glm::dvec3 along = point - eye;
    const double t = std::clamp(-glm::dot(eye, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(eye + t * along) < radius;
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
        LodSettings settings;
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
    LodSettings both;
    LodSettings frustumOnly;
    frustumOnly.horizonCulling = false;
    LodSettings horizonOnly;
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
        LodSettings settings;
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
                          return p.node == q.node && p.epsPx == q.epsPx && p.skirtDepthM == q.skirtDepthM;
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
        const ChunkTree tree = patchyTree(random);
        const View view = randomView(random, 1e5);
        LodSettings settings;
        settings.tauPx = 3;
        selectChunks(tree, view, settings, reused);
        EXPECT_TRUE(same(reused, select(tree, view, settings)));
    }
}

TEST(LodSelect, ListsAreSortedAndTiesAreInOrderOfIds) {
    std::mt19937 random(19);
    for (int i = 0; i < 50; ++i) {
        const Selection selection = select(patchyTree(random), randomView(random, 1e5), withoutCulling(1));
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
        LodSettings settings;
        settings.tauPx = 3;
        const Selection selection = select(wholeTree(), randomView(random, 1e5), settings);
        const std::set<NodeIndex> touched(selection.touched.begin(), selection.touched.end());
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

// The same rule, found the slow way: two drawn chunks share an edge where the finer one's neighbour of its
// own level lies in the other.
std::map<ChunkId, double> skirtDepthsByTryingAllPairs(const Selection& selection, double factor) {
    std::map<ChunkId, double> depths;
    const auto liesIn = [](ChunkId id, const ChunkId& other) {
        while (id.level > other.level) id = parentOf(id);
        return id == other;
    };
    for (const DrawItem& item : selection.draw) {
        depths[item.id] = std::max(2 * fakePyramid().shape.quantumM, 1e-6 * item.distanceM);
    }
    for (const DrawItem& fine : selection.draw) {
        for (int edge = 0; edge < edgeCount; ++edge) {
            const ChunkId beyond = neighbourOf(fine.id, static_cast<Edge>(edge));
            for (const DrawItem& other : selection.draw) {
                if (!liesIn(beyond, other.id)) continue;
                const double depth = factor * (fine.deltaCM + other.deltaCM);
                depths[fine.id] = std::max(depths[fine.id], depth);
                depths[other.id] = std::max(depths[other.id], depth);
            }
        }
    }
    return depths;
}

TEST(LodSelect, SkirtsCoverTheErrorsOnBothSidesOfEveryEdge) {
    std::mt19937 random(21);
    for (int i = 0; i < 24; ++i) {
        LodSettings settings = withoutCulling(8);
        settings.frustumCulling = i % 2;
        settings.skirtFactor = i % 3 ? 1 : 2.5;
        const ChunkTree tree = i % 4 ? patchyTree(random) : wholeTree();
        const Selection selection = select(tree, randomView(random, 1e5), settings);
        const auto expected = skirtDepthsByTryingAllPairs(selection, settings.skirtFactor);
        for (const DrawItem& item : selection.draw) {
            EXPECT_NEAR(item.skirtDepthM, expected.at(item.id), 1e-5 * expected.at(item.id))
                << toString(item.id);
        }
    }
}

TEST(LodSelect, ASkirtFactorOfZeroMeansNoSkirts) {
    LodSettings settings;
    settings.skirtFactor = 0;
    const Selection selection = select(wholeTree(), viewFromPose({}, 1e5, 1, 1280, 720), settings);
    ASSERT_FALSE(selection.draw.empty());
    for (const DrawItem& item : selection.draw) EXPECT_EQ(item.skirtDepthM, 0);
}

// Prints what selection costs; asserts only that there was much to select.
TEST(LodSelect, SelectsThousandsOfChunks) {
    const FakePyramid pyramid = makeFakePyramid(6);
    const ChunkTree tree = residentTree(pyramid, 6);
    CameraPose pose;
    pose.altitudeM = 50000;
    pose.pitchDeg = -70;
    const View view = viewFromPose(pose, 1e5, 1.2, 1920, 1080);
    LodSettings settings;
    settings.tauPx = 0.001;
    Selection selection;
    constexpr int repeats = 20;
    double bestUs = 1e300;
    for (int i = 0; i < repeats; ++i) {
        const auto start = std::chrono::steady_clock::now();
        selectChunks(tree, view, settings, selection);
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
        bestUs = std::min(bestUs, taken.count());
    }
    const SelectionCounters& counters = selection.counters;
    fmt::print("{} drawn, {} visited, {} culled: {:.0f} us, {:.3f} us a visited node\n", counters.drawn,
               counters.visited, counters.culledFrustum + counters.culledHorizon, bestUs,
               bestUs / counters.visited);
    EXPECT_GT(counters.drawn, 1500u);
}

}  // namespace
}  // namespace planet
