#include "ui/panels/measure/atlas_panel.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "app/scene/atlas_drape.h"
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
        shown.drape = &drape_;
    }

    PanelWindow window_{{500, 1400}};
    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    const planet::Atlas atlas_ = sixFaces();
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

TEST_F(AtlasPanel, tintsTheChunks) {
    showAtlas();
    clicked("Tint planet");
    EXPECT_EQ(settings_.overlay.colourBy, ColourBy::Atlas);
    clicked("Tint planet");
    EXPECT_EQ(settings_.overlay.colourBy, ColourBy::None);
}

}  // namespace
}  // namespace worldy::ui
