#include "planet/format/fitted_equations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace planet {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

TEST(FittedEquations, HaveTheSolutionOfAKnownSystem) {
    const auto solution = solved({2, {4, 2, 2, 3}, {8, 8}});
    ASSERT_TRUE(solution);
    EXPECT_THAT(*solution, ElementsAre(DoubleNear(1, 1e-12), DoubleNear(2, 1e-12)));
}

TEST(FittedEquations, WithoutASingleSolutionGiveNothing) {
    EXPECT_FALSE(solved({2, {1, 1, 1, 1}, {1, 1}}));
    EXPECT_FALSE(solved({2, {1, 0, 0, -1}, {1, 1}}));
}

// Returns samples whose targets are exactly 0.75 and -0.25 times their differences.
FitSamples plantedSamples() {
    FitSamples samples{2, {}, {}};
    std::mt19937 random(7);
    for (int i = 0; i < 500; ++i) {
        const double first = static_cast<int>(random() % 41) - 20;
        const double second = static_cast<int>(random() % 41) - 20;
        samples.differences.insert(samples.differences.end(), {first, second});
        samples.targets.push_back(0.75 * first - 0.25 * second);
    }
    return samples;
}

std::vector<double> fittedTo(const FitSamples& samples) {
    std::vector<double> weights(samples.terms);
    const std::vector<double> expected(samples.targets.size(), 1.0);
    for (int round = 0; round < 20; ++round) {
        const auto change = solved(robustEquations(samples, weights, expected));
        for (std::size_t i = 0; i < weights.size(); ++i) weights[i] += change.value()[i];
    }
    return weights;
}

TEST(FittedEquations, FindTheWeightsThatMadeTheSamples) {
    EXPECT_THAT(fittedTo(plantedSamples()), Pointwise(DoubleNear(1e-9), {0.75, -0.25}));
}

// A plain fit would have the first weight about 1 too large: 5 % of the targets are 20 times their first difference too large.
TEST(FittedEquations, HardlyFollowOutliers) {
    FitSamples samples = plantedSamples();
    for (std::size_t i = 0; i < samples.targets.size(); i += 20)
        samples.targets[i] += 20 * samples.differences[2 * i];
    EXPECT_THAT(fittedTo(samples), Pointwise(DoubleNear(0.01), {0.75, -0.25}));
}

TEST(FittedEquations, AreZeroWhereThereIsNothingToImprove) {
    const FitSamples samples = plantedSamples();
    const std::vector<double> expected(samples.targets.size(), 1.0);
    EXPECT_THAT(robustEquations(samples, std::vector{0.75, -0.25}, expected).right, ElementsAre(0, 0));
}

}  // namespace
}  // namespace planet
