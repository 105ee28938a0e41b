#include "ui/model/time_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/plot_scale.h"

namespace worldy::ui {

namespace {

struct TimeUnit {
    std::int64_t ns;
    const char* symbol;
};
constexpr std::array<TimeUnit, 4> timeUnits = {
    {{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "µs"}, {1, "ns"}}};

// Returns the largest unit that is at most ns long.
const TimeUnit& unitOf(std::int64_t ns) {
    const auto unit = std::ranges::find_if(timeUnits, [&](const TimeUnit& each) { return ns >= each.ns; });
    return unit != timeUnits.end() ? *unit : timeUnits.back();
}

// Returns a time as a multiple of a unit, with as many digits as a step needs.
std::string inUnit(std::int64_t ns, std::int64_t stepNs, const TimeUnit& unit) {
    int decimals = 0;
    for (std::int64_t one = unit.ns; one > 1 && stepNs % one != 0; one /= 10) ++decimals;
    return fmt::format("{:.{}f} {}", static_cast<double>(ns) / static_cast<double>(unit.ns), decimals,
                       unit.symbol);
}

}  // namespace

TimeRange within(const TimeRange& range, const TimeRange& all) {
    const std::int64_t mostNs = std::max(all.lengthNs(), shortestRangeNs);
    const std::int64_t lengthNs = std::clamp(range.lengthNs(), shortestRangeNs, mostNs);
    const std::int64_t fromNs = std::max(std::min(range.fromNs, all.toNs - lengthNs), all.fromNs);
    return {fromNs, fromNs + lengthNs};
}

TimeRange zoomed(const TimeRange& range, double place, double factor, const TimeRange& all) {
    const std::int64_t mostNs = std::max(all.lengthNs(), shortestRangeNs);
    const double lengthNs = std::clamp(static_cast<double>(range.lengthNs()) * factor,
                                       static_cast<double>(shortestRangeNs), static_cast<double>(mostNs));
    const double heldNs = place * static_cast<double>(range.lengthNs());
    const std::int64_t fromNs = range.fromNs + std::llround(heldNs - place * lengthNs);
    return within({fromNs, fromNs + std::llround(lengthNs)}, all);
}

TimeRange moved(const TimeRange& range, double share, const TimeRange& all) {
    const std::int64_t byNs = std::llround(share * static_cast<double>(range.lengthNs()));
    return within({range.fromNs + byNs, range.toNs + byNs}, all);
}

std::vector<TimeTick> timeTicks(const TimeRange& range, std::int64_t originNs, std::size_t most) {
    std::vector<TimeTick> ticks;
    if (range.lengthNs() <= 0 || most == 0) return ticks;
    const double least = static_cast<double>(range.lengthNs()) / static_cast<double>(most);
    const auto stepNs = std::max(static_cast<std::int64_t>(std::llround(roundedTop(least))), std::int64_t{1});
    const std::int64_t fromNs = range.fromNs - originNs;
    std::int64_t atNs = (fromNs / stepNs) * stepNs;
    if (atNs < fromNs) atNs += stepNs;
    const TimeUnit& unit = unitOf(range.lengthNs());
    const std::int64_t firstNs = atNs;
    const bool isFar = unit.ns < timeUnits[0].ns && std::abs(firstNs) / unit.ns >= 1'000;
    for (; atNs < range.toNs - originNs; atNs += stepNs) {
        std::string label = !isFar            ? inUnit(atNs, stepNs, unit)
                            : atNs == firstNs ? inUnit(atNs, stepNs, timeUnits[0])
                                              : "+" + inUnit(atNs - firstNs, stepNs, unit);
        ticks.push_back({originNs + atNs, std::move(label)});
    }
    return ticks;
}

std::string spanTimeText(std::int64_t ns) {
    const TimeUnit& unit = unitOf(std::max(std::abs(ns), std::int64_t{1}));
    const double value = static_cast<double>(ns) / static_cast<double>(unit.ns);
    const int decimals = unit.ns == 1 ? 0 : std::abs(value) < 9.995 ? 2 : std::abs(value) < 99.95 ? 1 : 0;
    return fmt::format("{:.{}f} {}", value, decimals, unit.symbol);
}

std::vector<SpanBox> boxesOf(const TimelineRow& row, const TimeRange& range, float widthPx) {
    std::vector<SpanBox> boxes;
    if (range.lengthNs() <= 0 || !(widthPx > 0)) return boxes;
    const double pxPerNs = static_cast<double>(widthPx) / static_cast<double>(range.lengthNs());
    const auto px = [&](std::int64_t ns) {
        return std::clamp(static_cast<double>(ns - range.fromNs) * pxPerNs, 0.0,
                          static_cast<double>(widthPx));
    };
    bool isShared = false;  // the last box is that of a column
    for (auto span = std::ranges::upper_bound(row, range.fromNs, {}, &planet::Span::endNs);
         span != row.end() && span->beginNs < range.toNs; ++span) {
        const double fromPx = px(span->beginNs), toPx = px(span->endNs);
        const std::int64_t busyNs = std::min(span->endNs, range.toNs) - std::max(span->beginNs, range.fromNs);
        if (toPx - fromPx >= 1) {
            boxes.push_back({static_cast<float>(fromPx), static_cast<float>(toPx), &*span, 1, busyNs});
            isShared = false;
            continue;
        }
        const auto column = static_cast<float>(std::floor(fromPx));
        if (isShared && boxes.back().fromPx == column) {
            SpanBox& box = boxes.back();
            ++box.spans;
            box.busyNs += busyNs;
            if (span->endNs - span->beginNs > box.longest->endNs - box.longest->beginNs) box.longest = &*span;
            continue;
        }
        boxes.push_back({column, std::min(column + 1, widthPx), &*span, 1, busyNs});
        isShared = true;
    }
    return boxes;
}

}  // namespace worldy::ui
