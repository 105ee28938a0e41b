#include "app/editor/shortcuts.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace worldy {
namespace {

// Each key on its own: "F5, F6" are two.
std::set<std::string> listedNames() {
    std::set<std::string> names;
    for (const ui::KeyHelp& help : ui::listedKeys()) {
        std::istringstream keys(help.keys);
        for (std::string name; std::getline(keys, name, ',');) {
            name.erase(0, name.find_first_not_of(' '));
            names.insert(name);
        }
    }
    return names;
}

TEST(Shortcuts, everyKeyIsListedInTheHelp) {
    const std::set<std::string> listed = listedNames();
    for (const std::string& name : shortcutNames()) EXPECT_TRUE(listed.contains(name)) << name;
    for (const PanelInfo& info : panelInfos) EXPECT_TRUE(listed.contains(info.shortcut)) << info.title;
}

TEST(Shortcuts, escClosesTheHelpWindowsOneByOneAndThenSelectsNothing) {
    ImGui::CreateContext();
    const FrameStats stats;
    const std::deque<ui::FrameSample> history;
    const planet::LodChanges changes;
    const std::deque<LogLine> log;
    const ui::EditorView view{
        .frames = {.stats = stats, .history = history}, .log = log, .instruments = {.changes = changes}};
    ViewSettings settings;
    Workspace workspace;
    ui::MenuState menu{true, true, {}};
    ui::Commands commands;
    const KeyPress escape{256, 0};
    const auto press = [&] {
        obeyShortcuts(std::span(&escape, 1), {view, settings, workspace, menu, commands});
    };
    press();
    EXPECT_TRUE(menu.showKeys);
    EXPECT_FALSE(menu.showAbout);
    press();
    EXPECT_FALSE(menu.showKeys);
    EXPECT_TRUE(commands.empty());
    press();
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_TRUE(commands.front().as<ui::SelectChunk>());
    ImGui::DestroyContext();
}

}  // namespace
}  // namespace worldy
