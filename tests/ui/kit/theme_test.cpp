#include "ui/kit/theme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

// Largest difference of a channel from the window's background.
float contrastOf(ImGuiCol colour) {
    const ImVec4& over = ImGui::GetStyleColorVec4(colour);
    const ImVec4& ground = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
    return over.w *
           std::max({std::abs(over.x - ground.x), std::abs(over.y - ground.y), std::abs(over.z - ground.z)});
}

TEST(Theme, aSelectedRowStandsOutFromTheStripes) {
    PanelWindow window{{400, 300}};
    for (const Theme theme : {Theme::Dark, Theme::Light}) {
        applyTheme(theme, 1);
        EXPECT_GT(contrastOf(ImGuiCol_Header), 6 * contrastOf(ImGuiCol_TableRowBgAlt));
        EXPECT_GT(contrastOf(ImGuiCol_Header), 0.15f);
    }
}

}  // namespace
}  // namespace worldy::ui
