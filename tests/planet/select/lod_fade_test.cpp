#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>

#include "planet/planet_tools.h"
#include "planet/select/drawn_surface.h"
#include "planet/select/lod_select.h"
#include "tests/support/fake_selection.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

constexpr double fadeFrameS = 1.0 / 60;
constexpr double usualFadeS = 0.25;
constexpr float fadeStep = static_cast<float>(fadeFrameS / usualFadeS);
constexpr float rounding = 2e-6f;

LodSettings fading(double tauPx) {
    LodSettings settings = suddenLod();
    settings.tauPx = tauPx;
    settings.morph = true;
    settings.fadeS = usualFadeS;
    return settings;
}

bool sameDrawing(const Selection& a, const Selection& b) {
    return std::equal(a.draw.begin(), a.draw.end(), b.draw.begin(), b.draw.end(),
                      [](const DrawItem& p, const DrawItem& q) {
                          return p.node == q.node && p.morph == q.morph && p.edgeMorph == q.edgeMorph &&
                                 p.coarserBy == q.coarserBy && p.skirtDepthM == q.skirtDepthM &&
                                 p.splitWaits == q.splitWaits;
                      }) &&
           a.touched == b.touched;
}

// Up and down and about; faster where there are more radians a second.
struct Flight {
    double radiansPerS = 1;
    double phase = 0;

    View at(double timeS) const {
        const double t = phase + radiansPerS * timeS;
        CameraPose pose;
        pose.altitudeM = 2e4 * std::exp(1.8 * std::sin(t));
        pose.latitudeDeg = 20 + 30 * std::sin(0.7 * t);
        pose.longitudeDeg = 10 + 40 * std::sin(0.5 * t);
        pose.headingDeg = 40 * std::sin(0.3 * t);
        pose.pitchDeg = -60 + 25 * std::sin(0.4 * t);
        return viewFromPose(pose, 1e5, 1, 1280, 720);
    }
};

// In pixels, or nothing where it is not in the picture.
std::optional<glm::dvec2> project(const View& view, const glm::dvec3& pointM) {
    const glm::dvec3 camera = cameraFromWorldRotation(view) * (pointM - view.eyeM);
    if (camera.z >= 0) return std::nullopt;
    const glm::dvec2 px = glm::dvec2(camera) * (screenScalePx(view) / -camera.z);
    if (std::abs(px.x) > view.widthPx / 2.0 || std::abs(px.y) > view.heightPx / 2.0) return std::nullopt;
    return px;
}

DrawnGrid fakeGridOf(const DrawItem& item, bool stitched) {
    return drawnGrid(wholeTree().shape, item, fakePyramid().at(item.id).heights, stitched);
}

// Whether a stitched edge of the parent's is drawn by the child as it was by the parent, or the reverse. The
// chunk beyond may slide on meanwhile, and the edge with it; or be split, and what takes its place be out of
// view.
bool edgeRests(const DrawItem& parent, const DrawItem& child, Edge edge) {
    const auto e = static_cast<std::size_t>(edge);
    if (child.coarserBy[e] == 0) return parent.coarserBy[e] == 0;
    return child.coarserBy[e] == parent.coarserBy[e] + 1 && child.edgeMorph[e] == parent.edgeMorph[e];
}

// The farthest that the picture moves when a chunk is exchanged for one of its children or the reverse: at
// all places of the child's vertices, but for the outermost cells along an edge that slides anyway.
double largestJumpPx(const View& view, const DrawItem& parent, const DrawItem& child, bool stitched) {
    const DrawnGrid coarse = fakeGridOf(parent, stitched);
    const DrawnGrid fine = fakeGridOf(child, stitched);
    const int quadrant = quadrantOf(child.id);
    const auto slides = [&](Edge edge) { return stitched && !edgeRests(parent, child, edge); };
    double most = 0;
    for (int y = 0; y <= fine.cells; ++y) {
        for (int x = 0; x <= fine.cells; ++x) {
            const double coarseX = 0.5 * (x + quadrant % 2 * fine.cells);
            const double coarseY = 0.5 * (y + quadrant / 2 * fine.cells);
            if ((coarseX < 1 && slides(Edge::West)) || (coarseX > coarse.cells - 1 && slides(Edge::East)) ||
                (coarseY < 1 && slides(Edge::South)) || (coarseY > coarse.cells - 1 && slides(Edge::North)))
                continue;
            const auto before = project(view, pointOn(coarse, coarseX, coarseY));
            const auto after = project(view, pointOn(fine, x, y));
            if (before && after) most = std::max(most, glm::length(*before - *after));
        }
    }
    return most;
}

struct Tally {
    std::size_t splits = 0;
    std::size_t merges = 0;
    std::size_t slid = 0;
    std::size_t waited = 0;
    std::size_t edgesSlid = 0;
    std::size_t edgesJumped = 0;
    double largestJumpPx = 0;
    std::size_t stitchedEdgesAtRest = 0;  // of what switched: their cells were looked at too
};

// Looks at all that differs between two frames.
class FramePair {
public:
    FramePair(const Selection& before, const Selection& now, const View& view, bool stitched)
        : view_(view),
          stitched_(stitched),
          before_(itemsOf(before)),
          now_(itemsOf(now)),
          splitBefore_(splitIds(before)) {}

    void check(Tally& tally) const {
        for (const auto& [id, item] : now_) {
            tally.waited += item.splitWaits;
            if (const auto last = before_.find(id); last != before_.end()) {
                EXPECT_LE(std::abs(item.morph - last->second.morph), fadeStep + rounding) << toString(id);
                tally.slid += item.morph != last->second.morph;
                checkEdges(last->second, item, tally);
            } else if (splitBefore_.contains(id)) {
                checkMerge(item, tally);
            } else if (id.level > 0) {
                checkNew(item, tally);
            }
        }
    }

private:
    void checkEdges(const DrawItem& before, const DrawItem& now, Tally& tally) const {
        for (std::size_t e = 0; !stitched_ && e < edgeCount; ++e) {
            const float moved = std::abs(now.edgeMorph[e] - before.edgeMorph[e]);
            tally.edgesSlid += moved > 0;
            tally.edgesJumped += moved > fadeStep + rounding;
        }
    }

    void checkMerge(const DrawItem& item, Tally& tally) const {
        bool any = false;
        for (int q = 0; q < quadrantCount; ++q) {
            const auto child = before_.find(childOf(item.id, q));
            EXPECT_FALSE(splitBefore_.contains(childOf(item.id, q))) << toString(item.id);
            if (child == before_.end()) continue;  // culled
            any = true;
            EXPECT_EQ(child->second.morph, 1) << toString(item.id);
            jump(item, child->second, tally);
        }
        tally.merges += any;
        if (any) {
            EXPECT_EQ(item.morph, 0) << toString(item.id);
        }
    }

    void checkNew(const DrawItem& item, Tally& tally) const {
        const auto parent = before_.find(parentOf(item.id));
        if (parent != before_.end()) {
            EXPECT_EQ(parent->second.morph, 0) << toString(item.id);
            EXPECT_EQ(item.morph, 1) << toString(item.id);
            jump(parent->second, item, tally);
            ++tally.splits;
            return;
        }
        for (ChunkId above = parentOf(item.id); above.level > 0;) {  // never two levels at once
            above = parentOf(above);
            EXPECT_FALSE(before_.contains(above)) << toString(item.id);
        }
    }

    void jump(const DrawItem& parent, const DrawItem& child, Tally& tally) const {
        const double px = largestJumpPx(view_, parent, child, stitched_);
        EXPECT_LT(px, 1e-3) << toString(child.id);
        for (const Edge edge : allEdges)
            tally.stitchedEdgesAtRest += stitched_ && child.coarserBy[static_cast<std::size_t>(edge)] > 0 &&
                                         edgeRests(parent, child, edge);
        tally.largestJumpPx = std::max(tally.largestJumpPx, px);
    }

    const View& view_;
    bool stitched_;
    ItemsById before_;
    ItemsById now_;
    std::set<ChunkId> splitBefore_;
};

// Every leaf lies in one drawn chunk.
void expectPartition(const Selection& selection) {
    const ItemsById items = itemsOf(selection);
    EXPECT_EQ(items.size(), selection.draw.size());
    double faces = 0;
    for (const auto& [id, item] : items) {
        faces += std::ldexp(1, -2 * id.level);
        for (ChunkId above = id; above.level > 0;) {
            above = parentOf(above);
            ASSERT_FALSE(items.contains(above)) << toString(id);
        }
    }
    EXPECT_EQ(faces, 6);
}

struct FlightCase {
    double tauPx;
    double radiansPerS;
    double hysteresis;
    SeamMode seams;
    ErrorMetric metric;
    bool culling;
};

class LodFadeFlight : public testing::TestWithParam<FlightCase> {
protected:
    LodSettings settings() const {
        LodSettings made = fading(GetParam().tauPx);
        made.hysteresis = GetParam().hysteresis;
        made.seams = GetParam().seams;
        made.metric = GetParam().metric;
        made.frustumCulling = made.horizonCulling = GetParam().culling;
        return made;
    }
};

TEST_P(LodFadeFlight, NoSwitchMovesAnything) {
    LodSettings lod = settings();
    const Flight flight{GetParam().radiansPerS, 1.5};
    Tally tally;
    Selection selection;
    constexpr int frames = 1200;
    for (int frame = 0; frame < frames; ++frame) {
        // In mid flight too.
        if (frame % 200 == 80) lod.tauPx = 3 * GetParam().tauPx;
        if (frame % 200 == 140) lod.tauPx = 0.5 * GetParam().tauPx;
        const View view = flight.at(frame * fadeFrameS);
        const Selection before = selection;
        selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
        if (frame > 0) FramePair(before, selection, view, lod.seams == SeamMode::Stitched).check(tally);
        if (!GetParam().culling && frame % 10 == 0) expectPartition(selection);
        if (HasFailure()) break;
    }
    EXPECT_GT(tally.splits, 100u);
    EXPECT_GT(tally.merges, 20u);
    if (lod.seams == SeamMode::Stitched) {
        EXPECT_GT(tally.stitchedEdgesAtRest, 20u);
    }
    EXPECT_GT(tally.slid, 1000u);
    EXPECT_LE(tally.edgesJumped, tally.edgesSlid / 1000);
    RecordProperty("splits", static_cast<int>(tally.splits));
    RecordProperty("merges", static_cast<int>(tally.merges));
    RecordProperty("largest_jump_px", std::to_string(tally.largestJumpPx));
}

TEST_P(LodFadeFlight, StandingStillEndsInWhatAViewWithoutMemoryShows) {
    const LodSettings lod = settings();
    const Flight flight{GetParam().radiansPerS, 0.3};
    Selection selection;
    for (int frame = 0; frame < 40; ++frame) {
        selectChunks(wholeTree(), flight.at(frame * fadeFrameS), lod, selection, fadeFrameS);
    }
    const View view = flight.at(41 * fadeFrameS);
    for (int frame = 0; frame < 400; ++frame) selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
    EXPECT_EQ(selection.counters.fading, 0u);
    Selection atOnce = selection;
    selectChunks(wholeTree(), view, lod, atOnce);
    EXPECT_TRUE(sameDrawing(selection, atOnce));
    if (lod.hysteresis == 0) {
        Selection without;
        selectChunks(wholeTree(), view, lod, without);
        EXPECT_TRUE(sameDrawing(selection, without));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Flights, LodFadeFlight,
    testing::Values(FlightCase{0.5, 0.5, 0, SeamMode::Skirts, ErrorMetric::Additive, true},
                    FlightCase{0.5, 8, 0.2, SeamMode::Stitched, ErrorMetric::Additive, true},
                    FlightCase{2, 0.5, 0.2, SeamMode::Skirts, ErrorMetric::Tight, true},
                    FlightCase{2, 8, 0, SeamMode::Stitched, ErrorMetric::Additive, true},
                    FlightCase{2, 1, 0, SeamMode::Skirts, ErrorMetric::Additive, false},
                    FlightCase{8, 1, 0, SeamMode::Stitched, ErrorMetric::Tight, false},
                    FlightCase{8, 8, 0.2, SeamMode::Skirts, ErrorMetric::Additive, true},
                    FlightCase{8, 2, 0.5, SeamMode::Stitched, ErrorMetric::Additive, true}));

// The same measure finds pops where there are some.
TEST(LodFade, WithoutAFadeTheSameFlightPops) {
    LodSettings lod = fading(2);
    lod.fadeS = 0;
    const Flight flight{2, 1.5};
    Selection selection;
    double mostPx = 0;
    for (int frame = 0; frame < 300; ++frame) {
        const View view = flight.at(frame * fadeFrameS);
        lod.tauPx = frame % 40 < 20 ? 2 : 6;
        const Selection before = selection;
        selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
        const ItemsById items = itemsOf(before);
        for (const DrawItem& item : selection.draw) {
            if (item.id.level == 0 || !items.contains(parentOf(item.id))) continue;
            mostPx = std::max(mostPx, largestJumpPx(view, items.at(parentOf(item.id)), item, false));
        }
    }
    EXPECT_GT(mostPx, 1);
}

// Every vertex on an edge is one of the chunk's beyond it too, morphs and levels what they may.
void expectNoGaps(const ChunkTree& tree, const Selection& selection, std::size_t& seamVertices) {
    const ItemsById items = itemsOf(selection);
    std::map<ChunkId, DrawnGrid> grids;
    for (const DrawItem& item : selection.draw) {
        grids.emplace(item.id, drawnGrid(tree.shape, item, *tree.nodes[item.node].heights, true));
    }
    const auto edgeOf = [&](const ChunkId& id, Edge edge) {
        const DrawnGrid& grid = grids.at(id);
        std::vector<glm::dvec3> line;
        for (int i = 0; i <= grid.cells; ++i) {
            const int column = edge == Edge::West ? 0 : edge == Edge::East ? grid.cells : i;
            const int row = edge == Edge::South ? 0 : edge == Edge::North ? grid.cells : i;
            line.push_back(grid.positionM[static_cast<std::size_t>(row * (grid.cells + 1) + column)]);
        }
        return line;
    };
    for (const DrawItem& item : selection.draw) {
        for (int e = 0; e < edgeCount; ++e) {
            ChunkId beyond = neighbourOf(item.id, static_cast<Edge>(e));
            while (!items.contains(beyond) && beyond.level > 0) beyond = parentOf(beyond);
            if (!items.contains(beyond)) continue;
            const ChunkId here = ancestorOf(item.id, beyond.level);
            for (int back = 0; back < edgeCount; ++back) {
                if (neighbourOf(beyond, static_cast<Edge>(back)) != here) continue;
                const auto theirs = edgeOf(beyond, static_cast<Edge>(back));
                for (const glm::dvec3& mine : edgeOf(item.id, static_cast<Edge>(e))) {
                    double nearest = 1e300;
                    for (const glm::dvec3& other : theirs) {
                        nearest = std::min(nearest, glm::length(mine - other));
                    }
                    ASSERT_LT(nearest, 1e-6) << toString(item.id) << " beside " << toString(beyond);
                    seamVertices += here != item.id;
                }
            }
        }
    }
}

TEST(LodFade, StitchedEdgesHaveTheSameVerticesOnBothSidesInEveryFrame) {
    std::mt19937 random(44);
    std::uint32_t widest = 0;
    std::size_t seamVertices = 0;
    std::size_t fadingFrames = 0;
    for (int round = 0; round < 4; ++round) {
        const ChunkTree tree = patchyTree(random, 0, 4);  // so that levels differ much
        LodSettings lod = fading(2);
        lod.seams = SeamMode::Stitched;
        lod.frustumCulling = lod.horizonCulling = false;
        const Flight flight{8, 1.7 * round};
        Selection selection;
        for (int frame = 0; frame < 60; ++frame) {
            lod.tauPx = frame % 20 < 10 ? 1 : 8;
            selectChunks(tree, flight.at(frame * fadeFrameS), lod, selection, fadeFrameS);
            if (frame % 4 == 3) expectNoGaps(tree, selection, seamVertices);
            widest = std::max(widest, selection.counters.widestSeam);
            fadingFrames += selection.counters.fading > 0;
        }
    }
    EXPECT_EQ(widest, 3u);  // the most that 16 cells allow
    EXPECT_GT(seamVertices, 10'000u);
    EXPECT_GT(fadingFrames, 100u);
}

std::unique_ptr<Planet> settledOnTwoLevels(const View& view, LodSettings& lod) {
    auto planet = openFake();
    lod = fading(1e-3);
    lod.fadeS = 1;
    lod.frustumCulling = lod.horizonCulling = false;
    for (const int level : {2, 1}) {
        lod.maxLevel = level;
        EXPECT_TRUE(planet->settle(view, lod, noUpload, timeoutS));
        EXPECT_EQ(planet->selection().draw.size(), 6u << (2 * level));
    }
    return planet;
}

TEST(PlanetFade, GoesByTheTimeThatAStepIsGiven) {
    const View view = viewAt(10, 20);
    LodSettings lod = suddenLod();
    const auto planet = settledOnTwoLevels(view, lod);
    lod.maxLevel = 2;
    const ViewInput input{view, lod};
    for (const float morph : {1.0f, 0.75f, 0.5f, 0.25f, 0.0f}) {
        planet->step({&input, 1}, noUpload, 0.25);
        EXPECT_EQ(planet->selection().draw.size(), 96u);
        for (const DrawItem& item : planet->selection().draw) EXPECT_EQ(item.morph, morph);
    }
    EXPECT_EQ(planet->selection().counters.fading, 0u);
}

TEST(PlanetFade, SettlingEndsEveryFade) {
    const View view = viewAt(10, 20);
    LodSettings lod = suddenLod();
    const auto planet = settledOnTwoLevels(view, lod);
    lod.maxLevel = 4;
    lod.tauPx = 0.5;
    const ViewInput input{view, lod};
    planet->step({&input, 1}, noUpload, 0.01);
    EXPECT_GT(planet->selection().counters.fading, 0u);
    EXPECT_TRUE(planet->settle(view, lod, noUpload, timeoutS));
    EXPECT_EQ(planet->selection().counters.fading, 0u);
    EXPECT_EQ(drawn(*planet), drawnOfWhole(view, lod));
    EXPECT_TRUE(std::isfinite(planet->lastStep().nowS));
}

TEST(PlanetFade, WhatASplitWaitsForIsInUse) {
    const View view = viewAt(10, 20);
    LodSettings lod = suddenLod();
    const auto planet = settledOnTwoLevels(view, lod);
    lod.maxLevel = 0;
    EXPECT_TRUE(planet->settle(view, lod, noUpload, timeoutS));
    lod.maxLevel = 2;
    const ViewInput input{view, lod};
    std::size_t waiting = 0;
    for (int frame = 0; frame < 3; ++frame) {
        planet->step({&input, 1}, noUpload, 0.1);
        const ChunkTree& tree = planet->tree();
        for (const DrawItem& item : planet->selection().draw) {
            if (!item.splitWaits) continue;
            ++waiting;
            const ChunkNode& node = tree.nodes[item.node];
            for (NodeIndex q = 0; q < quadrantCount; ++q) {
                EXPECT_EQ(tree.nodes[node.firstChild + q].lastUsedFrame, node.lastUsedFrame);
            }
        }
    }
    EXPECT_EQ(waiting, 3u * 24);
    EXPECT_TRUE(planet->inspect().pendingRequests(PagingType::PageOut).empty());
}

TEST(LodFade, ChildrenThatComeLateSlideInOverTheFade) {
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    LodSettings lod = fading(1e-3);
    Selection selection;
    for (int frame = 0; frame < 60; ++frame) {
        selectChunks(residentTree(fakePyramid(), 1), view, lod, selection, fadeFrameS);
    }
    EXPECT_GT(selection.counters.waiting, 0u);
    const ChunkTree grown = residentTree(fakePyramid(), 2);
    const auto frames = static_cast<int>(std::lround(usualFadeS / fadeFrameS));
    for (int frame = 0; frame <= frames; ++frame) {
        selectChunks(grown, view, lod, selection, fadeFrameS);
        ASSERT_FALSE(selection.draw.empty());
        for (const DrawItem& item : selection.draw) {
            EXPECT_EQ(item.id.level, 2);
            EXPECT_NEAR(item.morph, 1 - static_cast<float>(frame) * fadeStep, 1e-5) << frame;
        }
    }
    EXPECT_EQ(selection.counters.fading, 0u);
    for (const DrawItem& item : selection.draw) EXPECT_EQ(item.morph, 0);
}

TEST(LodFade, WhatIsResidentComesLevelByLevelAndSaysWhatItWaitsFor) {
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    LodSettings lod = fading(1e-3);
    lod.maxLevel = 1;
    Selection selection;
    selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
    lod.maxLevel = 4;
    std::uint32_t deepest = 1;
    int lastChange = 0;
    for (int frame = 1; frame < 80; ++frame) {
        selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
        if (selection.counters.deepestLevel != deepest) {
            EXPECT_EQ(selection.counters.deepestLevel, ++deepest);
            EXPECT_TRUE(deepest == 2 || frame - lastChange >= usualFadeS / fadeFrameS) << frame;
            lastChange = frame;
        }
        for (const DrawItem& item : selection.draw) {
            EXPECT_EQ(item.splitWaits, item.id.level < 4 && item.epsPx > 1e-3f) << toString(item.id);
        }
    }
    EXPECT_EQ(deepest, 4u);
}

TEST(LodFade, WithoutTheirParentBeforeChunksStartAsTheyAre) {
    std::mt19937 random(41);
    const LodSettings lod = fading(3);
    for (int i = 0; i < 30; ++i) {
        const View view = randomView(random, 1e5);
        Selection first;
        selectChunks(wholeTree(), view, lod, first, fadeFrameS);
        Selection without;
        selectChunks(wholeTree(), view, lod, without);
        EXPECT_TRUE(sameDrawing(first, without));
        EXPECT_EQ(first.counters.fading, 0u);
    }
}

TEST(LodFade, ACulledSiblingHoldsNoMergeUp) {
    std::mt19937 random(42);
    std::size_t withCulledSibling = 0;
    for (int i = 0; i < 200; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings lod = fading(2);
        Selection selection;
        selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
        const std::set<ChunkId> splits = splitIds(selection);
        const ItemsById before = itemsOf(selection);
        lod.tauPx = 5;
        for (int frame = 0; frame < 100; ++frame) selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
        EXPECT_EQ(selection.counters.fading, 0u);
        Selection without;
        selectChunks(wholeTree(), view, lod, without);
        ASSERT_TRUE(sameDrawing(selection, without)) << i;
        for (const DrawItem& item : without.draw) {
            if (!splits.contains(item.id)) continue;
            for (int q = 0; q < quadrantCount; ++q) {
                const ChunkId child = childOf(item.id, q);
                withCulledSibling += !before.contains(child) && !splits.contains(child);
            }
        }
    }
    EXPECT_GT(withCulledSibling, 50u);
}

TEST(LodFade, ChildrenThatAreGoneMergeAtOnce) {
    const View view = viewFromPose({}, 1e5, 1, 1280, 720);
    const LodSettings lod = fading(1e-3);
    Selection selection;
    selectChunks(residentTree(fakePyramid(), 2), view, lod, selection, fadeFrameS);
    EXPECT_EQ(selection.counters.deepestLevel, 2u);
    selectChunks(residentTree(fakePyramid(), 1), view, lod, selection, fadeFrameS);
    EXPECT_EQ(selection.counters.deepestLevel, 1u);
    ASSERT_FALSE(selection.draw.empty());
    for (const DrawItem& item : selection.draw) EXPECT_EQ(item.morph, 0);
}

TEST(LodFade, AFadeOfZeroRemembersNothing) {
    LodSettings lod = fading(3);
    lod.fadeS = 0;
    const Flight flight{8, 0};
    Selection selection;
    for (int frame = 0; frame < 60; ++frame) {
        const View view = flight.at(frame * fadeFrameS);
        selectChunks(wholeTree(), view, lod, selection, fadeFrameS);
        Selection without;
        selectChunks(wholeTree(), view, lod, without);
        ASSERT_TRUE(sameDrawing(selection, without));
        EXPECT_EQ(selection.counters.fading, 0u);
    }
}

TEST(LodFade, TheSameFlightGivesTheSameDrawings) {
    const Flight flight{8, 0};
    LodSettings lod = fading(3);
    lod.hysteresis = 0.1;
    Selection one;
    Selection other;
    for (int frame = 0; frame < 60; ++frame) {
        selectChunks(wholeTree(), flight.at(frame * fadeFrameS), lod, one, fadeFrameS);
        selectChunks(wholeTree(), flight.at(frame * fadeFrameS), lod, other, fadeFrameS);
        ASSERT_TRUE(sameDrawing(one, other));
    }
}

TEST(LodFade, ANewMetricIsSelectedByAndDeepensNoSkirtNeedlessly) {
    ChunkTree tree = wholeTree();
    for (ChunkNode& node : tree.nodes) node.deltaTightM = 0.4f * node.deltaCM;
    std::mt19937 random(43);
    for (int i = 0; i < 50; ++i) {
        const View view = randomView(random, 1e5);
        LodSettings additive = suddenLod();
        additive.tauPx = 5;
        LodSettings tight = additive;
        tight.metric = ErrorMetric::Tight;
        tight.tauPx = 0.4 * additive.tauPx;  // as the tight values are 0.4 of the others
        const Selection a = select(tree, view, additive);
        const Selection b = select(tree, view, tight);
        ASSERT_EQ(a.draw.size(), b.draw.size());
        const double floorM = 2 * tree.shape.quantumM;
        for (std::size_t k = 0; k < a.draw.size(); ++k) {
            EXPECT_EQ(a.draw[k].id, b.draw[k].id);
            EXPECT_FLOAT_EQ(b.draw[k].deltaCM, 0.4f * a.draw[k].deltaCM);
            EXPECT_FLOAT_EQ(b.draw[k].epsPx, 0.4f * a.draw[k].epsPx);
            if (b.draw[k].skirtDepthM > 2 * floorM) {
                EXPECT_FLOAT_EQ(b.draw[k].skirtDepthM, 0.4f * a.draw[k].skirtDepthM);
            }
        }
    }
}

}  // namespace
}  // namespace planet
