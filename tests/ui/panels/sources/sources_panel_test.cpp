#include "ui/panels/sources/sources_panel.h"

#include <gtest/gtest.h>

#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/model/source_text.h"

namespace worldy::ui {
namespace {

planet::WorldLayer editedLayer(const std::string& name) {
    planet::WorldLayer layer;
    layer.name = name;
    layer.files = {"/somewhere/" + name + ".tif"};
    return layer;
}

planet::SourceLayer readLayer(const std::string& name) {
    planet::SourceLayer layer;
    layer.name = name;
    layer.about = name + ".tif, 101 x 101 float, WGS 84";
    layer.sampleCount = 10000;
    layer.missingCount = 120;
    layer.spacingRad = 1e-4;
    layer.middle = {0.1, 0.2};
    return layer;
}

// A planet of three layers, low to high, one of which has a broken file.
class SourcesPanel : public testing::Test {
protected:
    SourcesPanel() : planet_(planet::openFake(planet::fakePyramid().source())), window_({420, 1400}) {
        for (const char* const name : {"low", "middle", "high"}) {
            edit_.layers.push_back(editedLayer(name));
            layers_.layers.push_back(readLayer(name));
        }
        view_.planet = planet_.get();
        layers_.layers[1].skipped = {"/somewhere/broken.tif: is not a readable raster"};
    }

    // Draws some frames and returns what they ask for.
    Commands draw(const std::function<void(SourcesView&)>& change = {}) {
        Commands commands;
        for (int i = 0; i < 3; ++i) window_.frame([&] { drawOnce(change, commands); });
        return commands;
    }
    Commands click(const char* item, const std::function<void(SourcesView&)>& change = {}) {
        draw(change);
        Commands commands;
        window_.click(item, 0.5f, [&] { window_.frame([&] { drawOnce(change, commands); }); });
        return commands;
    }
    void drawOnce(const std::function<void(SourcesView&)>& change, Commands& commands) {
        view_.sources = {};
        view_.sources.state = SourcesView::State::Read;
        view_.sources.source = "/somewhere/world.toml";
        view_.sources.layers = &layers_;
        view_.sources.edit = &edit_;
        if (change) change(view_.sources);
        sourcesPanel(view_, state_, settings_, commands);
    }
    // Returns the only edit that commands ask for.
    static const WorldEdit* editIn(const Commands& commands) {
        const EditLayers* found = nullptr;
        for (const Command& command : commands) {
            if (const auto* edit = command.as<EditLayers>()) {
                EXPECT_EQ(found, nullptr) << "two edits";
                found = edit;
            }
        }
        return found ? &found->edit : nullptr;
    }
    static std::vector<std::string> namesOf(const WorldEdit& edit) {
        std::vector<std::string> names;
        for (const planet::WorldLayer& layer : edit.layers) names.push_back(layer.name);
        return names;
    }

    std::unique_ptr<planet::Planet> planet_;
    PanelWindow window_;
    WorldEdit edit_;
    planet::SourceLayers layers_;
    SourcesPanelState state_;
    ViewSettings settings_;
    EmptyView empty_;
    EditorView& view_ = empty_.view;
};

TEST_F(SourcesPanel, listsTheTopLayerFirst) {
    draw();
    ASSERT_TRUE(window_.isShown("layer high") && window_.isShown("layer low"));
    EXPECT_LT(window_.find("layer high")->rect.y, window_.find("layer low")->rect.y);
}

TEST_F(SourcesPanel, checkBoxSwitchesItsLayer) {
    const Commands commands = click("on middle");
    const WorldEdit* const edit = editIn(commands);
    ASSERT_NE(edit, nullptr);
    EXPECT_TRUE(edit->layers[0].on);
    EXPECT_FALSE(edit->layers[1].on);
    EXPECT_TRUE(edit->layers[2].on);
}

TEST_F(SourcesPanel, buttonsMoveTheChosenLayer) {
    state_.chosen = 0;
    const Commands up = click("/Up");
    ASSERT_NE(editIn(up), nullptr);
    EXPECT_EQ(namesOf(*editIn(up)), (std::vector<std::string>{"middle", "low", "high"}));
    EXPECT_EQ(state_.chosen, 1u) << "the layer stays chosen";
    state_.chosen = 2;
    const Commands down = click("/Down");
    ASSERT_NE(editIn(down), nullptr);
    EXPECT_EQ(namesOf(*editIn(down)), (std::vector<std::string>{"low", "high", "middle"}));
    state_.chosen = 2;
    EXPECT_EQ(editIn(click("/Up")), nullptr) << "it is the topmost";
}

TEST_F(SourcesPanel, draggingARowMovesItsLayer) {
    draw();
    const Rect from = window_.find("layer high")->rect;
    const Rect to = window_.find("layer low")->rect;
    Commands commands;
    const auto frame = [&] { window_.frame([&] { drawOnce({}, commands); }); };
    PanelWindow::movePointer({from.x + from.width / 2, from.y + from.height / 2});
    frame();
    PanelWindow::press(true);
    frame();
    for (const float share : {0.3f, 0.7f, 1.0f, 1.0f}) {
        PanelWindow::movePointer(
            {from.x + from.width / 2, from.y + from.height / 2 + share * (to.y - from.y)});
        frame();
    }
    PanelWindow::press(false);
    frame();
    frame();
    ASSERT_NE(editIn(commands), nullptr);
    EXPECT_EQ(namesOf(*editIn(commands)), (std::vector<std::string>{"high", "low", "middle"}));
}

TEST_F(SourcesPanel, doubleClickFliesToTheMiddleOfTheLayer) {
    draw();
    const Rect row = window_.find("layer low")->rect;
    Commands commands;
    PanelWindow::movePointer({row.x + row.width / 2, row.y + row.height / 2});
    for (const bool down : {false, true, false, true, false}) {
        PanelWindow::press(down);
        window_.frame([&] { drawOnce({}, commands); });
    }
    const MoveCamera* move = nullptr;
    for (const Command& command : commands) {
        if (command.as<MoveCamera>()) move = command.as<MoveCamera>();
    }
    ASSERT_NE(move, nullptr);
    EXPECT_NEAR(move->pose.latitudeDeg, 0.1 * 180 / 3.14159265, 1e-3);
}

TEST_F(SourcesPanel, bakeIsPossibleOnlyIfSomethingIsChangedAndRight) {
    const auto bakes = [&](const std::function<void(SourcesView&)>& change) {
        for (const Command& command : click("/Bake", change)) {
            if (command.as<BakeLayers>()) return true;
        }
        return false;
    };
    EXPECT_FALSE(bakes({}));
    EXPECT_TRUE(bakes([](SourcesView& sources) { sources.edited = true; }));
    EXPECT_FALSE(bakes([](SourcesView& sources) {
        sources.edited = true;
        sources.bakeProblem = "scale is 0; expected another number";
    }));
    EXPECT_FALSE(bakes([](SourcesView& sources) { sources.edited = sources.baking = true; }));
    EXPECT_TRUE(click("/Revert").empty()) << "nothing is changed";
    for (bool SourcesView::*const changed : {&SourcesView::edited, &SourcesView::unsaved}) {
        const Commands revert = click("/Revert", [=](SourcesView& sources) { sources.*changed = true; });
        ASSERT_FALSE(revert.empty());
        EXPECT_NE(revert.back().as<RevertLayers>(), nullptr);
    }
}

TEST_F(SourcesPanel, saveProposesAFileBesideTheSource) {
    const Commands commands = click("/Save as");
    ASSERT_FALSE(commands.empty());
    ASSERT_NE(commands.back().as<SaveLayers>(), nullptr);
    EXPECT_EQ(commands.back().as<SaveLayers>()->file, "/somewhere/world-edited.toml");
}

TEST_F(SourcesPanel, existingFileIsReplacedOnlyAfterAQuestion) {
    draw();
    EXPECT_FALSE(window_.isShown("/Replace it"));
    const auto asked = [](SourcesView& sources) { sources.replaces = "/somewhere/world-edited.toml"; };
    const Commands commands = click("/Replace it", asked);
    ASSERT_FALSE(commands.empty());
    EXPECT_TRUE(commands.back().as<SaveLayers>()->replaces);
    // The question is about that name only.
    draw([](SourcesView& sources) { sources.replaces = "/x/other.toml"; });
    EXPECT_FALSE(window_.isShown("/Replace it"));
}

TEST_F(SourcesPanel, unknownSourceHasNoControls) {
    draw([](SourcesView& sources) { sources.state = SourcesView::State::Unknown; });
    EXPECT_FALSE(window_.isShown("/Bake"));
    SourcesView unknown;
    EXPECT_NE(stateText(unknown).find("opened from a chunk file"), std::string::npos);
}

TEST(SourceText, layersOfTheSameNameAreMatchedInTheirOrder) {
    SourcesView view;
    planet::SourceLayers layers;
    layers.layers = {readLayer("a"), readLayer("b"), readLayer("a")};
    WorldEdit edit;
    edit.layers = {editedLayer("a"), editedLayer("a"), editedLayer("new")};
    view.layers = &layers;
    view.edit = &edit;
    EXPECT_EQ(descriptionOf(view, 0), &layers.layers[0]);
    EXPECT_EQ(descriptionOf(view, 1), &layers.layers[2]);
    EXPECT_EQ(descriptionOf(view, 2), nullptr);
    EXPECT_EQ(descriptionOf(view, 3), nullptr);
}

TEST(SourceText, saysWhatALayerHas) {
    EXPECT_EQ(voidsText(readLayer("a")), "1.2 %");
    EXPECT_EQ(spacingText(readLayer("a"), 1e6), "100 m");
    EXPECT_EQ(voidsText(planet::SourceLayer{}), "");
    EXPECT_EQ(heightText({.heightM = 12.34}), "12.3 m");
    planet::SourceReading reading;
    EXPECT_EQ(heightText(reading), "not here");
    reading.isVoid = true;
    EXPECT_EQ(heightText(reading), "void");
    reading.file = "/x/mesa.tif";
    reading.column = 12;
    reading.row = 40;
    EXPECT_EQ(pixelText(reading), "mesa.tif 12, 40");
}

}  // namespace
}  // namespace worldy::ui
