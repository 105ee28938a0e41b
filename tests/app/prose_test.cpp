// Checks the words of labels and messages: no string of the sources uses a phrase that was retired.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

// A range is "expected [a, b]", a unit is a symbol, and a rate is "per".
constexpr std::array<std::string_view, 28> retiredPhrases = {
    "will do",         "f} deg",         "f deg",
    "deg of arc",      "degrees of arc", "that there is not",
    "taken over",      "as it is now",   "stays as it",
    "makes no sense",  "is none of its", "is no part of",
    "has no memory",   "has no room",    "must be from",
    "must be over",    "must be 2^n",    "must be {}",
    "samples a side",  "cells a side",   "bits a sample",
    "samples a pixel", "levels a tile",  "not counted in",
    "from on high",    "on purpose",     "anew",
    "said to be"};

bool isRetired(std::string_view text) {
    return std::any_of(retiredPhrases.begin(), retiredPhrases.end(),
                       [&](std::string_view phrase) { return text.find(phrase) != std::string_view::npos; });
}

// Returns the strings of a source without its comments. Strings with only space between them are one.
std::vector<std::string> stringsIn(std::string_view source) {
    std::vector<std::string> found;
    bool joins = false;
    for (std::size_t i = 0; i < source.size(); ++i) {
        const char quote = source[i];
        const bool separatesDigits = quote == '\'' && i > 0 && source[i - 1] >= '0' && source[i - 1] <= '9';
        if (source.substr(i, 2) == "//") {
            i = std::min(source.find('\n', i), source.size());
        } else if ((quote == '"' || quote == '\'') && !separatesDigits) {
            std::string text;
            for (++i; i < source.size() && source[i] != quote && source[i] != '\n'; ++i) {
                text += source[i];
                if (source[i] == '\\' && i + 1 < source.size()) text += source[++i];
            }
            if (quote == '\'') continue;
            if (joins)
                found.back() += text;
            else
                found.push_back(text);
            joins = true;
        } else if (quote != ' ' && quote != '\n') {
            joins = false;
        }
    }
    return found;
}

TEST(Prose, stringsAreReadWholeAndWithoutComments) {
    const auto found =
        stringsIn("f(\"loader \"\n  \"threads\");  // \"no\"\nchar c = '\"'; g(\"a\\\"\", \"b\");");
    EXPECT_EQ(found, (std::vector<std::string>{"loader threads", "a\\\"", "b"}));
}

TEST(Prose, noLabelOrMessageUsesARetiredPhrase) {
    namespace fs = std::filesystem;
    std::size_t read = 0;
    for (const char* folder : {"planet", "ui", "app"}) {
        for (const fs::directory_entry& entry :
             fs::recursive_directory_iterator(fs::path(WORLDY_SOURCE_DIR) / folder)) {
            const fs::path& file = entry.path();
            if (file.extension() != ".cpp" && file.extension() != ".h") continue;
            for (const std::string& text : stringsIn(tests::contentOf(file)))
                EXPECT_FALSE(isRetired(text)) << file << ": " << text;
            ++read;
        }
    }
    EXPECT_GT(read, 300u);
}

}  // namespace
}  // namespace worldy
