#include "app/settings/region_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <system_error>
#include <utility>

#include "app/base/output_file.h"
#include "app/base/toml_file.h"
#include "app/settings/settings.h"
#include "planet/base/try.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;
using planet::Region;
using planet::Result;

// An entry of a file: the node, and its name in errors.
struct RegionEntry {
    const fs::path& file;
    std::string name;
    const toml::node& node;

    auto wrongNode(std::string_view expected) const {
        return wrong(file, node, fmt::format("{} is {}; expected {}", name, shownValue(node), expected));
    }
    RegionEntry of(std::string_view key, const toml::node& child) const {
        return {file, fmt::format("{}: {}", name, key), child};
    }
    Result<double> number(double min, double max, std::string_view unit) const {
        return readNumber(file, name, node, {min, max, unit});
    }
};

// Reads an array of numbers of a fixed length.
template <std::size_t count>
Result<std::array<double, count>> numbersOf(const RegionEntry& entry,
                                            const std::array<NumberRange, count>& ranges,
                                            std::string_view expected) {
    const toml::array* const array = entry.node.as_array();
    if (!array || array->size() != count) return entry.wrongNode(expected);
    std::array<double, count> numbers{};
    for (std::size_t i = 0; i < count; ++i) {
        TRY_ASSIGN(numbers[i], readNumber(entry.file, entry.name, *array->get(i), ranges[i]));
    }
    return numbers;
}

// Calls read for each element of an array.
template <class Read>
Result<void> eachOf(const RegionEntry& entry, std::string_view element, std::size_t most,
                    std::string_view expected, const Read& read) {
    const toml::array* const array = entry.node.as_array();
    if (!array) return entry.wrongNode(expected);
    if (array->size() > most) {
        return wrong(entry.file, entry.node,
                     fmt::format("{}: {} of them; expected at most {}", entry.name, array->size(), most));
    }
    std::size_t number = 0;
    for (const toml::node& node : *array) TRY(read(entry.of(fmt::format("{} {}", element, ++number), node)));
    return {};
}

constexpr NumberRange latitudes{-90, 90, "degrees"};
constexpr NumberRange longitudes{-180, 180, "degrees"};

Result<void> readCircles(const RegionEntry& entry, Region& region) {
    const auto circle = [&](const RegionEntry& one) -> Result<void> {
        const std::array<NumberRange, 3> ranges = {latitudes, longitudes, {0, planet::mostRegionM, "m"}};
        TRY_ASSIGN(const auto n, numbersOf<3>(one, ranges, "[latitude, longitude, radius in metres]"));
        region.circles.push_back({{n[0], n[1]}, n[2]});
        return {};
    };
    return eachOf(entry, "circle", planet::mostCircles, "a list of [latitude, longitude, radius in metres]",
                  circle);
}

Result<void> readPolygons(const RegionEntry& entry, Region& region) {
    const auto corner = [&](const RegionEntry& one) -> Result<void> {
        const std::array<NumberRange, 2> ranges = {latitudes, longitudes};
        TRY_ASSIGN(const auto n, numbersOf<2>(one, ranges, "[latitude, longitude]"));
        region.polygons.back().push_back({n[0], n[1]});
        return {};
    };
    const auto polygon = [&](const RegionEntry& one) {
        region.polygons.emplace_back();
        return eachOf(one, "corner", planet::mostCorners, "a list of [latitude, longitude]", corner);
    };
    return eachOf(entry, "polygon", planet::mostPolygons, "a list of lists of [latitude, longitude]",
                  polygon);
}

Result<void> readHeights(const RegionEntry& entry, Region& region) {
    constexpr NumberRange heights{-planet::mostRegionM, planet::mostRegionM, "m"};
    TRY_ASSIGN(const auto n, numbersOf<2>(entry, {heights, heights}, "[lowest, highest] in metres"));
    if (!region.heights) region.heights.emplace();
    region.heights->lowestM = n[0];
    region.heights->highestM = n[1];
    return {};
}

Result<void> readMetric(const RegionEntry& entry, Region& region) {
    const std::string word = entry.node.value_or(std::string());
    const auto found = std::find(errorMetricNames.begin(), errorMetricNames.end(), word);
    if (found == errorMetricNames.end()) return entry.wrongNode("\"additive\" or \"tight\"");
    region.metric = static_cast<planet::ErrorMetric>(found - errorMetricNames.begin());
    return {};
}

Result<int> levelOf(const RegionEntry& entry) {
    return readInteger(entry.file, entry.name, entry.node, {0, planet::maxLevel, ""})
        .map([](std::int64_t level) { return static_cast<int>(level); });
}

Result<void> readKey(std::string_view key, const RegionEntry& entry, Region& region,
                     std::optional<double>& bandBorderM) {
    const auto into = [](auto& value) { return [&value](auto read) { value = std::move(read); }; };
    if (key == "name") return readText(entry.file, entry.name, entry.node).map(into(region.name));
    if (key == "on") return readBool(entry.file, entry.name, entry.node).map(into(region.on));
    if (key == "circles") return readCircles(entry, region);
    if (key == "polygons") return readPolygons(entry, region);
    if (key == "heights_m") return readHeights(entry, region);
    if (key == "heights_border_m") return entry.number(0, planet::mostRegionM, "m").map(into(bandBorderM));
    if (key == "border_m") return entry.number(0, planet::mostRegionM, "m").map(into(region.borderM));
    if (key == "tau_factor")
        return entry.number(planet::leastTauFactor, planet::mostTauFactor, "").map(into(region.tauFactor));
    if (key == "least_level") return levelOf(entry).map(into(region.leastLevel));
    if (key == "most_level") return levelOf(entry).map(into(region.mostLevel));
    if (key == "metric") return readMetric(entry, region);
    return wrong(entry.file, entry.node,
                 fmt::format("{} is an unknown key; expected one of name, on, circles, polygons, heights_m, "
                             "heights_border_m, border_m, tau_factor, least_level, most_level, metric",
                             entry.name));
}

Result<void> readRegion(const RegionEntry& entry, std::vector<Region>& regions) {
    const toml::table* const table = entry.node.as_table();
    if (!table) return entry.wrongNode("a table with a name, [[region]]");
    Region region;
    std::optional<double> bandBorderM;
    for (const auto& [key, value] : *table)
        TRY(readKey(key.str(), entry.of(fmt::format("{:.40}", key.str()), value), region, bandBorderM));
    if (bandBorderM && !region.heights) {
        return wrong(entry.file, entry.node,
                     entry.name + ": heights_border_m is given without heights_m; expected both");
    }
    if (bandBorderM) region.heights->borderM = *bandBorderM;
    const std::string name = fmt::format("{} \"{}\"", entry.name, region.name);
    if (const Result<void> good = checkRegion(region); !good)
        return wrong(entry.file, entry.node, fmt::format("{}: {}", name, good.error().message));
    if (std::ranges::find(regions, region.name, &Region::name) != regions.end()) {
        return wrong(entry.file, entry.node,
                     fmt::format("{}: name: an earlier region has it; expected a unique name", name));
    }
    regions.push_back(std::move(region));
    return {};
}

// Reads the regions, and refuses too many circles or corners before it looks at them.
Result<void> readRegions(const fs::path& file, const toml::array& array, std::vector<Region>& regions) {
    std::size_t number = 0;
    for (const toml::node& node : array) {
        TRY(readRegion({file, fmt::format("region {}", ++number), node}, regions));
        if (const Result<void> few = checkCounts(regions); !few)
            return wrong(file, node, few.error().message);
    }
    return {};
}

Result<std::vector<Region>> regionsOf(const toml::table& table, const fs::path& file) {
    std::vector<Region> regions;
    for (const auto& [key, value] : table) {
        if (key.str() != "region") {
            return wrong(file, value,
                         fmt::format("{:.40} is an unknown key; expected tables [[region]]", key.str()));
        }
        const RegionEntry all{file, "region", value};
        const toml::array* const array = value.as_array();
        if (!array) return all.wrongNode("tables [[region]], with two brackets");
        if (array->size() > planet::mostRegions) {
            return wrong(
                file, value,
                fmt::format("region: {} of them; expected at most {}", array->size(), planet::mostRegions));
        }
        TRY(readRegions(file, *array, regions));
    }
    return regions;
}

std::string circleText(const planet::RegionCircle& circle) {
    return fmt::format("[{}, {}, {}]", circle.centre.latitudeDeg, circle.centre.longitudeDeg, circle.radiusM);
}

std::string polygonText(const planet::RegionPolygon& polygon) {
    std::vector<std::string> corners;
    corners.reserve(polygon.size());
    for (const planet::RegionPoint& corner : polygon)
        corners.push_back(fmt::format("[{}, {}]", corner.latitudeDeg, corner.longitudeDeg));
    return fmt::format("[{}]", fmt::join(corners, ", "));
}

// Returns a list, one element a line.
template <class Elements, class TextOf>
std::string listText(std::string_view key, const Elements& elements, TextOf textOf) {
    if (elements.empty()) return {};
    std::string text = fmt::format("{} = [\n", key);
    for (const auto& element : elements) text += fmt::format("    {},\n", textOf(element));
    return text + "]\n";
}

}  // namespace

Result<std::vector<Region>> loadRegions(const fs::path& file) {
    TRY_ASSIGN(const auto table, parseTomlFile(file));
    return regionsOf(table, file);
}

Result<std::vector<Region>> regionsFromText(std::string_view text, const fs::path& place) {
    TRY_ASSIGN(const auto table, parseTomlText(text, place));
    return regionsOf(table, place);
}

std::string regionsText(const std::vector<Region>& regions) {
    std::string text;
    for (const Region& region : regions) {
        text += fmt::format("{}[[region]]\nname = {}\n", text.empty() ? "" : "\n", tomlText(region.name));
        if (!region.on) text += "on = false\n";
        if (region.tauFactor) text += fmt::format("tau_factor = {}\n", *region.tauFactor);
        if (region.leastLevel) text += fmt::format("least_level = {}\n", *region.leastLevel);
        if (region.mostLevel) text += fmt::format("most_level = {}\n", *region.mostLevel);
        if (region.metric)
            text +=
                fmt::format("metric = \"{}\"\n", errorMetricNames[static_cast<std::size_t>(*region.metric)]);
        if (region.borderM > 0) text += fmt::format("border_m = {}\n", region.borderM);
        if (region.heights) {
            text += fmt::format("heights_m = [{}, {}]\n", region.heights->lowestM, region.heights->highestM);
            if (region.heights->borderM > 0)
                text += fmt::format("heights_border_m = {}\n", region.heights->borderM);
        }
        text += listText("circles", region.circles, circleText);
        text += listText("polygons", region.polygons, polygonText);
    }
    return text;
}

Result<void> saveRegions(const std::vector<Region>& regions, const fs::path& file) {
    return writeTextFile(file, std::string(regionsFileHead) + regionsText(regions));
}

bool isRegionsFile(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.size() > regionsFileEnding.size() && name.ends_with(regionsFileEnding);
}

fs::path regionsFileOf(const fs::path& planetFile) {
    fs::path file = planetFile;
    return file.replace_extension(regionsFileEnding);
}

Result<RegionSettings> regionsFor(const fs::path& given, const fs::path& planetFile) {
    std::error_code status;
    const fs::path file = given.empty() ? regionsFileOf(planetFile) : given;
    if (given.empty() && !fs::exists(file, status)) return RegionSettings{};
    TRY_ASSIGN(auto regions, loadRegions(file));
    return RegionSettings{.list = std::make_shared<const std::vector<Region>>(std::move(regions)),
                          .file = file.string()};
}

}  // namespace worldy
