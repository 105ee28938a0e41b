#include "ui/kit/columns.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <string>

#include "tests/support/panel_fixture.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {
namespace {

std::array<Column, 3> columnsThatNeed(float first, float last) {
    return {Column{"A", 1, 0, {}, first}, Column{"B", 2, 0, {}}, Column{"C", 1, 0, {}, last}};
}

TEST(Columns, sharesDivideTheWidthWhereNoneFallsShort) {
    PanelWindow window{{900, 300}};
    window.frame([&] {
        const std::vector<float> widths = sideBySideWidths(columnsThatNeed(100, 0), 800);
        EXPECT_NEAR(widths[0], 200, 0.01);
        EXPECT_NEAR(widths[1], 400, 0.01);
        EXPECT_NEAR(widths[2], 200, 0.01);
    });
}

// The first takes so much that the last falls short only then.
TEST(Columns, aColumnGetsWhatItNeedsAndAScrollbar) {
    PanelWindow window{{900, 300}};
    window.frame([&] {
        const std::vector<float> widths = sideBySideWidths(columnsThatNeed(400, 150), 800);
        EXPECT_GE(widths[0], 400 + ImGui::GetStyle().ScrollbarSize);
        EXPECT_GE(widths[2], 150 + ImGui::GetStyle().ScrollbarSize);
        EXPECT_NEAR(widths[0] + widths[1] + widths[2], 800, 0.01);
    });
}

TEST(Columns, areStackedWhereTheirNeedsDoNotFit) {
    PanelWindow window{{900, 300}};
    window.frame([&] {
        EXPECT_TRUE(hasWideRoom());
        EXPECT_TRUE(hasWideRoom(columnsThatNeed(300, 300)));
        EXPECT_FALSE(hasWideRoom(columnsThatNeed(500, 400)));
    });
}

TEST(WrappedText, linesBreakAtSpacesAndNeverInsideANumber) {
    std::string broken;
    PanelWindow panel({300, 200});
    panel.frame([&] {
        const std::string words = "8 measured, \u03c4 1.46 px";
        const float upToPoint = ImGui::CalcTextSize("8 measured, \u03c4 1.").x;
        broken = brokenAtSpaces(words, upToPoint);
        EXPECT_EQ(brokenAtSpaces(words, 1e4f), words);
        EXPECT_EQ(brokenAtSpaces("one\ntwo", 1e4f), "one\ntwo");
        EXPECT_EQ(brokenAtSpaces("1234567.89", 1), "1234567.89");
        EXPECT_EQ(brokenAtSpaces("", 10), "");
    });
    EXPECT_EQ(broken, "8 measured, \u03c4\n1.46 px");
}

}  // namespace
}  // namespace worldy::ui
