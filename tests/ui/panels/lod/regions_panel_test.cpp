// Drives the Regions panel without a window.
#include "ui/panels/lod/regions_panel.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/editor_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

class RegionsPanel : public testing::Test {
protected:
    RegionsPanel() {
        fixture_.fly({}, 2);
        frame();
        frame();
    }

    void frame() {
        Commands commands;
        EditorView view = fixture_.view();
        view.settings.regionsFile = "/planets/earth.regions.toml";
        view.settings.regionsQuestion = question_;
        window_.frame([&] { regionsPanel(view, state_, settings_, commands); });
        addAsked(std::move(commands), commands_);
    }
    void click(const std::string& item, float share = 0.5f) {
        window_.click(item, share, [&] { frame(); });
        frame();
    }
    std::vector<planet::Region> regions() const { return settings_.regions.all(); }

    PanelWindow window_{{420, 1400}};
    worldy::test::EditorFixture fixture_{planet::openFake()};
    RegionsPanelState state_;
    ViewSettings settings_;
    Commands commands_;
    std::string question_;
};

TEST_F(RegionsPanel, aRegionIsAddedSwitchedCopiedAndDeleted) {
    EXPECT_FALSE(window_.isShown("Factor"));
    click("Add");
    ASSERT_EQ(regions().size(), 1u);
    EXPECT_TRUE(planet::checkRegions(regions()));
    EXPECT_EQ(regions()[0].tauFactor, 0.5);
    ASSERT_EQ(regions()[0].circles.size(), 1u);
    click("on: Region 1");
    EXPECT_FALSE(regions()[0].on);
    click("Copy");
    ASSERT_EQ(regions().size(), 2u);
    EXPECT_EQ(regions()[1].name, "Region 2");
    EXPECT_EQ(regions()[1].circles, regions()[0].circles);
    EXPECT_EQ(state_.chosen, 1u);
    click("region Region 1");
    EXPECT_EQ(state_.chosen, 0u);
    click("Delete");
    ASSERT_EQ(regions().size(), 1u);
    EXPECT_EQ(regions()[0].name, "Region 2");
    click("Delete");
    EXPECT_TRUE(regions().empty());
}

TEST_F(RegionsPanel, theControlsEditTheChosenRegion) {
    click("Add");
    click("Least level", 0.05f);
    EXPECT_EQ(regions()[0].leastLevel, 4);
    click("Factor on τ", 0.05f);
    EXPECT_EQ(regions()[0].tauFactor, std::nullopt);
    click("Only at heights", 0.05f);
    EXPECT_TRUE(regions()[0].heights);
    click("Add circle");
    EXPECT_EQ(regions()[0].circles.size(), 2u);
    click("Remove circle");
    EXPECT_EQ(regions()[0].circles.size(), 1u);
    click("regions.on");
    EXPECT_FALSE(settings_.regions.on);
}

TEST_F(RegionsPanel, theLevelsOfARegionStayInOrder) {
    click("Add");
    click("Largest level", 0.05f);
    click("At most", 0.001f);
    EXPECT_EQ(regions()[0].mostLevel, 0);
    click("Least level", 0.05f);
    EXPECT_EQ(regions()[0].leastLevel, 0);
    click("At least", 0.999f);
    EXPECT_EQ(regions()[0].leastLevel, 0);
    click("At most", 0.999f);
    EXPECT_EQ(regions()[0].mostLevel, planet::maxLevel);
    click("At least", 0.999f);
    EXPECT_EQ(regions()[0].leastLevel, planet::maxLevel);
    EXPECT_EQ(state_.problem, "");
}

TEST_F(RegionsPanel, namesKeepTheirRoomInANarrowPanel) {
    click("Add");
    click("Least level", 0.05f);
    click("Largest level", 0.05f);
    std::vector<planet::Region> all = regions();
    all[0].name = "Region 12";
    settings_.regions.list = std::make_shared<const std::vector<planet::Region>>(all);
    PanelWindow::resize({200, 1400});
    frame();
    frame();
    const ItemPlace* const row = window_.find("region Region 12");
    ASSERT_NE(row, nullptr);
    EXPECT_GE(row->rect.width, ImGui::CalcTextSize("Region 12").x);
}

TEST_F(RegionsPanel, savingAsksForTheFileBesideThePlanet) {
    click("Save");
    EXPECT_TRUE(commands_.empty()) << "there is nothing to save";
    click("Add");
    click("Save");
    ASSERT_EQ(commands_.size(), 1u);
    ASSERT_TRUE(commands_[0].as<SaveRegions>());
    EXPECT_TRUE(commands_[0].as<SaveRegions>()->file.empty());
}

TEST_F(RegionsPanel, theQuestionBeforeSavingHasThreeAnswers) {
    EXPECT_FALSE(window_.isShown("Replace it"));
    question_ = "earth.regions.toml has comments. Saving removes them.";
    frame();
    for (const char* const answer : {"Replace it", "Read it", "Do not save"}) click(answer);
    ASSERT_EQ(commands_.size(), 3u);
    ASSERT_TRUE(commands_[0].as<SaveRegions>());
    EXPECT_TRUE(commands_[0].as<SaveRegions>()->replaces);
    ASSERT_TRUE(commands_[1].as<LoadRegions>());
    EXPECT_EQ(commands_[1].as<LoadRegions>()->file, "/planets/earth.regions.toml");
    EXPECT_TRUE(commands_[2].as<KeepRegionsFile>());
}

TEST_F(RegionsPanel, aPolygonIsClosedFromItsCornersAndRemoved) {
    click("Add");
    EXPECT_FALSE(window_.isShown("Close polygon"));
    state_.brush.mode = BrushMode::Polygon;
    state_.corners = {{0, 0}, {0, 2}, {2, 0}, {2, 2}};
    frame();
    click("Close polygon");
    EXPECT_TRUE(regions()[0].polygons.empty()) << "its edges cross";
    EXPECT_NE(state_.problem, "");
    click("Remove corner");
    EXPECT_EQ(state_.problem, "");
    click("Close polygon");
    ASSERT_EQ(regions()[0].polygons.size(), 1u);
    EXPECT_TRUE(state_.corners.empty());
    click("Close polygon");
    EXPECT_EQ(regions()[0].polygons.size(), 1u) << "there are no corners";
    click("Remove polygon");
    EXPECT_TRUE(regions()[0].polygons.empty());
}

}  // namespace
}  // namespace worldy::ui
