// The budgets that a suggestion must meet. Plain data and pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "planet/base/result.h"

namespace worldy {

enum class SuggestLimit : std::uint8_t { FrameMs, Triangles, ResidentBytes, ErrorPx };
inline constexpr std::size_t suggestLimitCount = 4;
inline constexpr std::array<SuggestLimit, suggestLimitCount> suggestLimits = {
    SuggestLimit::FrameMs, SuggestLimit::Triangles, SuggestLimit::ResidentBytes, SuggestLimit::ErrorPx};

// Names on screen, and keys of reports.
struct SuggestLimitText {
    std::string_view name;
    std::string_view noun;  // in sentences
    std::string_view key;
};
inline constexpr std::array<SuggestLimitText, suggestLimitCount> suggestLimitTexts = {{
    {"Frame time", "frame time", "frame_ms"},
    {"Triangles", "triangles", "triangles"},
    {"Memory of chunks", "memory", "resident_bytes"},
    {"Drawn error", "drawn error", "error_px"},
}};
constexpr const SuggestLimitText& textOf(SuggestLimit limit) {
    return suggestLimitTexts[static_cast<std::size_t>(limit)];
}

// One value of each limit: milliseconds, triangles, bytes, pixels.
using SuggestValues = std::array<double, suggestLimitCount>;

struct SuggestBudget {
    std::array<std::optional<double>, suggestLimitCount> limits{};  // each > 0; unset: no limit

    const std::optional<double>& operator[](SuggestLimit limit) const {
        return limits[static_cast<std::size_t>(limit)];
    }
    std::optional<double>& operator[](SuggestLimit limit) { return limits[static_cast<std::size_t>(limit)]; }
    bool isEmpty() const;
    bool limitsCosts() const;  // frame time, triangles or memory

    bool operator==(const SuggestBudget&) const = default;
};

// Reads "16.6 ms, 200 k triangles, 64 MiB, 1.5 px": at least one budget, each once, in any order. The Error names each
// wrong part and what is right.
planet::Result<SuggestBudget> suggestBudgetFromText(std::string_view text);
// Returns such a text; reading it gives the same budget up to the digits of limitText.
std::string budgetText(const SuggestBudget& budget);
// Returns "16.6 ms", "200 k triangles", "64 MiB" or "1.5 px".
std::string limitText(SuggestLimit limit, double value);
// Reads the value of one limit: as limitText writes it, without "triangles", as "200 k", or a number alone, which counts in
// ms, triangles, MiB or px. The Error says what is wrong and what is right.
planet::Result<double> limitFromText(SuggestLimit limit, std::string_view text);

// Return the values as shares of their limits: the largest one, and the largest of costs or of the error alone. Limits
// that are unset do not count. A value that is no number counts as infinite: it was not measured, so its limit is not met.
double useOf(const SuggestBudget& budget, SuggestLimit limit, double value);
double mostUse(const SuggestBudget& budget, const SuggestValues& values);
double mostCostUse(const SuggestBudget& budget, const SuggestValues& values);
double errorUse(const SuggestBudget& budget, const SuggestValues& values);
// Returns the limit with the largest use, which binds; nothing for an empty budget.
std::optional<SuggestLimit> bindingLimit(const SuggestBudget& budget, const SuggestValues& values);

}  // namespace worldy
