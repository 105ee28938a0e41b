#include "ui/kit/tables.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

constexpr std::array threeColumns = {TableColumn{"Figure", 1.5f, nullptr, "a value that is very wide indeed"},
                                     TableColumn{"A", 1, nullptr, "12 MiB"}, TableColumn{"B / A", 0.5f}};

float widthOf(const char* text) {
    return ImGui::CalcTextSize(text).x;
}

TEST(Tables, aWideColumnDoesNotWidenTheOthers) {
    PanelWindow window{{400, 300}};
    window.frame([&] {
        const std::vector<float> widths = columnWidths(threeColumns, 0);
        EXPECT_GE(widths[0], widthOf(threeColumns[0].widest));
        EXPECT_GE(widths[1], widthOf("12 MiB"));
        EXPECT_LT(widths[1], widthOf("12 MiB") + 4 + ImGui::GetFontSize());
        EXPECT_GE(widths[2], widthOf("B / A"));
        EXPECT_LT(tableWidth(threeColumns),
                  widthOf(threeColumns[0].widest) + widthOf("12 MiB") + widthOf("B / A") + 80);
    });
}

TEST(Tables, onlyTheSurplusIsShared) {
    PanelWindow window{{400, 300}};
    window.frame([&] {
        const std::vector<float> least = columnWidths(threeColumns, 0);
        const std::vector<float> wide = columnWidths(threeColumns, tableWidth(threeColumns) + 300);
        EXPECT_NEAR(wide[0] - least[0], 150, 0.01);
        EXPECT_NEAR(wide[1] - least[1], 100, 0.01);
        EXPECT_NEAR(wide[2] - least[2], 50, 0.01);
    });
}

// In the table as it is drawn, and again after the panel has become narrower or wider.
TEST(Tables, everyColumnHoldsItsWidestTextAtAnyWidth) {
    PanelWindow window{{900, 300}};
    for (const float width : {900.0f, 300.0f, 600.0f}) {
        PanelWindow::resize({width, 300});
        std::array<float, 3> drawn{};
        for (int frames = 0; frames < 4; ++frames) {
            window.frame([&] {
                if (!beginListTable("table", threeColumns, 1)) return;
                ImGui::TableNextRow();
                for (float& room : drawn) {
                    ImGui::TableNextColumn();
                    room = ImGui::GetContentRegionAvail().x;
                }
                ImGui::EndTable();
            });
        }
        EXPECT_GE(drawn[0], widthOf(threeColumns[0].widest)) << width;
        EXPECT_GE(drawn[1], widthOf("12 MiB")) << width;
        EXPECT_GE(drawn[2], widthOf("B / A")) << width;
    }
}

}  // namespace
}  // namespace worldy::ui
