// Budgets of the settings move τ, and what binds is said in words.
#include "app/scene/governing.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/support/planet_fixture.h"

namespace worldy {
namespace {

using planet::GovernorBudget;
using planet::GovernorLimit;

class GovernedTau : public testing::Test {
protected:
    // A frame that the planet selects with the settings' τ.
    void frame() {
        const std::array views = {planet::ViewInput{.lodView = planet::viewAt(10, 20), .lod = settings_.lod}};
        planet_->step(views, planet::noUpload, 1.0 / 60);
        stats_.tauPx = settings_.lod.tauPx;
        stats_.selection = planet_->selection().counters;
    }
    void govern() { governTau(governing_, &stats_, *planet_, 1.0 / 60, settings_); }

    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    ViewSettings settings_;
    FrameStats stats_;
    Governing governing_;
};

TEST_F(GovernedTau, changesNothingWithoutABudget) {
    frame();
    const ViewSettings before = settings_;
    govern();
    EXPECT_EQ(settings_, before);
    EXPECT_FALSE(governing_.use.isOn);
    EXPECT_FALSE(isSettling(governing_));
}

TEST_F(GovernedTau, followsABudgetAndGivesTheUsersTauBack) {
    settings_.lod.tauPx = 3;
    settings_.budget.triangles = 1;
    settings_.budget.mostTauPx = 20;
    for (int i = 0; i < 30; ++i) frame(), govern();
    EXPECT_EQ(settings_.lod.tauPx, 20);
    EXPECT_TRUE(governing_.use.isMeasured);
    EXPECT_EQ(governing_.use.limit, GovernorLimit::MostTau);
    EXPECT_EQ(governing_.ownTauPx, 3);
    // A τ that the user sets while a budget is on is kept, and returns when the budget is turned off.
    settings_.lod.tauPx = 5;
    govern();
    EXPECT_EQ(settings_.lod.tauPx, 20);
    settings_.budget.triangles = 0;
    govern();
    EXPECT_EQ(settings_.lod.tauPx, 5);
    EXPECT_FALSE(governing_.use.isOn);
}

// Loads a fine picture, which a budget of one triangle then makes coarse over several levels.
class CatchingUp : public GovernedTau {
protected:
    void SetUp() override {
        settings_.lod.fadeS = 0.4;
        settings_.lod.tauPx = 0.3;
        ASSERT_TRUE(
            planet_->settle(planet::viewAt(10, 20), settings_.lod, planet::noUpload, planet::timeoutS));
        settings_.budget.triangles = 1;
        settings_.budget.mostTauPx = 20;
        for (int i = 0; i < 3; ++i) frame(), govern();
        ASSERT_LT(settings_.lod.fadeS, 0.4);
    }
};

TEST_F(CatchingUp, shortensFadesUntilItIsDone) {
    EXPECT_EQ(ungoverned(governing_, settings_).lod.fadeS, 0.4);
    for (int i = 0; i < 120; ++i) frame(), govern();
    EXPECT_EQ(settings_.lod.fadeS, 0.4);
}

TEST_F(CatchingUp, givesTheUsersFadeBackWhenTheBudgetIsTurnedOff) {
    settings_.budget.triangles = 0;
    govern();
    EXPECT_EQ(settings_.lod.fadeS, 0.4);
    EXPECT_EQ(settings_.lod.tauPx, 0.3);
}

TEST_F(CatchingUp, keepsTheUsersFadeForAnotherPlanet) {
    forgetCosts(governing_);
    EXPECT_EQ(ungoverned(governing_, settings_).lod.fadeS, 0.4);
}

TEST_F(CatchingUp, doesNotTouchFadesWithoutMorph) {
    settings_.lod.morph = false;
    for (int i = 0; i < 3; ++i) frame(), govern();
    EXPECT_EQ(settings_.lod.fadeS, 0.4);
}

// A preset or a suggestion that also turns the budget off, and an edit that Undo must see.
TEST_F(CatchingUp, whatTheUserSetsInTheSameFrameIsKept) {
    settings_.lod.fadeS = 0.7;
    settings_.lod.tauPx = 3;
    EXPECT_EQ(ungoverned(governing_, settings_), settings_);
    settings_.budget.triangles = 0;
    govern();
    EXPECT_EQ(settings_.lod.fadeS, 0.7);
    EXPECT_EQ(settings_.lod.tauPx, 3);
}

TEST_F(GovernedTau, settlesUntilItHasBeenStillForAWhile) {
    settings_.budget.triangles = 100'000'000;
    settings_.budget.leastTauPx = settings_.lod.tauPx;
    frame();
    govern();
    EXPECT_TRUE(isSettling(governing_));
    for (int i = 0; i < 120; ++i) frame(), govern();
    EXPECT_FALSE(isSettling(governing_));
}

TEST_F(GovernedTau, samplesAreWhatTheFrameCost) {
    frame();
    stats_.stages = {.uploadMs = 0.1, .selectMs = 0.2, .pagingMs = 0.4};
    stats_.drawCpuMs = 1;
    stats_.overlaysMs = 2;
    stats_.panelsMs = 4;
    stats_.presentMs = 100;  // waits for the monitor
    stats_.render.chunksMs = 8;
    stats_.render.skyMs = 16;
    stats_.render.shadowsMs = 32;
    stats_.panelsGpuMs = 64;
    stats_.selection.waiting = stats_.selection.drawn;
    const planet::GovernorSample sample = governorSampleOf(stats_, *planet_, settings_.lod, 1000, 0.5);
    EXPECT_NEAR(sample.cost.cpuMs, 7.7, 1e-12);
    EXPECT_EQ(sample.cost.gpuMs, 120);
    EXPECT_EQ(sample.cost.triangles, static_cast<double>(stats_.selection.triangles()));
    EXPECT_EQ(sample.cost.memoryBytes,
              static_cast<double>(planet::bytesOf(planet::neededChunks(planet_->selection()))));
    EXPECT_EQ(sample.cost.readBytesPerS, 2000);
    EXPECT_EQ(sample.tauPx, 2);
    EXPECT_EQ(sample.waitingShare, 1);
}

TEST_F(GovernedTau, theSettingsOfTheSelectionReachTheGovernor) {
    settings_.budget = {
        .cpuMs = 1, .gpuMs = 2, .triangles = 3, .memoryMB = 4, .readMBs = 5, .hysteresis = 0.2};
    settings_.lod.fadeS = 0.7;
    settings_.lod.hysteresis = 0.3;
    planet::GovernorSettings governor = governorSettingsOf(settings_);
    EXPECT_EQ(governor.budget, (planet::GovernorCosts{1, 2, 3, 4 << 20, 5e6}));
    EXPECT_EQ(governor.hysteresis, 0.2);
    EXPECT_EQ(governor.fadeS, 0.7);
    EXPECT_EQ(governor.lodHysteresis, 0.3);
    settings_.lod.morph = false;
    EXPECT_EQ(governorSettingsOf(settings_).fadeS, 0);
}

TEST(BudgetTexts, sayWhatBinds) {
    BudgetUse use;
    EXPECT_EQ(bindsText(use, "τ"), "No budget is on");
    use.isOn = true;
    EXPECT_EQ(bindsText(use, "τ"), "No cost is measured yet");
    EXPECT_EQ(bindsKey(use), "none");
    use.isMeasured = true;
    use.binds = GovernorBudget::GpuTime;
    EXPECT_EQ(bindsText(use, "τ"), "GPU time binds");
    EXPECT_EQ(bindsKey(use), "gpu_time");
    use.limit = GovernorLimit::LeastTau;
    EXPECT_EQ(bindsText(use, "τ"), "τ is at its lower limit");
    EXPECT_EQ(bindsKey(use), "lower_limit");
    use.limit = GovernorLimit::MostTau;
    use.binds = GovernorBudget::Triangles;
    EXPECT_EQ(bindsText(use, "tau"), "Triangles bind; tau is at its upper limit");
    EXPECT_EQ(bindsKey(use), "upper_limit");
}

TEST(BudgetTexts, costsStandBesideTheirBudgets) {
    BudgetUse use;
    use.uses = {0.5, 0.25, 1.5, 0.1, 0.02};
    const BudgetSettings budget{
        .cpuMs = 8, .gpuMs = 12.5, .triangles = 600'000, .memoryMB = 256, .readMBs = 20};
    EXPECT_EQ(costText(GovernorBudget::CpuTime, use, budget), "4.0 of 8 ms");
    EXPECT_EQ(costText(GovernorBudget::GpuTime, use, budget), "3.1 of 12.5 ms");
    EXPECT_EQ(costText(GovernorBudget::Triangles, use, budget), "900 k of 600 k");
    EXPECT_EQ(costText(GovernorBudget::Memory, use, budget), "25.6 of 256 MiB");
    EXPECT_EQ(costText(GovernorBudget::Reading, use, budget), "0.40 of 20 MB/s");
}

}  // namespace
}  // namespace worldy
