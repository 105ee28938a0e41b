#include "ui/shell/actions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "app/settings/settings_schema.h"
#include "tests/support/action_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/temporary_folder.h"
#include "ui/model/docking.h"
#include "ui/shell/gamepad_actions.h"
#include "ui/shell/help_windows.h"

namespace worldy::ui {
namespace {

using testing::HasSubstr;

TEST(Actions, idsAndNamesAndKeysAreUnique) {
    std::set<std::string> ids, names;
    std::map<KeyChord, std::string> owners;
    const ActionKeys keys = defaultKeys();
    for (std::size_t i = 0; i < actions().size(); ++i) {
        const Action& action = actions()[i];
        EXPECT_TRUE(ids.insert(action.id).second) << action.id;
        EXPECT_TRUE(names.insert(action.name).second) << action.name;
        EXPECT_TRUE(action.help.ends_with('.')) << action.id;
        EXPECT_NE(static_cast<bool>(action.act), static_cast<bool>(action.choices)) << action.id;
        EXPECT_EQ(action.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), std::string::npos)
            << action.id;
        ASSERT_EQ(keys[i].size(), action.keys.size()) << action.id;
        for (const KeyChord& chord : keys[i]) {
            EXPECT_TRUE(owners.emplace(chord, action.id).second)
                << nameOf(chord) << " of " << action.id << " and " << owners[chord];
            EXPECT_EQ(fixedUseOf(chord), "") << action.id;
        }
    }
}

TEST(Actions, whatTheyChangeAreSettings) {
    for (const Action& action : actions()) {
        if (action.setting.empty()) continue;
        EXPECT_TRUE(findField(defaultFields(), action.setting)) << action.setting;
    }
}

TEST(Actions, theActionsOfASubmenuAreSideBySide) {
    // The menu bar begins a submenu for each run of actions.
    std::set<std::string> ended;
    std::string last;
    for (const Action& action : actions()) {
        if (action.submenu == last) continue;
        EXPECT_TRUE(action.submenu.empty() || ended.insert(action.submenu).second) << action.id;
        last = action.submenu;
    }
}

TEST(Actions, theKeysOfTheFileReachTheirActions) {
    std::vector<KeyChords> ofCommands;
    for (const KeyedCommand& command : keyedCommands()) ofCommands.push_back(command.keys);
    EXPECT_EQ(actionKeys(ofCommands), defaultKeys());
}

TEST(Actions, whatIsNotPossibleSaysWhy) {
    ActionBench bench;
    EXPECT_EQ(whyNot(actionNamed("screenshot"), bench.context()), "No planet is open.");
    EXPECT_EQ(whyNot(actionNamed("undo"), bench.context()), "Nothing to undo.");
    EXPECT_EQ(whyNot(actionNamed("reset_settings"), bench.context()), "All settings have their defaults.");
    bench.settings.lod.tauPx = 7;
    EXPECT_EQ(whyNot(actionNamed("reset_settings"), bench.context()), "");
    EXPECT_EQ(whyNot(actionNamed("quit"), bench.context()), "");
}

TEST(Actions, aPanelBehindAnotherComesToTheFrontBeforeItIsHidden) {
    ActionBench bench;
    const auto toggle = [&] { actionNamed("panel_seams").act(bench.context()); };
    const auto right = static_cast<std::size_t>(Dock::Right);
    toggle();
    EXPECT_EQ(bench.workspace.inFront[right], PanelId::Seams);
    EXPECT_TRUE(isShown(bench.workspace, PanelId::Seams));
    toggle();
    EXPECT_FALSE(isShown(bench.workspace, PanelId::Seams));
    toggle();
    EXPECT_TRUE(isShown(bench.workspace, PanelId::Seams));
}

TEST(Actions, theNextTabIsTheNextShownPanelOfTheDock) {
    ActionBench bench;
    bench.menu.usedPanel = PanelId::Paging;
    const auto bottom = static_cast<std::size_t>(Dock::Bottom);
    const auto step = [&](const char* id) {
        actionNamed(id).act(bench.context());
        return bench.workspace.inFront[bottom];
    };
    EXPECT_EQ(step("next_tab"), PanelId::Frame);
    EXPECT_EQ(step("next_tab"), PanelId::Log);
    EXPECT_EQ(step("next_tab"), PanelId::Paging);
    EXPECT_EQ(step("previous_tab"), PanelId::Log);
}

TEST(Actions, theButtonsOfAGamepadHaveActionsOfTheList) {
    std::set<GamepadButton> buttons;
    for (const ButtonAction& one : buttonActions()) {
        EXPECT_TRUE(buttons.insert(one.button).second) << one.name;
        const Action* const action = actionOf(one.button);
        ASSERT_TRUE(action);
        EXPECT_EQ(action->id, one.id);
        EXPECT_TRUE(action->act) << one.id;
    }
    EXPECT_FALSE(actionOf(GamepadButton::Guide));
}

TEST(Actions, orbitingThePointEndsByTheSameKey) {
    ActionBench bench;
    EXPECT_EQ(whyNot(actionNamed("orbit_point"), bench.context()), "No planet is open.");
    bench.settings.camera.mode = CameraMode::Orbit;
    EXPECT_EQ(whyNot(actionNamed("orbit_point"), bench.context()), "");
    actionNamed("orbit_point").act(bench.context());
    EXPECT_EQ(bench.settings.camera.mode, CameraMode::Fly);
}

TEST(Actions, theFieldOfViewStaysInItsRange) {
    ActionBench bench;
    actionNamed("narrower_view").act(bench.context());
    EXPECT_NEAR(bench.settings.camera.fovDeg, 60 / 1.1, 1e-9);
    actionNamed("wider_view").act(bench.context());
    EXPECT_NEAR(bench.settings.camera.fovDeg, 60, 1e-9);
    for (int i = 0; i < 50; ++i) actionNamed("narrower_view").act(bench.context());
    EXPECT_EQ(bench.settings.camera.fovDeg, rangeOf("view.fov_deg").min);
    for (int i = 0; i < 50; ++i) actionNamed("wider_view").act(bench.context());
    EXPECT_EQ(bench.settings.camera.fovDeg, rangeOf("view.fov_deg").max);
}

TEST(Actions, thePanelUsedLastMovesToAnotherDock) {
    ActionBench bench;
    EXPECT_THAT(whyNot(actionNamed("move_panel_left"), bench.context()), HasSubstr("No panel"));
    bench.menu.usedPanel = PanelId::Log;
    EXPECT_EQ(whyNot(actionNamed("move_panel_left"), bench.context()), "");
    actionNamed("move_panel_left").act(bench.context());
    EXPECT_EQ(bench.workspace.panels[static_cast<std::size_t>(PanelId::Log)].dock, Dock::Left);
    EXPECT_EQ(bench.workspace.inFront[static_cast<std::size_t>(Dock::Left)], PanelId::Log);
    actionNamed("hide_panel").act(bench.context());
    EXPECT_FALSE(isShown(bench.workspace, PanelId::Log));
}

TEST(Actions, aTabMovesAmongThoseOfItsDock) {
    ActionBench bench;
    const Dock dock = bench.workspace.panels[static_cast<std::size_t>(PanelId::Log)].dock;
    const std::vector<PanelId> before = panelsIn(dock, bench.workspace);
    ASSERT_GE(before.size(), 3u);
    bench.menu.usedPanel = before[0];
    EXPECT_THAT(whyNot(actionNamed("move_tab_back"), bench.context()), HasSubstr("first tab"));
    actionNamed("move_tab_forward").act(bench.context());
    std::vector<PanelId> now = panelsIn(dock, bench.workspace);
    EXPECT_EQ(now[0], before[1]);
    EXPECT_EQ(now[1], before[0]);
    EXPECT_EQ(bench.workspace.inFront[static_cast<std::size_t>(dock)], before[0]);
    actionNamed("move_tab_back").act(bench.context());
    EXPECT_EQ(panelsIn(dock, bench.workspace), before);
    bench.menu.usedPanel = before.back();
    EXPECT_THAT(whyNot(actionNamed("move_tab_forward"), bench.context()), HasSubstr("last tab"));
    floatPanel(before.back(), {}, bench.workspace);
    EXPECT_THAT(whyNot(actionNamed("move_tab_back"), bench.context()), HasSubstr("floats"));
}

// The tables of the manual: what cannot be changed, the commands with their default keys, then gamepads and 3-D mice.
TEST(Actions, theManualListsAllKeys) {
    std::string table = "| key or mouse | action |\n|---|---|\n";
    for (const KeyHelp& help : fixedKeys()) table += "| " + help.keys + " | " + help.meaning + " |\n";
    table += "\n| key | command | in keys.toml | what it does |\n|---|---|---|---|\n";
    const ActionKeys keys = defaultKeys();
    for (std::size_t i = 0; i < actions().size(); ++i) {
        const Action& action = actions()[i];
        if (!keys[i].empty())
            table += "| " + keysText(keys[i]) + " | " + action.name + " | `" + action.id + "` | " +
                     action.help + " |\n";
    }
    table += "\n| gamepad or 3-D mouse | action |\n|---|---|\n";
    for (const KeyHelp& help : steeringHelp()) table += "| " + help.keys + " | " + help.meaning + " |\n";
    EXPECT_NE(tests::contentOf(WORLDY_SOURCE_DIR "/ui/README.md").find(table), std::string::npos)
        << "expected this table in ui/README.md:\n"
        << table;
}

TEST(Actions, theKeyFileOfTheManualIsRight) {
    const std::string manual = tests::contentOf(WORLDY_SOURCE_DIR "/ui/README.md");
    const std::size_t begin = manual.find("```toml\nfreeze_lod");
    ASSERT_NE(begin, std::string::npos);
    const std::string text = manual.substr(begin + 8, manual.find("```", begin + 8) - begin - 8);
    EXPECT_THAT(keysFromText(text, "README.md", keyedCommands()).problems, testing::IsEmpty()) << text;
}

}  // namespace
}  // namespace worldy::ui
