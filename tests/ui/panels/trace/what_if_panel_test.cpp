// The controls of the What if panel ask for what they say, and its tables show what was found.
#include "ui/panels/trace/what_if_panel.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cstring>

#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/traced_flight.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/what_if_tables.h"

namespace worldy::ui {
namespace {

using testing::HasSubstr;
using testing::Not;

// One flight and one result for all tests.
struct Found {
    Found() {
        TraceWhatIfRequest request;
        for (const double tauPx : {0.5, 4.0}) {
            request.settings.emplace_back();
            request.settings.back().tauPx = tauPx;
        }
        request.goal = planet::TraceTauGoal{.errorPx = 3};
        result = runTraceWhatIf(file, request, {}).value();
    }
    tests::TemporaryFolder folder;
    std::filesystem::path file = folder / "made.lodtrace";
    test::TracedFlight flight{file};
    TraceWhatIfResult result;
};
const Found& found() {
    static const Found once;
    return once;
}

class WhatIfPanel : public testing::Test {
protected:
    WhatIfPanel() {
        view_.trace.file = found().file;
        view_.trace.whatIf.result = &found().result;
    }

    void frame() {
        window_.frame([&] { whatIfPanel(view_, state_, commands_); });
    }
    void click(std::string_view label, float share = 0.5f) {
        frame();
        frame();
        window_.click(label, share, [&] { frame(); });
        frame();
    }
    // Returns the commands of a kind since the last call.
    template <class Kind>
    std::vector<Kind> taken() {
        std::vector<Kind> kinds;
        for (Command& command : commands_)
            if (const Kind* one = command.as<Kind>()) kinds.push_back(*one);
        commands_.clear();
        return kinds;
    }
    TraceWhatIfRequest asked(std::string_view button) {
        click(button);
        const auto requests = taken<StartTraceWhatIf>();
        EXPECT_EQ(requests.size(), 1u) << button;
        return requests.empty() ? TraceWhatIfRequest{} : requests.front().request;
    }
    bool saysWhy(std::string_view label) {
        return window_.saysWhy(label, [&] { frame(); });
    }
    // Returns the text of the panel.
    std::string text() {
        PanelWindow::movePointer({-1, -1});
        frame();
        std::string shown;
        window_.frame([&] {
            ImGui::LogToBuffer(10);
            whatIfPanel(view_, state_, commands_);
            shown = ImGui::GetCurrentContext()->LogBuffer.c_str();
            ImGui::LogFinish();
        });
        return shown;
    }

    PanelWindow window_{{1800, 420}};
    EmptyView empty_;
    EditorView& view_ = empty_.view;
    WhatIfPanelState state_;
    Commands commands_;
};

TEST_F(WhatIfPanel, asksForARowForEachTolerance) {
    const TraceWhatIfRequest request = asked("Run");
    ASSERT_EQ(request.settings.size(), 5u);
    EXPECT_EQ(request.settings[0].tauPx, 0.5);
    EXPECT_EQ(request.settings[4].tauPx, 8);
    EXPECT_EQ(request.settings[0].hysteresis, std::nullopt);
    EXPECT_EQ(request.settings[0].budgetBytes, std::nullopt);
    EXPECT_EQ(request.settings[0].residency, planet::TraceResidency::AllThere);
    EXPECT_FALSE(request.goal);
}

TEST_F(WhatIfPanel, asksForOtherHysteresisBudgetAndDisk) {
    for (const std::string_view item :
         {"Hysteresis: other", "Metric: centre", "Budget: limited", "Data: disk model"}) {
        click(item.substr(0, item.find(':')));
        click(item);
    }
    state_.latencyMs = 20;
    state_.loaders = 3;
    const TraceWhatIfRequest request = asked("Run");
    ASSERT_EQ(request.settings.size(), 5u);
    for (const planet::TraceSelectorSettings& settings : request.settings) {
        EXPECT_EQ(settings.hysteresis, 0.1);
        EXPECT_EQ(settings.metric, planet::TraceMetric::Centre);
        EXPECT_EQ(settings.budgetBytes, 64'000'000u);
        EXPECT_EQ(settings.residency, planet::TraceResidency::Disk);
        EXPECT_EQ(settings.disk.latencyS, 0.02);
        EXPECT_EQ(settings.disk.bytesPerS, 100e6);
        EXPECT_EQ(settings.disk.loaders, 3);
    }
}

TEST_F(WhatIfPanel, asksForASuggestionWithinTheLimitsThatAreOn) {
    TraceWhatIfRequest request = asked("Suggest");
    ASSERT_TRUE(request.goal);
    EXPECT_EQ(request.goal->bytes, 16e6);
    EXPECT_EQ(request.goal->errorPx, 1.5);
    EXPECT_EQ(request.settings.size(), 5u);
    click("Limit Bytes");
    request = asked("Suggest");
    EXPECT_EQ(request.goal->bytes, std::nullopt);
    EXPECT_EQ(request.goal->errorPx, 1.5);
    click("Limit Error");
    click("Suggest");
    EXPECT_TRUE(taken<StartTraceWhatIf>().empty());
    EXPECT_TRUE(saysWhy("Suggest"));
}

TEST_F(WhatIfPanel, wrongTolerancesAskForNothing) {
    std::strcpy(state_.taus.data(), "1 two");
    EXPECT_THAT(text(), HasSubstr("\"two\" is not a number"));
    for (const char* button : {"Run", "Suggest"}) {
        click(button);
        EXPECT_TRUE(taken<StartTraceWhatIf>().empty());
        EXPECT_TRUE(saysWhy(button));
    }
}

TEST_F(WhatIfPanel, theTableShowsTheEngineItsSettingsAndEachRow) {
    const std::string shown = text();
    const planet::TraceWhatIfView& view = found().result.report.views[0];
    const std::vector<WhatIfEntry> entries = whatIfEntries(found().result, 0, planet::TraceCost::Bytes);
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_EQ(entries[0].totals, &view.engine);
    EXPECT_EQ(entries[1].totals, &view.own.totals);
    EXPECT_EQ(entries[2].name, std::string(tauSymbol()) + " 0.5 px");
    EXPECT_EQ(whatIfDrawnText(entries[0]), fmt::format("{:.1f}", view.engine.meanDrawn));
    EXPECT_EQ(whatIfBytesText(entries[0]),
              fmt::format("{:.2f} MB", static_cast<double>(view.engine.mostBytes) / 1e6));
    for (const WhatIfEntry& entry : entries) {
        EXPECT_THAT(shown, HasSubstr(entry.name));
        EXPECT_THAT(shown, HasSubstr(whatIfDrawnText(entry)));
        EXPECT_THAT(shown, HasSubstr(whatIfTrianglesText(entry)));
        EXPECT_THAT(shown, HasSubstr(whatIfBytesText(entry)));
        EXPECT_THAT(shown, HasSubstr(whatIfErrorText(entry)));
    }
    EXPECT_THAT(shown, HasSubstr("360 frames; hysteresis as told, no budget, all data there"));
}

TEST_F(WhatIfPanel, boundsAreMarkedAndExplained) {
    const std::vector<WhatIfEntry> entries = whatIfEntries(found().result, 0, planet::TraceCost::Bytes);
    const WhatIfEntry &exact = entries[3], &bound = entries[2];
    ASSERT_EQ(exact.totals->unknown, 0u);
    ASSERT_GT(bound.totals->unknown, 0u);
    EXPECT_EQ(whatIfBoundReason(exact), "");
    EXPECT_THAT(whatIfTrianglesText(exact), Not(HasSubstr(inFont("\u2265"))));
    EXPECT_TRUE(whatIfDrawnText(bound).starts_with(inFont("\u2265 ")));
    EXPECT_TRUE(whatIfTrianglesText(bound).starts_with(inFont("\u2265 ")));
    EXPECT_TRUE(whatIfBytesText(bound).starts_with(inFont("\u2265 ")));
    EXPECT_TRUE(whatIfErrorText(bound).starts_with(inFont("\u2264 "))) << whatIfErrorText(bound);
    EXPECT_THAT(whatIfBoundReason(bound), HasSubstr("does not describe the children"));
    EXPECT_THAT(text(), HasSubstr(whatIfTrianglesText(bound)));
}

TEST_F(WhatIfPanel, aClickInTheTableSelectsARowAndShowsItsWorstFrameAndNode) {
    click("Row 2", 0.02f);
    EXPECT_EQ(state_.selected, 2u);
    click("Frame 0");
    const auto frames = taken<ShowTraceFrame>();
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].frame, found().result.report.views[0].engine.worstFrame);
    click("Node 0");
    const auto nodes = taken<SelectTraceNode>();
    ASSERT_EQ(nodes.size(), 1u);
    EXPECT_EQ(nodes[0].id, found().result.report.views[0].engine.worstNode);
    EXPECT_EQ(state_.selected, 2u);
    click("Row 2", 0.02f);
    EXPECT_EQ(state_.selected, std::nullopt);
}

TEST_F(WhatIfPanel, aClickInThePlotShowsTheFrame) {
    click("flight", 0.5f);
    const auto frames = taken<ShowTraceFrame>();
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_NEAR(static_cast<double>(frames[0].frame), 180, 2);
}

TEST_F(WhatIfPanel, aDisagreementSaysWhatIsWrongAndLeadsToItsNodeAndFrame) {
    click("Disagreements");
    const std::string shown = text();
    EXPECT_THAT(shown, HasSubstr("is not what its own numbers say, 1 time."));
    EXPECT_THAT(shown, HasSubstr(found().result.report.disagreements.at(0).sentence));
    click("Disagreeing node");
    const auto nodes = taken<SelectTraceNode>();
    ASSERT_EQ(nodes.size(), 1u);
    EXPECT_EQ(nodes[0].id, found().flight.planted());
    click("Disagreeing frame");
    const auto frames = taken<ShowTraceFrame>();
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].frame, test::TracedFlight::plantedFirst);
}

TEST_F(WhatIfPanel, waitsForFadesAreListedOnRequest) {
    TraceWhatIfResult result = found().result;
    result.report.disagreements.at(0).isFade = true;
    view_.trace.whatIf.result = &result;
    click("Disagreements");
    EXPECT_THAT(text(), HasSubstr("what its own numbers say. 1 switch may have waited for fades."));
    EXPECT_FALSE(window_.isShown("Disagreeing node"));
    click("Show waits for fades");
    frame();
    EXPECT_TRUE(window_.isShown("Disagreeing node"));
}

TEST_F(WhatIfPanel, aSuggestionIsTakenIntoTheListOnce) {
    const planet::TraceTauSuggestion& suggestion = *found().result.suggestion;
    ASSERT_TRUE(suggestion.isMet);
    EXPECT_THAT(text(), HasSubstr(fmt::format("{} = {:.3g} px keeps 3 px", tauSymbol(), suggestion.tauPx)));
    for (int i = 0; i < 2; ++i) click("Add to the list");
    EXPECT_EQ(std::string(state_.taus.data()), fmt::format("0.5 1 2 4 8 {:.3g}", suggestion.tauPx));
    EXPECT_EQ(asked("Run").settings.size(), 6u);
}

TEST_F(WhatIfPanel, aRunCanBeCancelledOnce) {
    view_.trace.whatIf.running = true;
    view_.trace.whatIf.progress = 0.25;
    EXPECT_TRUE(saysWhy("Suggest"));
    EXPECT_FALSE(window_.isShown("Run"));
    click("Cancel");
    EXPECT_EQ(taken<CancelTraceWhatIf>().size(), 1u);
    view_.trace.whatIf.cancelling = true;
    click("Cancel");
    EXPECT_TRUE(taken<CancelTraceWhatIf>().empty());
}

TEST_F(WhatIfPanel, aResultOfAnotherTraceIsNotShown) {
    view_.trace.file = "other.lodtrace";
    frame();
    frame();
    EXPECT_FALSE(window_.isShown("Row 0"));
    EXPECT_THAT(text(), HasSubstr("Press Run"));
    view_.trace.file.clear();
    EXPECT_THAT(text(), HasSubstr("No trace is open."));
}

TEST_F(WhatIfPanel, aViewThatTheTraceLacksOffersTheOthers) {
    view_.trace.view = 7;
    frame();
    EXPECT_FALSE(window_.isShown("Row 0"));
    click("View");
    click("View: view 0");
    const auto views = taken<SelectTraceView>();
    ASSERT_EQ(views.size(), 1u);
    EXPECT_EQ(views[0].view, 0);
}

TEST_F(WhatIfPanel, fitsANarrowDock) {
    PanelWindow::resize({330, 2400});
    for (int i = 0; i < 4; ++i) frame();
    for (const char* item : {"Tolerances", "Run", "Bytes to keep", "Error to keep", "Suggest", "flight",
                             "Row 0", "Disagreements"}) {
        const ItemPlace* place = window_.find(item);
        ASSERT_NE(place, nullptr) << item;
        EXPECT_GE(place->rect.x, 0) << item;
        // The table scrolls. The place of what is cut off ends at the edge of the window.
        if (item == std::string_view("Row 0")) continue;
        EXPECT_LT(place->rect.x + place->rect.width, 330) << item;
    }
}

}  // namespace
}  // namespace worldy::ui
