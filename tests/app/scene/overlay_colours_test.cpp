#include "app/scene/overlay_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <thread>

#include "tests/support/fake_pyramid.h"
#include "tests/support/sudden_lod.h"

namespace worldy {
namespace {

using planet::gl::ChunkTint;

// A small planet whose chunks near the eye are all there.
std::unique_ptr<planet::Planet> settledPlanet() {
    auto opened = planet::Planet::open(planet::fakePyramid().source(), {});
    EXPECT_TRUE(opened);
    planet::View view;
    view.eyeM = {2e5, 0, 0};
    view.right = {0, 1, 0};
    view.up = {0, 0, 1};
    view.back = {1, 0, 0};
    const planet::UploadChunk upload = [](std::uint32_t, planet::StepsView) {};
    EXPECT_TRUE((*opened)->settle(view, planet::suddenLod(1), upload, 20));
    return std::move(*opened);
}

glm::vec3 colourOf(const ChunkTint& tint) {
    return glm::vec3(tint.rgba[0], tint.rgba[1], tint.rgba[2]) / 255.0f;
}

bool isNear(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 0.01f;
}

float lightness(const glm::vec3& colour) {
    return 0.299f * colour.x + 0.587f * colour.y + 0.114f * colour.z;
}

TEST(OverlayColours, ErrorsTurnFromGreenOverYellowAtTauToRedAtTwice) {
    EXPECT_GT(errorColour(0).y, 2 * errorColour(0).x);
    EXPECT_GT(errorColour(1).x, 0.9f);
    EXPECT_GT(errorColour(1).y, 0.8f);
    EXPECT_GT(errorColour(2).x, 4 * errorColour(2).y);
    EXPECT_EQ(errorColour(2), errorColour(50));
}

TEST(OverlayColours, TheRampGrowsLighterAllTheWay) {
    for (int i = 1; i <= 40; ++i) {
        EXPECT_GT(lightness(rampColour(i / 40.0)), lightness(rampColour((i - 1) / 40.0)));
    }
    EXPECT_EQ(rampColour(-1), rampColour(0));
    EXPECT_EQ(rampColour(2), rampColour(1));
}

TEST(OverlayColours, NoTwoStatesAndNoTwoNeighbouringLevelsLookAlike) {
    for (int a = 0; a <= static_cast<int>(planet::ChunkState::NotInFile); ++a) {
        for (int b = 0; b < a; ++b) {
            EXPECT_GT(glm::length(stateColour(static_cast<planet::ChunkState>(a)) -
                                  stateColour(static_cast<planet::ChunkState>(b))),
                      0.1f)
                << a << " and " << b;
        }
    }
    for (int level = 1; level <= planet::maxLevel; ++level) {
        EXPECT_GT(glm::length(levelColour(level) - levelColour(level - 1)), 0.3f) << level;
    }
}

TEST(OverlayColours, DeltaHasAScaleOfFourDecades) {
    EXPECT_DOUBLE_EQ(deltaShare(1000, 1000), 1);
    EXPECT_DOUBLE_EQ(deltaShare(10, 1000), 0.5);
    EXPECT_DOUBLE_EQ(deltaShare(0.1, 1000), 0);
    EXPECT_DOUBLE_EQ(deltaShare(0, 1000), 0);
    EXPECT_DOUBLE_EQ(deltaShare(1e6, 1000), 1);
}

TEST(OverlayColours, TintsStandInTheDrawListsOrderAndMeanWhatTheLegendSays) {
    const auto planet = settledPlanet();
    const planet::Selection& selection = planet->selection();
    ASSERT_GT(selection.draw.size(), 20u);
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Level;
    const auto levels = chunkTints(*planet, selection, overlay, 8);
    overlay.colourBy = ColourBy::Error;
    overlay.errorScale = 0.5;
    const auto errors = chunkTints(*planet, selection, overlay, 8);
    overlay.colourBy = ColourBy::DeltaC;
    const auto deltas = chunkTints(*planet, selection, overlay, 8);
    ASSERT_EQ(levels.size(), selection.draw.size());
    for (std::size_t i = 0; i < selection.draw.size(); ++i) {
        const planet::DrawItem& item = selection.draw[i];
        EXPECT_TRUE(isNear(colourOf(levels[i]), levelColour(item.id.level)));
        EXPECT_TRUE(isNear(colourOf(errors[i]), errorColour(static_cast<double>(item.epsPx) / (8 * 0.5))));
        EXPECT_TRUE(isNear(colourOf(deltas[i]),
                           rampColour(deltaShare(static_cast<double>(item.deltaCM), overlay.deltaTopM))));
    }
}

TEST(OverlayColours, LeafDepthAndSpacingAreThoseOfTheDeepestLeaf) {
    const auto planet = settledPlanet();
    const planet::Selection& selection = planet->selection();
    const int deepest = planet::deepestLevelOf(planet->tree().shape);
    // A dense planet, one of whose chunks is said to have shallower leaves.
    const planet::DrawItem* coarse = nullptr;
    for (const planet::DrawItem& item : selection.draw) {
        if (planet->tree().nodes[item.node].childrenState != planet::ChildrenState::None) coarse = &item;
    }
    ASSERT_NE(coarse, nullptr);
    LeafDepths depths;
    depths.below[coarse->id] = static_cast<std::uint8_t>(deepest - 1);
    OverlaySettings overlay;
    for (const ColourBy by : {ColourBy::LeafDepth, ColourBy::Spacing}) {
        overlay.colourBy = by;
        const auto colourAt = [&](int level) {
            return by == ColourBy::LeafDepth ? levelColour(level) : rampColour(spacingShare(level, deepest));
        };
        const auto tints = chunkTints(*planet, selection, overlay, 8, {.depths = &depths});
        const auto unknown = chunkTints(*planet, selection, overlay, 8);
        for (std::size_t i = 0; i < selection.draw.size(); ++i) {
            const planet::DrawItem& item = selection.draw[i];
            const bool isLeaf = planet->tree().nodes[item.node].childrenState == planet::ChildrenState::None;
            const int level = &item == coarse ? deepest - 1 : isLeaf ? item.id.level : item.id.level + 1;
            EXPECT_TRUE(isNear(colourOf(tints[i]), colourAt(level))) << toString(item.id);
            EXPECT_TRUE(isNear(colourOf(unknown[i]), isLeaf ? colourAt(level) : unmeasuredColour));
        }
    }
    EXPECT_NEAR(leafSpacingM(planet->tree().shape, 1) / leafSpacingM(planet->tree().shape, 3), 4, 1e-9);
    EXPECT_DOUBLE_EQ(spacingShare(3, 12), 0.25);
}

TEST(OverlayColours, SourceIsTheTopmostLayerWithAHeight) {
    const auto planet = settledPlanet();
    const planet::Selection& selection = planet->selection();
    const SourceTops tops = {{selection.draw[0].id, 2}, {selection.draw[1].id, std::nullopt}};
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Source;
    const auto tints = chunkTints(*planet, selection, overlay, 8, {.tops = &tops});
    EXPECT_TRUE(isNear(colourOf(tints[0]), layerColour(2)));
    EXPECT_TRUE(isNear(colourOf(tints[1]), noLayerColour));
    EXPECT_TRUE(isNear(colourOf(tints[2]), unmeasuredColour)) << "not asked yet";
    EXPECT_TRUE(isNear(colourOf(chunkTints(*planet, selection, overlay, 8)[0]), unmeasuredColour));
}

TEST(OverlayColours, RegionIsTheOneThatDecides) {
    const auto planet = settledPlanet();
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Region;
    EXPECT_TRUE(isNear(colourOf(chunkTints(*planet, planet->selection(), overlay, 8)[0]), noRegionColour));
    std::vector<planet::Region> regions(2);
    regions[0].name = "idle";
    regions[1].name = "all";
    regions[1].circles = {{{0, 0}, 1e9}};
    regions[1].tauFactor = 2;
    ASSERT_TRUE(planet->setRegions(regions));
    for (const auto& tint : chunkTints(*planet, planet->selection(), overlay, 8))
        EXPECT_TRUE(isNear(colourOf(tint), regionColour(1)));
    // In a soft border, the colour lies between that of the region and that of none.
    planet::ChunkDemand soft;
    soft.region = 1;
    soft.tauFactor = std::sqrt(2.0f);
    EXPECT_TRUE(isNear(demandColour(planet->tree(), soft), 0.5f * (regionColour(1) + noRegionColour)));
    EXPECT_FALSE(isNear(regionColour(0), regionColour(1)));
}

TEST(OverlayColours, withoutColouringThereAreNoTints) {
    const auto planet = settledPlanet();
    EXPECT_TRUE(chunkTints(*planet, planet->selection(), {}, 2).empty());
}

TEST(OverlayColours, OpacityIsThatOfTheSettings) {
    const auto planet = settledPlanet();
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Level;
    overlay.opacity = 0.4;
    EXPECT_EQ(chunkTints(*planet, planet->selection(), overlay, 2).front().rgba[3], 102);
}

TEST(OverlayColours, WhatWasLoadedLastIsLightestByLoadOrder) {
    const auto planet = settledPlanet();
    const planet::Selection& selection = planet->selection();
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::LoadOrder;
    const auto tints = chunkTints(*planet, selection, overlay, 8);
    std::size_t newest = 0;
    for (std::size_t i = 0; i < tints.size(); ++i) {
        const auto order = [&](std::size_t at) {
            return planet->tree().nodes[selection.draw[at].node].loadOrder;
        };
        if (order(i) > order(newest)) newest = i;
    }
    ASSERT_GT(planet->tree().nodes[selection.draw[newest].node].loadOrder, 1u);
    EXPECT_TRUE(isNear(colourOf(tints[newest]), rampColour(1)));
}

TEST(OverlayColours, ChunksDarkenWithTheirAge) {
    EXPECT_DOUBLE_EQ(ageShare(0, 10), 1);
    EXPECT_DOUBLE_EQ(ageShare(5, 10), 0.5);
    EXPECT_DOUBLE_EQ(ageShare(11, 10), 0);
}

}  // namespace
}  // namespace worldy
