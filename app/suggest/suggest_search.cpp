#include "app/suggest/suggest_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/suggest/suggest_budget.h"
#include "planet/base/result.h"
#include "planet/base/try.h"

namespace worldy {

namespace {

using planet::Result;

constexpr std::array<double, 3> triedFactors = {1.3, 1.7, 2.5};  // on τ in regions

bool meets(const SuggestBudget& budget, const SuggestFigures& figures) {
    return mostUse(budget, figures.values) <= 1;
}

// Three digits are enough for the accuracy, and are easier to read.
double roundedTau(double tauPx) {
    return numberFromText(fmt::format("{:.3g}", tauPx)).value_or(tauPx);
}

// Returns -1 if a is less than b by more than the accuracy, 1 if it is larger, else 0.
int compared(double a, double b) {
    if (a * suggestAccuracy < b) return -1;
    return b * suggestAccuracy < a ? 1 : 0;
}

bool isWorthRegions(const SuggestFigures& with, const SuggestFigures& without) {
    constexpr double leastGain = 1.1;  // of the error
    return with.p99ErrorPx * leastGain < without.p99ErrorPx ||
           with.meanErrorPx * leastGain < without.meanErrorPx;
}

// The measurements of one choice of the other settings, by τ.
class TauSearch {
public:
    TauSearch(const SuggestBudget& budget, const SuggestRanges& ranges, SuggestCandidate candidate,
              SuggestScope scope,
              const std::function<Result<SuggestFigures>(const SuggestCandidate&, SuggestScope)>& measure)
        : budget_(budget),
          ranges_(ranges),
          candidate_(std::move(candidate)),
          scope_(scope),
          measure_(measure) {}

    // Finds the best τ near a guess. step: the first factor on τ, > 1.
    Result<SuggestTrial> find(double guessPx, double step) {
        if (!ranges_.variesTau) return at(candidate_.tauPx);
        // The smallest τ within the budgets of costs leaves the least error. Without such budgets, the largest τ within
        // that of the error costs least.
        const bool limitsCosts = budget_.limitsCosts();
        TRY(bracket(guessPx, step, [&](const SuggestFigures& figures) {
            return limitsCosts ? mostCostUse(budget_, figures.values) > 1
                               : errorUse(budget_, figures.values) <= 1;
        }));
        if (const auto met = bestMet()) return trialOf(*met);
        if (limitsCosts && budget_[SuggestLimit::ErrorPx]) {
            TRY(bracket(guessPx, step, [&](const SuggestFigures& figures) {
                return mostCostUse(budget_, figures.values) > errorUse(budget_, figures.values);
            }));
            if (const auto met = bestMet()) return trialOf(*met);
        }
        return trialOf(closest());
    }

    // Also finds the largest τ within the budget of the error.
    Result<void> findErrorMet(double guessPx, double step) {
        return bracket(guessPx, step,
                       [&](const SuggestFigures& figures) { return errorUse(budget_, figures.values) <= 1; });
    }
    std::optional<SuggestTrial> leastError() const {
        for (const auto& [tauPx, figures] : known_) {
            if (mostCostUse(budget_, figures.values) <= 1) return trialOf(tauPx);
        }
        return std::nullopt;
    }
    std::optional<SuggestTrial> leastCost() const {
        for (auto one = known_.rbegin(); one != known_.rend(); ++one) {
            if (errorUse(budget_, one->second.values) <= 1) return trialOf(one->first);
        }
        return std::nullopt;
    }

private:
    Result<SuggestTrial> at(double tauPx) {
        if (!known_.contains(tauPx)) {
            SuggestCandidate candidate = candidate_;
            candidate.tauPx = tauPx;
            TRY_ASSIGN(known_[tauPx], measure_(candidate, scope_));
        }
        return trialOf(tauPx);
    }

    // Measures until τ are known, no farther apart than the accuracy, of which the smaller one is too small and the larger
    // one is not; or until the end of the range shows that there are none. Two budgets of one kind may not fall exactly at
    // one τ, so values that were measured for another question count too.
    Result<void> bracket(double guessPx, double step,
                         const std::function<bool(const SuggestFigures&)>& isTooSmall) {
        // A larger τ needs less data, so it may be loaded in time.
        const auto needsLarger = [&](const SuggestFigures& figures) {
            return figures.unsettled > 0 || isTooSmall(figures);
        };
        std::optional<double> small, large;
        for (const auto& [tauPx, figures] : known_) {
            if (needsLarger(figures))
                small = tauPx;
            else if (!large)
                large = tauPx;
        }
        double next = std::clamp(guessPx, ranges_.leastTauPx, ranges_.mostTauPx);
        double factor = step;
        while (!small || !large || *large / *small > suggestAccuracy) {
            if (small && large && *small > *large) break;  // the measurement is not monotone
            if (small && large) {
                next = std::sqrt(*small * *large);
            } else if (small) {
                if (*small >= ranges_.mostTauPx) break;
                next = std::min(*small * factor, ranges_.mostTauPx);
                factor *= factor;
            } else if (large) {
                if (*large <= ranges_.leastTauPx) break;
                next = std::max(*large / factor, ranges_.leastTauPx);
                factor *= factor;
            }
            next = std::clamp(roundedTau(next), ranges_.leastTauPx, ranges_.mostTauPx);
            if (next == small || next == large) break;
            TRY_ASSIGN(const SuggestTrial trial, at(next));
            (needsLarger(trial.figures) ? small : large) = next;
        }
        return {};
    }

    std::optional<double> bestMet() const {
        std::optional<double> best;
        for (const auto& [tauPx, figures] : known_) {
            if (!meets(budget_, figures)) continue;
            best = tauPx;
            if (budget_.limitsCosts()) break;
        }
        // If not even the smallest τ uses the budgets of costs up, a larger one that leaves as little error is enough.
        if (best != ranges_.leastTauPx || !budget_.limitsCosts()) return best;
        for (auto one = known_.rbegin(); one != known_.rend(); ++one) {
            if (!meets(budget_, one->second)) continue;
            const bool leavesAsLittle = compared(one->second.p99ErrorPx, known_.at(*best).p99ErrorPx) == 0 &&
                                        compared(one->second.meanErrorPx, known_.at(*best).meanErrorPx) == 0;
            if (leavesAsLittle) return one->first;
        }
        return best;
    }

    double closest() const {
        const auto least = std::min_element(known_.begin(), known_.end(), [&](const auto& a, const auto& b) {
            return mostUse(budget_, a.second.values) < mostUse(budget_, b.second.values);
        });
        return least->first;
    }

    SuggestTrial trialOf(double tauPx) const {
        SuggestTrial trial{candidate_, known_.at(tauPx), scope_};
        trial.candidate.tauPx = tauPx;
        return trial;
    }

    const SuggestBudget& budget_;
    const SuggestRanges& ranges_;
    SuggestCandidate candidate_;
    SuggestScope scope_;
    const std::function<Result<SuggestFigures>(const SuggestCandidate&, SuggestScope)>& measure_;
    std::map<double, SuggestFigures> known_;
};

// The whole search.
class SuggestSearch {
public:
    SuggestSearch(const SuggestBudget& budget, const SuggestRanges& ranges, const SuggestCalls& calls)
        : budget_(budget), ranges_(ranges), calls_(calls) {}
    SuggestSearch(const SuggestSearch&) = delete;
    SuggestSearch& operator=(const SuggestSearch&) = delete;

    Result<SuggestFound> run(const SuggestCandidate& now) {
        tellAhead(expectedSamples(), 1 + suggestSurvivors * wholesOfOne);
        TRY_ASSIGN(const SuggestFigures before, measure(now, SuggestScope::Whole));
        found_.before = {now, before, SuggestScope::Whole};
        found_.best = found_.before;
        if (meets(budget_, before)) {
            found_.isMet = found_.isUnchanged = true;
            return std::move(found_);
        }
        TRY_ASSIGN(const std::vector<SuggestTrial> survivors, sampled(now));
        TRY(flown(survivors));
        TRY(tryPlans());
        found_.isMet = meets(budget_, found_.best.figures);
        if (!found_.isMet) TRY(findNeeds());
        return std::move(found_);
    }

private:
    static constexpr std::size_t samplesOfOne = 11, wholesOfOne = 6;  // usual numbers of measurements

    Result<SuggestFigures> measure(const SuggestCandidate& candidate, SuggestScope scope) {
        TRY_ASSIGN(const SuggestFigures figures, calls_.measure(candidate, scope));
        ++(scope == SuggestScope::Sample ? found_.samples : found_.wholes);
        found_.trials.push_back({candidate, figures, scope});
        if (calls_.tried) calls_.tried(found_.trials.back());
        return figures;
    }

    TauSearch searchOf(const SuggestCandidate& candidate, SuggestScope scope) {
        return {budget_, ranges_, candidate, scope, measure_};
    }

    std::size_t expectedSamples() const {
        const std::size_t one = ranges_.variesTau ? samplesOfOne : 1;
        return one * ranges_.metrics.size() * ranges_.morphRanges.size() * ranges_.memoriesMiB.size() *
               ranges_.chunkSizes.size();
    }
    void tellAhead(std::size_t samples, std::size_t wholes) const {
        if (calls_.ahead) calls_.ahead(samples, wholes);
    }

    // Returns the choices of all but τ, that of now first.
    std::vector<SuggestCandidate> choices(const SuggestCandidate& now) const {
        std::vector<SuggestCandidate> all;
        SuggestCandidate candidate = now;
        for (const int chunkSize : ranges_.chunkSizes) {
            candidate.chunkSize = chunkSize;
            for (const planet::ErrorMetric metric : ranges_.metrics) {
                candidate.metric = metric;
                for (const double morphRange : ranges_.morphRanges) {
                    candidate.morphRange = morphRange;
                    for (const int memoryMiB : ranges_.memoriesMiB) {
                        candidate.memoryMiB = memoryMiB;
                        all.push_back(candidate);
                    }
                }
            }
        }
        return all;
    }

    // Returns the best trials on the sample, one of each choice, the best first.
    Result<std::vector<SuggestTrial>> sampled(const SuggestCandidate& now) {
        std::vector<SuggestTrial> all;
        double guessPx = now.tauPx;
        for (const SuggestCandidate& candidate : choices(now)) {
            TRY_ASSIGN(const SuggestTrial trial,
                       searchOf(candidate, SuggestScope::Sample).find(guessPx, all.empty() ? 2 : 1.3));
            guessPx = trial.candidate.tauPx;
            all.push_back(trial);
        }
        // Selection by comparisons, because isBetter is no strict order: it ignores small differences.
        std::vector<SuggestTrial> chosen;
        while (!all.empty() && chosen.size() < suggestSurvivors) {
            auto best = all.begin();
            for (auto one = all.begin() + 1; one != all.end(); ++one) {
                if (isBetter(budget_, one->figures, best->figures)) best = one;
            }
            chosen.push_back(*best);
            all.erase(best);
        }
        return chosen;
    }

    Result<void> flown(const std::vector<SuggestTrial>& survivors) {
        tellAhead(0, survivors.size() * wholesOfOne);
        for (std::size_t i = 0; i < survivors.size(); ++i) {
            const SuggestCandidate& candidate = survivors[i].candidate;
            TauSearch search = searchOf(candidate, SuggestScope::Whole);
            TRY_ASSIGN(const SuggestTrial trial, search.find(candidate.tauPx, 1.08));
            // The settings of now are kept unless something is better.
            if (isBetter(budget_, trial.figures, found_.best.figures)) found_.best = trial;
            tellAhead(0, (survivors.size() - i - 1) * wholesOfOne);
        }
        return {};
    }

    // Regions let τ fall elsewhere. They must not leave more error than without them where that is worst, and must be worth
    // a file of their own.
    Result<void> tryPlans() {
        if (!calls_.plans || !ranges_.variesTau || !budget_.limitsCosts() ||
            !meets(budget_, found_.best.figures))
            return {};
        const SuggestTrial without = found_.best;
        const std::vector<SuggestPlan> plans = calls_.plans(without.candidate);
        tellAhead(0, plans.size() * triedFactors.size() * wholesOfOne);
        for (const SuggestPlan& plan : plans) {
            for (const double factor : triedFactors) {
                SuggestCandidate candidate = without.candidate;
                candidate.plan = plan.name;
                for (planet::Region region : plan.regions) {
                    region.tauFactor = factor;
                    candidate.regions.push_back(std::move(region));
                }
                TauSearch search = searchOf(candidate, SuggestScope::Whole);
                TRY_ASSIGN(const SuggestTrial trial,
                           search.find(without.candidate.tauPx / std::sqrt(factor), 1.2));
                constexpr auto error = static_cast<std::size_t>(SuggestLimit::ErrorPx);
                const bool leavesMore =
                    compared(trial.figures.values[error], without.figures.values[error]) > 0;
                if (!leavesMore && isWorthRegions(trial.figures, without.figures) &&
                    isBetter(budget_, trial.figures, found_.best.figures))
                    found_.best = trial;
                // A larger factor cannot help where the smaller one already leaves too much error.
                if (leavesMore) break;
            }
        }
        return {};
    }

    Result<void> findNeeds() {
        if (!ranges_.variesTau) return {};
        tellAhead(0, wholesOfOne);
        TauSearch search = searchOf(found_.best.candidate, SuggestScope::Whole);
        const double guessPx = found_.best.candidate.tauPx;
        TRY(search.find(guessPx, 1.3));
        if (budget_[SuggestLimit::ErrorPx]) TRY(search.findErrorMet(guessPx, 1.3));
        if (budget_.limitsCosts()) found_.needs.costsMet = search.leastError();
        if (budget_[SuggestLimit::ErrorPx]) found_.needs.errorMet = search.leastCost();
        return {};
    }

    const SuggestBudget& budget_;
    const SuggestRanges& ranges_;
    const SuggestCalls& calls_;
    const std::function<Result<SuggestFigures>(const SuggestCandidate&, SuggestScope)> measure_ =
        [this](const SuggestCandidate& candidate, SuggestScope scope) { return measure(candidate, scope); };
    SuggestFound found_;
};

}  // namespace

bool isBetter(const SuggestBudget& budget, const SuggestFigures& other, const SuggestFigures& soFar) {
    const double use = mostUse(budget, other.values), useSoFar = mostUse(budget, soFar.values);
    if ((use <= 1) != (useSoFar <= 1)) return use <= 1;
    if (use > 1) return compared(use, useSoFar) < 0;
    // Without budgets of costs, the costs that a suggestion leaves decide instead of the error.
    if (!budget.limitsCosts()) {
        constexpr auto triangles = static_cast<std::size_t>(SuggestLimit::Triangles);
        return compared(other.values[triangles], soFar.values[triangles]) < 0;
    }
    if (const int p99 = compared(other.p99ErrorPx, soFar.p99ErrorPx); p99 != 0) return p99 < 0;
    if (const int mean = compared(other.meanErrorPx, soFar.meanErrorPx); mean != 0) return mean < 0;
    if (other.thrashes != soFar.thrashes) return other.thrashes < soFar.thrashes;
    return compared(other.worstPopPx, soFar.worstPopPx) < 0;
}

Result<SuggestFound> searchSuggestion(const SuggestBudget& budget, const SuggestCandidate& now,
                                      const SuggestRanges& ranges, const SuggestCalls& calls) {
    return SuggestSearch(budget, ranges, calls).run(now);
}

}  // namespace worldy
