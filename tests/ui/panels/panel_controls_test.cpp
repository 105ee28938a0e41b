// Presses the panels' controls without a window: ImGui with a mouse of the test's own, and a small planet.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "planet/planet_tools.h"
#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/exports.h"
#include "ui/shell/panels.h"

namespace worldy::ui {
namespace {

class PanelControls : public testing::Test {
protected:
    void openPlanet() {
        planet_ = planet::openFake();
        const planet::View view = planet::viewFromPose({.altitudeM = planet_->tree().shape.radiusM},
                                                       planet_->tree().shape.radiusM, 1.05, 640, 480);
        planet_->settle(
            view, {}, [](std::uint32_t, planet::StepsView) {}, planet::timeoutS);
        view_.planet = planet_.get();
        view_.camera.lodView = view;
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
        // Not at 0.1 of a wide table, where two of its columns may meet.
        window_.click(label, 0.08f, [&] { addAsked(frame(id), all); });
        return all;
    }

    PanelWindow window_{{400, 1600}};
    std::unique_ptr<planet::Planet> planet_;
    EmptyView empty_;
    EditorView& view_ = empty_.view;
    PanelStates states_;
    ViewSettings settings_;
    int wantedChunkSize_ = 0;  // as if it had been chosen from the list
};

template <class T>
const T* only(const Commands& commands) {
    return commands.size() == 1 ? commands.front().as<T>() : nullptr;
}

constexpr std::array ownPanels = {PanelId::Lod,   PanelId::Paging, PanelId::Seams, PanelId::Surface,
                                  PanelId::Frame, PanelId::Log,    PanelId::Sweep};

TEST_F(PanelControls, aBudgetTakesTheToleranceFromTheUser) {
    openPlanet();
    click(PanelId::Lod, "Tolerance τ");
    const double clickedPx = settings_.lod.tauPx;
    EXPECT_NE(clickedPx, 2);
    settings_.budget.triangles = 600'000;
    empty_.stats.budget = {
        .isOn = true, .isMeasured = true, .binds = planet::GovernorBudget::Triangles, .use = 0.9};
    empty_.stats.budget.uses[2] = 0.9;
    window_.movePointer({-1, -1});
    settings_.lod.tauPx = 2;
    click(PanelId::Lod, "Tolerance τ");
    EXPECT_EQ(settings_.lod.tauPx, 2);
    // Without one, its limits cannot be changed.
    settings_.budget = {};
    click(PanelId::Lod, "Least τ");
    EXPECT_EQ(settings_.budget, BudgetSettings{});
}

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
    const Commands freeze = click(PanelId::Lod, "Freeze");
    ASSERT_TRUE(only<FreezeLod>(freeze));
    EXPECT_TRUE(only<FreezeLod>(freeze)->frozen);
    view_.camera.lodFrozen = true;
    const Commands thaw = click(PanelId::Lod, "Freeze");
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
    wantedChunkSize_ = planet::chunkSize(planet_->tree().shape);
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
    EXPECT_TRUE(only<DropAll>(click(PanelId::Paging, "Evict all")));
}

TEST_F(PanelControls, blocksThatCouldNotBeReadAreListedAndTriedAgainOneByOneOrAll) {
    planet::Faulty faulty;
    planet_ = planet::openFake(faulty.source());
    planet::LodSettings fine = planet::fineSettings();
    fine.frustumCulling = fine.horizonCulling = false;
    fine.tauPx = 0.02;
    ASSERT_TRUE(planet_->settle(planet::viewAt(10, 20, 2e4), fine, planet::noUpload, planet::timeoutS));
    view_.planet = planet_.get();
    view_.camera.lodView = planet_->views()[0].input.lodView;
    empty_.stats.paging = planet_->paging();
    const std::vector<planet::FailedBlock> failed = planet_->inspect().failedBlocks();
    ASSERT_GT(failed.size(), 2u);
    const Commands all = click(PanelId::Paging, "Retry failed");
    ASSERT_TRUE(only<RetryFailed>(all));
    EXPECT_FALSE(only<RetryFailed>(all)->block);
    EXPECT_FALSE(window_.isShown("Retry " + toString(failed[1].block)));
    EXPECT_TRUE(click(PanelId::Paging, "Failed blocks").empty());
    for (int i = 0; i < 12; ++i) {
        view_.frames.timeS += 0.1;
        frame(PanelId::Paging);
    }
    const Commands one = click(PanelId::Paging, "Retry " + toString(failed[1].block));
    ASSERT_TRUE(only<RetryFailed>(one));
    EXPECT_EQ(only<RetryFailed>(one)->block, failed[1].block);
    // Without any, the list says so and asks for nothing.
    faulty.broken = false;
    planet_->tools().retryFailed();
    empty_.stats.paging = planet_->paging();
    for (int i = 0; i < 12; ++i) {
        view_.frames.timeS += 0.1;
        EXPECT_TRUE(frame(PanelId::Paging).empty());
    }
    EXPECT_TRUE(click(PanelId::Paging, "Retry failed").empty());
    EXPECT_FALSE(window_.isShown("Retry " + toString(failed[1].block)));
}

TEST_F(PanelControls, aRowOfColoursSelectsTheChunkOnItsGround) {
    openPlanet();
    const planet::ChunkTree& tree = planet_->tree();
    // Far below what is resident.
    const planet::ChunkId deep{planet::Face::PosY, 12, 77, 1234};
    const planet::ChunkId chunk = chunkAround(tree, deep);
    EXPECT_NE(planet::findNode(tree, chunk), planet::noNode);
    EXPECT_EQ(planet::ancestorOf(deep, chunk.level), chunk);
    EXPECT_EQ(planet::findNode(tree, planet::ancestorOf(deep, chunk.level + 1)), planet::noNode);
    EXPECT_EQ(chunkAround(tree, tree.nodes[0].id), tree.nodes[0].id);
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
    view_.frames.paused = true;
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

TEST_F(PanelControls, layersAreAddedCopiedMovedAndRemoved) {
    const planet::LayerSet earth = settings_.surface.layers.set;
    const auto& layers = settings_.surface.layers.set.layers;
    ASSERT_EQ(layers.size(), planet::maxLayers);
    click(PanelId::Surface, "layer rock");
    EXPECT_EQ(states_.surface.layers.chosen, 1u);
    click(PanelId::Surface, "/Add");
    click(PanelId::Surface, "/Copy");
    EXPECT_EQ(layers.size(), planet::maxLayers) << "no more fit";
    click(PanelId::Surface, "/Up");
    EXPECT_EQ(layers[2], earth.layers[1]);
    click(PanelId::Surface, "/Down");
    EXPECT_EQ(settings_.surface.layers.set, earth);
    click(PanelId::Surface, "/Remove");
    EXPECT_EQ(layers[1], earth.layers[2]);
    click(PanelId::Surface, "/Copy");
    EXPECT_EQ(layers[2].name, "grass 2");
    EXPECT_EQ(layers[2].albedo, layers[1].albedo);
    while (!layers.empty()) click(PanelId::Surface, "/Remove");
    EXPECT_FALSE(window_.isShown("/Scale"));
    click(PanelId::Surface, "/Add");
    EXPECT_EQ(layers.size(), 1u);
    EXPECT_TRUE(window_.isShown("/Scale"));
}

TEST_F(PanelControls, layersAreMutedAndMadeSoloInTheirRow) {
    click(PanelId::Surface, "mute grass");
    EXPECT_TRUE(settings_.surface.layers.set.layers[2].muted);
    click(PanelId::Surface, "mute grass");
    EXPECT_FALSE(settings_.surface.layers.set.layers[2].muted);
    click(PanelId::Surface, "solo snow");
    EXPECT_TRUE(settings_.surface.layers.set.layers[5].solo);
    EXPECT_FALSE(planet::isDrawn(settings_.surface.layers.set, 2));
}

TEST_F(PanelControls, thePreviewFollowsTheChosenLayer) {
    click(PanelId::Surface, "layer forest");
    EXPECT_EQ(settings_.surface.layers.previewed, 1) << "nothing to undo while it is off";
    settings_.surface.layers.preview = planet::gl::LayerPreview::Heat;
    click(PanelId::Surface, "layer snow");
    EXPECT_EQ(settings_.surface.layers.previewed, 6);
}

TEST_F(PanelControls, aLayerSetIsSavedUnderItsName) {
    const std::string_view name = "mine";
    name.copy(states_.surface.layers.newName.data(), name.size());
    const Commands save = click(PanelId::Surface, "/Save##set");
    ASSERT_TRUE(only<SaveLayerSet>(save));
    EXPECT_EQ(only<SaveLayerSet>(save)->name, "mine");
    EXPECT_TRUE(click(PanelId::Surface, "/Save##set").empty()) << "a name is saved once";
}

TEST_F(PanelControls, aLayerSetThatWasRefusedKeepsItsName) {
    const std::string_view name = "flight";
    name.copy(states_.surface.layers.newName.data(), name.size());
    view_.layers.setProblem = "flight.toml: exists and is not a layer set";
    ASSERT_TRUE(only<SaveLayerSet>(click(PanelId::Surface, "/Save##set")));
    EXPECT_EQ(std::string_view(states_.surface.layers.newName.data()), "flight");
}

TEST_F(PanelControls, aFileThatIsNoPresetIsNotReplaced) {
    const std::array presets = {PresetView{.name = "broken", .problem = "line 1"}, PresetView{.name = "own"}};
    view_.settings.presets = presets;
    const auto replaced = [&](std::string_view name) {
        states_.presets.name.fill(0);
        name.copy(states_.presets.name.data(), name.size());
        return only<SavePreset>(click(PanelId::Presets, "Replace")) != nullptr;
    };
    EXPECT_FALSE(replaced("broken"));
    EXPECT_TRUE(replaced("own"));
}

TEST_F(PanelControls, theLogIsCopiedAsItIsFiltered) {
    empty_.log.push_back({LogLevel::Info, "14:03:22", "opened"});
    empty_.log.push_back({LogLevel::Error, "14:03:23", "broken"});
    click(PanelId::Log, "info");
    Commands sent;
    ExportState exports;
    const auto draw = [&] {
        beginExports(exports, sent);
        frame(PanelId::Log);
        endExports();
    };
    for (const char* item : {"log menu", "Save all as CSV"}) {
        for (int i = 0; i < 2; ++i) draw();
        window_.click(item, 0.5f, draw);
    }
    ASSERT_EQ(sent.size(), 1u);
    ASSERT_TRUE(sent[0].as<SaveExport>());
    EXPECT_EQ(sent[0].as<SaveExport>()->text,
              "schema_version,time,level,text\r\n2,14:03:23,error,broken\r\n");
}

TEST_F(PanelControls, aNewLogLineIsShownAtOnce) {
    states_.log.filter.text = {'b', 'r'};
    for (int i = 0; i < 3; ++i) {
        empty_.log.push_back({LogLevel::Error, "14:03:23", i == 1 ? "fine" : "broken"});
        frame(PanelId::Log);
    }
    EXPECT_EQ(states_.log.shown.lines, (std::vector<std::size_t>{0, 2}));
    // At its cap the log keeps its length.
    empty_.log.pop_front();
    empty_.log.push_back({LogLevel::Info, "14:03:24", "done"});
    frame(PanelId::Log);
    EXPECT_EQ(states_.log.shown.lines, (std::vector<std::size_t>{1}));
}

TEST_F(PanelControls, aLogLineLeadsToItsChunk) {
    empty_.log.push_back({LogLevel::Error, "14:03:23", "chunk z_pos/3/1/2 is broken"});
    const Commands select = click(PanelId::Log, "line 0");
    ASSERT_TRUE(only<SelectChunk>(select));
    EXPECT_EQ(only<SelectChunk>(select)->id, (planet::ChunkId{planet::Face::PosZ, 3, 1, 2}));
}

// The Sweep panel, with one flight.
class SweepControls : public PanelControls {
protected:
    SweepControls() {
        openPlanet();
        view_.camera.flights = flights_;
        view_.data.source = "/data/heights.tif";
        view_.camera.renderView.widthPx = 640;
        view_.camera.renderView.heightPx = 480;
        table_.source = "/data/heights.tif";
        table_.points = {{17, planet::ErrorMetric::Additive, 1}, {own(), planet::ErrorMetric::Tight, 3}};
        table_.points[0].figures = {12, 9000, 9500, 40, 8, 5, 1, 0.5, 0.3, 0.6, 0};
        table_.points[1].figures = {12, 2000, 2500, 10, 4, 3, 3, 1.5, 0.9, 1.6, 0};
        table_.whole = true;
    }
    int own() const { return planet::chunkSize(planet_->tree().shape); }
    const std::vector<std::filesystem::path> flights_ = {"/flights/orbit_to_ground.toml"};
    SweepTable table_;
};

TEST_F(SweepControls, runAsksForWhatTheControlsSay) {
    const Commands run = click(PanelId::Sweep, "/Run");
    ASSERT_TRUE(only<StartSweep>(run));
    const SweepRequest& request = only<StartSweep>(run)->request;
    EXPECT_EQ(request.flight, flights_[0]);
    EXPECT_EQ(request.tausPx, (std::vector{0.5, 1.0, 2.0, 4.0, 8.0}));
    EXPECT_EQ(request.chunkSizes, std::vector{own()});
    EXPECT_EQ(request.metrics.size(), 2u);
    EXPECT_EQ(request.widthPx, 640);
    EXPECT_FALSE(request.goal);
}

TEST_F(SweepControls, nothingIsRunWithWrongTolerancesOrWithoutAMetricOrASize) {
    states_.sweep.taus = {"1 two"};
    EXPECT_TRUE(click(PanelId::Sweep, "/Run").empty());
    states_.sweep.taus = {"1 2"};
    EXPECT_TRUE(click(PanelId::Sweep, "/additive").empty());
    EXPECT_TRUE(only<StartSweep>(click(PanelId::Sweep, "/Run")));
    click(PanelId::Sweep, "/tight");
    EXPECT_TRUE(click(PanelId::Sweep, "/Run").empty());
    EXPECT_TRUE(click(PanelId::Sweep, "/Suggest").empty());
    click(PanelId::Sweep, "/tight");
    click(PanelId::Sweep, "/Chunk " + std::to_string(own()));
    EXPECT_TRUE(click(PanelId::Sweep, "/Run").empty());
}

TEST_F(SweepControls, otherChunkSizesNeedTheSource) {
    const int other = own() == 17 ? 33 : 17;
    const std::string box = "/Chunk " + std::to_string(other);
    click(PanelId::Sweep, box);
    EXPECT_EQ(only<StartSweep>(click(PanelId::Sweep, "/Run"))->request.chunkSizes, std::vector{own()});
    view_.bake.canBake = true;
    click(PanelId::Sweep, box);
    const Commands run = click(PanelId::Sweep, "/Run");
    ASSERT_TRUE(only<StartSweep>(run));
    const bool fits = other - 1 <= planet::faceCells(planet_->tree().shape);
    EXPECT_EQ(only<StartSweep>(run)->request.chunkSizes.size(), fits ? 2u : 1u);
}

TEST_F(SweepControls, whatRunsCanOnlyBeCancelled) {
    view_.sweep.running = true;
    view_.sweep.progress.flights = 10;
    frame(PanelId::Sweep);
    EXPECT_FALSE(window_.isShown("/Run"));
    EXPECT_TRUE(only<CancelSweep>(click(PanelId::Sweep, "/Cancel")));
    EXPECT_TRUE(click(PanelId::Sweep, "/Suggest").empty());
    view_.sweep.cancelling = true;
    EXPECT_TRUE(click(PanelId::Sweep, "/Cancel").empty());
}

TEST_F(SweepControls, suggestAsksForTheGoalOverThePlanetAsItIs) {
    states_.sweep.goal = 1;
    states_.sweep.limits[1] = 50'000;
    const Commands asked = click(PanelId::Sweep, "/Suggest");
    ASSERT_TRUE(only<StartSweep>(asked));
    const SweepRequest& request = only<StartSweep>(asked)->request;
    ASSERT_TRUE(request.goal);
    EXPECT_FALSE(request.goal->limitsError);
    EXPECT_EQ(request.goal->cost, SweepCost::Triangles);
    EXPECT_EQ(request.goal->limit, 50'000);
    EXPECT_TRUE(request.chunkSizes.empty());
}

TEST_F(SweepControls, anAnswerIsTakenOverIntoTheSettingsWhereItMeetsTheGoal) {
    const std::vector<SweepSuggestion> found = {
        {33, planet::ErrorMetric::Additive, {true, SweepCost::Triangles, 1}, {0.1, 1.2, false, 1}},
        {33, planet::ErrorMetric::Tight, {true, SweepCost::Triangles, 1}, {1.83, 0.98, true, 7}}};
    view_.sweep.suggestions = found;
    frame(PanelId::Sweep);
    EXPECT_FALSE(window_.isShown("/Apply: additive"));
    EXPECT_TRUE(click(PanelId::Sweep, "/Apply: tight").empty());
    EXPECT_EQ(settings_.lod.tauPx, 1.83);
    EXPECT_EQ(settings_.lod.metric, planet::ErrorMetric::Tight);
}

TEST_F(SweepControls, aRowIsSelectedAndItsSettingsAreUsed) {
    view_.sweep.table = &table_;
    EXPECT_TRUE(click(PanelId::Sweep, "/Use these settings").empty());
    EXPECT_EQ(settings_, ViewSettings{});
    click(PanelId::Sweep, "/Row 1");
    EXPECT_EQ(states_.sweep.selected, 1u);
    EXPECT_TRUE(click(PanelId::Sweep, "/Use these settings").empty());
    EXPECT_EQ(settings_.lod.tauPx, 3);
    EXPECT_EQ(settings_.lod.metric, planet::ErrorMetric::Tight);
    table_.points[1].chunkSize = 129;
    const Commands use = click(PanelId::Sweep, "/Use these settings");
    ASSERT_TRUE(only<OpenSweptChunks>(use));
    EXPECT_EQ(only<OpenSweptChunks>(use)->chunkSize, 129);
    // Chunks of another planet are not what is meant.
    view_.data.source = "/data/mars.tif";
    EXPECT_TRUE(click(PanelId::Sweep, "/Use these settings").empty());
}

TEST_F(SweepControls, aPointOfThePlotIsSelectedByAClick) {
    view_.sweep.table = &table_;
    click(PanelId::Sweep, "/Point 0");
    EXPECT_EQ(states_.sweep.selected, 0u);
}

TEST_F(SweepControls, onlyAWholeTableIsSaved) {
    view_.sweep.table = &table_;
    states_.sweep.cost = SweepCost::MemoryMiB;
    const Commands save = click(PanelId::Sweep, "/Save table and plot");
    ASSERT_TRUE(only<SaveSweep>(save));
    EXPECT_EQ(only<SaveSweep>(save)->cost, SweepCost::MemoryMiB);
    table_.whole = false;
    EXPECT_TRUE(click(PanelId::Sweep, "/Save table and plot").empty());
}

TEST_F(SweepControls, withoutAFlightItSaysWhereOneComesFrom) {
    view_.camera.flights = {};
    frame(PanelId::Sweep);
    EXPECT_FALSE(window_.isShown("/Run"));
    const std::vector<RecordedFlight> recorded = {{"mine", "/recordings/mine.flight", 100}};
    view_.recording.flights = recorded;
    const Commands run = click(PanelId::Sweep, "/Run");
    ASSERT_TRUE(only<StartSweep>(run));
    EXPECT_EQ(only<StartSweep>(run)->request.flight, recorded[0].file);
}

TEST_F(PanelControls, comparingBeginsWithKeptSettingsAndEnds) {
    frame(PanelId::Compare);
    EXPECT_FALSE(window_.isShown("Snapshot as B"));
    openPlanet();
    const Commands start = click(PanelId::Compare, "Snapshot as B");
    ASSERT_TRUE(only<StartCompare>(start));
    EXPECT_EQ(only<StartCompare>(start)->with, StartCompare::With::SettingsKept);
    EXPECT_FALSE(window_.isShown("Swap A and B"));

    const ViewSettings settingsOfB;
    view_.compare.on = true;
    view_.compare.planetB = planet_.get();
    view_.compare.settingsB = &settingsOfB;
    EXPECT_TRUE(only<SwapCompare>(click(PanelId::Compare, "Swap A and B")));
    EXPECT_TRUE(only<StopCompare>(click(PanelId::Compare, "End comparison")));
    EXPECT_TRUE(only<MeasureCompare>(click(PanelId::Compare, "Measure this view")));
    settings_.compare.mode = CompareMode::Flip;
    click(PanelId::Compare, "Show B");
    EXPECT_TRUE(settings_.compare.showB);
    EXPECT_FALSE(window_.isShown("Divider"));
    settings_.compare.mode = CompareMode::Wipe;
    frame(PanelId::Compare);
    EXPECT_TRUE(window_.isShown("Divider"));
}

TEST_F(PanelControls, aComparisonOverAFlightIsStartedAndCancelled) {
    openPlanet();
    const ViewSettings settingsOfB;
    const std::vector<std::filesystem::path> flights = {"/flights/over_there.toml"};
    view_.camera.flights = flights;
    view_.compare.on = true;
    view_.compare.planetB = planet_.get();
    view_.compare.settingsB = &settingsOfB;
    const Commands run = click(PanelId::Compare, "Measure over the flight");
    ASSERT_TRUE(only<CompareOverFlight>(run));
    EXPECT_EQ(only<CompareOverFlight>(run)->flight, flights[0]);
    EXPECT_EQ(only<CompareOverFlight>(run)->moments, 12);
    view_.compare.flight.running = true;
    EXPECT_TRUE(only<CancelCompareFlight>(click(PanelId::Compare, "Cancel")));
    EXPECT_FALSE(window_.isShown("Measure over the flight"));
}

TEST_F(PanelControls, theCameraPanelSaysWhichDevicesSteer) {
    openPlanet();
    EXPECT_TRUE(click(PanelId::Camera, "Invert up and down").empty());  // grey without a device
    std::vector<SteeringState> devices = {gamepadState("Xbox Controller", {}, {}), {.name = "Old wheel"}};
    view_.camera.steering = {devices, 1.5, false};
    const Commands commands = click(PanelId::Camera, "Invert up and down");
    ASSERT_EQ(commands.size(), 1u);
    const auto* const set = commands.front().as<SetSteering>();
    ASSERT_TRUE(set);
    EXPECT_TRUE(set->inverted);
    EXPECT_EQ(set->sensitivity, 1.5);
    devices.erase(devices.begin());
    view_.camera.steering = {devices, 1.5, false};
    EXPECT_TRUE(click(PanelId::Camera, "Invert up and down").empty());
}

}  // namespace
}  // namespace worldy::ui
