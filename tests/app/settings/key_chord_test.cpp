#include "app/settings/key_chord.h"

#include <gtest/gtest.h>

#include <array>

namespace worldy {
namespace {

TEST(KeyChord, namesAreReadBack) {
    for (const char* name : {"F1", "F12", "Ctrl+Shift+Z", "Alt+M", "Ctrl++", "Ctrl+-", "Shift+F10", "Esc",
                             "Ctrl+PageDown", "Ctrl+Shift+Alt+9", "Ctrl+\\", "Menu", "Ctrl+Tab"}) {
        const auto chord = keyChordFrom(name);
        ASSERT_TRUE(chord) << name;
        EXPECT_EQ(nameOf(*chord), name);
    }
}

TEST(KeyChord, caseAndTheOrderOfModifiersDoNotMatter) {
    EXPECT_EQ(keyChordFrom("shift+ctrl+z"), keyChordFrom("Ctrl+Shift+Z"));
    EXPECT_EQ(keyChordFrom("ctrl+pageup"), keyChordFrom("Ctrl+PageUp"));
}

TEST(KeyChord, whatIsNoKeyIsRefused) {
    for (const char* name :
         {"", "F0", "F13", "Ctrl+", "Ctrl", "Hyper+Z", "ZZ", "Ctrl+Ctrl", "+Z", "Ctrl Z", "é"})
        EXPECT_FALSE(keyChordFrom(name)) << name;
}

TEST(KeyChord, theKeysOfTheKeypadWriteTheSameSigns) {
    constexpr int control = 2, shift = 1, equal = 61, keypadAdd = 334, keypadSubtract = 333;
    EXPECT_EQ(nameOf(pressedChord(keypadAdd, control)), "Ctrl++");
    EXPECT_EQ(nameOf(pressedChord(equal, control | shift)), "Ctrl++");
    EXPECT_EQ(nameOf(pressedChord(keypadSubtract, control)), "Ctrl+-");
    EXPECT_EQ(nameOf(pressedChord('Z', control | shift)), "Ctrl+Shift+Z");
}

TEST(KeyChord, keysThatFlyOrMoveTheFocusAreFixed) {
    for (const char* name :
         {"W", "Shift+A", "Alt+Q", "L", "+", "-", "Tab", "Enter", "Space", "Left", "Shift+Tab"})
        EXPECT_NE(fixedUseOf(*keyChordFrom(name)), "") << name;
    for (const char* name : {"Ctrl+W", "F2", "Z", "Ctrl+Tab", "Alt+Left", "Ctrl++", "Esc"})
        EXPECT_EQ(fixedUseOf(*keyChordFrom(name)), "") << name;
}

}  // namespace
}  // namespace worldy
