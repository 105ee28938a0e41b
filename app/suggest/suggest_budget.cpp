#include "app/suggest/suggest_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/text.h"
#include "planet/base/result.h"

namespace worldy {

namespace {

using planet::Result;

struct BudgetUnit {
    std::string_view name;
    SuggestLimit limit;
    double factor;
};
constexpr std::array<BudgetUnit, 10> budgetUnits = {{
    {"ms", SuggestLimit::FrameMs, 1},
    {"triangles", SuggestLimit::Triangles, 1},
    {"k triangles", SuggestLimit::Triangles, 1e3},
    {"M triangles", SuggestLimit::Triangles, 1e6},
    {"KiB", SuggestLimit::ResidentBytes, 1024.0},
    {"MiB", SuggestLimit::ResidentBytes, 1024.0 * 1024},
    {"GiB", SuggestLimit::ResidentBytes, 1024.0 * 1024 * 1024},
    {"MB", SuggestLimit::ResidentBytes, 1e6},
    {"GB", SuggestLimit::ResidentBytes, 1e9},
    {"px", SuggestLimit::ErrorPx, 1},
}};
constexpr double mostBudget = 1e15;

std::string_view trimmedPart(std::string_view text) {
    const auto isSpace = [](char letter) { return letter == ' ' || letter == '\t'; };
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    return text;
}

struct BudgetPart {
    SuggestLimit limit = SuggestLimit::FrameMs;
    double value = 0;
};

// Returns "ms, triangles, ... or px".
std::string unitsText() {
    std::string text;
    for (const BudgetUnit& unit : budgetUnits) {
        const bool isLast = &unit == &budgetUnits.back();
        text += fmt::format("{}{}", text.empty() ? "" : isLast ? " or " : ", ", unit.name);
    }
    return text;
}

// The problem of a part is in the Error, without the name of the option.
Result<BudgetPart> budgetPart(std::string_view part) {
    const std::string wanted = fmt::format("expected a number above 0 with {}", unitsText());
    if (part.empty()) return planet::badInput(fmt::format("a part between commas is empty; {}", wanted));
    const std::size_t digits =
        std::min(part.find_first_not_of("+-0123456789.eE"), part.size());  // "e" begins no unit
    const std::string_view unitText = trimmedPart(part.substr(digits));
    const auto* const unit = std::find_if(budgetUnits.begin(), budgetUnits.end(),
                                          [&](const BudgetUnit& one) { return one.name == unitText; });
    if (digits == 0) return planet::badInput(fmt::format("\"{}\" begins with no number; {}", part, wanted));
    const std::optional<double> number = numberFromText(part.substr(0, digits));
    if (!number || *number <= 0)
        return planet::badInput(
            fmt::format("\"{}\": {} is no number above 0; {}", part, part.substr(0, digits), wanted));
    if (unitText.empty()) return planet::badInput(fmt::format("\"{}\" has no unit; {}", part, wanted));
    if (unit == budgetUnits.end())
        return planet::badInput(fmt::format("\"{}\": the unit {} is unknown; {}", part, unitText, wanted));
    const double value = *number * unit->factor;
    if (value > mostBudget)
        return planet::badInput(
            fmt::format("\"{}\" is too large; {} and at most {:g}", part, wanted, mostBudget));
    return BudgetPart{unit->limit, value};
}

}  // namespace

bool SuggestBudget::isEmpty() const {
    return std::ranges::none_of(limits, [](const auto& limit) { return limit.has_value(); });
}

bool SuggestBudget::limitsCosts() const {
    return std::ranges::any_of(suggestLimits, [&](SuggestLimit limit) {
        return limit != SuggestLimit::ErrorPx && (*this)[limit].has_value();
    });
}

Result<SuggestBudget> suggestBudgetFromText(std::string_view text) {
    SuggestBudget budget;
    std::vector<std::string> problems;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view part = trimmedPart(text.substr(begin, end - begin));
        begin = end + 1;
        const Result<BudgetPart> read = budgetPart(part);
        if (!read) {
            problems.push_back(read.error().message);
        } else if (budget[read->limit]) {
            problems.push_back(fmt::format("\"{}\" limits {} a second time; expected each budget once", part,
                                           textOf(read->limit).noun));
        } else {
            budget[read->limit] = read->value;
        }
    }
    if (!problems.empty()) return planet::badInput(fmt::format("budget: {}", fmt::join(problems, "; ")));
    return budget;
}

std::string limitText(SuggestLimit limit, double value) {
    if (std::isnan(value)) return "not measured";
    switch (limit) {
        case SuggestLimit::FrameMs:
            return fmt::format("{:.3g} ms", value);
        case SuggestLimit::Triangles:
            if (value >= 1e6) return fmt::format("{:.4g} M triangles", value / 1e6);
            return value >= 1e4 ? fmt::format("{:.4g} k triangles", value / 1e3)
                                : fmt::format("{:.0f} triangles", value);
        case SuggestLimit::ResidentBytes:
            if (value >= 1 << 30) return fmt::format("{:.4g} GiB", value / (1 << 30));
            return value >= 1 << 20 ? fmt::format("{:.4g} MiB", value / (1 << 20))
                                    : fmt::format("{:.4g} KiB", value / (1 << 10));
        case SuggestLimit::ErrorPx:
            return value < 1e5 ? fmt::format("{:.3g} px", value) : fmt::format("{:.2e} px", value);
    }
    return "";
}

Result<double> limitFromText(SuggestLimit limit, std::string_view text) {
    constexpr std::string_view counted = " triangles";
    constexpr std::array<std::string_view, suggestLimitCount> usual = {"ms", "triangles", "MiB", "px"};
    const std::string_view part = trimmedPart(text);
    const std::size_t digits = std::min(part.find_first_not_of("+-0123456789.eE"), part.size());
    std::string_view unit = trimmedPart(part.substr(digits));
    if (unit.empty()) unit = usual[static_cast<std::size_t>(limit)];
    const std::optional<double> number = numberFromText(part.substr(0, digits));
    std::string units;
    for (const BudgetUnit& one : budgetUnits) {
        if (one.limit != limit) continue;
        std::string_view brief = one.name;
        if (brief.ends_with(counted)) brief.remove_suffix(counted.size());
        units += fmt::format("{}{}", units.empty() ? "" : ", ", one.name);
        if (unit != one.name && unit != brief) continue;
        if (number && *number > 0 && *number * one.factor <= mostBudget) return *number * one.factor;
    }
    return planet::badInput(fmt::format("\"{}\" is no {}; expected a number above 0 in {}, at most {:g}",
                                        part, textOf(limit).noun, units, mostBudget));
}

std::string budgetText(const SuggestBudget& budget) {
    std::string text;
    for (const SuggestLimit limit : suggestLimits) {
        if (!budget[limit]) continue;
        text += (text.empty() ? "" : ", ") + limitText(limit, *budget[limit]);
    }
    return text;
}

double useOf(const SuggestBudget& budget, SuggestLimit limit, double value) {
    if (!budget[limit]) return 0;
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value / *budget[limit];
}

double mostCostUse(const SuggestBudget& budget, const SuggestValues& values) {
    double most = 0;
    for (const SuggestLimit limit : suggestLimits) {
        if (limit != SuggestLimit::ErrorPx)
            most = std::max(most, useOf(budget, limit, values[static_cast<std::size_t>(limit)]));
    }
    return most;
}

double errorUse(const SuggestBudget& budget, const SuggestValues& values) {
    return useOf(budget, SuggestLimit::ErrorPx, values[static_cast<std::size_t>(SuggestLimit::ErrorPx)]);
}

double mostUse(const SuggestBudget& budget, const SuggestValues& values) {
    return std::max(mostCostUse(budget, values), errorUse(budget, values));
}

std::optional<SuggestLimit> bindingLimit(const SuggestBudget& budget, const SuggestValues& values) {
    std::optional<SuggestLimit> binds;
    double most = -1;
    for (const SuggestLimit limit : suggestLimits) {
        if (!budget[limit]) continue;
        const double use = useOf(budget, limit, values[static_cast<std::size_t>(limit)]);
        if (use > most) {
            binds = limit;
            most = use;
        }
    }
    return binds;
}

}  // namespace worldy
