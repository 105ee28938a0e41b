// What is baked, chosen in the Bake panel, without a window.
#include "ui/panels/bake/source_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "app/data/worlds.h"
#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "ui/shell/panels.h"

namespace worldy::ui {
namespace {

using ::testing::HasSubstr;

TEST(SourceControls, TakeASourceApartAndPutItTogetherAgain) {
    SourceEdit edit;
    for (const char* text :
         {"/data/elevation.tif", "noise:fbm,seed=5", "noise:ridged,seed=1,gain=0.4",
          "noise:faults,seed=1,count=7", "noise:midpoint,seed=3,roughness=0.5",
          "noise:craters,seed=1,sizes=4", "detail:seed=4,strength=2,of=/data/elevation.tif",
          "detail:seed=1,of=noise:fbm,seed=9", ""}) {
        setSource(text, edit);
        EXPECT_EQ(sourceOf(edit), text);
    }
    // Bad ones stand as they are, with what is wrong.
    setSource("noise:fbm,octaves=99", edit);
    EXPECT_EQ(edit.kind, 0);
    EXPECT_EQ(sourceOf(edit), "noise:fbm,octaves=99");
    EXPECT_THAT(edit.problem, HasSubstr("octaves is 99"));
    setSource("/nonexistent.tif", edit);
    EXPECT_THAT(edit.problem, HasSubstr("No such image"));
    setSource("noise:fbm", edit);
    EXPECT_EQ(edit.problem, "");
}

class BakePanelSource : public testing::Test {
protected:
    BakePanelSource() {
        view_.data.chunkFile = "/cache/world.chk";
        view_.bake.worlds = worlds_;
    }

    // Also lets half a second pass, after which the panel asks for what it needs.
    Commands frame(double afterS = 0) {
        Commands commands;
        view_.frames.timeS += afterS;
        window_.frame([&] { drawPanel(PanelId::Bake, view_, states_, settings_, commands); });
        return commands;
    }
    void click(std::string_view label, float share = 0.5f) {
        frame();
        frame();
        window_.click(label, share, [&] { frame(); });
    }
    template <class T>
    const T* askedFor() {
        frame();
        asked_ = frame(1);
        for (const Command& command : asked_) {
            if (const T* found = command.as<T>()) return found;
        }
        return nullptr;
    }

    PanelWindow window_{{420, 2000}};
    std::vector<World> worlds_ = worldy::worlds();
    EmptyView empty_;
    EditorView& view_ = empty_.view;
    PanelStates states_;
    ViewSettings settings_;
    Commands asked_;
};

TEST_F(BakePanelSource, ANewSeedIsAnotherWorldThatIsPreviewedAndEstimated) {
    view_.bake.current.source = "noise:ridged,seed=7,gain=0.4";
    click("New seed");
    const EstimateBake* estimate = askedFor<EstimateBake>();
    ASSERT_TRUE(estimate);
    const auto terrain = planet::terrainFromText(estimate->request.source);
    ASSERT_TRUE(terrain);
    const auto& ridged = std::get<planet::RidgedTerrain>(terrain->settings);
    EXPECT_NE(ridged.seed, 7u);
    EXPECT_EQ(ridged.gain, 0.4);
    const std::filesystem::path before = estimate->request.source;
    click("New seed");
    const PreviewSource* preview = askedFor<PreviewSource>();
    ASSERT_TRUE(preview);
    EXPECT_NE(preview->request.source, before);
    EXPECT_FALSE(askedFor<PreviewSource>());  // once
}

TEST_F(BakePanelSource, NothingIsDrawnForAFileThatNobodyChanges) {
    view_.bake.current.source = worlds_[0].request.source;
    EXPECT_FALSE(askedFor<PreviewSource>());
    click("Preview of the source");
    ASSERT_TRUE(askedFor<PreviewSource>());
}

TEST_F(BakePanelSource, AClickIntoThePictureShowsAQuarterOfIt) {
    view_.bake.current.source = "noise:fbm";
    click("Preview of the source");
    ASSERT_TRUE(askedFor<PreviewSource>());
    click("/Preview", 0.75f);
    const PreviewSource* preview = askedFor<PreviewSource>();
    ASSERT_TRUE(preview);
    EXPECT_EQ(preview->request.zoomLog2, 2);
    EXPECT_NEAR(preview->request.u, 0.5, 0.02);
    EXPECT_NEAR(preview->request.v, 0, 0.02);
    click("Whole face");
    const PreviewSource* whole = askedFor<PreviewSource>();
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->request.zoomLog2, 0);
}

TEST_F(BakePanelSource, DetailIsAddedToTheFileThatIsNamed) {
    view_.bake.current.source = worlds_[0].request.source;
    click("Add fractal detail", 0.05f);
    const EstimateBake* estimate = askedFor<EstimateBake>();
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->request.source, "detail:seed=1,of=" + worlds_[0].request.source.string());
}

TEST_F(BakePanelSource, ColoursAreTheSourcesOwnAnotherImageOrNone) {
    view_.bake.current = worlds_[0].request;
    ASSERT_TRUE(view_.bake.current.colour.string().ends_with("colour.jpg"));
    view_.bake.current.settings.colour.faceSize = 1025;
    click("/Colours");
    click("Colours: none");
    const EstimateBake* none = askedFor<EstimateBake>();
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->request.colour.empty());
    EXPECT_FALSE(window_.isShown("/Colour face"));
    click("/Colours");
    click("Colours: the source's own");
    const EstimateBake* own = askedFor<EstimateBake>();
    ASSERT_TRUE(own);
    EXPECT_EQ(own->request.colour, worlds_[0].request.colour);
    click("/Colour face");
    click("Colour face: 513 texels");
    click("/Colour format");
    click("Colour format: lossless");
    const EstimateBake* small = askedFor<EstimateBake>();
    ASSERT_TRUE(small);
    EXPECT_EQ(small->request.settings.colour.faceSize, 513);
    EXPECT_EQ(small->request.settings.colour.format, planet::ColourFormat::Lossless);
}

TEST_F(BakePanelSource, AnImageThatWasChosenIsTakenAndOneThatIsNotThereCannotBeBaked) {
    view_.bake.current = worlds_[0].request;
    frame();
    const std::filesystem::path image = view_.bake.current.source;  // any image will do
    states_.bake.colour.chosen = image;
    const EstimateBake* chosen = askedFor<EstimateBake>();
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen->request.colour, image);
    click("/Bake");
    EXPECT_TRUE(window_.isShown("/Choose"));
    states_.bake.colour.chosen = "/nonexistent/map.png";
    EXPECT_FALSE(askedFor<EstimateBake>());
    EXPECT_THAT(states_.bake.colour.problem, HasSubstr("/nonexistent/map.png: no such image or cube faces"));
}

TEST_F(BakePanelSource, AnotherWorldBringsItsOwnColours) {
    view_.bake.current = worlds_[0].request;
    click("/Preset");
    click("Preset: Moon");
    const EstimateBake* moon = askedFor<EstimateBake>();
    ASSERT_TRUE(moon);
    EXPECT_TRUE(moon->request.colour.empty());
    click("/Preset");
    click("Preset: Earth amplified");
    const EstimateBake* amplified = askedFor<EstimateBake>();
    ASSERT_TRUE(amplified);
    EXPECT_EQ(amplified->request.colour, worlds_[0].request.colour);
}

TEST_F(BakePanelSource, ASourceThatIsNotThereCannotBeBaked) {
    view_.bake.current.source = "/nonexistent/elevation.tif";
    frame();
    frame();
    Commands all;
    window_.click("/Bake again", 0.5f, [&] {
        for (Command& command : frame()) all.push_back(std::move(command));
    });
    for (const Command& command : all) EXPECT_FALSE(command.as<StartBake>());
    view_.data.chunkFile = "/cache/other.chk";
    view_.bake.current.source = "noise:fbm";
    frame();
    frame();
    window_.click("/Bake again", 0.5f, [&] {
        for (Command& command : frame()) all.push_back(std::move(command));
    });
    EXPECT_TRUE(
        std::any_of(all.begin(), all.end(), [](const Command& command) { return command.as<StartBake>(); }));
}

}  // namespace
}  // namespace worldy::ui
