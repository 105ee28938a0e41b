#include "ui/panels/measure/ruler_panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/kit/exports.h"
#include "ui/model/figures.h"
#include "ui/panels/measure/ruler_profile.h"

namespace worldy::ui {
namespace {

// Three places of a planet of 1000 km: finest heights 0, 100 and 50 m; nothing is drawn at the last one.
MeasuredGround threePlaces() {
    MeasuredGround measured;
    measured.profile.radiusM = 1e6;
    const auto add = [&](double alongM, double finestM, std::optional<double> drawnM) {
        const double turned = alongM / measured.profile.radiusM;
        measured.profile.points.push_back({{std::cos(turned), std::sin(turned), 0}, alongM, finestM, drawnM});
    };
    add(0, 0, 2);
    add(1000, 100, 93);
    add(2000, 50, std::nullopt);
    measured.summary = planet::summaryOf(measured.profile);
    return measured;
}

class RulerPanel : public testing::Test {
protected:
    RulerPanel() { view_.planet = planet_.get(); }

    Commands frame() {
        Commands commands;
        window_.frame([&] { rulerPanel(view_, commands); });
        return commands;
    }
    Commands clicked(std::string_view label) {
        Commands all;
        frame();
        frame();
        window_.click(label, 0.5f, [&] { addAsked(frame(), all); });
        return all;
    }
    void showMeasured() {
        view_.instruments.ruler = {.ends = ends_, .measured = &measured_, .current = true};
        view_.instruments.ruler.inPicture = {{glm::dvec2(0, 0), 1}, {glm::dvec2(30, 40), 2}};
    }

    PanelWindow window_{{400, 900}};
    std::unique_ptr<planet::Planet> planet_ = planet::openFake();
    const MeasuredGround measured_ = threePlaces();
    const std::vector<glm::dvec3> ends_{{1e6, 0, 0}, {1e6 * std::cos(0.002), 1e6 * std::sin(0.002), 0}};
    EmptyView empty_;
    EditorView& view_ = empty_.view;
};

TEST_F(RulerPanel, asksForClicks) {
    const Commands commands = clicked("Click places");
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_TRUE(commands[0].as<TakeRulerClicks>());
    EXPECT_TRUE(commands[0].as<TakeRulerClicks>()->on);
}

TEST_F(RulerPanel, withoutEndsThereIsNothingToSwapOrClear) {
    for (const char* label : {"Swap", "Clear"}) EXPECT_TRUE(clicked(label).empty()) << label;
    EXPECT_FALSE(window_.isShown("Profile"));
}

TEST_F(RulerPanel, swapsAndClearsItsEnds) {
    showMeasured();
    Commands commands = clicked("Swap");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<SwapRulerEnds>());
    commands = clicked("Clear");
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands[0].as<ClearRuler>());
}

TEST_F(RulerPanel, copiesEachPlaceOfTheProfile) {
    showMeasured();
    ExportState state;
    Commands all;
    const auto draw = [&] {
        Commands commands;
        window_.frame([&] {
            beginExports(state, commands);
            rulerPanel(view_, commands);
            endExports();
        });
        addAsked(std::move(commands), all);
    };
    draw();
    draw();
    window_.click("height profile menu", 0.5f, draw);
    draw();
    window_.click("Copy samples", 0.5f, draw);
    ASSERT_EQ(all.size(), 1u);
    ASSERT_TRUE(all[0].as<CopyText>());
    const std::string& text = all[0].as<CopyText>()->text;
    EXPECT_TRUE(text.starts_with("along_m\tlatitude_deg\tlongitude_deg\tfinest_m\tdrawn_m\n0\t0\t0\t0\t2\n"))
        << text;
    EXPECT_EQ(std::ranges::count(text, '\n'), 4) << text;
    EXPECT_TRUE(text.ends_with("\t50\t\n")) << text;
}

TEST_F(RulerPanel, marksThePlaceOfTheProfileUnderThePointer) {
    showMeasured();
    frame();
    frame();
    const auto markedAt = [&](float share) {
        const Rect profile = window_.find("Profile")->rect;
        PanelWindow::movePointer({profile.x + share * profile.width, profile.y + profile.height / 2});
        frame();
        std::optional<std::size_t> marked;
        for (const Command& command : frame()) {
            if (const auto* hover = command.as<HoverProfile>()) marked = hover->point;
        }
        return marked;
    };
    EXPECT_EQ(markedAt(0.02f), 0u);
    EXPECT_EQ(markedAt(0.5f), 1u);
    EXPECT_EQ(markedAt(0.98f), 2u);
    EXPECT_EQ(markedAt(1.5f), std::nullopt);
}

TEST_F(RulerPanel, drawsAGroundThatIsFlatOrIsNotDrawn) {
    MeasuredGround flat = measured_;
    for (planet::ProfilePoint& point : flat.profile.points) {
        point.finestM = 0;
        point.drawnM.reset();
    }
    flat.summary = planet::summaryOf(flat.profile);
    showMeasured();
    view_.instruments.ruler.measured = &flat;
    view_.instruments.ruler.current = false;
    frame();
    frame();
    EXPECT_TRUE(window_.isShown("Profile"));
}

TEST(RulerHeightText, hasCentimetresBelowAHundredMetres) {
    EXPECT_EQ(heightText(12.346), "12.35 m");
    EXPECT_EQ(heightText(-8849.4), "-8849 m");
}

}  // namespace
}  // namespace worldy::ui
