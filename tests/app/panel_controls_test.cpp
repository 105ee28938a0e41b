// Presses the panels' controls without a window: ImGui with a mouse of the test's own, and a small planet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <variant>

#include "tests/panel_fixture.h"
#include "tests/planet_fixture.h"
#include "ui/panels.h"

namespace ui {
namespace {

class PanelControls : public testing::Test {
protected:
    void openPlanet() {
        planet_ = planet::openFake();
        const planet::View view = planet::viewFromPose({.altitudeM = planet_->shape().radiusM},
                                                       planet_->shape().radiusM, 1.05, 640, 480);
        planet_->settle(
            view, {}, [](std::uint32_t, std::span<const std::int16_t>) {}, planet::timeoutS);
        view_.planet = planet_.get();
        view_.lodView = view;
    }

    Commands frame(PanelId id) {
        Commands commands;
        window_.frame([&] {
            if (wantedChunkSize_ > 0)
                ImGui::GetStateStorage()->SetInt(ImGui::GetID("wantedChunkSize"), wantedChunkSize_);
            drawPanel(id, view_, states_, settings_, commands);
        });
        return commands;
    }

    // Clicks a control and returns what that asks for.
    Commands click(PanelId id, std::string_view label) {
        frame(id);
        frame(id);
        Commands all;
        window_.click(label, 0.1f, [&] { addAsked(frame(id), all); });
        return all;
    }

    PanelWindow window_{{400, 1600}};
    std::unique_ptr<planet::Planet> planet_;
    FrameStats stats_;
    std::deque<FrameSample> history_;
    planet::LodChanges changes_;
    std::deque<LogLine> log_;
    EditorView view_{.stats = stats_, .history = history_, .changes = changes_, .log = log_};
    PanelStates states_;
    ViewSettings settings_;
    int wantedChunkSize_ = 0;  // as if it had been chosen from the list
};

template <class T>
const T* only(const Commands& commands) {
    return commands.size() == 1 ? std::get_if<T>(&commands.front()) : nullptr;
}

constexpr std::array ownPanels = {PanelId::Lod,     PanelId::Paging, PanelId::Seams,
                                  PanelId::Surface, PanelId::Frame,  PanelId::Log};

TEST_F(PanelControls, panelsStandWithoutAPlanet) {
    for (const PanelId id : ownPanels) EXPECT_TRUE(frame(id).empty()) << static_cast<int>(id);
}

TEST_F(PanelControls, drawingChangesNoSettingAndAsksForNothing) {
    openPlanet();
    for (const float width : {330.0f, 900.0f}) {
        window_.resize({width, 900});
        for (const PanelId id : ownPanels) {
            for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame(id).empty()) << static_cast<int>(id);
        }
    }
    EXPECT_EQ(settings_, ViewSettings{});
}

TEST_F(PanelControls, freezeAsksForTheOppositeOfWhatIs) {
    const Commands freeze = click(PanelId::Lod, "Freeze (F2)");
    ASSERT_TRUE(only<FreezeLod>(freeze));
    EXPECT_TRUE(only<FreezeLod>(freeze)->frozen);
    view_.lodFrozen = true;
    const Commands thaw = click(PanelId::Lod, "Freeze (F2)");
    ASSERT_TRUE(only<FreezeLod>(thaw));
    EXPECT_FALSE(only<FreezeLod>(thaw)->frozen);
}

TEST_F(PanelControls, cullingIsSwitchedInTheSettings) {
    EXPECT_TRUE(click(PanelId::Lod, "Horizon culling").empty());
    EXPECT_FALSE(settings_.lod.horizonCulling);
    EXPECT_TRUE(settings_.lod.frustumCulling);
}

TEST_F(PanelControls, anotherChunkSizeOffersABakeOfTheSameSource) {
    openPlanet();
    view_.bake.current.source = "/data/heights.tif";
    view_.bake.current.settings.quantumM = 0.25;
    view_.bake.canBake = true;
    frame(PanelId::Lod);
    EXPECT_FALSE(window_.isShown("/Bake"));
    wantedChunkSize_ = 65;
    const Commands bake = click(PanelId::Lod, "/Bake");
    ASSERT_TRUE(only<StartBake>(bake));
    const BakeRequest& request = only<StartBake>(bake)->request;
    EXPECT_EQ(request.source, "/data/heights.tif");
    EXPECT_EQ(request.settings.quantumM, 0.25);
    EXPECT_EQ(request.settings.chunkSize, 65);
}

TEST_F(PanelControls, nothingIsBakedWithoutASourceNorWhileABakeRuns) {
    openPlanet();
    wantedChunkSize_ = 65;
    EXPECT_TRUE(click(PanelId::Lod, "/Bake").empty());
    view_.bake.canBake = true;
    view_.bake.running = BakeRequest{};
    EXPECT_TRUE(click(PanelId::Lod, "/Bake").empty());
}

TEST_F(PanelControls, theOfferGoesWhenTheFileHasTheChunkSize) {
    openPlanet();
    wantedChunkSize_ = planet::chunkSize(planet_->shape());
    frame(PanelId::Lod);
    EXPECT_FALSE(window_.isShown("/Bake"));
}

TEST_F(PanelControls, oneRequestIsLetThroughOnlyWhilePaused) {
    openPlanet();
    EXPECT_TRUE(click(PanelId::Paging, "Load one").empty());
    view_.pagingPaused = true;
    EXPECT_TRUE(only<LoadOne>(click(PanelId::Paging, "Load one")));
    const Commands resume = click(PanelId::Paging, "Pause");
    ASSERT_TRUE(only<PausePaging>(resume));
    EXPECT_FALSE(only<PausePaging>(resume)->paused);
    EXPECT_TRUE(only<DropAll>(click(PanelId::Paging, "Drop all")));
}

TEST_F(PanelControls, aBadDiskIsTurnedOffButKeepsItsSeed) {
    openPlanet();
    settings_.paging.badDisk.latencyMs = 200;
    settings_.paging.badDisk.shuffledOrder = true;
    settings_.paging.badDisk.seed = 77;
    EXPECT_TRUE(click(PanelId::Paging, "/Off").empty());
    planet::BadDiskSettings expected;
    expected.seed = 77;
    EXPECT_EQ(settings_.paging.badDisk, expected);
}

TEST_F(PanelControls, framesAreSteppedOnlyWhilePaused) {
    EXPECT_TRUE(click(PanelId::Frame, "Step").empty());
    const Commands pause = click(PanelId::Frame, "Pause");
    ASSERT_TRUE(only<PauseFrames>(pause));
    EXPECT_TRUE(only<PauseFrames>(pause)->paused);
    view_.framesPaused = true;
    EXPECT_TRUE(only<StepFrame>(click(PanelId::Frame, "Step")));
}

TEST_F(PanelControls, theRampIsMadeOfStopsAndGivenUp) {
    click(PanelId::Surface, "Hypsometric");
    EXPECT_GT(settings_.surface.ramp.size(), 5u);
    const std::size_t stops = settings_.surface.ramp.size();
    click(PanelId::Surface, "Add a stop");
    EXPECT_EQ(settings_.surface.ramp.size(), stops + 1);
    click(PanelId::Surface, "Built-in");
    EXPECT_TRUE(settings_.surface.ramp.empty());
    click(PanelId::Surface, "Add a stop");
    EXPECT_EQ(settings_.surface.ramp.size(), 3u);
}

TEST_F(PanelControls, aRampSpansTrueHeightsUnderAnyExaggeration) {
    openPlanet();
    click(PanelId::Surface, "Grey");
    const std::vector<planet::gl::RampStop> ramp = settings_.surface.ramp;
    ASSERT_GT(ramp.back().heightM, ramp.front().heightM);
    planet_->setExaggeration(3);
    click(PanelId::Surface, "Grey");
    EXPECT_EQ(settings_.surface.ramp, ramp);
}

TEST_F(PanelControls, theLogIsCopiedAsItIsFiltered) {
    log_.push_back({LogLevel::Info, "14:03:22", "opened"});
    log_.push_back({LogLevel::Error, "14:03:23", "broken"});
    click(PanelId::Log, "info");
    const Commands copy = click(PanelId::Log, "Copy");
    ASSERT_TRUE(only<CopyText>(copy));
    EXPECT_EQ(only<CopyText>(copy)->text, "14:03:23 error    broken\n");
}

TEST_F(PanelControls, aNewLogLineIsShownAtOnce) {
    states_.log.filter = {'b', 'r'};
    for (int i = 0; i < 3; ++i) {
        log_.push_back({LogLevel::Error, "14:03:23", i == 1 ? "fine" : "broken"});
        frame(PanelId::Log);
    }
    EXPECT_EQ(states_.log.shown.lines, (std::vector<std::size_t>{0, 2}));
    // At its cap the log keeps its length.
    log_.pop_front();
    log_.push_back({LogLevel::Info, "14:03:24", "done"});
    frame(PanelId::Log);
    EXPECT_EQ(states_.log.shown.lines, (std::vector<std::size_t>{1}));
}

TEST_F(PanelControls, aLogLineLeadsToItsChunk) {
    log_.push_back({LogLevel::Error, "14:03:23", "chunk z_pos/3/1/2 is broken"});
    const Commands select = click(PanelId::Log, "line 0");
    ASSERT_TRUE(only<SelectChunk>(select));
    EXPECT_EQ(only<SelectChunk>(select)->id, (planet::ChunkId{planet::Face::PosZ, 3, 1, 2}));
}

}  // namespace
}  // namespace ui
