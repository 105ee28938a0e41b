// Keys with modifiers, and their names: "Ctrl+Shift+Z", "F1", "Ctrl++". Pure functions, any thread.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace worldy {

struct KeyChord {
    int key = 0;  // GLFW's key code
    bool ctrl = false;
    bool shift = false;
    bool alt = false;

    auto operator<=>(const KeyChord&) const = default;
};

// Returns the chord of GLFW's key code and modifiers. Keys that write the same character are one: both minus
// keys, and the plus key with and without Shift.
KeyChord pressedChord(int key, int modifiers);

// Convert a chord to and from its name. Case does not matter in a name. The name of a key that has none is
// empty.
std::string nameOf(const KeyChord& chord);
std::optional<KeyChord> keyChordFrom(std::string_view name);

// Returns what a key always does, so that no command can have it: "W flies the camera". Empty: it is free.
std::string fixedUseOf(const KeyChord& chord);

}  // namespace worldy
