// The search over planted costs and errors, whose best settings are known.
#include "app/suggest/suggest_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "app/suggest/suggest_budget.h"
#include "planet/base/result.h"

namespace worldy {
namespace {

using testing::HasSubstr;

constexpr double trianglesAtOnePx = 400'000;

SuggestBudget suggestBudgetOf(const std::string& text) {
    const auto budget = suggestBudgetFromText(text);
    EXPECT_TRUE(budget) << text;
    return budget.value_or(SuggestBudget{});
}

// Triangles fall as 1 / τ, and the error is τ. The tight metric draws as much with 2/3 of the triangles. A wider morph
// leaves more error.
SuggestFigures plantedFigures(const SuggestCandidate& candidate) {
    const double metric = candidate.metric == planet::ErrorMetric::Tight ? 2.0 / 3 : 1;
    double triangles = metric * trianglesAtOnePx / candidate.tauPx;
    double errorPx = candidate.tauPx * (1 + candidate.morphRange);
    double meanPx = errorPx;
    // A third of the triangles lies in a region, with a third of the frames.
    if (!candidate.regions.empty()) {
        const double factor = *candidate.regions[0].tauFactor;
        triangles *= 2.0 / 3 + 1 / (3 * factor);
        meanPx = errorPx * (2.0 / 3 + factor / 3);
        errorPx *= factor;
    }
    SuggestFigures figures;
    figures.values = {triangles * 1e-4, triangles, candidate.memoryMiB * 1048576.0, errorPx};
    figures.p99ErrorPx = errorPx;
    figures.meanErrorPx = meanPx;
    return figures;
}

struct SuggestPlanted {
    SuggestCandidate now{};
    SuggestRanges ranges{
        .metrics = {planet::ErrorMetric::Additive}, .morphRanges = {0.3}, .memoriesMiB = {256}};
    SuggestCalls calls{.measure = [](const SuggestCandidate& candidate, SuggestScope) {
        return planet::Result<SuggestFigures>(plantedFigures(candidate));
    }};

    SuggestFound search(const std::string& budget) const {
        auto found = searchSuggestion(suggestBudgetOf(budget), now, ranges, calls);
        EXPECT_TRUE(found);
        return found.value_or(SuggestFound{});
    }
};

TEST(SuggestSearch, findsTheSmallestToleranceWithinACost) {
    // 400,000 / τ = 100,000.
    const SuggestFound found = SuggestPlanted{}.search("100 k triangles");
    EXPECT_TRUE(found.isMet);
    EXPECT_FALSE(found.isUnchanged);
    EXPECT_GE(found.best.candidate.tauPx, 4);
    EXPECT_LE(found.best.candidate.tauPx, 4 * suggestAccuracy);
    EXPECT_EQ(found.best.scope, SuggestScope::Whole);
    EXPECT_LT(found.samples + found.wholes, 25u);
    EXPECT_EQ(found.samples + found.wholes, found.trials.size());
}

TEST(SuggestSearch, findsTheLargestToleranceWithinAnError) {
    const SuggestFound found = SuggestPlanted{}.search("1.3 px");
    EXPECT_TRUE(found.isMet);
    EXPECT_LE(found.best.candidate.tauPx, 1);
    EXPECT_GE(found.best.candidate.tauPx, 1 / suggestAccuracy);
}

TEST(SuggestSearch, theTightestOfSeveralCostsDecides) {
    // 20 ms allow 200,000 triangles, which is more than 100,000.
    const SuggestFound found = SuggestPlanted{}.search("20 ms, 100 k triangles, 8 px");
    EXPECT_TRUE(found.isMet);
    EXPECT_NEAR(found.best.candidate.tauPx, 4, 4 * (suggestAccuracy - 1));
}

TEST(SuggestSearch, settingsThatMeetTheBudgetStay) {
    // τ = 2 draws 200,000 triangles.
    SuggestPlanted planted;
    planted.ranges.metrics.push_back(planet::ErrorMetric::Tight);
    const SuggestFound found = planted.search("250 k triangles, 3 px");
    EXPECT_TRUE(found.isMet);
    EXPECT_TRUE(found.isUnchanged);
    EXPECT_EQ(found.best.candidate, planted.now);
    EXPECT_EQ(found.trials.size(), 1u);
}

TEST(SuggestSearch, theMetricAndTheMorphWithLessErrorWin) {
    SuggestPlanted planted;
    planted.ranges.metrics.push_back(planet::ErrorMetric::Tight);
    planted.ranges.morphRanges = {0.3, 0.1, 0.6};
    const SuggestFound found = planted.search("100 k triangles");
    EXPECT_EQ(found.best.candidate.metric, planet::ErrorMetric::Tight);
    EXPECT_EQ(found.best.candidate.morphRange, 0.1);
    EXPECT_NEAR(found.best.candidate.tauPx, 4 * 2.0 / 3, 0.06);
}

TEST(SuggestSearch, aChunkSizeWithLessErrorWins) {
    SuggestPlanted planted;
    planted.ranges.chunkSizes = {0, 17, 65};
    planted.calls.measure = [](const SuggestCandidate& candidate, SuggestScope) {
        SuggestFigures figures = plantedFigures(candidate);
        figures.values[1] *= candidate.chunkSize == 17 ? 0.5 : candidate.chunkSize == 65 ? 2 : 1;
        return planet::Result<SuggestFigures>(figures);
    };
    const SuggestFound found = planted.search("100 k triangles");
    EXPECT_EQ(found.best.candidate.chunkSize, 17);
    EXPECT_NEAR(found.best.candidate.tauPx, 2, 0.05);
}

TEST(SuggestSearch, viewsThatAreNotLoadedInTimeAskForALargerTolerance) {
    SuggestPlanted planted;
    // Below 3 px, the disk is too slow.
    planted.calls.measure = [](const SuggestCandidate& candidate, SuggestScope) {
        SuggestFigures figures = plantedFigures(candidate);
        if (candidate.tauPx < 3) {
            figures.values.fill(std::numeric_limits<double>::quiet_NaN());
            figures.unsettled = 1;
        }
        return planet::Result<SuggestFigures>(figures);
    };
    const SuggestFound error = planted.search("13 px");
    EXPECT_TRUE(error.isMet);
    EXPECT_NEAR(error.best.candidate.tauPx, 10, 10 * (suggestAccuracy - 1));
    const SuggestFound cost = planted.search("300 k triangles");
    EXPECT_TRUE(cost.isMet);
    EXPECT_GE(cost.best.candidate.tauPx, 3);
    EXPECT_LE(cost.best.candidate.tauPx, 3 * suggestAccuracy);
    const SuggestFound none = planted.search("2 px");
    EXPECT_FALSE(none.isMet);
    EXPECT_FALSE(none.isUnchanged);
}

TEST(SuggestSearch, whatIsNoBetterStaysAsItIs) {
    SuggestPlanted planted;
    planted.ranges.memoriesMiB = {256, 64};
    EXPECT_EQ(planted.search("100 k triangles").best.candidate.memoryMiB, 256);
    EXPECT_EQ(planted.search("100 k triangles, 64 MiB").best.candidate.memoryMiB, 64);
}

TEST(SuggestSearch, aBudgetThatCannotBeMetIsReportedWithWhatWouldBeNeeded) {
    // 100,000 triangles need τ >= 4, whose error is 5.2 px; 1.3 px need 400,000 triangles.
    const SuggestFound found = SuggestPlanted{}.search("100 k triangles, 1.3 px");
    EXPECT_FALSE(found.isMet);
    // The closest one exceeds both by the same factor: 400,000 / τ / 100,000 = 1.3 τ / 1.3.
    EXPECT_NEAR(found.best.candidate.tauPx, 2, 0.05);
    ASSERT_TRUE(found.needs.costsMet && found.needs.errorMet);
    EXPECT_NEAR(found.needs.costsMet->figures.values[3], 5.2, 0.15);
    EXPECT_NEAR(found.needs.errorMet->figures.values[1], 400'000, 10'000);
    EXPECT_LE(found.needs.costsMet->figures.values[1], 100'000);
    EXPECT_LE(found.needs.errorMet->figures.values[3], 1.3);
}

TEST(SuggestSearch, aCostBelowWhatTheRangeReachesIsNotMet) {
    // τ = 64 draws 6,250.
    const SuggestFound found = SuggestPlanted{}.search("5 k triangles");
    EXPECT_FALSE(found.isMet);
    EXPECT_EQ(found.best.candidate.tauPx, 64);
    EXPECT_FALSE(found.needs.costsMet);
}

TEST(SuggestSearch, aToleranceThatLeavesNoLessErrorIsNotTaken) {
    // The data ends at 1 px, so that smaller tolerances draw the same.
    SuggestPlanted planted;
    planted.calls.measure = [](SuggestCandidate candidate, SuggestScope) {
        candidate.tauPx = std::max(candidate.tauPx, 1.0);
        return planet::Result<SuggestFigures>(plantedFigures(candidate));
    };
    const SuggestFound found = planted.search("1 M triangles, 1.5 px");
    EXPECT_TRUE(found.isMet);
    EXPECT_GE(found.best.candidate.tauPx, 0.9);
    EXPECT_LE(found.best.candidate.tauPx, 1);
}

TEST(SuggestSearch, aBudgetThatWasNotMeasuredIsNotMet) {
    SuggestPlanted planted;
    planted.calls.measure = [](const SuggestCandidate& candidate, SuggestScope) {
        SuggestFigures figures = plantedFigures(candidate);
        figures.values[0] = std::numeric_limits<double>::quiet_NaN();
        return planet::Result<SuggestFigures>(figures);
    };
    EXPECT_FALSE(planted.search("1000 ms, 400 k triangles").isMet);
}

TEST(SuggestSearch, theSampleOnlyRejects) {
    // The sample sees only 80 % of the triangles.
    SuggestPlanted planted;
    planted.calls.measure = [](const SuggestCandidate& candidate, SuggestScope scope) {
        SuggestFigures figures = plantedFigures(candidate);
        if (scope == SuggestScope::Sample) figures.values[1] *= 0.8;
        return planet::Result<SuggestFigures>(figures);
    };
    const SuggestFound found = planted.search("100 k triangles");
    EXPECT_TRUE(found.isMet);
    EXPECT_GE(found.best.candidate.tauPx, 4);
    EXPECT_LE(found.best.candidate.tauPx, 4 * suggestAccuracy);
}

TEST(SuggestSearch, regionsAreTakenIfTheyLeaveLessErrorOnTheWhole) {
    SuggestPlanted planted;
    planted.calls.plans = [](const SuggestCandidate&) {
        planet::Region region{.name = "places", .circles = {{{0, 0}, 1000}}};
        return std::vector{SuggestPlan{"places", {region}}};
    };
    // In the planted region the error is that of τ times the factor, which grows: no region may be taken.
    EXPECT_EQ(planted.search("100 k triangles").best.candidate.plan, "");
    planted.calls.measure = [](const SuggestCandidate& candidate, SuggestScope) {
        // A region that costs a third of the triangles and leaves no error at all.
        SuggestFigures figures = plantedFigures(candidate);
        figures.p99ErrorPx = figures.meanErrorPx = figures.values[3] = candidate.tauPx;
        return planet::Result<SuggestFigures>(figures);
    };
    const SuggestFound found = planted.search("100 k triangles");
    EXPECT_EQ(found.best.candidate.plan, "places");
    ASSERT_EQ(found.best.candidate.regions.size(), 1u);
    EXPECT_EQ(found.best.candidate.regions[0].tauFactor, 2.5);
    EXPECT_NEAR(found.best.candidate.tauPx, 4 * (2.0 / 3 + 1 / 7.5), 0.08);
}

TEST(SuggestSearch, anErrorOfAMeasurementEndsIt) {
    SuggestPlanted planted;
    int calls = 0;
    planted.calls.measure = [&](const SuggestCandidate& candidate,
                                SuggestScope) -> planet::Result<SuggestFigures> {
        if (++calls == 4) return planet::cancelled();
        return plantedFigures(candidate);
    };
    const auto found =
        searchSuggestion(suggestBudgetOf("100 k triangles"), planted.now, planted.ranges, planted.calls);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(calls, 4);
}

TEST(SuggestBudget, textIsReadInAnyOrderAndWrittenBack) {
    const SuggestBudget budget = suggestBudgetOf("1.5 px, 64 MiB,200 k triangles ,  16.6ms");
    EXPECT_EQ(budget[SuggestLimit::FrameMs], 16.6);
    EXPECT_EQ(budget[SuggestLimit::Triangles], 200'000);
    EXPECT_EQ(budget[SuggestLimit::ResidentBytes], 64.0 * 1048576);
    EXPECT_EQ(budget[SuggestLimit::ErrorPx], 1.5);
    EXPECT_EQ(budgetText(budget), "16.6 ms, 200 k triangles, 64 MiB, 1.5 px");
    EXPECT_EQ(suggestBudgetOf(budgetText(budget)), budget);
    EXPECT_EQ(suggestBudgetOf("2 M triangles")[SuggestLimit::Triangles], 2e6);
    EXPECT_EQ(suggestBudgetOf("64 MB")[SuggestLimit::ResidentBytes], 64e6);
}

TEST(SuggestBudget, aFieldOfThePanelTakesTheUnitsOfItsLimitAndRefusesOthers) {
    EXPECT_EQ(limitFromText(SuggestLimit::Triangles, "20k"), 20'000);
    EXPECT_EQ(limitFromText(SuggestLimit::Triangles, " 1.5 M triangles "), 1.5e6);
    EXPECT_EQ(limitFromText(SuggestLimit::Triangles, "20"), 20);
    EXPECT_EQ(limitFromText(SuggestLimit::ResidentBytes, "64"), 64.0 * 1024 * 1024);
    EXPECT_EQ(limitFromText(SuggestLimit::ResidentBytes, "1 KiB"), 1024);
    EXPECT_EQ(limitFromText(SuggestLimit::FrameMs, "16.6"), 16.6);
    EXPECT_EQ(limitFromText(SuggestLimit::ErrorPx, "1.5 px"), 1.5);
    for (const char* const wrong : {"", "k", "20 q", "20 ms", "-5", "0", "1e300", "nan", "20 k k"})
        EXPECT_FALSE(limitFromText(SuggestLimit::Triangles, wrong)) << wrong;
    EXPECT_EQ(limitFromText(SuggestLimit::Triangles, "20 q").error().message,
              "\"20 q\" is no triangles; expected a number above 0 in triangles, k triangles, M triangles, "
              "at most 1e+15");
}

TEST(SuggestBudget, smallMemoryIsInKibibytes) {
    EXPECT_EQ(limitText(SuggestLimit::ResidentBytes, 1024), "1 KiB");
    EXPECT_EQ(limitText(SuggestLimit::ResidentBytes, 1 << 20), "1 MiB");
}

TEST(SuggestBudget, everyWrongPartIsNamed) {
    const auto problem = [](const std::string& text) {
        const auto budget = suggestBudgetFromText(text);
        return budget ? std::string("none") : budget.error().message;
    };
    EXPECT_THAT(problem(""), HasSubstr("empty"));
    EXPECT_THAT(problem("16 ms,"), HasSubstr("empty"));
    EXPECT_THAT(problem("ms"), HasSubstr("\"ms\" begins with no number"));
    EXPECT_THAT(problem("-3 px"), HasSubstr("-3 is no number above 0"));
    EXPECT_THAT(problem("0 px"), HasSubstr("0 is no number above 0"));
    EXPECT_THAT(problem("1.2.3 px"), HasSubstr("1.2.3 is no number above 0"));
    EXPECT_THAT(problem("nan px"), HasSubstr("begins with no number"));
    EXPECT_THAT(problem("1e300 k triangles"), HasSubstr("too large"));
    EXPECT_THAT(problem("16"), HasSubstr("\"16\" has no unit"));
    EXPECT_THAT(problem("1 px, 2 px"), HasSubstr("a second time"));
    const std::string two = problem("16 msec, 5 quads, 1 px");
    EXPECT_THAT(two, HasSubstr("the unit msec is unknown"));
    EXPECT_THAT(two, HasSubstr("the unit quads is unknown"));
    EXPECT_THAT(two, HasSubstr("expected a number above 0 with ms, triangles"));
}

}  // namespace
}  // namespace worldy
