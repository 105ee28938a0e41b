// Converts terrain to and from text, so that a string names it as a path names a file.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/source/terrain.h"

namespace planet {

namespace {

constexpr std::string_view noisePrefix = "noise:";
constexpr std::string_view detailPrefix = "detail:";
constexpr std::string_view ofKey = "of";

// Returns the Levenshtein distance.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

std::string_view nearestTo(std::string_view name, std::span<const std::string_view> names) {
    return *std::min_element(names.begin(), names.end(), [&](std::string_view a, std::string_view b) {
        return distance(a, name) < distance(b, name);
    });
}

// Removes and returns the part of the text before the separator; the whole text if there is none.
std::string_view cutAt(char separator, std::string_view& text) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view first = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return first;
}

Result<const TerrainKind*> kindNamed(std::string_view name) {
    std::vector<std::string_view> names;
    for (const TerrainKind& kind : terrainKinds()) {
        if (kind.name == name) return &kind;
        if (kind.name.starts_with(noisePrefix)) names.push_back(kind.name);
    }
    return badInput(fmt::format("{}: unknown terrain; did you mean {}? expected one of {}", name,
                                nearestTo(name, names), fmt::join(names, ", ")));
}

Result<void> setField(const TerrainKind& kind, std::string_view key, std::string_view value,
                      TerrainSource& source) {
    const auto setting = std::find_if(kind.fields.begin(), kind.fields.end(),
                                      [&](const TerrainField& candidate) { return candidate.name == key; });
    if (setting == kind.fields.end()) {
        std::vector<std::string_view> names;
        for (const TerrainField& candidate : kind.fields) names.push_back(candidate.name);
        if (kind.name == "detail") names.push_back(ofKey);
        return badInput(fmt::format("{}: {} is an unknown setting; did you mean {}? expected one of {}",
                                    kind.name, key, nearestTo(key, names), fmt::join(names, ", ")));
    }
    double number = 0;
    const auto [end, problem] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool good = problem == std::errc{} && end == value.data() + value.size();
    const bool inRange = good && number >= setting->least && number <= setting->most;
    if (!inRange || (setting->whole && number != std::floor(number))) {
        return badInput(fmt::format("{}: {} is {}; expected {} in [{}, {}]{}{}", kind.name, key,
                                    value.empty() ? "empty" : value,
                                    setting->whole ? "an integer" : "a number", setting->least, setting->most,
                                    setting->unit.empty() || setting->unit == "°" ? "" : " ", setting->unit));
    }
    setting->set(source.settings, number);
    return {};
}

Result<void> setFields(const TerrainKind& kind, std::string_view rest, TerrainSource& source) {
    std::vector<std::string_view> seen;
    while (!rest.empty()) {
        const std::string_view whole = rest;
        std::string_view value = cutAt(',', rest);
        const std::string_view key = cutAt('=', value);
        if (kind.name == "detail" && key == ofKey) {
            source.of = std::string(whole.substr(std::min(whole.size(), ofKey.size() + 1)));
            return {};
        }
        if (std::find(seen.begin(), seen.end(), key) != seen.end())
            return badInput(fmt::format("{}: {} is given twice; expected once", kind.name, key));
        seen.push_back(key);
        TRY(setField(kind, key, value, source));
    }
    return {};
}

}  // namespace

bool isTerrainText(const std::filesystem::path& path) {
    const std::string text = path.string();
    return text.starts_with(noisePrefix) || text.starts_with(detailPrefix);
}

Result<TerrainSource> terrainFromText(const std::filesystem::path& path) {
    const std::string text = path.string();
    std::string_view rest = text;
    const bool isDetail = text.starts_with(detailPrefix);
    const std::string_view name = cutAt(isDetail ? ':' : ',', rest);
    TRY_ASSIGN(const auto kind, kindNamed(name));
    TerrainSource source{kind->defaults, {}};
    TRY(setFields(*kind, rest, source));
    TRY(checkTerrain(source.settings));
    if (isDetail && source.of.empty())
        return badInput("detail: has no source; expected detail:strength=1,of=PATH");
    return source;
}

Result<std::string> wholeTerrainText(const std::filesystem::path& text) {
    TRY_ASSIGN(auto source, terrainFromText(text));
    if (isTerrainText(source.of)) {
        Result<std::string> of = wholeTerrainText(source.of);
        if (!of) return of;
        source.of = *std::move(of);
    } else if (!source.of.empty()) {
        std::error_code problem;
        source.of = std::filesystem::absolute(source.of, problem).lexically_normal();
    }
    return terrainText(source);
}

std::string terrainText(const TerrainSource& source) {
    const TerrainKind& kind = kindOf(source.settings);
    std::string text(kind.name);
    const bool isDetail = std::holds_alternative<DetailTerrain>(source.settings);
    char separator = isDetail ? ':' : ',';
    for (const TerrainField& setting : kind.fields) {
        const double value = setting.get(source.settings);
        if (value == setting.get(kind.defaults) && setting.name != "seed") continue;
        text += fmt::format("{}{}={}", separator, setting.name, value);
        separator = ',';
    }
    if (isDetail) text += fmt::format("{}{}={}", separator, ofKey, source.of.string());
    return text;
}

}  // namespace planet
