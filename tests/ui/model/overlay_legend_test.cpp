#include "ui/model/overlay_legend.h"

#include <gtest/gtest.h>

#include "app/scene/overlay_colours.h"

namespace worldy::ui {
namespace {

TEST(OverlayLegend, isEmptyWithoutTints) {
    EXPECT_TRUE(legendOf({}, 2, 5).entries.empty());
}

TEST(OverlayLegend, TheLegendOfErrorsFollowsTauAndTheScale) {
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Error;
    overlay.errorScale = 2;
    const Legend legend = legendOf(overlay, 3, 7);
    ASSERT_EQ(legend.entries.size(), 5u);
    EXPECT_EQ(legend.entries[2].label, "6 px");
    EXPECT_EQ(legend.entries[2].colour, errorColour(1));
    EXPECT_EQ(legend.entries[4].label, "12 px and over");
}

TEST(OverlayLegend, TheLegendOfLevelsEndsAtTheDeepestThatIsDrawn) {
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::Level;
    const Legend legend = legendOf(overlay, 2, 7);
    ASSERT_EQ(legend.entries.size(), 8u);
    EXPECT_EQ(legend.entries[7].label, "7");
    EXPECT_EQ(legend.entries[7].colour, levelColour(7));
}

TEST(OverlayLegend, EveryColouringHasALegendWithUnits) {
    for (const ColourBy by : {ColourBy::Level, ColourBy::Error, ColourBy::DeltaC, ColourBy::Morph,
                              ColourBy::Age, ColourBy::LoadOrder}) {
        OverlaySettings overlay;
        overlay.colourBy = by;
        const Legend legend = legendOf(overlay, 2, 4);
        EXPECT_FALSE(legend.title.empty());
        EXPECT_GE(legend.entries.size(), 2u);
    }
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::DeltaC;
    EXPECT_EQ(legendOf(overlay, 2, 4).entries[4].label, "1000 m");
    EXPECT_EQ(legendOf(overlay, 2, 4).entries[0].label, "0.1 m");
}

TEST(OverlayLegend, namesTheLeavesTheirSpacingAndTheLayers) {
    // 1024 cells along a face in chunks of 32 cells: the leaves have level 5.
    const LegendFacts facts{.shape = {.radiusM = 1024 * 2 / 3.14159265358979 * 100, .faceCellsLog2 = 10},
                            .layers = {"low", "high"}};
    OverlaySettings overlay;
    overlay.colourBy = ColourBy::LeafDepth;
    const Legend depth = legendOf(overlay, 2, 3, facts);
    ASSERT_EQ(depth.entries.size(), 7u);
    EXPECT_EQ(depth.entries[5].label, "5");
    EXPECT_EQ(depth.entries[5].colour, levelColour(5));
    EXPECT_EQ(depth.entries[6].colour, unmeasuredColour);
    overlay.colourBy = ColourBy::Spacing;
    const Legend spacing = legendOf(overlay, 2, 3, facts);
    EXPECT_EQ(spacing.entries[4].label, "100 m") << "the finest samples are the lightest";
    EXPECT_EQ(spacing.entries[4].colour, rampColour(1));
    EXPECT_EQ(spacing.entries[0].label, "3200 m");
    overlay.colourBy = ColourBy::Source;
    const Legend source = legendOf(overlay, 2, 3, facts);
    ASSERT_EQ(source.entries.size(), 4u);
    EXPECT_EQ(source.entries[0].label, "high") << "the top layer first";
    EXPECT_EQ(source.entries[0].colour, layerColour(1));
    EXPECT_EQ(source.entries[1].label, "low");
    EXPECT_EQ(legendOf(overlay, 2, 3).entries.size(), 1u) << "the source is not known";
}

TEST(OverlayLegend, TheScaleOfAnAtlasEndsWithWhatHasNoBoundAndIsOneEntryForOneValue) {
    AtlasDrape drape{.measure = planet::AtlasMeasure::EpsPx, .least = 1, .most = 3, .isClamped = true};
    drape.cellsOnScale = 5;
    drape.hasUnbounded = true;
    const Legend legend = legendOf(drape);
    ASSERT_EQ(legend.entries.size(), 6u);
    EXPECT_EQ(legend.entries[0].label, "1 px");
    EXPECT_EQ(legend.entries[2].label, "2 px");
    EXPECT_EQ(legend.entries[5].label, "no bound");
    EXPECT_EQ(legend.entries[5].colour, unboundedColour);
    drape.most = 1;
    drape.hasUnbounded = false;
    EXPECT_EQ(legendOf(drape).entries.size(), 1u);
}

TEST(OverlayLegend, ChangesOfAnAtlasAreSignedAndTellLostAndGainedBounds) {
    AtlasDrape drape{.measure = planet::AtlasMeasure::EpsPx, .isChange = true, .least = -2, .most = 2};
    drape.cellsOnScale = 5;
    drape.hasUnbounded = drape.hasGained = true;
    const Legend legend = legendOf(drape);
    EXPECT_EQ(legend.title, "Screen-space error \u03b5, change");
    ASSERT_EQ(legend.entries.size(), 7u);
    EXPECT_EQ(legend.entries[0].label, "-2 px");
    EXPECT_EQ(legend.entries[2].label, "0");
    EXPECT_EQ(legend.entries[4].label, "+2 px");
    EXPECT_EQ(legend.entries[5].label, "bound lost");
    EXPECT_EQ(legend.entries[6].label, "bound gained");
    drape.cellsOnScale = 0;
    EXPECT_EQ(legendOf(drape).entries.size(), 2u);
}

}  // namespace
}  // namespace worldy::ui
