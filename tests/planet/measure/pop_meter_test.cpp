// The pop meter against planted jumps of known size, and against what must read zero.
#include "planet/measure/pop_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <random>

#include "planet/select/drawn_surface.h"
#include "planet/select/screen_error.h"
#include "planet/sphere/cube_sphere.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

constexpr double popFrameS = 1.0 / 60;

DrawItem itemOf(const ChunkTree& tree, const ChunkId& id, float morph = 0) {
    DrawItem item;
    item.node = findNode(tree, id);
    item.id = id;
    item.slot = tree.nodes[item.node].slot;
    item.morph = morph;
    item.edgeMorph.fill(morph);
    return item;
}

Selection drawing(std::vector<DrawItem> items) {
    Selection selection;
    selection.draw = std::move(items);
    return selection;
}

Selection drawingChildren(const ChunkTree& tree, const ChunkId& parent, const std::array<float, 4>& morphs) {
    Selection selection;
    for (int q = 0; q < quadrantCount; ++q)
        selection.draw.push_back(itemOf(tree, childOf(parent, q), morphs[static_cast<std::size_t>(q)]));
    return selection;
}

// The largest distance between a child's vertex and the middle of what replaces it in the parent.
double ownErrorM(const ChunkId& parent) {
    float below = 0;
    for (int q = 0; q < quadrantCount; ++q)
        below = std::max(below, fakePyramid().at(childOf(parent, q)).deltaCM);
    return static_cast<double>(fakePyramid().at(parent).deltaCM - below);
}

constexpr double farAwayM = 1e7;

// From so far beside a chunk that all of it is equally far, heights standing upright in the picture.
View fromBeside(const ChunkId& id) {
    const PlanetShape& shape = fakePyramid().shape;
    const glm::dvec3 middle = vertexM(shape, fakePyramid().at(id), 8, 8);
    View view;
    view.up = glm::normalize(middle);
    view.right = glm::normalize(glm::cross(view.up, glm::dvec3(0.3, 0.2, 0.9)));
    view.back = glm::cross(view.right, view.up);
    view.eyeM = middle + farAwayM * view.back;
    view.horizontalFovRad = 0.006;
    return view;
}

const ChunkId mountain{Face::PosX, 2, 1, 2};

TEST(PopMeter, ASwitchWithoutMorphJumpsByTheParentsOwnError) {
    const View view = fromBeside(mountain);
    const double expectedPx = ownErrorM(mountain) * screenScalePx(view) / farAwayM;
    ASSERT_GT(expectedPx, 0.5);
    const Selection coarse = drawing({itemOf(wholeTree(), mountain)});
    const Selection fine = drawingChildren(wholeTree(), mountain, {0, 0, 0, 0});
    PopMeter meter;
    meter.add(wholeTree(), coarse, view, {}, 0);
    meter.add(wholeTree(), fine, view, {}, popFrameS);
    meter.add(wholeTree(), coarse, view, {}, 2 * popFrameS);
    ASSERT_EQ(meter.events().size(), 2u);
    for (const PopEvent& event : meter.events()) {
        EXPECT_EQ(event.chunk, mountain);
        EXPECT_EQ(event.cause, PopCause::CameraMoved);
        EXPECT_NEAR(event.jump.largestPx, expectedPx, 0.02 * expectedPx);
        EXPECT_NEAR(event.jump.largestFacingPx, expectedPx, 0.02 * expectedPx);
        EXPECT_GT(event.jump.meanPx, 0);
        EXPECT_LT(event.jump.meanPx, event.jump.largestPx);
        EXPECT_EQ(parentOf(event.jump.worstChunk), mountain);
        EXPECT_EQ(event.jump.places, 4u * 17 * 17);
    }
    EXPECT_EQ(meter.events()[0].fromLevel, 2);
    EXPECT_EQ(meter.events()[0].toLevel, 3);
    EXPECT_EQ(meter.events()[1].fromLevel, 3);
    EXPECT_EQ(meter.events()[1].toLevel, 2);
    EXPECT_EQ(meter.events()[1].before.size(), 4u);
    EXPECT_EQ(meter.events()[1].after.size(), 1u);
    EXPECT_NEAR(meter.percentilePx(0.99), expectedPx, 0.02 * expectedPx);
}

TEST(PopMeter, FullyMorphedChildrenGiveWayWithoutAJump) {
    const View view = fromBeside(mountain);
    PopMeter meter;
    meter.add(wholeTree(), drawingChildren(wholeTree(), mountain, {1, 1, 1, 1}), view, {}, 0);
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain)}), view, {}, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    EXPECT_GT(meter.events()[0].jump.places, 0u);
    EXPECT_LT(meter.events()[0].jump.largestPx, 0.001);
    EXPECT_EQ(meter.totals().outsidePicture, 0u);
}

TEST(PopMeter, AChunkThatDoesNotMorphIsFoundAmongThoseThatDo) {
    const View view = fromBeside(mountain);
    const PlanetShape& shape = fakePyramid().shape;
    for (int faulty = 0; faulty < quadrantCount; ++faulty) {
        std::array<float, 4> morphs{1, 1, 1, 1};
        morphs[static_cast<std::size_t>(faulty)] = 0;
        const ChunkData& chunk = fakePyramid().at(childOf(mountain, faulty));
        double errorM = 0;
        for (int row = 0; row <= 16; ++row) {
            for (int column = 0; column <= 16; ++column) {
                const int x = column & 1;
                const int y = row & 1;
                if (x == 0 && y == 0) continue;
                const glm::dvec3 middle = 0.5 * (vertexM(shape, chunk, column - x, row - y) +
                                                 vertexM(shape, chunk, column + x, row + y));
                errorM = std::max(errorM, glm::length(middle - vertexM(shape, chunk, column, row)));
            }
        }
        const double expectedPx = errorM * screenScalePx(view) / farAwayM;
        ASSERT_GT(expectedPx, 0.1);
        PopMeter meter;
        meter.add(wholeTree(), drawingChildren(wholeTree(), mountain, morphs), view, {}, 0);
        meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain)}), view, {}, popFrameS);
        ASSERT_EQ(meter.events().size(), 1u);
        EXPECT_EQ(meter.events()[0].jump.worstChunk, chunk.id);
        EXPECT_NEAR(meter.events()[0].jump.largestPx, expectedPx, 0.02 * expectedPx);
    }
}

TEST(PopMeter, AJumpOverTwoLevelsIsOneEventForItsPlace) {
    const View view = fromBeside(mountain);
    Selection fine = drawingChildren(wholeTree(), mountain, {0, 0, 0, 0});
    const ChunkId split = childOf(mountain, 2);
    fine.draw.erase(fine.draw.begin() + 2);
    for (int q = 0; q < quadrantCount; ++q) fine.draw.push_back(itemOf(wholeTree(), childOf(split, q)));
    PopMeter meter;
    meter.add(wholeTree(), fine, view, {}, 0);
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain)}), view, {}, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    EXPECT_EQ(meter.events()[0].fromLevel, 4);
    EXPECT_EQ(meter.events()[0].toLevel, 2);
    EXPECT_EQ(meter.events()[0].before.size(), 7u);
    EXPECT_EQ(meter.totals().cameIntoView, 0u);
    EXPECT_EQ(meter.totals().wentOutOfView, 0u);
}

// With stitched edges and any morph, no place of the two surfaces jumps farther than is reported.
TEST(PopMeter, NoPlaceJumpsFartherThanTheLargest) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0, 1);
    std::uniform_int_distribution<int> coarserBy(0, 2);
    const PlanetShape& shape = fakePyramid().shape;
    const View view = fromBeside(mountain);
    const auto shuffled = [&](const ChunkId& id) {
        DrawItem item = itemOf(wholeTree(), id, share(random));
        for (std::size_t e = 0; e < edgeCount; ++e) {
            item.coarserBy[e] = static_cast<std::uint8_t>(coarserBy(random));
            item.edgeMorph[e] = share(random);
        }
        return DrawnChunk{item, wholeTree().nodes[item.node].heights, true};
    };
    for (int round = 0; round < 20; ++round) {
        const DrawnChunk coarse = shuffled(mountain);
        const DrawnChunk fine = shuffled(childOf(mountain, round % 4));
        const SurfaceJump jump = surfaceJump(shape, coarse, {&fine, 1}, round % 2 == 0, view);
        const DrawnGrid coarseGrid = drawnGrid(shape, coarse.item, *coarse.heights, true);
        const DrawnGrid fineGrid = drawnGrid(shape, fine.item, *fine.heights, true);
        double largestM = 0;
        for (int i = 0; i < 15000; ++i) {
            const double x = 16 * static_cast<double>(share(random));
            const double y = 16 * static_cast<double>(share(random));
            const glm::dvec3 coarsePoint =
                pointOn(coarseGrid, (x + 16 * (round % 2)) / 2, (y + 16 * (round % 4 / 2)) / 2);
            const glm::dvec3 apart = pointOn(fineGrid, x, y) - coarsePoint;
            largestM = std::max(largestM, glm::length(apart - glm::dot(apart, view.back) * view.back));
        }
        const double sampledPx = largestM * screenScalePx(view) / farAwayM;
        EXPECT_LE(sampledPx, 1.01 * jump.largestPx);
        EXPECT_GE(sampledPx, 0.6 * jump.largestPx);
    }
}

// A spike in the second row stands still while the edge's odd vertices are drawn away under it, along a level
// edge: only the triangles between them change, by half of its height in the middle of one's longest side.
TEST(PopMeter, AStitchedEdgeThatIsCutAgainIsSeenBetweenItsVertices) {
    const PlanetShape& shape = fakePyramid().shape;
    DrawItem item;
    item.id = {Face::PosX, 9, 200, 300};
    std::vector<std::int16_t> steps(17 * 17, 0);
    steps[17 + 3] = 30'000;
    const auto heights = std::make_shared<const Steps>(steps);
    DrawItem gathered = item;
    gathered.edgeMorph[static_cast<std::size_t>(Edge::South)] = 1;
    View view = fromBeside(mountain);
    const DrawnGrid ground = drawnGrid(shape, item, *heights, false);
    const double spikeM = heightM(shape, 30'000) - heightM(shape, 0);
    view.up = glm::normalize(ground.positionM[3]);
    view.right = glm::normalize(glm::cross(view.up, glm::dvec3(0.3, 0.2, 0.9)));
    view.back = glm::cross(view.right, view.up);
    view.eyeM = ground.positionM[3] + farAwayM * view.back;
    const double expectedPx = 0.5 * spikeM * screenScalePx(view) / farAwayM;
    ASSERT_GT(expectedPx, 0.5);
    const SurfaceJump atEdge =
        edgeJump(shape, {item, heights, true}, {gathered, heights, true}, Edge::South, view);
    EXPECT_NEAR(atEdge.largestPx, expectedPx, 0.01 * expectedPx);
    EXPECT_LT(
        edgeJump(shape, {item, heights, false}, {gathered, heights, false}, Edge::South, view).largestPx,
        0.01 * expectedPx);
}

TEST(PopMeter, WhatLiesOutsideThePictureIsNotMeasured) {
    View view = fromBeside(mountain);
    view.back = -view.back;
    view.right = -view.right;
    PopMeter meter;
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain)}), view, {}, 0);
    meter.add(wholeTree(), drawingChildren(wholeTree(), mountain, {0, 0, 0, 0}), view, {}, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    EXPECT_EQ(meter.events()[0].jump.places, 0u);
    EXPECT_EQ(meter.totals().outsidePicture, 1u);
    EXPECT_EQ(meter.percentilePx(0.99), 0);
}

TEST(PopMeter, WhatComesIntoViewOrGoesOutIsNoSwitch) {
    const View view = fromBeside(mountain);
    const ChunkId other{Face::NegZ, 1, 0, 1};
    PopMeter meter;
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain)}), view, {}, 0);
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), other)}), view, {}, popFrameS);
    EXPECT_TRUE(meter.events().empty());
    EXPECT_EQ(meter.totals().cameIntoView, 1u);
    EXPECT_EQ(meter.totals().wentOutOfView, 1u);
}

// An edge of an unchanged chunk that follows its neighbour jumps with it.
TEST(PopMeter, AnEdgeBesideASwitchCountsToIt) {
    const View view = fromBeside(mountain);
    const ChunkId beside = neighbourOf(mountain, Edge::East);
    DrawItem edge = itemOf(wholeTree(), beside);
    PopMeter meter;
    Selection before = drawingChildren(wholeTree(), mountain, {1, 1, 1, 1});
    before.draw.push_back(edge);
    meter.add(wholeTree(), before, view, {}, 0);
    edge.edgeMorph[static_cast<std::size_t>(Edge::West)] = 1;
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain), edge}), view, {}, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    const PlanetShape& shape = fakePyramid().shape;
    const ChunkData& chunk = fakePyramid().at(beside);
    double errorM = 0;
    for (int row = 1; row <= 16; row += 2) {
        const glm::dvec3 middle =
            0.5 * (vertexM(shape, chunk, 0, row - 1) + vertexM(shape, chunk, 0, row + 1));
        errorM = std::max(errorM, glm::length(middle - vertexM(shape, chunk, 0, row)));
    }
    const double expectedPx = errorM * screenScalePx(view) / farAwayM;
    ASSERT_GT(expectedPx, 0.1);
    EXPECT_LT(meter.events()[0].jump.largestPx, 0.001);
    EXPECT_NEAR(meter.events()[0].besidePx, expectedPx, 0.02 * expectedPx);
}

// Causes.

LodSettings tauOf(double tauPx) {
    LodSettings settings = suddenLod();
    settings.tauPx = tauPx;
    return settings;
}

void addSelected(PopMeter& meter, const ChunkTree& tree, const View& view, const LodSettings& settings,
                 double timeS) {
    const Selection selection = select(tree, view, settings);
    meter.add(tree, selection, view, settings, timeS);
}

std::size_t countOf(const PopMeter& meter, PopCause cause) {
    return meter.totals().byCause[static_cast<std::size_t>(cause)];
}

TEST(PopMeter, AStillCameraSwitchesNothing) {
    PopMeter meter;
    LodSettings settings = tauOf(1);
    settings.morph = true;
    for (int i = 0; i < 20; ++i) addSelected(meter, wholeTree(), viewAt(30, 20), settings, i * popFrameS);
    EXPECT_TRUE(meter.events().empty());
    EXPECT_TRUE(meter.late().empty());
    EXPECT_EQ(meter.totals().cameIntoView, 0u);
    EXPECT_EQ(meter.totals().measuringS, 0);
}

TEST(PopMeter, AnotherToleranceIsTheSettings) {
    PopMeter meter;
    addSelected(meter, wholeTree(), viewAt(30, 20), tauOf(30), 0);
    addSelected(meter, wholeTree(), viewAt(30, 20), tauOf(2), popFrameS);
    EXPECT_GT(meter.totals().switches, 2u);
    EXPECT_EQ(countOf(meter, PopCause::SettingsChanged), meter.totals().switches);
}

// Frames of a selection that remembers the one before, as the window draws them.
struct FadingFrames {
    PopMeter meter{};
    Selection selection{};
    double timeS = 0;

    void add(const ChunkTree& tree, const View& view, const LodSettings& settings, int frames = 1) {
        for (int i = 0; i < frames; ++i) {
            selectChunks(tree, view, settings, selection, popFrameS);
            meter.add(tree, selection, view, settings, timeS += popFrameS);
        }
    }
    void addAfterJump(const ChunkTree& tree, const View& view, const LodSettings& settings) {
        selectChunks(tree, view, settings, selection, popFrameS);
        meter.add(tree, selection, view, settings, timeS += popFrameS, {.cameraJumped = true});
    }
    std::uint64_t switches() const { return meter.totals().switches; }
};

LodSettings fadingSettings(double tauPx, SeamMode seams = SeamMode::Skirts) {
    LodSettings settings = tauOf(tauPx);
    settings.morph = true;
    settings.fadeS = 0.25;
    settings.seams = seams;
    return settings;
}

constexpr int fadedFrames = 120;  // in which every fade comes to its end

TEST(PopMeter, ASwitchThatFadesAfterAnotherToleranceIsTheSettings) {
    for (const SeamMode seams : {SeamMode::Skirts, SeamMode::Stitched}) {
        FadingFrames frames;
        for (const double tauPx : {2.0, 24.0, 2.0}) {
            const std::uint64_t before = frames.switches();
            frames.add(wholeTree(), viewAt(30, 20), fadingSettings(tauPx, seams), fadedFrames);
            EXPECT_EQ(frames.selection.counters.fading, 0u);
            if (before > 0 || tauPx > 2) {
                EXPECT_GT(frames.switches(), before + 2);
            }
        }
        EXPECT_EQ(countOf(frames.meter, PopCause::SettingsChanged), frames.switches());
    }
}

TEST(PopMeter, ASwitchThatFadesAfterTheCameraMovedIsTheCamera) {
    FadingFrames frames;
    frames.add(wholeTree(), viewAt(30, 20, 60000), fadingSettings(1), fadedFrames);
    frames.add(wholeTree(), viewAt(30, 20, 8000), fadingSettings(1), fadedFrames);
    const std::uint64_t down = frames.switches();
    EXPECT_GT(down, 2u);
    frames.add(wholeTree(), viewAt(30, 20, 60000), fadingSettings(1), fadedFrames);
    EXPECT_GT(frames.switches(), down + 2);
    EXPECT_EQ(countOf(frames.meter, PopCause::CameraMoved), frames.switches());
}

// Another tolerance while the camera's switches still fade.
TEST(PopMeter, EachSwitchKeepsTheCauseThatDecidedIt) {
    FadingFrames frames;
    frames.add(wholeTree(), viewAt(30, 20, 60000), fadingSettings(1), fadedFrames);
    frames.add(wholeTree(), viewAt(30, 20, 8000), fadingSettings(1), 2);
    ASSERT_GT(frames.selection.counters.fading, 0u);
    LodSettings finer = fadingSettings(0.2);
    frames.add(wholeTree(), viewAt(30, 20, 8000), finer, fadedFrames);
    EXPECT_GT(countOf(frames.meter, PopCause::CameraMoved), 0u);
    EXPECT_GT(countOf(frames.meter, PopCause::SettingsChanged), 0u);
    EXPECT_EQ(countOf(frames.meter, PopCause::CameraMoved) + countOf(frames.meter, PopCause::SettingsChanged),
              frames.switches());
}

TEST(PopMeter, SettingsThatChooseNoLevelAreNoCause) {
    PopMeter meter;
    LodSettings settings = tauOf(1);
    addSelected(meter, wholeTree(), viewAt(30, 20, 8000), settings, 0);
    settings.skirtFactor = 2;
    settings.morphRange = 0.5;
    addSelected(meter, wholeTree(), viewAt(30, 20, 60000), settings, popFrameS);
    EXPECT_GT(meter.totals().switches, 1u);
    EXPECT_EQ(countOf(meter, PopCause::CameraMoved), meter.totals().switches);
}

TEST(PopMeter, AnotherFieldOfViewOrPictureSizeIsTheSettings) {
    const View view = viewAt(30, 20);
    View narrow = view;
    narrow.horizontalFovRad /= 8;
    View large = view;
    large.widthPx *= 4;
    large.heightPx *= 4;
    for (const View& other : {narrow, large}) {
        FadingFrames frames;
        frames.add(wholeTree(), view, fadingSettings(4), fadedFrames);
        frames.add(wholeTree(), other, fadingSettings(4), fadedFrames);
        EXPECT_GT(frames.switches(), 0u);
        EXPECT_EQ(countOf(frames.meter, PopCause::SettingsChanged), frames.switches());
    }
}

TEST(PopMeter, AnotherExaggerationIsTheSettingsWhereItFades) {
    ChunkTree tree = residentTree(fakePyramid(), 5);
    FadingFrames frames;
    frames.add(tree, viewAt(30, 20), fadingSettings(4), fadedFrames);
    setExaggeration(tree, 3);
    frames.add(tree, viewAt(30, 20), fadingSettings(4), fadedFrames);
    EXPECT_GT(frames.switches(), 0u);
    EXPECT_EQ(countOf(frames.meter, PopCause::SettingsChanged), frames.switches());
}

TEST(PopMeter, AJumpOfTheCameraIsTheCamera) {
    PopMeter meter;
    addSelected(meter, wholeTree(), viewAt(30, 20, 8000), tauOf(1), 0);
    addSelected(meter, wholeTree(), viewAt(30, 20, 60000), tauOf(1), popFrameS);
    EXPECT_GT(meter.totals().switches, 1u);
    EXPECT_EQ(countOf(meter, PopCause::CameraMoved), meter.totals().switches);
}

void addBlock(ChunkTree& tree, const ChunkId& parent) {
    addFakeChildren(tree, findNode(tree, parent));
}

TEST(PopMeter, ALoadHeldBackForThirtyFramesIsLateForThirtyFrames) {
    ChunkTree tree = residentTree(fakePyramid(), 3);
    const View view = viewAt(30, 20);
    const LodSettings settings = tauOf(2);
    const Selection selection = select(tree, view, settings);
    ASSERT_FALSE(selection.requests.empty());
    const ChunkId held = selection.requests.front().parentId;
    const double epsPx =
        epsPxOf(tree.nodes[findNode(tree, held)], view.eyeM, screenScalePx(view), settings.metric);
    PopMeter meter;
    for (int i = 0; i < 30; ++i) addSelected(meter, tree, view, settings, i * popFrameS);
    EXPECT_EQ(meter.lateOpen(), selection.requests.size());
    EXPECT_TRUE(meter.events().empty());
    addBlock(tree, held);
    addSelected(meter, tree, view, settings, 30 * popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    EXPECT_EQ(meter.events()[0].chunk, held);
    EXPECT_EQ(meter.events()[0].cause, PopCause::LoadFinished);
    EXPECT_GT(meter.events()[0].jump.largestPx, 0);
    EXPECT_EQ(meter.lateOpen(), selection.requests.size() - 1);
    ASSERT_EQ(meter.late().size(), selection.requests.size());
    const LateArrival& arrival = meter.late().front();
    EXPECT_EQ(arrival.chunk, held);
    EXPECT_EQ(arrival.end, LateEnd::Loaded);
    EXPECT_EQ(arrival.frames, 30u);
    EXPECT_EQ(arrival.sinceS, 0);
    EXPECT_NEAR(arrival.untilS, 0.5, 1e-9);
    EXPECT_NEAR(arrival.worstEpsPx, epsPx, 1e-4 * epsPx);
    EXPECT_EQ(arrival.tauPx, 2);
}

// The children's own children come while the children still fade in.
TEST(PopMeter, ALoadThatComesDuringAFadeIsTheLoad) {
    ChunkTree tree = residentTree(fakePyramid(), 2);
    const View view = viewAt(30, 20);
    FadingFrames frames;
    frames.add(tree, view, fadingSettings(0.2), fadedFrames);
    const auto loadRequested = [&] {
        for (const ChildrenRequest& request : frames.selection.requests) addBlock(tree, request.parentId);
    };
    loadRequested();
    for (int i = 0; i < fadedFrames && frames.switches() == 0; ++i)
        frames.add(tree, view, fadingSettings(0.2));
    ASSERT_GT(frames.selection.counters.fading, 0u);
    ASSERT_FALSE(frames.selection.requests.empty());
    const std::uint64_t before = frames.switches();
    loadRequested();
    frames.add(tree, view, fadingSettings(0.2), fadedFrames);
    EXPECT_GT(frames.switches(), before);
    EXPECT_EQ(countOf(frames.meter, PopCause::LoadFinished), frames.switches());
}

TEST(PopMeter, WhatIsNoLongerWantedIsNoLongerLate) {
    const ChunkTree tree = residentTree(fakePyramid(), 3);
    PopMeter meter;
    addSelected(meter, tree, viewAt(30, 20), tauOf(2), 0);
    const std::size_t late = meter.lateOpen();
    ASSERT_GT(late, 0u);
    addSelected(meter, tree, viewAt(30, 20), tauOf(200), popFrameS);
    EXPECT_EQ(meter.lateOpen(), 0u);
    ASSERT_EQ(meter.late().size(), late);
    for (const LateArrival& arrival : meter.late()) EXPECT_EQ(arrival.end, LateEnd::NotWanted);
}

// The same on a planet whose loads wait at a gate.
TEST(PopMeter, APlanetsHeldLoadsAreLateUntilTheyCome) {
    Gated gated;
    const auto planet = openFake(gated.source());
    const std::vector<ViewInput> views{{viewAt(30, 20, 30000), tauOf(4), 1}};
    PopMeter meter;
    std::uint32_t waited = 0;
    const auto step = [&] {
        planet->step(views, noUpload, popFrameS);
        waited += planet->selection().counters.waiting > 0 ? 1 : 0;
        meter.add(planet->tree(), planet->selection(), planet->views()[0].input.lodView,
                  planet->views()[0].input.lod, planet->lastStep().nowS);
    };
    for (int i = 0; i < 30; ++i) step();
    EXPECT_TRUE(meter.events().empty());
    gated.gate.open();
    while (!planet->settled()) step();
    EXPECT_GT(meter.totals().switches, 4u);
    EXPECT_EQ(countOf(meter, PopCause::LoadFinished), meter.totals().switches);
    EXPECT_EQ(meter.lateOpen(), 0u);
    std::uint32_t root = 0;
    for (const LateArrival& arrival : meter.late()) {
        if (arrival.chunk.level == 0) root = std::max(root, arrival.frames);
        EXPECT_LE(arrival.frames, waited);
    }
    EXPECT_GE(root, 30u);
}

TEST(PopMeter, ChildrenThatAreGoneWereEvicted) {
    ChunkTree tree = residentTree(fakePyramid(), 3);
    const View view = viewAt(30, 20);
    const LodSettings settings = tauOf(2);
    PopMeter meter;
    addSelected(meter, tree, view, settings, 0);
    const Selection selection = select(tree, view, settings);
    ChunkId above = selection.requests.front().parentId;
    ASSERT_EQ(above.level, 3);
    above = parentOf(above);
    removeChildren(tree, findNode(tree, above));
    addSelected(meter, tree, view, settings, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    EXPECT_EQ(meter.events()[0].chunk, above);
    EXPECT_EQ(meter.events()[0].cause, PopCause::Evicted);
    // What was drawn then is measured though its heights have left the tree.
    EXPECT_GT(meter.events()[0].jump.places, 0u);
    EXPECT_GT(meter.events()[0].jump.largestPx, 0.1);
}

// The chunks of level 3 in a column that touches the next face.
TEST(PopMeter, AChunkHeldBackByItsNeighbourIsTheSeams) {
    ChunkTree tree = makeChunkTree(fakePyramid().shape, fakePyramid().minStep, fakePyramid().maxStep,
                                   fakePyramid().roots())
                         .value();
    ChunkId down{Face::PosX, 0, 0, 0};
    for (; down.level < 4; down = childOf(down, 1)) addBlock(tree, down);
    LodSettings settings = tauOf(0.001);
    settings.seams = SeamMode::Stitched;
    settings.frustumCulling = settings.horizonCulling = false;
    const View view = viewAt(0, 0, 1e6, -90);
    PopMeter meter;
    addSelected(meter, tree, view, settings, 0);
    addBlock(tree, neighbourOf({Face::PosX, 0, 0, 0}, Edge::East));
    addBlock(tree, neighbourOf({Face::PosX, 0, 0, 0}, Edge::South));
    addSelected(meter, tree, view, settings, popFrameS);
    EXPECT_EQ(countOf(meter, PopCause::LoadFinished), 2u);
    EXPECT_EQ(countOf(meter, PopCause::SeamLimit), 1u);
    for (const PopEvent& event : meter.events()) {
        if (event.cause == PopCause::SeamLimit) {
            EXPECT_EQ(event.chunk, parentOf(down));
        }
    }
}

TEST(PopMeter, AChunkFreedByANeighbourOutOfViewIsCulling) {
    LodSettings settings = tauOf(1);
    settings.seams = SeamMode::Stitched;
    const View view = fromBeside(mountain);
    DrawItem held = itemOf(wholeTree(), mountain);
    held.epsPx = 2;
    PopMeter meter;
    meter.add(wholeTree(), drawing({held, itemOf(wholeTree(), neighbourOf(mountain, Edge::West))}), view,
              settings, 0);
    meter.add(wholeTree(), drawingChildren(wholeTree(), mountain, {0, 0, 0, 0}), view, settings, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    EXPECT_EQ(meter.events()[0].cause, PopCause::Culling);
}

// Jumps of the camera.

TEST(PopMeter, WhatAJumpBeginsIsAfterTheJumpUntilItHasFaded) {
    FadingFrames frames;
    frames.add(wholeTree(), viewAt(30, 20, 60000), fadingSettings(1), fadedFrames);
    frames.addAfterJump(wholeTree(), viewAt(30, 20, 8000), fadingSettings(1));
    frames.add(wholeTree(), viewAt(30, 20, 8000), fadingSettings(1), fadedFrames);
    const PopTotals jumped = frames.meter.totals();
    EXPECT_GT(jumped.afterJump, 1u);
    EXPECT_EQ(jumped.counted, 0u);
    EXPECT_EQ(jumped.worstPx, 0);
    EXPECT_EQ(frames.meter.percentilePx(1), 0);
    for (const PopEvent& event : frames.meter.events()) EXPECT_TRUE(event.afterJump);
    frames.add(wholeTree(), viewAt(30, 20, 8000), fadingSettings(24), fadedFrames);
    EXPECT_GT(frames.meter.totals().counted, 1u);
    EXPECT_EQ(frames.meter.totals().afterJump, jumped.afterJump);
}

TEST(PopMeter, LoadsThatTheFirstFrameWaitsForAreAfterAJump) {
    ChunkTree tree = residentTree(fakePyramid(), 2);
    const View view = viewAt(30, 20);
    const LodSettings settings = tauOf(0.2);
    PopMeter meter;
    double timeS = 0;
    const auto add = [&] { addSelected(meter, tree, view, settings, timeS += popFrameS); };
    add();
    for (int level = 2; level < 4; ++level) {
        for (const ChildrenRequest& request : select(tree, view, settings).requests)
            addBlock(tree, request.parentId);
        add();
    }
    EXPECT_GT(meter.totals().switches, 2u);
    for (const PopEvent& event : meter.events()) {
        EXPECT_TRUE(event.afterJump) << toString(event.chunk);
        EXPECT_EQ(event.cause, PopCause::LoadFinished);
        if (event.jump.places > 0) {
            EXPECT_STREQ(popNote(event), "after jump");
        }
    }
}

TEST(PopMeter, LoadsThatAreWantedLaterAreNotAfterAJump) {
    ChunkTree tree = residentTree(fakePyramid(), 3);
    const View view = viewAt(30, 20);
    PopMeter meter;
    addSelected(meter, tree, view, tauOf(200), 0);
    ASSERT_EQ(meter.lateOpen(), 0u);
    addSelected(meter, tree, view, tauOf(2), popFrameS);
    for (const ChildrenRequest& request : select(tree, view, tauOf(2)).requests)
        addBlock(tree, request.parentId);
    addSelected(meter, tree, view, tauOf(2), 2 * popFrameS);
    EXPECT_GT(countOf(meter, PopCause::LoadFinished), 0u);
    for (const PopEvent& event : meter.events()) EXPECT_FALSE(event.afterJump);
}

TEST(PopMeter, SwitchesThatCountAreWorseThanThoseThatDoNot) {
    PopEvent small, large, jumped, unseen;
    small.jump.largestPx = 0.1;
    large.jump.largestPx = 2;
    jumped.jump.largestPx = 40;
    small.jump.places = large.jump.places = jumped.jump.places = 1;
    jumped.afterJump = true;
    EXPECT_TRUE(isWorsePop(large, small));
    EXPECT_TRUE(isWorsePop(small, jumped));
    EXPECT_TRUE(isWorsePop(jumped, unseen));
    EXPECT_FALSE(isWorsePop(unseen, small));
    EXPECT_STREQ(popNote(large), "");
    EXPECT_STREQ(popNote(unseen), "outside picture");
}

// The sea.

PopEvent switchAtSea(std::optional<double> seaM) {
    const View view = fromBeside(mountain);
    PopMeter meter;
    meter.add(wholeTree(), drawing({itemOf(wholeTree(), mountain)}), view, {}, 0, {.seaM = seaM});
    meter.add(wholeTree(), drawingChildren(wholeTree(), mountain, {0, 0, 0, 0}), view, {}, popFrameS,
              {.seaM = seaM});
    EXPECT_EQ(meter.totals().underSea, meter.events().front().jump.underSea ? 1u : 0u);
    return meter.events().front();
}

TEST(PopMeter, ADrawnSeaHidesTheBedsJump) {
    const PlanetShape& shape = fakePyramid().shape;
    const ChunkData& chunk = fakePyramid().at(mountain);
    const double lowM = heightM(shape, chunk.minStep);
    const double highM = heightM(shape, chunk.maxStep);
    const PopEvent dry = switchAtSea(std::nullopt);
    EXPECT_FALSE(dry.jump.underSea);
    const PopEvent below = switchAtSea(lowM - 1);
    EXPECT_EQ(below.jump.places, dry.jump.places);
    EXPECT_EQ(below.jump.largestPx, dry.jump.largestPx);
    EXPECT_EQ(below.jump.meanPx, dry.jump.meanPx);
    const PopEvent half = switchAtSea(0.5 * (lowM + highM));
    EXPECT_FALSE(half.jump.underSea);
    EXPECT_GT(half.jump.places, 0u);
    EXPECT_LT(half.jump.places, dry.jump.places);
    EXPECT_LE(half.jump.largestPx, dry.jump.largestPx);
    const PopEvent covered = switchAtSea(highM + 1);
    EXPECT_TRUE(covered.jump.underSea);
    EXPECT_EQ(covered.jump.places, 0u);
    EXPECT_EQ(covered.jump.largestPx, 0);
    EXPECT_EQ(covered.jump.meanPx, 0);
    EXPECT_STREQ(popNote(covered), "under sea");
}

// The mean over the screen, by many small squares of the finer chunk, each with its area on screen. It shares
// no more with the meter than where the surfaces lie.
// Vertices below the sea are lifted to it, and squares that it covers before and after are left out.
double meanBySquares(const DrawnChunk& coarser, const DrawnChunk& finer, int quadrant, const View& view,
                     bool coarserIsAfter = false, std::optional<double> seaM = std::nullopt) {
    const PlanetShape& shape = fakePyramid().shape;
    const double seaRadiusM = shape.radiusM + seaM.value_or(-shape.radiusM);
    const auto drawn = [&](const DrawnChunk& chunk) {
        DrawnGrid grid = drawnGrid(shape, chunk.item, *chunk.heights, chunk.stitched);
        for (glm::dvec3& pointM : grid.positionM)
            if (glm::length(pointM) < seaRadiusM) pointM *= seaRadiusM / glm::length(pointM);
        return grid;
    };
    const DrawnGrid coarse = drawn(coarser);
    const DrawnGrid fine = drawn(finer);
    const auto coarseAt = [&](double x, double y) {
        return pointOn(coarse, (x + 16 * (quadrant % 2)) / 2, (y + 16 * (quadrant / 2)) / 2);
    };
    const auto fineAt = [&](double x, double y) { return pointOn(fine, x, y); };
    const auto after = [&](double x, double y) { return coarserIsAfter ? coarseAt(x, y) : fineAt(x, y); };
    const auto before = [&](double x, double y) { return coarserIsAfter ? fineAt(x, y) : coarseAt(x, y); };
    const auto isCovered = [&](const glm::dvec3& pointM) { return glm::length(pointM) <= seaRadiusM + 1e-3; };
    const auto project = [&](const glm::dvec3& pointM) {
        const glm::dvec3 fromEye = pointM - view.eyeM;
        const double ahead = -glm::dot(fromEye, view.back);
        return glm::dvec3(glm::dot(fromEye, view.right) / ahead, glm::dot(fromEye, view.up) / ahead, ahead);
    };
    constexpr int squares = 320;
    constexpr double side = 16.0 / squares;
    const double scalePx = view.widthPx / (2 * std::tan(view.horizontalFovRad / 2));
    double area = 0;
    double total = 0;
    for (int i = 0; i < squares * squares; ++i) {
        const double x = side * (i % squares);
        const double y = side * (i / squares);
        const glm::dvec3 corner = project(after(x, y));
        const glm::dvec3 east = project(after(x + side, y)) - corner;
        const glm::dvec3 north = project(after(x, y + side)) - corner;
        const glm::dvec3 nowM = after(x + side / 2, y + side / 2);
        const glm::dvec3 wasM = before(x + side / 2, y + side / 2);
        if (isCovered(nowM) && isCovered(wasM)) continue;
        const glm::dvec3 now = project(nowM);
        const glm::dvec3 was = project(wasM);
        if (now.z <= 0 || was.z <= 0) continue;
        if (2 * scalePx * std::abs(now.x) > view.widthPx || 2 * scalePx * std::abs(now.y) > view.heightPx)
            continue;
        const double squareArea = std::abs(east.x * north.y - east.y * north.x);
        area += squareArea;
        total += squareArea * scalePx * std::hypot(now.x - was.x, now.y - was.y);
    }
    return total / area;
}

// Near, so that the foreground has most of the picture, and partly outside of it.
TEST(PopMeter, TheMeanIsOverTheScreen) {
    const auto chunkOf = [](const ChunkId& id, float morph) {
        const DrawItem item = itemOf(wholeTree(), id, morph);
        return DrawnChunk{item, wholeTree().nodes[item.node].heights};
    };
    const glm::dvec3 middle = glm::normalize(vertexM(fakePyramid().shape, fakePyramid().at(mountain), 8, 8));
    const Geographic place = geographicFromDirection(middle);
    const double latitudeDeg = glm::degrees(place.latitudeRad);
    const double longitudeDeg = glm::degrees(place.longitudeRad);
    int checked = 0;
    for (const double altitudeM : {12'000.0, 30'000.0, 200'000.0}) {
        for (const double pitchDeg : {-25.0, -60.0, -90.0}) {
            const View view =
                viewFromPose({latitudeDeg, longitudeDeg, altitudeM, 30, pitchDeg}, 1e5, 1.0, 800, 500);
            for (int q = 0; q < quadrantCount; ++q) {
                const DrawnChunk coarse = chunkOf(mountain, 0);
                const DrawnChunk fine = chunkOf(childOf(mountain, q), 0.3f);
                const SurfaceJump jump = surfaceJump(fakePyramid().shape, coarse, {&fine, 1}, false, view);
                if (jump.places < 30) continue;
                ++checked;
                const double expectedPx = meanBySquares(coarse, fine, q, view);
                EXPECT_NEAR(jump.meanPx, expectedPx, 0.02 * expectedPx)
                    << altitudeM << " " << pitchDeg << " " << q;
            }
        }
    }
    EXPECT_GT(checked, 10);
}

// From high above, so that all of a chunk is in the picture.
View aboveMountain() {
    const glm::dvec3 middle = glm::normalize(vertexM(fakePyramid().shape, fakePyramid().at(mountain), 8, 8));
    const Geographic place = geographicFromDirection(middle);
    return viewFromPose({glm::degrees(place.latitudeRad), glm::degrees(place.longitudeRad), 200'000, 30, -90},
                        1e5, 1.0, 800, 500);
}

DrawnChunk chunkOfTree(const ChunkId& id, float morph, bool stitched = false) {
    const DrawItem item = itemOf(wholeTree(), id, morph);
    return {item, wholeTree().nodes[item.node].heights, stitched};
}

TEST(PopMeter, TheMeanOfAMergeIsOverTheScreenToo) {
    const View view = aboveMountain();
    const DrawnChunk coarse = chunkOfTree(mountain, 0);
    for (int q = 0; q < quadrantCount; ++q) {
        const DrawnChunk fine = chunkOfTree(childOf(mountain, q), 0.3f);
        const SurfaceJump jump = surfaceJump(fakePyramid().shape, coarse, {&fine, 1}, true, view);
        ASSERT_GT(jump.places, 30u);
        const double expectedPx = meanBySquares(coarse, fine, q, view, true);
        ASSERT_GT(expectedPx, 0.001);
        EXPECT_NEAR(jump.meanPx, expectedPx, 0.02 * expectedPx) << q;
    }
}

// For stitched edges the mean counts grid points only.
TEST(PopMeter, TheMeanOfStitchedChunksIsOverTheScreenToo) {
    const View view = aboveMountain();
    const DrawnChunk coarse = chunkOfTree(mountain, 0, true);
    for (int q = 0; q < quadrantCount; ++q) {
        DrawnChunk fine = chunkOfTree(childOf(mountain, q), 0.3f, true);
        fine.item.edgeMorph[static_cast<std::size_t>(Edge::South)] = 1;
        fine.item.coarserBy[static_cast<std::size_t>(Edge::East)] = 1;
        for (const bool coarserIsAfter : {false, true}) {
            const SurfaceJump jump =
                surfaceJump(fakePyramid().shape, coarse, {&fine, 1}, coarserIsAfter, view);
            const double expectedPx = meanBySquares(coarse, fine, q, view, coarserIsAfter);
            ASSERT_GT(expectedPx, 0.001);
            EXPECT_NEAR(jump.meanPx, expectedPx, 0.04 * expectedPx) << q << " " << coarserIsAfter;
        }
    }
}

TEST(PopMeter, TheMeanBesideASeaIsOverWhatItLeavesDry) {
    const View view = aboveMountain();
    const DrawnChunk coarse = chunkOfTree(mountain, 0);
    int checked = 0;
    for (int q = 0; q < quadrantCount; ++q) {
        const ChunkData& chunk = fakePyramid().at(childOf(mountain, q));
        const DrawnChunk fine = chunkOfTree(chunk.id, 0);
        const double seaM =
            0.5 * (heightM(fakePyramid().shape, chunk.minStep) + heightM(fakePyramid().shape, chunk.maxStep));
        const SurfaceJump dry = surfaceJump(fakePyramid().shape, coarse, {&fine, 1}, false, view);
        const SurfaceJump jump = surfaceJump(fakePyramid().shape, coarse, {&fine, 1}, false, view, seaM);
        if (jump.places < dry.places / 8 || jump.places > 7 * dry.places / 8) continue;
        ++checked;
        const double expectedPx = meanBySquares(coarse, fine, q, view, false, seaM);
        EXPECT_NEAR(jump.meanPx, expectedPx, 0.05 * expectedPx) << q;
    }
    EXPECT_GT(checked, 1);
}

// An edge has no area on screen.
TEST(PopMeter, TheMeanOfAnEdgeIsOverItsVertices) {
    const View view = fromBeside(mountain);
    const PlanetShape& shape = fakePyramid().shape;
    const ChunkData& chunk = fakePyramid().at(mountain);
    const DrawnChunk before = chunkOfTree(mountain, 0);
    DrawnChunk after = before;
    after.item.edgeMorph[static_cast<std::size_t>(Edge::West)] = 1;
    double totalPx = 0;
    for (int row = 1; row <= 16; row += 2) {
        const glm::dvec3 middle =
            0.5 * (vertexM(shape, chunk, 0, row - 1) + vertexM(shape, chunk, 0, row + 1));
        const glm::dvec3 apart = middle - vertexM(shape, chunk, 0, row);
        totalPx +=
            glm::length(apart - glm::dot(apart, view.back) * view.back) * screenScalePx(view) / farAwayM;
    }
    const SurfaceJump jump = edgeJump(shape, before, after, Edge::West, view);
    EXPECT_EQ(jump.places, 17u);
    EXPECT_NEAR(jump.meanPx, totalPx / 17, 0.02 * totalPx / 17);
}

// Down from high up in small steps over several places, all loaded: what the morph is for. With a fade each
// frame knows the one before, and what is seen first is no switch.
PopTotals totalsOfDescents(double tauPx, SeamMode seams, bool morph, double fadeS) {
    LodSettings settings = tauOf(tauPx);
    settings.morph = morph;
    settings.fadeS = fadeS;
    settings.seams = seams;
    PopMeter meter;
    double timeS = 0;
    for (const double longitudeDeg : {20.0, 110.0, 200.0, 290.0}) {
        Selection selection;
        meter.add(wholeTree(), selection, viewAt(0, 0), settings, timeS);
        for (int i = 0; i < 900; ++i) {
            const View view = viewAt(30, longitudeDeg + 1e-4 * i, 150'000 * std::pow(0.9975, i));
            selectChunks(wholeTree(), view, settings, selection, popFrameS);
            meter.add(wholeTree(), selection, view, settings, timeS += popFrameS);
        }
    }
    return meter.totals();
}

TEST(PopMeter, ASlowCameraWithMorphHardlyJumps) {
    for (const SeamMode seams : {SeamMode::Stitched, SeamMode::Skirts}) {
        const PopTotals smooth = totalsOfDescents(0.5, seams, true, 0);
        const PopTotals hard = totalsOfDescents(0.5, seams, false, 0);
        EXPECT_GT(smooth.switches, 20u);
        EXPECT_GT(hard.worstPx, 0.5);
        // What morphs slides to its parent's own surface. Beside a coarser chunk the parent is drawn stitched
        // to that, and skirts leave an edge to its own chunk: there the one jumps a little, and the other.
        if (seams == SeamMode::Stitched) {
            EXPECT_LT(smooth.worstBesidePx, 0.01);
            EXPECT_LT(smooth.worstPx, 0.4 * hard.worstPx);
        } else {
            EXPECT_LT(smooth.worstPx, 0.1);
        }
    }
}

// Edges fade too, so that a switch moves nothing, whatever the tolerance.
TEST(PopMeter, WithAFadeASlowCameraDoesNotJumpAtAnyTolerance) {
    constexpr double nothingPx = 1e-6;
    for (const SeamMode seams : {SeamMode::Stitched, SeamMode::Skirts}) {
        for (const double tauPx : {0.5, 2.0, 8.0}) {
            const PopTotals smooth = totalsOfDescents(tauPx, seams, true, 0.25);
            const PopTotals hard = totalsOfDescents(tauPx, seams, false, 0);
            EXPECT_GT(smooth.switches, 20u);
            EXPECT_GT(hard.worstPx, 0.8 * tauPx);
            EXPECT_LT(smooth.worstBesidePx, nothingPx);
            EXPECT_LT(smooth.worstPx, nothingPx) << tauPx;
        }
    }
}

// What it remembers.

TEST(PopMeter, ForgetsAllForAnotherPlanetAndWhenTimeRunsBackwards) {
    const View view = fromBeside(mountain);
    const Selection coarse = drawing({itemOf(wholeTree(), mountain)});
    const Selection fine = drawingChildren(wholeTree(), mountain, {0, 0, 0, 0});
    PopMeter meter;
    meter.add(wholeTree(), coarse, view, {}, 10);
    meter.add(wholeTree(), fine, view, {}, 11);
    ASSERT_EQ(meter.events().size(), 1u);
    meter.add(wholeTree(), coarse, view, {}, 5);
    EXPECT_TRUE(meter.events().empty());
    meter.add(wholeTree(), fine, view, {}, 6);
    ASSERT_EQ(meter.events().size(), 1u);
    meter.clear();
    EXPECT_TRUE(meter.events().empty());
    EXPECT_EQ(meter.totals().switches, 0u);
    meter.add(wholeTree(), coarse, view, {}, 7);
    EXPECT_TRUE(meter.events().empty());
}

TEST(PopMeter, ASwitchWithAnotherExaggerationIsCountedAndNotMeasured) {
    ChunkTree tree = residentTree(fakePyramid(), 3);
    const View view = fromBeside(mountain);
    PopMeter meter;
    meter.add(tree, drawing({itemOf(tree, mountain)}), view, {}, 0);
    setExaggeration(tree, 2);
    meter.add(tree, drawingChildren(tree, mountain, {0, 0, 0, 0}), view, {}, popFrameS);
    ASSERT_EQ(meter.events().size(), 1u);
    const PopEvent& event = meter.events().front();
    EXPECT_EQ(event.cause, PopCause::SettingsChanged);
    EXPECT_EQ(event.toLevel, mountain.level + 1);
    EXPECT_FALSE(counts(event));
    EXPECT_STREQ(popNote(event), "not measured");
    EXPECT_EQ(event.jump.largestPx, 0);
    EXPECT_EQ(meter.totals().switches, 1u);
    EXPECT_EQ(meter.totals().notMeasured, 1u);
    EXPECT_EQ(meter.totals().counted + meter.totals().outsidePicture, 0u);
    EXPECT_EQ(meter.percentilePx(1), 0);
}

// Fade 0: what the other heights want is drawn in the very frame that they are drawn in.
TEST(PopMeter, AnotherExaggerationIsTheSettingsWhereNothingFades) {
    ChunkTree tree = residentTree(fakePyramid(), 5);
    PopMeter meter;
    const View view = viewAt(30, 20);
    LodSettings settings = tauOf(4);
    settings.fadeS = 0;
    addSelected(meter, tree, view, settings, 0);
    setExaggeration(tree, 3);
    addSelected(meter, tree, view, settings, popFrameS);
    EXPECT_GT(meter.totals().switches, 0u);
    EXPECT_EQ(countOf(meter, PopCause::SettingsChanged), meter.totals().switches);
    EXPECT_EQ(meter.totals().notMeasured, meter.totals().switches);
}

TEST(PopMeter, KeepsTheLastMinutesAndWhatWasDrawnInThem) {
    const View view = fromBeside(mountain);
    const Selection coarse = drawing({itemOf(wholeTree(), mountain)});
    const Selection fine = drawingChildren(wholeTree(), mountain, {0, 0, 0, 0});
    PopMeter meter;
    for (int i = 0; i < 40; ++i) meter.add(wholeTree(), i % 2 == 0 ? coarse : fine, view, {}, 10.0 * i);
    EXPECT_EQ(meter.totals().switches, 39u);
    EXPECT_GE(meter.events().front().timeS, 390 - PopMeter::keptS);
    const PopEvent& last = meter.events().back();
    const auto frameBefore = last.frameBefore.lock();
    const auto frameAfter = last.frameAfter.lock();
    ASSERT_TRUE(frameBefore && frameAfter);
    EXPECT_EQ(frameBefore->items.size(), 1u);
    EXPECT_EQ(frameAfter->items.size(), 4u);
}

}  // namespace
}  // namespace planet
