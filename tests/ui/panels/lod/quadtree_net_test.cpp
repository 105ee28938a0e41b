#include "ui/panels/lod/quadtree_net.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "app/scene/overlay_colours.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/sudden_lod.h"

namespace worldy::ui {
namespace {

using planet::ChunkId;
using planet::ChunkState;
using planet::Face;
using planet::NodeIndex;

constexpr Rect area{10, 20, 800, 600};

planet::View viewOfTheMeridian(double altitudeM) {
    return planet::viewFromPose({0, 0, altitudeM, 0, -90}, planet::fakePyramid().shape.radiusM, 1.0, 1600,
                                900);
}

struct Fixture {
    planet::ChunkTree tree = planet::residentTree(planet::fakePyramid(), 4);
    planet::View view = viewOfTheMeridian(5e4);
    planet::Selection selection;

    explicit Fixture(double tauPx = 20) { selectChunks(tree, view, {.tauPx = tauPx}, selection); }

    NetData data() const {
        return {.tree = tree,
                .visited = visitedStates(tree, selection),
                .loading = {},
                .eyeM = view.eyeM,
                .screenScalePx = screenScalePx(view),
                .tauPx = 20,
                .nowS = 0};
    }
};

std::optional<ChunkId> chunkOnNet(const NetPoint& point, int level) {
    const auto place = facePointOnNet(point);
    if (!place) return std::nullopt;
    return chunkAt(*place, level);
}

TEST(QuadtreeNet, NeighboursAcrossEveryDrawnEdgeAreNeighboursOnTheCube) {
    constexpr int level = 3;
    constexpr double step = 1.0 / 8;
    int acrossFaces = 0;
    for (double y = step / 2; y < netRows; y += step) {
        for (double x = step / 2; x < netColumns; x += step) {
            const auto here = chunkOnNet({x, y}, level);
            const auto right = chunkOnNet({x + step, y}, level);
            const auto below = chunkOnNet({x, y + step}, level);
            if (here && right) {
                EXPECT_EQ(neighbourOf(*here, planet::Edge::East), *right) << toString(*here);
                acrossFaces += here->face != right->face;
            }
            if (here && below) {
                EXPECT_EQ(neighbourOf(*here, planet::Edge::South), *below) << toString(*here);
                acrossFaces += here->face != below->face;
            }
        }
    }
    EXPECT_EQ(acrossFaces, 5 * 8);  // a tree of six faces has five edges
}

TEST(QuadtreeNet, EveryFaceHasItsOwnCellAndPointsReturn) {
    std::set<std::pair<int, int>> taken;
    for (const Face face : planet::allFaces) {
        for (const double u : {-0.9, 0.1, 0.7}) {
            for (const double v : {-0.8, 0.2, 0.9}) {
                const NetPoint point = netPoint({face, u, v});
                taken.emplace(static_cast<int>(point.x), static_cast<int>(point.y));
                const auto back = facePointOnNet(point);
                ASSERT_TRUE(back);
                EXPECT_EQ(back->face, face);
                EXPECT_NEAR(back->u, u, 1e-12);
                EXPECT_NEAR(back->v, v, 1e-12);
            }
        }
    }
    EXPECT_EQ(taken.size(), 6u);
    EXPECT_FALSE(facePointOnNet({0.5, 0.5}));
    EXPECT_FALSE(facePointOnNet({-0.1, 1.5}));
    EXPECT_FALSE(facePointOnNet({2.5, 2.5}));
}

TEST(QuadtreeNet, ChunksLieWhereTheirMiddlesDo) {
    for (const ChunkId id :
         {ChunkId{Face::PosZ, 3, 5, 2}, ChunkId{Face::NegY, 1, 0, 1}, ChunkId{Face::NegX, 0, 0, 0}}) {
        const NetSquare square = netSquare(id);
        EXPECT_EQ(chunkOnNet({square.x + square.side / 2, square.y + square.side / 2}, id.level), id);
        const planet::FaceSquare place = faceSquareOf(id);
        const NetPoint middle = netPoint({id.face, place.u + place.side / 2, place.v + place.side / 2});
        EXPECT_DOUBLE_EQ(square.x + square.side / 2, middle.x);
        EXPECT_DOUBLE_EQ(square.y + square.side / 2, middle.y);
    }
}

TEST(QuadtreeNet, AllOfItFitsAtZoomOne) {
    const NetPlacement placement = placementOf(netSize, {}, area);
    const NetPoint low = onScreen(placement, {0, 0});
    const NetPoint high = onScreen(placement, {netColumns, netRows});
    EXPECT_GE(low.x, 10);
    EXPECT_GE(low.y, 20);
    EXPECT_LE(high.x, 810);
    EXPECT_LE(high.y, 620);
}

TEST(QuadtreeNet, ZoomKeepsWhatIsUnderThePointer) {
    const NetFocus start{4, 0.4, 0.6};
    const NetPoint before = onPlan(placementOf(netSize, start, area), 300, 250);
    const NetFocus zoomed = zoomedAbout(netSize, start, area, 300, 250, 8);
    const NetPoint after = onPlan(placementOf(netSize, zoomed, area), 300, 250);
    EXPECT_DOUBLE_EQ(zoomed.zoom, 32);
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);
}

TEST(QuadtreeNet, ZoomAndPanStayWithinTheNet) {
    EXPECT_DOUBLE_EQ(zoomedAbout(netSize, {1, 0.5, 0.5}, area, 300, 250, 0.1).zoom, 1);
    EXPECT_DOUBLE_EQ(zoomedAbout(netSize, {planZoomMax, 0.5, 0.5}, area, 300, 250, 9).zoom, planZoomMax);
    EXPECT_DOUBLE_EQ(movedBy(netSize, {2, 0.5, 0.5}, area, 1e6, -1e6).centreX, 0);
    EXPECT_DOUBLE_EQ(movedBy(netSize, {2, 0.5, 0.5}, area, 1e6, -1e6).centreY, 1);
}

TEST(QuadtreeNet, ACentredChunkIsInTheMiddleAndLargeEnough) {
    const ChunkId id{Face::NegZ, 9, 300, 17};
    const NetFocus focus = centredOn({}, area, id, 40);
    const NetSquare square = netSquare(id);
    const NetPlacement placement = placementOf(netSize, focus, area);
    const NetPoint middle = onScreen(placement, {square.x + square.side / 2, square.y + square.side / 2});
    EXPECT_NEAR(middle.x, 410, 1e-6);
    EXPECT_NEAR(middle.y, 320, 1e-6);
    EXPECT_NEAR(square.side * placement.scalePx, 40, 1e-6);
}

TEST(QuadtreeNet, StatesAreThoseOfTheSelection) {
    const Fixture fixture(4);
    const NetData data = fixture.data();
    std::map<ChunkState, std::size_t> counts;
    for (const ChunkState state : data.visited) ++counts[state];
    EXPECT_EQ(counts[ChunkState::Drawn], fixture.selection.draw.size());
    EXPECT_EQ(counts[ChunkState::CulledHorizon], fixture.selection.counters.culledHorizon);
    EXPECT_EQ(counts[ChunkState::CulledFrustum], fixture.selection.counters.culledFrustum);
    EXPECT_GT(counts[ChunkState::Split], 0u);
    EXPECT_GT(counts[ChunkState::CulledHorizon], 0u);
    for (const planet::DrawItem& item : fixture.selection.draw) {
        EXPECT_EQ(data.visited[item.node], ChunkState::Drawn);
    }
}

TEST(QuadtreeNet, WhatLiesBelowACulledChunkIsCulledAndBelowADrawnOneResident) {
    EXPECT_EQ(stateBelow(ChunkState::CulledHorizon, ChunkState::NotResident), ChunkState::CulledHorizon);
    EXPECT_EQ(stateBelow(ChunkState::Drawn, ChunkState::NotResident), ChunkState::Resident);
    EXPECT_EQ(stateBelow(ChunkState::Split, ChunkState::Drawn), ChunkState::Drawn);
}

TEST(QuadtreeNet, MissingChildrenAreRequestedLoadingOrFailedAsTheirParentSays) {
    planet::ChunkNode node;
    node.id = {Face::PosY, 2, 1, 1};
    const std::vector<ChunkId> loading{node.id};
    node.childrenState = planet::ChildrenState::Requested;
    EXPECT_EQ(missingChildrenState(node, {}), ChunkState::Requested);
    EXPECT_EQ(missingChildrenState(node, loading), ChunkState::Loading);
    node.childrenState = planet::ChildrenState::Absent;
    EXPECT_EQ(missingChildrenState(node, {}), ChunkState::NotResident);
    node.childrenState = planet::ChildrenState::Failed;
    EXPECT_EQ(missingChildrenState(node, loading), ChunkState::Failed);
    node.childrenState = planet::ChildrenState::AwaitingRetry;
    EXPECT_EQ(missingChildrenState(node, loading), ChunkState::Failed);
    node.childrenState = planet::ChildrenState::None;
    EXPECT_EQ(missingChildrenState(node, {}), ChunkState::NotInFile);
}

std::uint32_t colourOf(ChunkState state) {
    const glm::vec3 c = stateColour(state);
    const auto channel = [](float value) { return static_cast<std::uint32_t>(std::lround(value * 255)); };
    return 0xFF000000u | (channel(c.z) << 16) | (channel(c.y) << 8) | channel(c.x);
}

// Of the last rectangle over a point: what is seen there.
std::optional<std::uint32_t> seenAt(const std::vector<NetRect>& rects, double x, double y) {
    std::optional<std::uint32_t> seen;
    for (const NetRect& rect : rects) {
        if (static_cast<double>(rect.x0) <= x && x < static_cast<double>(rect.x1) &&
            static_cast<double>(rect.y0) <= y && y < static_cast<double>(rect.y1)) {
            seen = rect.colour;
        }
    }
    return seen;
}

TEST(QuadtreeNet, WhatIsSeenAtAChunkIsItsStateAndThePointerFindsIt) {
    const Fixture fixture(4);
    const NetData data = fixture.data();
    const NetPlacement placement = placementOf(netSize, {}, area);
    std::vector<NetRect> rects;
    fillNetRects(data, placement, area, {}, rects);
    std::size_t compared = 0;
    for (NodeIndex i = 0; i < fixture.tree.nodes.size(); ++i) {
        const planet::ChunkNode& node = fixture.tree.nodes[i];
        if (node.childrenState != planet::ChildrenState::None &&
            node.childrenState != planet::ChildrenState::Absent) {
            continue;
        }
        const NetSquare square = netSquare(node.id);
        // Beside the frame of a drawn chunk above it.
        const NetPoint at =
            onScreen(placement, {square.x + 0.45 * square.side, square.y + 0.55 * square.side});
        const auto hit = netHit(data, placement, at.x, at.y);
        ASSERT_TRUE(hit) << toString(node.id);
        EXPECT_EQ(seenAt(rects, at.x, at.y), colourOf(hit->state)) << toString(node.id);
        compared += hit->id == node.id;
    }
    EXPECT_GT(compared, 1000u);
    EXPECT_FALSE(netHit(data, placement, 15, 25));
}

TEST(QuadtreeNet, ADrawnChunkFramesItsResidentChildren) {
    const Fixture fixture(1000);  // so coarse that roots are drawn
    const NetData data = fixture.data();
    ASSERT_EQ(data.visited[0], ChunkState::Drawn);
    const NetPlacement placement = placementOf(netSize, {}, area);
    const NetPoint corner = onScreen(placement, {1, 1});
    const auto onFrame = netHit(data, placement, corner.x + 1.5, corner.y + 50);
    const auto inside = netHit(data, placement, corner.x + 20, corner.y + 50);
    ASSERT_TRUE(onFrame && inside);
    EXPECT_EQ(onFrame->id, (ChunkId{Face::PosX, 0, 0, 0}));
    EXPECT_EQ(onFrame->state, ChunkState::Drawn);
    EXPECT_GT(inside->id.level, 0);
    EXPECT_EQ(inside->state, ChunkState::Resident);
    std::vector<NetRect> rects;
    fillNetRects(data, placement, area, {}, rects);
    EXPECT_EQ(seenAt(rects, corner.x + 1.5, corner.y + 50), colourOf(ChunkState::Drawn));
    EXPECT_EQ(seenAt(rects, corner.x + 20, corner.y + 50), colourOf(ChunkState::Resident));
}

TEST(QuadtreeNet, MissingChildrenAreMarkedInsideTheirQuarters) {
    Fixture fixture;
    fixture.tree = planet::residentTree(planet::fakePyramid(), 1);
    fixture.tree.nodes[6].childrenState = planet::ChildrenState::Requested;
    selectChunks(fixture.tree, fixture.view, {.tauPx = 20}, fixture.selection);
    const NetData data = fixture.data();
    const NetPlacement placement = placementOf(netSize, {}, area);
    const ChunkId child = childOf(fixture.tree.nodes[6].id, 2);
    const NetSquare square = netSquare(child);
    const NetPoint middle = onScreen(placement, {square.x + square.side / 2, square.y + square.side / 2});
    const NetPoint edge = onScreen(placement, {square.x + square.side * 0.1, square.y + square.side * 0.1});
    const auto hit = netHit(data, placement, middle.x, middle.y);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->id, child);
    EXPECT_EQ(hit->node, planet::noNode);
    EXPECT_EQ(hit->state, ChunkState::Requested);
    EXPECT_EQ(netHit(data, placement, edge.x, edge.y)->id, parentOf(child));
    std::vector<NetRect> rects;
    fillNetRects(data, placement, area, {}, rects);
    EXPECT_EQ(seenAt(rects, middle.x, middle.y), colourOf(ChunkState::Requested));
}

TEST(QuadtreeNet, OnlyWhatIsInTheAreaAndLargeEnoughIsDrawn) {
    const Fixture fixture;
    std::vector<NetRect> rects;
    // 800 pixels hold 4 faces of about 190: all 6 * 256 leaves.
    fillNetRects(fixture.data(), placementOf(netSize, {}, area), area, {}, rects);
    EXPECT_GE(rects.size(), 6u * 256);
    // As small as a stamp, faces stand for what is below them.
    const Rect stamp{0, 0, 24, 20};
    fillNetRects(fixture.data(), placementOf(netSize, {}, stamp), stamp, {}, rects);
    EXPECT_LE(rects.size(), 6u);
    // Close up there is nothing but what is near.
    const NetFocus close = centredOn({}, area, {Face::PosX, 4, 5, 5}, 400);
    fillNetRects(fixture.data(), placementOf(netSize, close, area), area, {}, rects);
    EXPECT_GT(rects.size(), 0u);
    EXPECT_LE(rects.size(), 40u);
    for (const NetRect& rect : rects) {
        EXPECT_LT(rect.x0, 810);
        EXPECT_GT(rect.x1, 10);
    }
}

TEST(QuadtreeNet, WhatIsNotDrawnIsDimmerUnlessStatesAreShown) {
    const Fixture fixture(4);
    const NetData data = fixture.data();
    const NetPlacement placement = placementOf(netSize, {}, area);
    for (const NetColour by :
         {NetColour::Level, NetColour::Error, NetColour::DeltaC, NetColour::Age, NetColour::Tight}) {
        std::vector<NetRect> rects;
        fillNetRects(data, placement, area, {.by = by}, rects);
        const NetPoint behind = onScreen(placement, {3.47, 1.52});  // the far side
        const auto seen = seenAt(rects, behind.x, behind.y);
        ASSERT_TRUE(seen);
        EXPECT_LT(*seen & 0xFFu, 110u);
        EXPECT_LT((*seen >> 8) & 0xFFu, 110u);
    }
}

TEST(QuadtreeNet, LinesNeverCrossWhatTheNetHasCutOpen) {
    std::vector<glm::dvec3> meridian;
    for (int i = 0; i <= 72; ++i) {
        const double angle = i * 5.0 / 180 * 3.14159265358979;
        meridian.emplace_back(std::cos(angle) * 0.8, std::cos(angle) * 0.6, std::sin(angle));
    }
    const auto segments = netLine(meridian);
    double length = 0;
    for (const NetSegment& segment : segments) {
        const double piece = std::hypot(segment.from.x - segment.to.x, segment.from.y - segment.to.y);
        EXPECT_LE(piece, 0.03 + 1e-9);
        length += piece;
    }
    // Once about a cube is four faces and more, off the middle less through the poles.
    EXPECT_GT(length, 3.5);
    EXPECT_LT(length, 7);
}

TEST(QuadtreeNet, AFootprintLooksWhereTheCameraLooks) {
    const double radiusM = 1e5;
    const auto near =
        footprintOf(planet::viewFromPose({30, 40, 1000, 0, -90}, radiusM, 1.0, 1600, 900), radiusM);
    ASSERT_FALSE(near.empty());
    EXPECT_EQ(near.front(), near.back());
    const glm::dvec3 below =
        planet::directionFromGeographic({30.0 / 180 * 3.14159265358979, 40.0 / 180 * 3.14159265358979});
    for (const glm::dvec3& direction : near) {
        EXPECT_NEAR(glm::length(direction), 1, 1e-9);
        EXPECT_GT(glm::dot(direction, below), 0.9999);  // about 1 km about the point below, of 100
    }
    // The whole planet in view: its horizon.
    const auto far =
        footprintOf(planet::viewFromPose({30, 40, 1e6, 0, -90}, radiusM, 1.0, 1600, 900), radiusM);
    ASSERT_FALSE(far.empty());
    for (const glm::dvec3& direction : far) EXPECT_NEAR(glm::dot(direction, below), 1e5 / 1.1e6, 1e-9);
    // Up at the sky: nothing.
    EXPECT_TRUE(
        footprintOf(planet::viewFromPose({30, 40, 1e6, 0, 90}, radiusM, 1.0, 1600, 900), radiusM).empty());
}

TEST(QuadtreeNet, TheTreeListOpensTheWayToAChunk) {
    const Fixture fixture;
    const NetData data = fixture.data();
    EXPECT_EQ(treeRows(data, {}).size(), 6u);
    OpenChunks open;
    const ChunkId id{Face::PosZ, 3, 5, 2};
    openWayTo(id, open);
    const auto rows = treeRows(data, open);
    EXPECT_EQ(rows.size(), 6u + 3 * 4);
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const TreeRow& row) { return row.id == id; });
    ASSERT_NE(found, rows.end());
    EXPECT_EQ(found->node, findNode(fixture.tree, id));
    EXPECT_TRUE(found->canOpen);
    EXPECT_FALSE(found->open);
}

TEST(QuadtreeNet, TheTreeListNamesChildrenThatAreMissing) {
    Fixture fixture;
    fixture.tree = planet::residentTree(planet::fakePyramid(), 0);
    fixture.tree.nodes[0].childrenState = planet::ChildrenState::Failed;
    selectChunks(fixture.tree, fixture.view, planet::suddenLod(), fixture.selection);
    const auto rows = treeRows(fixture.data(), {fixture.tree.nodes[0].id});
    ASSERT_EQ(rows.size(), 10u);
    EXPECT_EQ(rows[1].id, (ChunkId{Face::PosX, 1, 0, 0}));
    EXPECT_EQ(rows[1].node, planet::noNode);
    EXPECT_EQ(rows[1].state, ChunkState::Failed);
    EXPECT_FALSE(rows[1].canOpen);
}

TEST(QuadtreeNet, TheTreeListSortsTheRootsAndTheChildrenOfEachChunk) {
    const Fixture fixture;
    const NetData data = fixture.data();
    const OpenChunks open = {{Face::PosZ, 0, 0, 0}};
    const TableSort byEps{static_cast<std::size_t>(TreeColumn::Eps), true};
    const auto rows = treeRows(data, open, byEps);
    ASSERT_EQ(rows.size(), 10u);
    std::vector<TreeRow> roots;
    std::vector<TreeRow> children;
    for (const TreeRow& row : rows) (row.id.level == 0 ? roots : children).push_back(row);
    const auto isLarger = [](const TreeRow& a, const TreeRow& b) { return a.epsPx > b.epsPx; };
    EXPECT_TRUE(std::is_sorted(roots.begin(), roots.end(), isLarger));
    EXPECT_TRUE(std::is_sorted(children.begin(), children.end(), isLarger));
    EXPECT_GT(roots.front().epsPx, roots.back().epsPx);
    const auto parent = std::find_if(rows.begin(), rows.end(), [](const TreeRow& row) { return row.open; });
    ASSERT_LT(parent, rows.end() - 4);
    for (auto child = parent + 1; child != parent + 5; ++child) EXPECT_EQ(parentOf(child->id), parent->id);

    const TableSort byChunk{static_cast<std::size_t>(TreeColumn::Chunk), true};
    EXPECT_EQ(treeRows(data, open, byChunk).front().id, (ChunkId{Face::NegZ, 0, 0, 0}));
}

TEST(QuadtreeNet, ErrorsAreThoseOfTheSelection) {
    const Fixture fixture(4);
    const NetData data = fixture.data();
    ASSERT_FALSE(fixture.selection.draw.empty());
    for (const planet::DrawItem& item : fixture.selection.draw) {
        EXPECT_NEAR(epsPxOf(data, fixture.tree.nodes[item.node]), static_cast<double>(item.epsPx),
                    1e-4 * static_cast<double>(item.epsPx) + 1e-9);
    }
}

}  // namespace
}  // namespace worldy::ui
