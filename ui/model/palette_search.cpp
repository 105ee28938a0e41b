#include "ui/model/palette_search.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "ui/model/fuzzy_match.h"

namespace worldy::ui {

namespace {

// A match of the text that is not shown counts somewhat less.
constexpr int ofHiddenText = -12;

struct Ranked {
    PaletteRow row;
    int score = 0;
    std::size_t recent = 0;  // position among the recent ones
};

Ranked rankOf(std::string_view query, const PaletteEntry& entry, bool& isMatch) {
    Ranked ranked;
    isMatch = true;
    if (entry.isTyped) {
        ranked.score = std::numeric_limits<int>::max();
        ranked.row.matched = {{0, entry.title.size()}};
        return ranked;
    }
    const auto title = fuzzyMatch(query, entry.title);
    const auto also = entry.also.empty() ? std::nullopt : fuzzyMatch(query, entry.also);
    isMatch = title || also;
    if (!isMatch) return ranked;
    ranked.score = title ? title->score : std::numeric_limits<int>::min();
    if (also) ranked.score = std::max(ranked.score, also->score + ofHiddenText);
    if (title) ranked.row.matched = title->parts;
    return ranked;
}

}  // namespace

const char* paletteKindName(PaletteKind kind) {
    constexpr std::array names = {"command", "panel", "setting", "bookmark", "flight",
                                  "preset",  "file",  "chunk",   "place"};
    return names[static_cast<std::size_t>(kind)];
}

std::string nameOf(const PaletteEntry& entry) {
    return std::string(paletteKindName(entry.kind)) + "/" + (entry.also.empty() ? entry.title : entry.also);
}

std::vector<PaletteRow> paletteRows(std::string_view query, std::span<const PaletteEntry> entries,
                                    std::span<const std::string> recent) {
    std::vector<Ranked> ranked;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        bool isMatch = false;
        Ranked one = rankOf(query, entries[i], isMatch);
        if (!isMatch) continue;
        one.row.entry = i;
        one.recent = static_cast<std::size_t>(std::find(recent.begin(), recent.end(), nameOf(entries[i])) -
                                              recent.begin());
        ranked.push_back(std::move(one));
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
        return std::tuple(-a.score, a.recent) < std::tuple(-b.score, b.recent);
    });
    std::vector<PaletteRow> rows;
    rows.reserve(ranked.size());
    for (Ranked& one : ranked) rows.push_back(std::move(one.row));
    return rows;
}

void remember(std::vector<std::string>& recent, const std::string& name) {
    std::erase(recent, name);
    recent.insert(recent.begin(), name);
    if (recent.size() > mostRecent) recent.pop_back();
}

}  // namespace worldy::ui
