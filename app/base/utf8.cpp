#include "app/base/utf8.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace worldy {

namespace {

// Spells the letters from U+00A0 to U+017F in ASCII; a row has 16 of them.
constexpr std::array<std::string_view, 224> latinLetters = {
    " ",    "!",  "c",  "GBP", "?", "JPY", "|",  "?", "?", "(c)", "a", "<<", "-",   "",    "(r)", "-",   //
    " deg", "+-", "2",  "3",   "'", "u",   "?",  ".", ",", "1",   "o", ">>", "1/4", "1/2", "3/4", "?",   //
    "A",    "A",  "A",  "A",   "A", "A",   "AE", "C", "E", "E",   "E", "E",  "I",   "I",   "I",   "I",   //
    "D",    "N",  "O",  "O",   "O", "O",   "O",  "x", "O", "U",   "U", "U",  "U",   "Y",   "Th",  "ss",  //
    "a",    "a",  "a",  "a",   "a", "a",   "ae", "c", "e", "e",   "e", "e",  "i",   "i",   "i",   "i",   //
    "d",    "n",  "o",  "o",   "o", "o",   "o",  "/", "o", "u",   "u", "u",  "u",   "y",   "th",  "y",   //
    "A",    "a",  "A",  "a",   "A", "a",   "C",  "c", "C", "c",   "C", "c",  "C",   "c",   "D",   "d",   //
    "D",    "d",  "E",  "e",   "E", "e",   "E",  "e", "E", "e",   "E", "e",  "G",   "g",   "G",   "g",   //
    "G",    "g",  "G",  "g",   "H", "h",   "H",  "h", "I", "i",   "I", "i",  "I",   "i",   "I",   "i",   //
    "I",    "i",  "IJ", "ij",  "J", "j",   "K",  "k", "k", "L",   "l", "L",  "l",   "L",   "l",   "L",   //
    "l",    "L",  "l",  "N",   "n", "N",   "n",  "N", "n", "'n",  "N", "n",  "O",   "o",   "O",   "o",   //
    "O",    "o",  "OE", "oe",  "R", "r",   "R",  "r", "R", "r",   "S", "s",  "S",   "s",   "S",   "s",   //
    "S",    "s",  "T",  "t",   "T", "t",   "T",  "t", "U", "u",   "U", "u",  "U",   "u",   "U",   "u",   //
    "U",    "u",  "U",  "u",   "W", "w",   "Y",  "y", "Y", "Z",   "z", "Z",  "z",   "Z",   "z",   "s",   //
};
constexpr char32_t firstLatin = 0xA0;

// Other letters that the program writes itself, or that names hold often.
constexpr std::array<std::pair<char32_t, std::string_view>, 13> otherLetters = {{{0x3B4, "delta"},
                                                                                 {0x3B5, "eps"},
                                                                                 {0x3BC, "u"},
                                                                                 {0x3C4, "tau"},
                                                                                 {0x2010, "-"},
                                                                                 {0x2013, "-"},
                                                                                 {0x2014, "-"},
                                                                                 {0x2018, "'"},
                                                                                 {0x2019, "'"},
                                                                                 {0x201C, "\""},
                                                                                 {0x201D, "\""},
                                                                                 {0x2026, "..."},
                                                                                 {0x2212, "-"}}};

std::string_view asciiOfLetter(char32_t letter) {
    if (letter >= firstLatin && letter < firstLatin + latinLetters.size())
        return latinLetters[letter - firstLatin];
    const auto* const other =
        std::ranges::find(otherLetters, letter, [](const auto& one) { return one.first; });
    if (other != otherLetters.end()) return other->second;
    const bool joinsTheLetterBefore = letter >= 0x300 && letter < 0x370;
    return joinsTheLetterBefore ? "" : "?";
}

}  // namespace

bool isUtf8(std::string_view text) {
    try {
        nlohmann::json(text).dump();  // throws on text that is not UTF-8
        return true;
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

std::string asciiOf(std::string_view text) {
    std::string ascii;
    while (!text.empty()) {
        const auto first = static_cast<unsigned char>(text.front());
        const std::size_t bytes = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
        const std::string_view letter = text.substr(0, bytes);
        if (first < 0x80) {
            ascii += text.front();
        } else if (letter.size() == bytes && isUtf8(letter)) {
            char32_t code = first & (0xFFu >> (bytes + 1));
            for (const char byte : letter.substr(1))
                code = code << 6 | (static_cast<unsigned char>(byte) & 0x3Fu);
            ascii += asciiOfLetter(code);
        } else {
            ascii += '?';
            text.remove_prefix(1);
            continue;
        }
        text.remove_prefix(bytes);
    }
    return ascii;
}

}  // namespace worldy
