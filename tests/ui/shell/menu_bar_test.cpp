#include "ui/shell/menu_bar.h"

#include <gtest/gtest.h>

#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

TEST(MenuBar, theKeysWindowStaysWithinASmallScreen) {
    PanelWindow window{{1024, 640}};
    ImGui::GetIO().FontGlobalScale = 1.5f;
    MenuState state{true, false, {}};
    for (int frames = 0; frames < 4; ++frames) window.frame([&] { helpWindows(state); });
    const ItemPlace* keys = window.find("help/Keys and mouse");
    ASSERT_TRUE(keys);
    EXPECT_GE(keys->rect.x, 0);
    EXPECT_GE(keys->rect.y, 0);
    EXPECT_LE(keys->rect.x + keys->rect.width, 1024);
    EXPECT_LE(keys->rect.y + keys->rect.height, 640);
}

}  // namespace
}  // namespace worldy::ui
