// Searches for the settings that meet a budget with the least drawn error. README.md beside this file says how. Pure:
// whoever calls it measures the candidates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/suggest/suggest_budget.h"
#include "planet/base/result.h"
#include "planet/tree/error_metric.h"
#include "planet/tree/region.h"

namespace worldy {

// A choice of the settings that may vary.
struct SuggestCandidate {
    double tauPx = 2;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double morphRange = 0.3;
    int memoryMiB = 256;                    // budget of the paging
    int chunkSize = 0;                      // vertices per side; 0: that of the file
    std::string plan{};                     // what the regions are: "places"; empty without any
    std::vector<planet::Region> regions{};  // besides those that the planet has

    bool operator==(const SuggestCandidate&) const = default;
};

// Sample: a few settled views, to reject candidates. Whole: every frame.
enum class SuggestScope : std::uint8_t { Sample, Whole };

struct SuggestFigures {
    SuggestValues
        values{};  // the worst of all places, at the percentile of the measurement; NaN: not measured
    double p99ErrorPx = 0;   // of all frames together
    double meanErrorPx = 0;  // likewise, where those above the 99th percentile count as that
    double worstPopPx = 0;   // of flown frames; 0 in a sample
    std::uint64_t pops = 0;
    std::uint64_t thrashes = 0;
    double lateShare = 0;  // of the drawn chunks: their children have not been loaded yet
    std::size_t frames = 0;
    // Views that were not loaded in time (suggestSettleS), so that their values are not known and no budget counts as met.
    std::size_t unsettled = 0;

    bool operator==(const SuggestFigures&) const = default;
};

struct SuggestTrial {
    SuggestCandidate candidate;
    SuggestFigures figures;
    SuggestScope scope = SuggestScope::Whole;
};

// The values that may vary. Each list holds at least the value of now, which comes first and is preferred if another one
// is not better.
struct SuggestRanges {
    bool variesTau = true;
    double leastTauPx = 0.1;  // > 0
    double mostTauPx = 64;
    std::vector<planet::ErrorMetric> metrics;
    std::vector<double> morphRanges;
    std::vector<int> memoriesMiB;
    std::vector<int> chunkSizes{0};
};

// Regions to try, with the factor on τ still open.
struct SuggestPlan {
    std::string name;
    std::vector<planet::Region> regions;
};

struct SuggestCalls {
    // An Error, also of kind Cancelled, ends the search.
    std::function<planet::Result<SuggestFigures>(const SuggestCandidate&, SuggestScope)> measure;
    // Returns regions that may help, from the last whole measurement of a candidate; may be empty.
    std::function<std::vector<SuggestPlan>(const SuggestCandidate&)> plans{};
    std::function<void(const SuggestTrial&)> tried{};  // after each measurement; may be empty
    // Called when the number of measurements that are still to come is known better; may be empty.
    std::function<void(std::size_t samples, std::size_t wholes)> ahead{};
};

// The trials that would meet a part of a budget that cannot be met, if τ alone were to decide.
struct SuggestNeeds {
    std::optional<SuggestTrial> costsMet;  // the least error within the budgets of costs
    std::optional<SuggestTrial> errorMet;  // the least costs within the budget of the error
};

struct SuggestFound {
    SuggestTrial before;               // the settings of now, whole
    SuggestTrial best;                 // whole
    bool isMet = false;                // best meets all budgets
    bool isUnchanged = false;          // the settings of now already do
    SuggestNeeds needs;                // if not met
    std::vector<SuggestTrial> trials;  // all, in order
    std::size_t samples = 0;           // measurements
    std::size_t wholes = 0;
};

// τ is known to this ratio.
inline constexpr double suggestAccuracy = 1.02;
inline constexpr std::size_t suggestSurvivors = 3;

// Returns whether a trial is better than the one so far: it meets more, or it leaves less error, or it pops and thrashes
// less. Differences that the accuracy of τ explains do not count.
bool isBetter(const SuggestBudget& budget, const SuggestFigures& other, const SuggestFigures& soFar);

// budget: not empty. now: the settings of now. Costs must not grow with τ, and the error must not fall with it; where a
// measurement does otherwise, the result is still what was measured, but may not be the best.
planet::Result<SuggestFound> searchSuggestion(const SuggestBudget& budget, const SuggestCandidate& now,
                                              const SuggestRanges& ranges, const SuggestCalls& calls);

}  // namespace worldy
