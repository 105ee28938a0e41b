#include "app/editor/suggest_controller.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "app/editor/settings_controller.h"
#include "app/session/notices.h"
#include "app/session/session.h"
#include "app/settings/view_settings.h"
#include "app/suggest/suggest_meter.h"
#include "app/suggest/suggest_run.h"
#include "planet/tree/region.h"
#include "tests/app/session_fixture.h"
#include "ui/model/commands.h"

namespace worldy {
namespace {

TEST(SuggestController, applyingChangesWhatTheSuggestionChoseAndNothingElse) {
    ViewSettings now;
    now.lod.hysteresis = 0.3;
    now.overlay.wireframe = true;
    now.budget.triangles = 5000;
    SuggestOutcome outcome;
    outcome.settings.lod.tauPx = 5;
    outcome.settings.lod.metric = planet::ErrorMetric::Tight;
    outcome.settings.lod.morphRange = 0.15;
    outcome.settings.paging.budgetMB = 64;

    ViewSettings wanted = now;
    wanted.lod.tauPx = 5;
    wanted.lod.metric = planet::ErrorMetric::Tight;
    wanted.lod.morphRange = 0.15;
    wanted.paging.budgetMB = 64;
    wanted.budget.triangles = 0;
    EXPECT_EQ(settingsToApply(now, outcome), wanted);

    const std::vector<planet::Region> regions = {{.name = "suggested places", .tauFactor = 2}};
    outcome.found.best.candidate.regions = regions;
    const ViewSettings applied = settingsToApply(now, outcome);
    EXPECT_EQ(applied.regions.applied(), regions);
    EXPECT_EQ(settingsToApply(applied, outcome), applied);
}

TEST(SuggestController, applyingKeepsRegionsThatWereAddedWhileItSearched) {
    const planet::Region suggested{.name = "suggested places", .tauFactor = 2};
    const planet::Region added{.name = "peaks", .tauFactor = 0.5},
        ofSameName{.name = suggested.name, .tauFactor = 3};
    SuggestOutcome outcome;
    outcome.found.best.candidate.plan = "places";
    outcome.found.best.candidate.regions = {suggested};
    ViewSettings now;
    now.regions.list = std::make_shared<const std::vector<planet::Region>>(std::vector{added, ofSameName});
    planet::Region renamed = suggested;
    renamed.name = "suggested places 2";
    EXPECT_EQ(settingsToApply(now, outcome).regions.all(), (std::vector{added, ofSameName, renamed}));
}

TEST(SuggestController, aResultNamesItsPlanetAsTheWindowDid) {
    SuggestController controller;
    controller.planet = "earth.toml";
    controller.request.file = "/cache/earth-f359fddae3db3d98.chk";
    const ui::SuggestView view = suggestViewOf(controller, nullptr);
    EXPECT_EQ(view.planet, "earth.toml");
    EXPECT_EQ(view.openPlanet, "");
    EXPECT_FALSE(view.fitsPlanet);
}

TEST(SuggestController, applyingKeepsRegionsThatAreSwitchedOff) {
    const planet::Region mine{.name = "mine", .tauFactor = 4}, offAlready{.name = "off", .on = false};
    const planet::Region suggested{.name = "suggested places", .tauFactor = 2};
    planet::Region mineOff = mine;
    mineOff.on = false;
    ViewSettings now;
    now.regions.list = std::make_shared<const std::vector<planet::Region>>(std::vector{mine, offAlready});
    now.regions.file = "planet.regions.toml";
    const SuggestCandidate candidate{.regions = {suggested}};
    SuggestOutcome outcome;
    outcome.found.best.candidate = candidate;
    for (const bool areOn : {true, false}) {
        now.regions.on = areOn;
        const RegionSettings applied = settingsToApply(now, outcome).regions;
        EXPECT_TRUE(applied.on);
        EXPECT_EQ(applied.all(), (std::vector{areOn ? mine : mineOff, offAlready, suggested}));
        EXPECT_EQ(applied.file, now.regions.file);
        EXPECT_EQ(settingsWith(now, {}).regions, now.regions);
    }
}

// A suggestion of chunks of 17 for a planet that was opened as a chunk file with chunks of 33.
class AppliedSuggestion : public test::SessionTest {
protected:
    AppliedSuggestion() {
        const auto file = bakeTo("planet.chk", {.faceSize = 65, .chunkSize = 33});
        const planet::BakeSettings bake{.faceSize = 65, .chunkSize = 17};
        const auto other = bakeTo("other.chk", bake);
        session_ = sessionOf(file);
        EXPECT_TRUE(advanceUntil(session_, [&] { return shownPlanet(session_) != nullptr; }));
        followRegions(settings_, shownPlanet(session_)->data, notices_);
        const std::vector regions = {planet::Region{.name = "mine"}};
        regionList() = std::make_shared<const std::vector<planet::Region>>(regions);
        controller_.request.file = file;
        controller_.request.bakes = {folder_ / "slope.pgm", {{17, other, false, bake}}};
        SuggestOutcome& outcome = controller_.outcome.emplace();
        outcome.file = other;
        outcome.found.best.candidate.chunkSize = 17;
        outcome.settings.lod.tauPx = 5;
    }

    std::shared_ptr<const std::vector<planet::Region>>& regionList() {
        return settings_.settings.view.regions.list;
    }
    void apply() { execute(controller_, ui::ApplySuggest{}, {session_, settings_, false}, notices_); }
    int shownChunkSize() const { return planet::chunkSize(shownScene(session_)->planet->tree().shape); }

    Session session_;
    SettingsController settings_;
    SuggestController controller_;
    Notices notices_{log_};
};

TEST_F(AppliedSuggestion, opensItsChunksAndKeepsTheRegionsOfThePlanet) {
    EXPECT_TRUE(suggestViewOf(controller_, shownPlanet(session_)).fitsPlanet);
    apply();
    EXPECT_EQ(shownChunkSize(), 17);
    EXPECT_EQ(settings_.settings.view.lod.tauPx, 5);
    followRegions(settings_, shownPlanet(session_)->data, notices_);
    EXPECT_EQ(settings_.settings.view.regions.all().size(), 1u);
    EXPECT_TRUE(suggestViewOf(controller_, shownPlanet(session_)).fitsPlanet);
    EXPECT_EQ(notices_.message.title, "");
}

TEST_F(AppliedSuggestion, changesNothingWhileABakeRuns) {
    session_.bake.emplace();
    const ViewSettings before = settings_.settings.view;
    apply();
    EXPECT_EQ(shownChunkSize(), 33);
    EXPECT_EQ(settings_.settings.view, before);
    EXPECT_EQ(notices_.message.title, "The suggestion was not applied");
    session_.bake.reset();
}

TEST_F(AppliedSuggestion, aSearchThatCannotStartLeavesTheLastResult) {
    std::filesystem::remove(folder_ / "slope.pgm");
    execute(controller_, ui::StartSuggest{.budget = {}, .chunkSizes = {17}}, {session_, settings_, false},
            notices_);
    EXPECT_FALSE(controller_.job);
    EXPECT_TRUE(controller_.outcome);
    EXPECT_EQ(notices_.message.title, "The search cannot start");
}

}  // namespace
}  // namespace worldy
