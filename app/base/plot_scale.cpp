#include "app/base/plot_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "app/base/text.h"

namespace worldy {

double roundedTop(double largest) {
    if (!(largest > 0) || !std::isfinite(largest)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(largest)));
    for (const double step : {1.0, 2.0, 5.0}) {
        // The tolerance keeps a rounded value from moving up to the next step.
        if (largest <= step * power * (1 + 1e-9)) return step * power;
    }
    return 10 * power;
}

std::string axisText(double value) {
    const double size = std::abs(value);
    if (size >= 9'999.5) return countText(value);
    if (size >= 99.95) return fmt::format("{:.0f}", value);
    return fmt::format("{:.3g}", value);
}

std::vector<std::size_t> peakOfColumns(std::span<const float> timesS, std::span<const float> values,
                                       float columnS) {
    assert(timesS.size() == values.size() && columnS > 0);
    std::vector<std::size_t> peaks;
    double column = 0;
    for (std::size_t i = 0; i < timesS.size(); ++i) {
        const double own = std::floor(static_cast<double>(timesS[i]) / static_cast<double>(columnS));
        if (peaks.empty() || own != column) {
            peaks.push_back(i);
            column = own;
        } else if (values[i] > values[peaks.back()]) {
            peaks.back() = i;
        }
    }
    return peaks;
}

std::vector<float> summed(std::span<const std::span<const float>> rows) {
    std::vector<float> sums(rows.empty() ? 0 : rows.front().size(), 0.0f);
    for (const std::span<const float> row : rows) {
        assert(row.size() == sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += row[i];
    }
    return sums;
}

namespace {

// Returns the ticks of a decade. A wider axis has fewer of them.
std::vector<double> roundSteps(double ratio) {
    if (ratio > 500) return {1};
    if (ratio > 5) return {1, 2, 5};
    return {1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9};
}

}  // namespace

LogAxis logAxisOver(std::span<const double> values) {
    LogAxis axis;
    if (values.empty()) return axis;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    assert(*least > 0);
    constexpr double rounding = 1e-9;
    axis.ticks.clear();
    for (double decade = std::pow(10, std::floor(std::log10(*least)));; decade *= 10) {
        for (const double step : roundSteps(*most / *least)) {
            const double tick = decade * step;
            if (tick <= *least * (1 + rounding)) axis.ticks.clear();
            axis.ticks.push_back(tick);
            if (tick < *most * (1 - rounding) || axis.ticks.size() < 2) continue;
            axis.lowest = axis.ticks.front();
            axis.highest = axis.ticks.back();
            return axis;
        }
    }
}

double linearPosition(double value, double lowest, double highest) {
    if (!(highest > lowest)) return 0;
    return std::clamp((value - lowest) / (highest - lowest), 0.0, 1.0);
}

double logarithmicPosition(double value, double lowest, double highest) {
    assert(lowest > 0 && highest > 0);
    return value > lowest ? linearPosition(std::log(value), std::log(lowest), std::log(highest)) : 0;
}

double logarithmicValue(double position, double lowest, double highest) {
    assert(lowest > 0 && highest > 0);
    return lowest * std::pow(highest / lowest, position);
}

std::vector<float> bucketCounts(std::span<const float> positions, std::size_t buckets) {
    assert(buckets > 0);
    std::vector<float> counts(buckets, 0.0f);
    for (const float position : positions) {
        const float place = std::clamp(position, 0.0f, 1.0f) * static_cast<float>(buckets);
        counts[std::min(static_cast<std::size_t>(place), buckets - 1)] += 1;
    }
    return counts;
}

std::vector<float> growthPerS(std::span<const float> timesS, std::span<const double> totals, double windowS) {
    assert(timesS.size() == totals.size() && windowS > 0);
    std::vector<float> rates(timesS.size(), 0.0f);
    std::size_t first = 0;
    for (std::size_t i = 1; i < timesS.size(); ++i) {
        if (totals[i] < totals[i - 1]) first = i;
        while (first + 1 < i && static_cast<double>(timesS[i] - timesS[first]) > windowS) ++first;
        const double seconds = static_cast<double>(timesS[i] - timesS[first]);
        if (seconds > 0) rates[i] = static_cast<float>((totals[i] - totals[first]) / seconds);
    }
    return rates;
}

}  // namespace worldy
