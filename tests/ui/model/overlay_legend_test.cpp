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

}  // namespace
}  // namespace worldy::ui
