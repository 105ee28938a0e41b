#include "ui/panels/sweep/suggest_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "app/suggest/suggest_run.h"
#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

class SuggestPanel : public testing::Test {
protected:
    SuggestPanel() {
        view_.planet = planet_.get();
        view_.camera.flights = flights_;
    }

    Commands frame() {
        Commands commands;
        window_.frame([&] { suggestPanel(view_, state_, commands); });
        return commands;
    }
    Commands clicked(std::string_view label) {
        Commands all;
        frame();
        frame();
        window_.click(label, 0.5f, [&] { addAsked(frame(), all); });
        return all;
    }
    // τ 2 exceeds a budget of 100,000 triangles; τ 4 meets it.
    void showResult() {
        outcome_.budget[SuggestLimit::Triangles] = 100'000;
        outcome_.found.before.candidate.tauPx = 2;
        outcome_.found.best.candidate.tauPx = 4;
        outcome_.beforeMeasured.figures.values = {0, 200'000, 1e6, 2};
        outcome_.measured.figures.values = {0, 99'000, 1e6, 4};
        outcome_.found.trials = {{outcome_.found.before.candidate, outcome_.beforeMeasured.figures},
                                 {outcome_.found.best.candidate, outcome_.measured.figures}};
        outcome_.isMet = true;
        SuggestPlace place;
        place.limit = SuggestLimit::Triangles;
        place.value = 99'000;
        outcome_.places = {place};
        SuggestView& shown = view_.instruments.suggest;
        shown.outcome = &outcome_;
        shown.fitsPlanet = true;
        shown.budget = outcome_.budget;
        shown.trials = outcome_.found.trials;
    }

    PanelWindow window_{{520, 2200}};
    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    const std::vector<std::filesystem::path> flights_ = {"/flights/down.toml", "/flights/along.toml"};
    SuggestOutcome outcome_;
    SuggestPanelState state_;
    EmptyView empty_;
    EditorView& view_ = empty_.view;
};

TEST_F(SuggestPanel, searchesTheBudgetsThatAreOnOverTheChosenFlights) {
    clicked("Limit Memory");
    clicked("Flight along");
    clicked("Vary regions");
    const Commands commands = clicked("Suggest");
    ASSERT_EQ(commands.size(), 1u);
    const StartSuggest* start = commands[0].as<StartSuggest>();
    ASSERT_TRUE(start);
    EXPECT_EQ(budgetText(start->budget), "200 k triangles, 1.5 px");
    EXPECT_EQ(start->flights, flights_);
    EXPECT_FALSE(start->surveys);
    EXPECT_FALSE(start->vary.regions);
    EXPECT_TRUE(start->vary.metric);
}

TEST_F(SuggestPanel, withoutABudgetAPlaceOrAPlanetNothingIsSearched) {
    state_.on.fill(false);
    EXPECT_TRUE(clicked("Suggest").empty());
    state_.on.fill(true);
    clicked("Flight down");
    EXPECT_TRUE(clicked("Suggest").empty());
    clicked("whole planet");
    EXPECT_EQ(clicked("Suggest").size(), 1u);
    view_.planet = nullptr;
    EXPECT_TRUE(frame().empty());
}

TEST_F(SuggestPanel, triesNeighbouringChunkSizesOnlyIfTheSourceIsThere) {
    clicked("Vary chunk size");
    Commands commands = clicked("Suggest");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<StartSuggest>()->chunkSizes.empty());
    view_.bake.canBake = true;
    clicked("Vary chunk size");
    commands = clicked("Suggest");
    ASSERT_EQ(commands.size(), 1u);
    const int own = planet::chunkSize(planet_->tree().shape);
    const std::vector<int>& others = commands[0].as<StartSuggest>()->chunkSizes;
    EXPECT_FALSE(others.empty());
    for (const int size : others) EXPECT_TRUE(size - 1 == 2 * (own - 1) || 2 * (size - 1) == own - 1) << size;
}

TEST_F(SuggestPanel, aRunningSearchIsCancelled) {
    view_.instruments.suggest.running = true;
    SuggestProgress& progress = view_.instruments.suggest.progress;
    progress.stage = SuggestStage::Searching;
    progress.measured = 3;
    progress.ahead = 20;
    progress.leftS = 4;
    const Commands commands = clicked("Cancel");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<CancelSuggest>());
}

TEST_F(SuggestPanel, theResultIsAppliedSavedAndShown) {
    showResult();
    Commands commands = clicked("Apply");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<ApplySuggest>());
    commands = clicked("Save report");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<SaveSuggest>());
    commands = clicked("Go 0");
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_TRUE(commands[0].as<MoveCamera>());
    clicked("Row 1");
    EXPECT_EQ(state_.selected, 1u);
}

TEST_F(SuggestPanel, settingsThatStayAsTheyAreCannotBeApplied) {
    showResult();
    outcome_.found.best.candidate = outcome_.found.before.candidate;
    outcome_.isMet = false;
    EXPECT_TRUE(clicked("Apply").empty());
}

TEST_F(SuggestPanel, aBudgetThatCannotBeReadIsNotSearched) {
    EXPECT_EQ(clicked("Suggest").size(), 1u);
    state_.edits[1].problem = "\"20 q\" is no triangles";
    EXPECT_TRUE(clicked("Suggest").empty());
    state_.on[1] = false;
    EXPECT_EQ(clicked("Suggest").size(), 1u);
}

TEST_F(SuggestPanel, aTypedBudgetTakesItsUnit) {
    frame();
    frame();
    window_.click("/Triangles", 0.5f, [&] { frame(); });
    ImGui::GetIO().AddInputCharactersUTF8("20k");
    frame();
    frame();
    EXPECT_EQ(state_.limits[1], 20'000);
}

TEST_F(SuggestPanel, aResultOfAnotherPlanetCannotBeApplied) {
    showResult();
    view_.instruments.suggest.fitsPlanet = false;
    EXPECT_TRUE(clicked("Apply").empty());
    EXPECT_TRUE(clicked("Go 0").empty());
}

}  // namespace
}  // namespace worldy::ui
