#include "ui/model/text_filter.h"
#include "app/base/text.h"

#include <algorithm>

namespace worldy::ui {

namespace {

bool isSameLetter(char a, char b) {
    return lowerAscii(a) == lowerAscii(b);
}

std::size_t findPart(std::string_view text, std::string_view part, std::size_t from) {
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(from);
    const auto found = std::search(begin, text.end(), part.begin(), part.end(), isSameLetter);
    return found == text.end() ? std::string_view::npos : static_cast<std::size_t>(found - text.begin());
}

// Calls use(word) for each word. Stops and returns false if use returns false.
template <class Use>
bool forEachWord(std::string_view text, const Use& use) {
    constexpr std::string_view blanks = " \t";
    for (std::size_t at = 0; (at = text.find_first_not_of(blanks, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
        if (!use(text.substr(at, end - at))) return false;
        at = end;
    }
    return true;
}

}  // namespace

bool holds(std::string_view text, std::string_view part) {
    return part.empty() || findPart(text, part, 0) != std::string_view::npos;
}

bool passes(std::string_view filter, std::initializer_list<std::string_view> texts) {
    return forEachWord(filter, [&](std::string_view word) {
        return std::any_of(texts.begin(), texts.end(),
                           [&](std::string_view text) { return holds(text, word); });
    });
}

std::vector<TextPart> hitsIn(std::string_view text, std::string_view filter) {
    std::vector<bool> isHit(text.size(), false);
    forEachWord(filter, [&](std::string_view word) {
        for (std::size_t at = findPart(text, word, 0); at != std::string_view::npos;
             at = findPart(text, word, at + 1))
            std::fill_n(isHit.begin() + static_cast<std::ptrdiff_t>(at), word.size(), true);
        return true;
    });
    std::vector<TextPart> hits;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!isHit[i]) continue;
        if (i == 0 || !isHit[i - 1]) hits.push_back({i, 0});
        ++hits.back().size;
    }
    return hits;
}

}  // namespace worldy::ui
