#include "planet/measure/atlas_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "planet/base/result.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"

namespace planet {

namespace {

constexpr std::string_view chunksKey = "chunks";

std::optional<AtlasMeasure> atlasMeasureNamed(std::string_view key) {
    if (key == "error_px") return AtlasMeasure::MeasuredPx;
    for (std::size_t i = 0; i < atlasMeasureCount; ++i) {
        if (atlasMeasureTexts[i].key == key) return static_cast<AtlasMeasure>(i);
    }
    return std::nullopt;
}

tl::unexpected<Error> badLimit(const std::string& text) {
    std::string keys{chunksKey};
    for (const AtlasMeasureText& one : atlasMeasureTexts) keys += fmt::format(", {}", one.key);
    return badInput(fmt::format(
        "{}: is not a limit; expected NAME=+X or NAME=-X, or X% of the old value, with one of the names {}",
        text, keys));
}

}  // namespace

Result<AtlasLimit> atlasLimitFromText(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return badLimit(text);
    const std::string_view key = std::string_view(text).substr(0, equals);
    std::string_view value = std::string_view(text).substr(equals + 1);
    AtlasLimit limit{.measure = atlasMeasureNamed(key)};
    if ((!limit.measure && key != chunksKey) || value.empty() || (value[0] != '+' && value[0] != '-'))
        return badLimit(text);
    limit.isDown = value[0] == '-';
    value.remove_prefix(1);
    limit.isShare = value.ends_with('%');
    if (limit.isShare) value.remove_suffix(1);
    const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), limit.by);
    const bool isNumber = status == std::errc{} && end == value.data() + value.size();
    if (!isNumber || !std::isfinite(limit.by) || std::signbit(limit.by)) return badLimit(text);
    if (!limit.measure && (limit.isDown || limit.isShare))
        return badInput(fmt::format("{}: chunks are counted; expected chunks=+N", text));
    if (limit.isShare) limit.by /= 100;
    return limit;
}

std::string textOf(const AtlasLimit& limit) {
    return fmt::format("{}={}{:g}{}", limit.measure ? textOf(*limit.measure).key : chunksKey,
                       limit.isDown ? '-' : '+', limit.isShare ? 100 * limit.by : limit.by,
                       limit.isShare ? "%" : "");
}

bool isExceeded(const AtlasLimit& limit, double before, double now) {
    const double by = (limit.isDown ? -1 : 1) * AtlasMove{0, before, now}.by();
    if (std::isinf(by)) return by > 0;
    return by > 0 && by > (limit.isShare ? limit.by * before : limit.by);
}

Result<std::vector<AtlasMeasureDiff>> compareViewpoints(std::span<const AtlasViewpoint> before,
                                                        std::span<const AtlasViewpoint> now) {
    if (before.size() != now.size())
        return badInput(fmt::format("{} viewpoints cannot be compared with {}", before.size(), now.size()));
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i].place != now[i].place || before[i].eyeM != now[i].eyeM)
            return badInput(fmt::format("viewpoint {} is not the same in both surveys", i));
    }
    std::vector<AtlasMeasureDiff> diffs;
    for (std::size_t measure = 0; measure < atlasMeasureCount; ++measure) {
        AtlasMeasureDiff diff{.measure = static_cast<AtlasMeasure>(measure)};
        for (std::size_t i = 0; i < before.size(); ++i) {
            const AtlasMove move{i, before[i].figures[measure], now[i].figures[measure]};
            if (std::isnan(move.by())) continue;
            ++diff.compared;
            if (move.by() == 0) continue;
            ++(move.by() > 0 ? diff.grew : diff.shrank);
            diff.moves.push_back(move);
        }
        std::stable_sort(diff.moves.begin(), diff.moves.end(),
                         [](const AtlasMove& a, const AtlasMove& b) { return a.by() > b.by(); });
        if (diff.compared > 0) diffs.push_back(std::move(diff));
    }
    return diffs;
}

std::vector<AtlasViewpoint> changesOf(std::span<const AtlasViewpoint> before,
                                      std::span<const AtlasViewpoint> now) {
    std::vector<AtlasViewpoint> changes(now.begin(), now.end());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        for (std::size_t measure = 0; measure < atlasMeasureCount; ++measure)
            changes[i].figures[measure] =
                AtlasMove{i, before[i].figures[measure], now[i].figures[measure]}.by();
    }
    return changes;
}

double worseChange(double a, double b) {
    if (a > 0 || b > 0) return std::fmax(a, b);
    return std::fmin(a, b);
}

std::vector<AtlasCell> changedCellsOf(const AtlasGrid& grid, std::span<const AtlasViewpoint> changes) {
    std::map<std::pair<std::uint8_t, ChunkId>, AtlasFigures> worst;
    for (const AtlasViewpoint& change : changes) {
        const auto [found, isNew] =
            worst.try_emplace({change.place.altitude, change.place.cell}, change.figures);
        if (isNew) continue;
        for (std::size_t i = 0; i < atlasMeasureCount; ++i)
            found->second[i] = worseChange(found->second[i], change.figures[i]);
    }
    std::vector<AtlasCell> cells = cellsOf(grid, changes);
    for (AtlasCell& cell : cells) cell.values = worst.at({cell.altitude, cell.cell});
    return cells;
}

}  // namespace planet
