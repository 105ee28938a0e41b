#include "ui/kit/columns.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/panel_fixture.h"

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

}  // namespace
}  // namespace worldy::ui
