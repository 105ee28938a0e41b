#include "ui/model/fuzzy_match.h"
#include "app/base/text.h"

#include <algorithm>
#include <limits>

namespace worldy::ui {

namespace {

constexpr std::size_t mostTextLetters = 256;
constexpr int none = std::numeric_limits<int>::min() / 2;
constexpr int perLetter = 16;
constexpr int atWordStart = 12;
constexpr int atTextStart = 4;  // in addition
constexpr int besideLast = 14;
constexpr int perSkippedLetter = -1;
constexpr int firstSkippedLetter = -4;

// A character of UTF-8 text.
struct Letter {
    std::string_view bytes;
    std::size_t first = 0;
};

bool isSame(const Letter& a, const Letter& b) {
    return std::equal(a.bytes.begin(), a.bytes.end(), b.bytes.begin(), b.bytes.end(),
                      [](char x, char y) { return lowerAscii(x) == lowerAscii(y); });
}

std::vector<Letter> lettersOf(std::string_view text, std::size_t most, bool withSpaces) {
    std::vector<Letter> letters;
    for (std::size_t at = 0; at < text.size() && letters.size() < most;) {
        std::size_t end = at + 1;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) ++end;
        if (withSpaces || text[at] != ' ') letters.push_back({text.substr(at, end - at), at});
        at = end;
    }
    return letters;
}

bool isWordLetter(const Letter& letter) {
    const char c = letter.bytes.front();
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (static_cast<unsigned char>(c) & 0x80u) != 0;
}

int bonusAt(const std::vector<Letter>& text, std::size_t i) {
    if (i == 0) return atWordStart + atTextStart;
    return isWordLetter(text[i]) && !isWordLetter(text[i - 1]) ? atWordStart : 0;
}

// best[q][t]: the score of the best match of the first q + 1 letters of which the last is text[t].
// from[q][t]: where the letter before it is in that match.
struct Scores {
    std::vector<std::vector<int>> best;
    std::vector<std::vector<std::size_t>> from;
};

Scores scoresOf(const std::vector<Letter>& query, const std::vector<Letter>& text) {
    Scores scores{std::vector(query.size(), std::vector<int>(text.size(), none)),
                  std::vector(query.size(), std::vector<std::size_t>(text.size(), 0))};
    for (std::size_t q = 0; q < query.size(); ++q) {
        int gapped = none;  // the best of the letters before text[t - 1], with the gap up to text[t]
        std::size_t gappedFrom = 0;
        for (std::size_t t = q; t < text.size(); ++t) {
            if (q > 0 && t > 1) {
                gapped += perSkippedLetter;
                const int opened = scores.best[q - 1][t - 2] + firstSkippedLetter;
                if (opened > gapped) gappedFrom = t - 2;
                gapped = std::max(gapped, opened);
            }
            if (!isSame(query[q], text[t])) continue;
            const int here = perLetter + bonusAt(text, t);
            if (q == 0) {
                scores.best[q][t] = here + std::max(static_cast<int>(t) * perSkippedLetter, -6);
                continue;
            }
            const int beside = scores.best[q - 1][t - 1] + besideLast;
            scores.best[q][t] = std::max(std::max(beside, gapped) + here, none);
            scores.from[q][t] = beside >= gapped ? t - 1 : gappedFrom;
        }
    }
    return scores;
}

}  // namespace

std::optional<FuzzyMatch> fuzzyMatch(std::string_view query, std::string_view text) {
    const std::vector<Letter> wanted = lettersOf(query, mostFuzzyLetters, false);
    const std::vector<Letter> letters = lettersOf(text, mostTextLetters, true);
    if (wanted.empty()) return FuzzyMatch{};
    if (wanted.size() > letters.size()) return std::nullopt;
    const Scores scores = scoresOf(wanted, letters);
    const std::vector<int>& last = scores.best.back();
    const auto best = std::max_element(last.begin(), last.end());
    if (*best < none / 2) return std::nullopt;
    FuzzyMatch match{*best - static_cast<int>(letters.size()) / 8, {}};
    auto at = static_cast<std::size_t>(best - last.begin());
    for (std::size_t q = wanted.size(); q-- > 0;) {
        const TextPart part{letters[at].first, letters[at].bytes.size()};
        if (!match.parts.empty() && part.first + part.size == match.parts.back().first)
            match.parts.back() = {part.first, part.size + match.parts.back().size};
        else
            match.parts.push_back(part);
        at = scores.from[q][at];
    }
    std::reverse(match.parts.begin(), match.parts.end());
    return match;
}

}  // namespace worldy::ui
