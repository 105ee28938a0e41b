// The window's pop meter: its panel driven without a window, and what it draws when one goes back to a pop.
#include "app/measure/pops.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <string_view>

#include "app/base/plot_scale.h"
#include "app/editor/instrument_views.h"
#include "planet/planet_tools.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/sudden_lod.h"
#include "ui/shell/panels.h"

namespace worldy {
namespace {

class PopsTest : public testing::Test {
protected:
    PopsTest() {
        planet_ = planet::openFake();
        view_.planet = planet_.get();
    }

    // Frames that are settled, one second apart.
    void settle(double altitudeM) {
        const planet::View view = planet::viewAt(30, 20, altitudeM);
        planet::LodSettings settings = planet::suddenLod();
        settings.tauPx = 0.5;
        planet_->settle(view, settings, planet::noUpload, planet::timeoutS);
        pops_.meter.add(planet_->tree(), planet_->selection(), view, settings, timeS_ += 1);
    }
    void flyUpAndDown() {
        for (const double altitudeM : {150e3, 8e3, 150e3, 20e3}) settle(altitudeM);
    }

    ui::Commands frame() {
        ui::Commands commands;
        view_.instruments.pops = popsViewOf(pops_);
        view_.frames.timeS += 1;
        window_.frame([&] { ui::drawPanel(PanelId::Pops, view_, states_, settings_, commands); });
        return commands;
    }

    // Presses at a share of a control's width, and returns what that asks for.
    ui::Commands click(std::string_view label, float share = 0.1f) {
        frame();
        frame();
        ui::Commands all;
        window_.click(label, share, [&] {
            if (running_) settle(20e3);
            ui::addAsked(frame(), all);
        });
        window_.movePointer({-1, -1});
        return all;
    }

    const planet::PopEvent& worst() const {
        const auto& events = pops_.meter.events();
        return *std::max_element(events.begin(), events.end(), [](const auto& a, const auto& b) {
            return a.jump.largestPx < b.jump.largestPx;
        });
    }

    ui::PanelWindow window_{{330, 1800}};
    std::unique_ptr<planet::Planet> planet_;
    Pops pops_;
    double timeS_ = 0;
    bool running_ = false;  // whether frames go on while a button is held
    FrameStats stats_;
    std::deque<ui::FrameSample> history_;
    planet::LodChanges changes_;
    std::deque<LogLine> log_;
    ui::EditorView view_{
        .frames = {.stats = stats_, .history = history_}, .log = log_, .instruments = {.changes = changes_}};
    ui::PanelStates states_;
    ViewSettings settings_;
};

TEST_F(PopsTest, ThePanelStandsWithoutPlanetAndWithoutPops) {
    EXPECT_TRUE(frame().empty());
    view_.planet = nullptr;
    EXPECT_TRUE(frame().empty());
    window_.resize({1400, 260});
    flyUpAndDown();
    view_.planet = planet_.get();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame().empty());
    EXPECT_EQ(settings_, ViewSettings{});
}

TEST_F(PopsTest, TheFirstRowIsTheWorstAndGoesBackToItsView) {
    flyUpAndDown();
    ASSERT_GT(pops_.meter.events().size(), 2u);
    running_ = true;
    click("Row 0", 0.03f);
    running_ = false;
    ASSERT_TRUE(states_.pops.selected);
    EXPECT_EQ(*states_.pops.selected, ui::keyOf(worst()));
    const ui::Commands back = click("Go to view");
    ASSERT_EQ(back.size(), 1u);
    const auto* command = back.front().as<ui::GoBackToPop>();
    ASSERT_TRUE(command);
    EXPECT_EQ(findPop(pops_, command->frame, command->chunk), &worst());
    EXPECT_FALSE(window_.isShown("Before"));
    pops_.shown = worst();
    const ui::Commands before = click("Before");
    ASSERT_EQ(before.size(), 1u);
    ASSERT_TRUE(before.front().as<ui::ShowPopSide>());
    EXPECT_EQ(before.front().as<ui::ShowPopSide>()->side, PopSide::Before);
}

TEST_F(PopsTest, AClickOnTheTimelineSelectsWhatIsThere) {
    flyUpAndDown();
    states_.pops.timeline.spanS = 4;
    frame();
    const planet::PopEvent& last = pops_.meter.events().back();
    const double share = 1 - (pops_.meter.lastTimeS() - last.timeS) / 4;
    click("Timeline", static_cast<float>(share) - 0.001f);
    ASSERT_TRUE(states_.pops.selected);
    EXPECT_EQ(states_.pops.selected->frame, last.frame);
}

TEST_F(PopsTest, TheWheelZoomsTheTimeline) {
    flyUpAndDown();
    frame();
    frame();
    const ui::ItemPlace timeline = *window_.find("Timeline");
    window_.movePointer({timeline.rect.x + timeline.rect.width / 2, timeline.rect.y + 10});
    frame();
    ImGui::GetIO().MouseWheel = 2;
    frame();
    EXPECT_LT(states_.pops.timeline.spanS, 60);
    EXPECT_GT(states_.pops.timeline.behindS, 0);
}

TEST_F(PopsTest, ClearAndMeasureAreAskedFor) {
    flyUpAndDown();
    const ui::Commands clear = click("Clear");
    ASSERT_EQ(clear.size(), 1u);
    EXPECT_TRUE(clear.front().as<ui::ClearPops>());
    const ui::Commands measure = click("Measure");
    ASSERT_EQ(measure.size(), 1u);
    ASSERT_TRUE(measure.front().as<ui::MeasurePops>());
    EXPECT_FALSE(measure.front().as<ui::MeasurePops>()->on);
    pops_.measuring = false;
    forgetPops(pops_);
    EXPECT_TRUE(pops_.meter.events().empty());
    EXPECT_FALSE(pops_.measuring);
}

TEST_F(PopsTest, BothSidesAreDrawnWithTheChunksWhereTheyAreNow) {
    flyUpAndDown();
    pops_.shown = worst();
    EXPECT_FALSE(keptPicture(planet_->tree(), pops_));
    for (const PopSide side : {PopSide::Before, PopSide::After}) {
        pops_.side = side;
        const auto frame = side == PopSide::Before ? worst().frameBefore.lock() : worst().frameAfter.lock();
        ASSERT_TRUE(frame);
        const std::optional<KeptPicture> kept = keptPicture(planet_->tree(), pops_);
        ASSERT_TRUE(kept) << pops_.problem;
        EXPECT_EQ(pops_.problem, "");
        ASSERT_EQ(kept->selection.draw.size(), frame->items.size());
        for (std::size_t i = 0; i < frame->items.size(); ++i) {
            const planet::DrawItem& item = kept->selection.draw[i];
            EXPECT_EQ(item.id, frame->items[i].id);
            EXPECT_EQ(item.morph, frame->items[i].morph);
            EXPECT_EQ(planet_->tree().nodes[item.node].id, item.id);
            EXPECT_EQ(planet_->tree().nodes[item.node].slot, item.slot);
        }
    }
}

TEST_F(PopsTest, WhatHasBeenDroppedIsSaid) {
    flyUpAndDown();
    pops_.shown = worst();
    pops_.side = worst().toLevel > worst().fromLevel ? PopSide::After : PopSide::Before;
    planet_->tools().dropAll();
    EXPECT_FALSE(keptPicture(planet_->tree(), pops_));
    EXPECT_NE(pops_.problem.find("not resident"), std::string::npos);
    pops_.meter.clear();
    EXPECT_FALSE(keptPicture(planet_->tree(), pops_));
    EXPECT_NE(pops_.problem.find("no longer stored"), std::string::npos);
}

}  // namespace
}  // namespace worldy
