#include "ui/shell/menu_bar.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "tests/support/action_fixture.h"
#include "tests/support/panel_fixture.h"
#include "ui/shell/help_windows.h"

namespace worldy::ui {
namespace {

TEST(MenuBar, theKeysWindowStaysWithinASmallScreen) {
    PanelWindow window{{1024, 640}};
    ImGui::GetIO().FontGlobalScale = 1.5f;
    ActionBench bench;
    bench.menu.showKeys = true;
    for (int frames = 0; frames < 4; ++frames) window.frame([&] { helpWindows(bench.context()); });
    const ItemPlace* keys = window.find("help/Keys and mouse");
    ASSERT_TRUE(keys);
    EXPECT_GE(keys->rect.x, 0);
    EXPECT_GE(keys->rect.y, 0);
    EXPECT_LE(keys->rect.x + keys->rect.width, 1024);
    EXPECT_LE(keys->rect.y + keys->rect.height, 640);
}

TEST(MenuBar, aMenuHoldsItsActionsAndAnItemActs) {
    PanelWindow window{{1024, 1600}};
    ActionBench bench;
    const auto frame = [&] { window.frame([&] { menuBar(bench.context()); }); };
    frame();
    window.click("menu/View", 0.5f, frame);
    frame();
    for (const Action& action : actions()) {
        if (action.menu != Menu::View || !action.submenu.empty()) continue;
        EXPECT_TRUE(window.find("menu item/" + action.name)) << action.name;
    }
    window.click("menu item/Seams", 0.5f, frame);
    EXPECT_FALSE(isShown(bench.workspace, PanelId::Seams)) << "it is hidden, although it is behind another";
}

// A menu that is higher than the window scrolls, and its last entries are hard to find.
TEST(MenuBar, everyMenuFitsASmallWindow) {
    PanelWindow window{{1024, 640}};
    ActionBench bench;
    const auto frame = [&] { window.frame([&] { menuBar(bench.context()); }); };
    frame();
    for (const char* const menu : {"File", "Edit", "View", "Camera", "Help"}) {
        window.click(std::string("menu/") + menu, 0.5f, frame);
        frame();
        frame();
        const ImGuiWindow* const list = ImGui::FindWindowByName("##Menu_00");
        ASSERT_TRUE(list && list->Active) << menu;
        EXPECT_LE(list->ContentSize.y, list->InnerRect.GetHeight()) << menu;
        window.click(std::string("menu/") + menu, 0.5f, frame);
        frame();
    }
}

TEST(MenuBar, aGreyItemDoesNothing) {
    PanelWindow window{{1024, 1600}};
    ActionBench bench;
    const auto frame = [&] { window.frame([&] { menuBar(bench.context()); }); };
    frame();
    window.click("menu/File", 0.5f, frame);
    frame();
    window.click("menu item/Screenshot", 0.5f, frame);
    EXPECT_TRUE(bench.commands.empty());
    window.click("menu item/Screenshot with panels", 0.5f, frame);
    EXPECT_EQ(bench.commands.size(), 1u);
}

}  // namespace
}  // namespace worldy::ui
