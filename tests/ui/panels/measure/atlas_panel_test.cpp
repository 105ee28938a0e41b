#include "ui/panels/measure/atlas_panel.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "app/measure/atlas_table.h"
#include "app/scene/atlas_drape.h"
#include "planet/measure/atlas_diff.h"
#include "planet/measure/atlas_sampling.h"
#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

using planet::AtlasMeasure;

// One viewpoint for each face, two headings each; the fourth face is worst.
planet::Atlas sixFaces() {
    planet::Atlas atlas;
    atlas.survey.radiusM = planet::fakePyramid().shape.radiusM;
    atlas.survey.grid.altitudesM = {1000};
    atlas.survey.grid.headings = 2;
    atlas.isFinished = true;
    for (std::uint8_t i = 0; i < 12; ++i) {
        planet::AtlasViewpoint viewpoint;
        viewpoint.place.cell.face = planet::allFaces[i / 2u];
        viewpoint.place.heading = i % 2;
        viewpoint.eyeM = 1000;
        viewpoint.figures.fill(std::numeric_limits<double>::quiet_NaN());
        viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)] = i == 7 ? 3 : 0.1 * i;
        viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::Triangles)] = 1000 + i;
        atlas.viewpoints.push_back(viewpoint);
    }
    return atlas;
}

class AtlasPanel : public testing::Test {
protected:
    AtlasPanel() { view_.planet = planet_.get(); }

    Commands frame() {
        Commands commands;
        window_.frame([&] { atlasPanel(view_, state_, settings_, commands); });
        return commands;
    }
    Commands clicked(std::string_view label, float share = 0.5f) {
        Commands all;
        frame();
        frame();
        window_.click(label, share, [&] { addAsked(frame(), all); });
        return all;
    }
    void showAtlas() {
        AtlasView& shown = view_.instruments.atlas;
        shown.atlas = &atlas_;
        shown.name = "earth.atlas";
        shown.cells = cells_;
        shown.spreads = spreads_;
        shown.drape = &drape_;
    }
    // The fourth face got worse by 2 px from its second heading, and the first better by 0.5 px.
    void showChange() {
        showAtlas();
        planet::Atlas earlier = atlas_;
        earlier.viewpoints[7].figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)] -= 2;
        earlier.viewpoints[1].figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)] += 0.5;
        comparison_.earlier = "old.atlas";
        comparison_.diff = diffOf(earlier, atlas_, {}).value();
        comparison_.changes = planet::changesOf(earlier.viewpoints, atlas_.viewpoints);
        comparison_.cells = planet::changedCellsOf(atlas_.survey.grid, comparison_.changes);
        change_ = changeDrapeOf(comparison_.cells, AtlasMeasure::EpsPx, 0);
        view_.instruments.atlas.comparison = &comparison_;
        view_.instruments.atlas.drape = &change_;
    }

    PanelWindow window_{{500, 1400}};
    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    planet::Atlas atlas_ = sixFaces();
    const std::vector<AtlasSpread> spreads_ = spreadsOf(atlas_.viewpoints);
    AtlasComparison comparison_;
    AtlasDrape change_;
    const std::vector<planet::AtlasCell> cells_ = planet::cellsOf(atlas_.survey.grid, atlas_.viewpoints);
    const AtlasDrape drape_ = drapeOf(cells_, AtlasMeasure::EpsPx, 0);
    AtlasPanelState state_;
    ViewSettings settings_;
    EmptyView empty_;
    EditorView& view_ = empty_.view;
};

TEST_F(AtlasPanel, surveysThePlanetAndCancels) {
    state_.viewpoints = 500;
    const Commands started = clicked("Survey");
    ASSERT_EQ(started.size(), 1u);
    ASSERT_TRUE(started[0].as<StartAtlas>());
    EXPECT_EQ(started[0].as<StartAtlas>()->viewpoints, 500u);
    view_.instruments.atlas.running = true;
    const Commands cancelled = clicked("Cancel");
    ASSERT_EQ(cancelled.size(), 1u);
    EXPECT_TRUE(cancelled[0].as<CancelAtlas>());
}

TEST_F(AtlasPanel, withoutAPlanetNothingIsSurveyed) {
    view_.planet = nullptr;
    EXPECT_TRUE(clicked("Survey").empty());
}

// The net is four faces wide; its middle is between the second and the third, in the row of the equator.
TEST_F(AtlasPanel, aClickOnTheMapLooksFromTheWorstHeadingOfTheCell) {
    showAtlas();
    const Commands commands = clicked("atlas map", 0.1f);
    ASSERT_EQ(commands.size(), 1u);
    const LookFromAtlas* look = commands[0].as<LookFromAtlas>();
    ASSERT_TRUE(look);
    EXPECT_EQ(atlas_.viewpoints[look->viewpoint].place.cell.face, planet::Face::NegY);
    EXPECT_EQ(look->viewpoint, 7u);
    EXPECT_EQ(state_.shown, 7u);
}

TEST_F(AtlasPanel, theWorstViewpointComesFirstInTheList) {
    showAtlas();
    const Commands commands = clicked("Go 0");
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_TRUE(commands[0].as<LookFromAtlas>());
    EXPECT_EQ(commands[0].as<LookFromAtlas>()->viewpoint, 7u);
}

TEST_F(AtlasPanel, anUnfinishedSurveyIsContinued) {
    showAtlas();
    frame();
    EXPECT_FALSE(window_.isShown("Resume"));
    atlas_.isFinished = false;
    const Commands commands = clicked("Resume");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<ResumeAtlas>());
    EXPECT_TRUE(clicked("Survey again").empty());
}

TEST_F(AtlasPanel, asksForAnEarlierSurveyOrSurveysAgain) {
    showAtlas();
    const Commands asked = clicked("Compare with...");
    ASSERT_EQ(asked.size(), 1u);
    EXPECT_EQ(asked[0].as<AskForFile>()->purpose, FilePurpose::EarlierAtlas);
    const Commands again = clicked("Survey again");
    ASSERT_EQ(again.size(), 1u);
    EXPECT_TRUE(again[0].as<RevisitAtlas>()->withItsSettings);
    state_.withCurrentSettings = true;
    EXPECT_FALSE(clicked("Survey again")[0].as<RevisitAtlas>()->withItsSettings);
}

TEST_F(AtlasPanel, theLargestIncreaseComesFirstAmongChangesAndThenTheLargestDecrease) {
    showChange();
    const Commands worse = clicked("Go 0");
    ASSERT_EQ(worse.size(), 1u);
    EXPECT_EQ(worse[0].as<LookFromAtlas>()->viewpoint, 7u);
    const Commands better = clicked("Go 1");
    ASSERT_EQ(better.size(), 1u);
    EXPECT_EQ(better[0].as<LookFromAtlas>()->viewpoint, 1u);
    EXPECT_FALSE(window_.isShown("Go 2"));
}

TEST_F(AtlasPanel, aClickOnTheMapLooksFromTheHeadingThatChangedForTheWorse) {
    showChange();
    const Commands commands = clicked("atlas map", 0.1f);
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_EQ(commands[0].as<LookFromAtlas>()->viewpoint, 7u);
}

TEST_F(AtlasPanel, showsTheSurveyOrItsChange) {
    showAtlas();
    frame();
    EXPECT_FALSE(window_.isShown("Show"));
    showChange();
    clicked("Show");
    const Commands commands = clicked("Show: survey");
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_TRUE(commands[0].as<ChooseAtlas>());
    EXPECT_FALSE(commands[0].as<ChooseAtlas>()->isChange);
}

TEST_F(AtlasPanel, tintsTheChunks) {
    showAtlas();
    clicked("Tint planet");
    EXPECT_EQ(settings_.overlay.colourBy, ColourBy::Atlas);
    clicked("Tint planet");
    EXPECT_EQ(settings_.overlay.colourBy, ColourBy::None);
}

}  // namespace
}  // namespace worldy::ui
