// Filters lists by typed words, and finds the hits in their texts. Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace worldy::ui {

// The text of a filter's field.
struct TextFilter {
    std::array<char, 128> text{};

    std::string_view view() const { return text.data(); }
    bool empty() const { return view().empty(); }
    bool operator==(const TextFilter&) const = default;
};

// Returns true if text contains part, ignoring the case of ASCII letters. Every text contains the empty one.
bool holds(std::string_view text, std::string_view part);

// Returns true if each word of the filter is contained in one of the texts, ignoring the case of ASCII
// letters. The empty filter passes all.
bool passes(std::string_view filter, std::initializer_list<std::string_view> texts);

// A part of a text, in bytes.
struct TextPart {
    std::size_t first = 0;
    std::size_t size = 0;

    bool operator==(const TextPart&) const = default;
};
// Returns where the words of the filter are in a text, in order and without overlaps.
std::vector<TextPart> hitsIn(std::string_view text, std::string_view filter);

}  // namespace worldy::ui
