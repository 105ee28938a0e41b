#include "app/settings/key_chord.h"

#include <algorithm>
#include <array>

namespace worldy {

namespace {

struct NamedKey {
    int key;
    std::string_view name;
};

// GLFW's codes of keys that write a character are the character's. app/editor/shortcuts.cpp checks the others.
constexpr int plusKey = '=';
constexpr int firstFunctionKey = 290;
constexpr int functionKeys = 12;
constexpr std::array namedKeys = std::to_array<NamedKey>({
    {256, "Esc"},   {257, "Enter"}, {258, "Tab"},   {259, "Backspace"}, {260, "Insert"}, {261, "Delete"},
    {262, "Right"}, {263, "Left"},  {264, "Down"},  {265, "Up"},        {266, "PageUp"}, {267, "PageDown"},
    {268, "Home"},  {269, "End"},   {284, "Pause"}, {348, "Menu"},      {' ', "Space"},  {plusKey, "+"},
    {'-', "-"},     {',', ","},     {'.', "."},     {'/', "/"},         {';', ";"},      {'\'', "'"},
    {'[', "["},     {'\\', "\\"},   {']', "]"},     {'`', "`"},
});

constexpr int keypadMinus = 333;
constexpr int keypadPlus = 334;
constexpr int shiftBit = 1;
constexpr int controlBit = 2;
constexpr int altBit = 4;

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool isSame(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return upper(x) == upper(y); });
}

bool isLetterOrDigit(int key) {
    return (key >= 'A' && key <= 'Z') || (key >= '0' && key <= '9');
}

bool isFunctionKey(int key) {
    return key >= firstFunctionKey && key < firstFunctionKey + functionKeys;
}

// Removes a modifier and its plus from the front of a name. Returns false if the name does not begin so.
bool takeModifier(std::string_view& name, std::string_view modifier) {
    if (name.size() <= modifier.size() + 1 || name[modifier.size()] != '+') return false;
    if (!isSame(name.substr(0, modifier.size()), modifier)) return false;
    name.remove_prefix(modifier.size() + 1);
    return true;
}

std::optional<int> keyNamed(std::string_view name) {
    if (name.size() == 1 && isLetterOrDigit(upper(name[0]))) return upper(name[0]);
    for (int i = 0; i < functionKeys; ++i)
        if (isSame(name, "F" + std::to_string(i + 1))) return firstFunctionKey + i;
    const auto found = std::find_if(namedKeys.begin(), namedKeys.end(),
                                    [&](const NamedKey& named) { return isSame(named.name, name); });
    return found == namedKeys.end() ? std::nullopt : std::optional(found->key);
}

}  // namespace

KeyChord pressedChord(int key, int modifiers) {
    if (key == keypadPlus) key = plusKey;
    if (key == keypadMinus) key = '-';
    KeyChord chord{key, (modifiers & controlBit) != 0, (modifiers & shiftBit) != 0,
                   (modifiers & altBit) != 0};
    // Shift is needed only to type the plus on some keyboards.
    if (key == plusKey) chord.shift = false;
    return chord;
}

std::string nameOf(const KeyChord& chord) {
    std::string name;
    if (chord.ctrl) name += "Ctrl+";
    if (chord.shift) name += "Shift+";
    if (chord.alt) name += "Alt+";
    if (isLetterOrDigit(chord.key)) return name + static_cast<char>(chord.key);
    if (isFunctionKey(chord.key)) return name + "F" + std::to_string(chord.key - firstFunctionKey + 1);
    const auto found = std::find_if(namedKeys.begin(), namedKeys.end(),
                                    [&](const NamedKey& named) { return named.key == chord.key; });
    return found == namedKeys.end() ? std::string() : name + std::string(found->name);
}

std::optional<KeyChord> keyChordFrom(std::string_view name) {
    KeyChord chord;
    for (bool taken = true; taken;) {
        taken = false;
        if (takeModifier(name, "Ctrl")) taken = chord.ctrl = true;
        if (takeModifier(name, "Shift")) taken = chord.shift = true;
        if (takeModifier(name, "Alt")) taken = chord.alt = true;
    }
    const std::optional<int> key = keyNamed(name);
    if (!key) return std::nullopt;
    chord.key = *key;
    if (chord.key == plusKey) chord.shift = false;
    return chord;
}

std::string fixedUseOf(const KeyChord& chord) {
    constexpr std::string_view flying = "WASDEQ";
    constexpr std::string_view turning = "IJKL";
    const char letter = isLetterOrDigit(chord.key) ? static_cast<char>(chord.key) : '\0';
    const auto does = [&](const char* what) { return nameOf({chord.key}) + " " + what; };
    if (!chord.ctrl && letter != '\0') {
        if (flying.find(letter) != std::string_view::npos) return does("flies the camera");
        if (turning.find(letter) != std::string_view::npos) return does("turns the camera");
    }
    if (!chord.ctrl && (chord.key == plusKey || chord.key == '-'))
        return does("changes the speed of the camera");
    if (chord.ctrl || chord.alt) return "";
    constexpr std::array moves = std::to_array<std::string_view>(
        {"Tab", "Enter", "Space", "Up", "Down", "Left", "Right", "PageUp", "PageDown", "Home", "End"});
    const std::string name = nameOf({chord.key});
    if (std::find(moves.begin(), moves.end(), name) != moves.end())
        return does("moves through the controls of a panel");
    return "";
}

}  // namespace worldy
