// Finds the letters of a query in a text in their order, not necessarily side by side. Pure functions, any
// thread.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "ui/model/text_filter.h"

namespace worldy::ui {

struct FuzzyMatch {
    int score = 0;                // larger is better; comparable for one query
    std::vector<TextPart> parts;  // the matched letters, in order; neighbours are one part
};

inline constexpr std::size_t mostFuzzyLetters = 64;  // of a query; texts are searched in their first 256

// Returns the best match; none: the text does not contain the letters of the query in this order. The case of
// ASCII letters and the query's spaces do not matter. Letters at the beginning of words and letters side by
// side make a better match, gaps and a long text a worse one. An empty query matches with score 0.
std::optional<FuzzyMatch> fuzzyMatch(std::string_view query, std::string_view text);

}  // namespace worldy::ui
