#include "app/session/shortcuts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>

#include "tests/support/action_fixture.h"

namespace worldy {
namespace {

class ShortcutsTest : public testing::Test {
protected:
    void SetUp() override { ImGui::CreateContext(); }
    void TearDown() override { ImGui::DestroyContext(); }

    void press(const char* name) {
        const KeyChord chord = keyChordFrom(name).value();
        const KeyPress press{chord.key, (chord.ctrl ? 2 : 0) | (chord.shift ? 1 : 0) | (chord.alt ? 4 : 0)};
        obeyShortcuts(std::span(&press, 1), bench_.context());
    }
    KeyChords& keysOf(const char* id) {
        return bench_.keys[static_cast<std::size_t>(&ui::actionNamed(id) - ui::actions().data())];
    }

    ui::ActionBench bench_;
};

TEST_F(ShortcutsTest, escClosesTheHelpWindowsOneByOneAndThenSelectsNothing) {
    bench_.menu.showKeys = bench_.menu.showAbout = true;
    press("Esc");
    EXPECT_TRUE(bench_.menu.showKeys);
    EXPECT_FALSE(bench_.menu.showAbout);
    press("Esc");
    EXPECT_FALSE(bench_.menu.showKeys);
    EXPECT_TRUE(bench_.commands.empty());
    press("Esc");
    ASSERT_EQ(bench_.commands.size(), 1u);
    EXPECT_TRUE(bench_.commands.front().as<ui::SelectChunk>());
}

TEST_F(ShortcutsTest, anEscThatImGuiClosedAMenuWithDoesNothingElse) {
    bench_.menu.popupWasOpen = true;
    press("Esc");
    EXPECT_TRUE(bench_.commands.empty());
    press("Esc");
    EXPECT_EQ(bench_.commands.size(), 1u);
}

TEST_F(ShortcutsTest, escLeavesASettingBeforeItClosesThePalette) {
    press("Ctrl+K");
    bench_.menu.palette.edited = "lod.tau_px";
    press("Esc");
    EXPECT_TRUE(bench_.menu.palette.isOpen);
    EXPECT_EQ(bench_.menu.palette.edited, "");
    press("Esc");
    EXPECT_FALSE(bench_.menu.palette.isOpen);
    EXPECT_TRUE(bench_.commands.empty());
}

TEST_F(ShortcutsTest, whatIsTypedBeforeThePalettesFieldHasTheFocusIsNoShortcut) {
    press("Ctrl+K");
    press("F2");
    EXPECT_TRUE(bench_.commands.empty());
    press("Ctrl+K");
    EXPECT_FALSE(bench_.menu.palette.isOpen);
    press("F2");
    EXPECT_EQ(bench_.commands.size(), 1u);
}

TEST_F(ShortcutsTest, aButtonDoesWhatItsActionDoesAndSaysWhyNot) {
    const std::array pressed = {GamepadButton::X, GamepadButton::Guide, GamepadButton::A};
    obeyButtons(pressed, bench_.context());
    ASSERT_EQ(bench_.commands.size(), 1u);
    EXPECT_TRUE(bench_.commands.front().as<ui::FreezeLod>());
    EXPECT_EQ(bench_.menu.refused, "Select chunk in the middle: No planet is open.");
}

TEST_F(ShortcutsTest, aChangedKeyActsAndTheOldOneDoesNot) {
    keysOf("freeze_lod") = {*keyChordFrom("Ctrl+Alt+F")};
    press("F2");
    EXPECT_TRUE(bench_.commands.empty());
    press("Ctrl+Alt+F");
    ASSERT_EQ(bench_.commands.size(), 1u);
    EXPECT_TRUE(bench_.commands.front().as<ui::FreezeLod>());
}

TEST_F(ShortcutsTest, inATextFieldOnlyTheKeysForItWork) {
    ImGui::GetIO().WantTextInput = true;
    press("F2");
    press("Esc");
    EXPECT_TRUE(bench_.commands.empty());
    press("Ctrl+K");
    EXPECT_TRUE(bench_.menu.palette.isOpen);
    press("Esc");
    EXPECT_FALSE(bench_.menu.palette.isOpen);
}

TEST_F(ShortcutsTest, whatIsNotPossibleSaysWhyAndDoesNothing) {
    press("F12");
    EXPECT_TRUE(bench_.commands.empty());
    EXPECT_EQ(bench_.menu.refused, "Screenshot: No planet is open.");
}

}  // namespace
}  // namespace worldy
