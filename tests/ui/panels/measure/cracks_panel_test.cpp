// The buttons of the Cracks panel apply the values that it has found.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/shell/panels.h"

namespace worldy::ui {
namespace {

class CracksPanel : public testing::Test {
protected:
    CracksPanel() {
        measured_.required = {42.5, 0.75};
        view_.planet = planet_.get();
        view_.instruments.cracks = {&measured_, true, &smallest_};
    }

    Commands frame() {
        Commands commands;
        window_.frame([&] { drawPanel(PanelId::Cracks, view_, states_, settings_, commands); });
        return commands;
    }
    void click(std::string_view label) {
        frame();
        frame();
        window_.click(label, 0.5f, [&] { frame(); });
    }
    bool saysWhy(std::string_view label) {
        return window_.saysWhy(label, [&] { frame(); });
    }

    PanelWindow window_{{400, 1200}};
    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    CrackMeasurement measured_;
    SmallestSkirts smallest_{30, 0.021};
    EmptyView empty_;
    EditorView& view_ = empty_.view;
    PanelStates states_;
    ViewSettings settings_;
};

TEST_F(CracksPanel, appliesTheSmallestDepthAsAFixedOne) {
    settings_.lod.seams = planet::SeamMode::None;
    click("Apply Smallest depth");
    EXPECT_EQ(settings_.lod.seams, planet::SeamMode::Skirts);
    EXPECT_EQ(settings_.lod.skirtDepth, planet::SkirtDepth::Fixed);
    EXPECT_EQ(settings_.lod.skirtDepthM, 30);
}

TEST_F(CracksPanel, appliesTheSmallestFactorAsAnAutomaticOne) {
    settings_.lod.skirtDepth = planet::SkirtDepth::Fixed;
    click("Apply Smallest factor");
    EXPECT_EQ(settings_.lod.skirtDepth, planet::SkirtDepth::Automatic);
    EXPECT_EQ(settings_.lod.skirtFactor, 0.021);
}

TEST_F(CracksPanel, appliesWhatTheGapsAskFor) {
    click("Apply Required depth (max gap)");
    EXPECT_EQ(settings_.lod.skirtDepthM, 42.5);
    click("Apply Required factor (max gap)");
    EXPECT_EQ(settings_.lod.skirtDepth, planet::SkirtDepth::Automatic);
    EXPECT_EQ(settings_.lod.skirtFactor, 0.75);
}

TEST_F(CracksPanel, withoutCracksThereIsNothingToApply) {
    smallest_ = {0, 0};
    measured_.required = {0, 0};
    for (const char* name : {"Apply Smallest depth", "Apply Smallest factor",
                             "Apply Required depth (max gap)", "Apply Required factor (max gap)"}) {
        click(name);
        EXPECT_TRUE(saysWhy(name)) << name;
    }
    EXPECT_EQ(settings_, ViewSettings{});
}

TEST_F(CracksPanel, resultsThatAreOutOfDateAreGreyAndSayWhy) {
    view_.instruments.cracks.current = false;
    click("Apply Smallest depth");
    EXPECT_EQ(settings_, ViewSettings{});
    EXPECT_TRUE(saysWhy("Apply Smallest depth"));
}

TEST_F(CracksPanel, aFactorThatNobodyMaySetIsGreyAndSaysWhy) {
    smallest_.factor = std::numeric_limits<double>::infinity();
    click("Apply Smallest factor");
    EXPECT_EQ(settings_, ViewSettings{});
    EXPECT_TRUE(saysWhy("Apply Smallest factor"));
    EXPECT_FALSE(saysWhy("Apply Smallest depth"));
}

TEST(CracksView, crackPixelsWithoutAGapComeFromRounding) {
    EXPECT_STREQ(roundingNote(0, 0), "");
    EXPECT_STREQ(roundingNote(1, 0.0006), "");
    EXPECT_STRNE(roundingNote(1, 0.0004), "");
    EXPECT_STRNE(roundingNote(1, 0), "");
}

TEST_F(CracksPanel, findSmallestSkirtsSaysWhyItIsGrey) {
    EXPECT_FALSE(saysWhy("Find smallest skirts"));
    view_.instruments.cracks.current = false;
    EXPECT_TRUE(saysWhy("Find smallest skirts"));
}

}  // namespace
}  // namespace worldy::ui
