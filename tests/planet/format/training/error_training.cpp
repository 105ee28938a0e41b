#include "tests/planet/format/training/error_training.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "planet/base/parallel.h"
#include "planet/format/fitted_prediction.h"
#include "planet/format/fitted_tables.h"
#include "planet/format/height_rows.h"
#include "tests/planet/format/training/training_random.h"

namespace planet::training {

namespace {

// The weights of all terms; those that a pass does not have are 0.
using ErrorWeights = std::array<double, maxErrorTerms>;

struct ErrorSample {
    std::array<float, maxErrorTerms> terms{};
    float error = 0;
};
using ErrorSamples = std::vector<ErrorSample>;

// The degrees of freedom of the errors' distribution, Student's t.
constexpr double freedom = 5;
// The expected error is this many scales of the distribution. That is exact for 3 degrees of freedom, and it matters little,
// because the encoder scales the expected errors of each block.
constexpr double meanOfScale = 1.1;

ErrorSamples errorSamplesOf(RefinementPass pass, TrainingBlock& block, std::span<const double> errors) {
    const auto columns = static_cast<std::size_t>(passColumns(pass, trainingCells));
    ErrorSamples samples(errors.size());
    std::vector<std::int32_t> term(columns);
    std::vector<std::int16_t> rounded(columns);
    block.predictor.beginPass(pass);
    for (int row = 0; row < passRows(pass, trainingCells); ++row) {
        const std::size_t start = static_cast<std::size_t>(row) * columns;
        for (int t = 0; t < errorTermCount(pass); ++t) {
            block.predictor.readErrorTerm(t, row, term);
            for (std::size_t x = 0; x < columns; ++x)
                samples[start + x].terms[static_cast<std::size_t>(t)] = static_cast<float>(term[x]);
        }
        for (std::size_t x = 0; x < columns; ++x) {
            samples[start + x].error = static_cast<float>(errors[start + x]);
            rounded[x] = static_cast<std::int16_t>(std::lround(errors[start + x]));
        }
        block.predictor.setErrors(row, rounded);
    }
    return samples;
}

double expectedError(const ErrorSample& sample, const ErrorWeights& weights) {
    double expected = 1e-3;
    for (std::size_t i = 0; i < weights.size(); ++i)
        expected += weights[i] * static_cast<double>(sample.terms[i]);
    return expected;
}

// Returns the gradient of the mean -log likelihood of the errors, with respect to the logarithms of the weights.
ErrorWeights likelihoodGradient(const ErrorSamples& samples, const ErrorWeights& weights) {
    constexpr double roundingVariance = 0.08;  // of a step: 1/12
    ErrorWeights gradient{};
    for (const ErrorSample& sample : samples) {
        const double expected = expectedError(sample, weights);
        constexpr double square = meanOfScale * meanOfScale;
        const double variance = expected * expected / square + roundingVariance;
        const double scale = std::sqrt(variance);
        const auto error = static_cast<double>(sample.error);
        const double excess = error * error / (freedom * variance);
        const double byScale = (1 - (freedom + 1) * excess / (1 + excess)) / scale;
        const double byExpected = byScale * (expected / square / scale);
        for (std::size_t i = 0; i < weights.size(); ++i)
            gradient[i] += byExpected * static_cast<double>(sample.terms[i]) * weights[i];
    }
    for (double& value : gradient) value /= static_cast<double>(samples.size());
    return gradient;
}

// Fits the weights by maximum likelihood. Their logarithms descend along the gradient by Adam (Kingma and Ba, "Adam: a method
// for stochastic optimization", 2015), so that no weight becomes negative.
void maximiseLikelihood(const ErrorSamples& samples, std::size_t terms, ErrorWeights& weights) {
    constexpr int steps = 100;
    constexpr int largeSteps = 59;
    constexpr double momentum = 0.9;
    constexpr double squareMomentum = 0.99;
    ErrorWeights mean{};
    ErrorWeights meanSquare{};
    ErrorWeights logarithms{};
    for (std::size_t i = 0; i < terms; ++i) {
        weights[i] = std::max(weights[i], 1e-4);
        logarithms[i] = std::log(weights[i]);
    }
    for (int step = 1; step <= steps; ++step) {
        const ErrorWeights gradient = likelihoodGradient(samples, weights);
        const double rate = step <= largeSteps ? 0.1 : 0.03;
        for (std::size_t i = 0; i < terms; ++i) {
            mean[i] = momentum * mean[i] + (1 - momentum) * gradient[i];
            meanSquare[i] = squareMomentum * meanSquare[i] + (1 - squareMomentum) * gradient[i] * gradient[i];
            const double unbiased = mean[i] / (1 - std::pow(momentum, step));
            const double unbiasedSquare = meanSquare[i] / (1 - std::pow(squareMomentum, step));
            logarithms[i] -= rate * unbiased / (std::sqrt(unbiasedSquare) + 1e-9);
            logarithms[i] = std::clamp(logarithms[i], -9.0, 1.0);
            weights[i] = std::exp(logarithms[i]);
        }
    }
}

// Returns the -log likelihood of a block's errors, but for a constant. The encoder scales the expected errors of a block by what
// fits it best, so the block is compared with the weights after such a scaling.
double costOf(const ErrorSamples& block, const ErrorWeights& weights) {
    constexpr double leastExpected = 0.1;
    double ratios = 0;
    for (const ErrorSample& sample : block)
        ratios +=
            std::abs(static_cast<double>(sample.error)) / (expectedError(sample, weights) + leastExpected);
    const double factor = ratios / static_cast<double>(block.size()) / meanOfScale;
    double cost = 0;
    for (const ErrorSample& sample : block) {
        const double scale = (expectedError(sample, weights) + leastExpected) * factor;
        const double relative = static_cast<double>(sample.error) / scale;
        cost += std::log(scale) + (freedom + 1) / 2 * std::log(1 + relative * relative / freedom);
    }
    return cost;
}

std::size_t cheapestSet(const ErrorSamples& block, std::span<const ErrorWeights> sets) {
    std::size_t cheapest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t set = 0; set < sets.size(); ++set) {
        const double cost = costOf(block, sets[set]);
        if (cost >= least) continue;
        least = cost;
        cheapest = set;
    }
    return cheapest;
}

// Returns one set of weights for all blocks, from about a sixth of their samples.
ErrorWeights fitOneSet(std::span<const ErrorSamples> blocks, std::size_t terms) {
    ErrorSamples some;
    Random random(1);
    for (const ErrorSamples& block : blocks)
        for (const ErrorSample& sample : block)
            if ((random() >> 20) % 6 == 0) some.push_back(sample);
    ErrorWeights weights{};
    std::fill_n(weights.begin(), terms, 0.05);
    maximiseLikelihood(some, terms, weights);
    return weights;
}

// Returns the first set, and others whose weights are those of the first times random factors in [0.29, 3.4].
std::vector<ErrorWeights> scatteredSets(const ErrorWeights& first) {
    std::vector<ErrorWeights> sets(errorWeightSetCount, first);
    for (std::uint32_t set = 1; set < sets.size(); ++set) {
        Random random(99 * set);
        for (double& weight : sets[set])
            weight *= std::exp((static_cast<int>((random() >> 16) % 100) - 50) / 40.0);
    }
    return sets;
}

// Fits each set to the blocks to which it is the cheapest one, with a third of their samples, another third in each round.
void refitSets(std::span<const ErrorSamples> blocks, std::size_t terms, std::size_t round,
               std::vector<ErrorWeights>& sets) {
    std::vector<std::size_t> setOfBlock(blocks.size());
    parallelFor(blocks.size(), [&](std::size_t i) { setOfBlock[i] = cheapestSet(blocks[i], sets); });
    std::vector<ErrorSamples> samples(sets.size());
    for (std::size_t block = 0; block < blocks.size(); ++block)
        for (std::size_t i = (block + round) % 3; i < blocks[block].size(); i += 3)
            samples[setOfBlock[block]].push_back(blocks[block][i]);
    constexpr std::size_t fewSamples = 3000;
    parallelFor(sets.size(), [&](std::size_t set) {
        if (samples[set].size() > fewSamples) maximiseLikelihood(samples[set], terms, sets[set]);
    });
}

}  // namespace

// The sets are found as clusters of blocks by classification expectation-maximisation (Celeux and Govaert, "A classification EM
// algorithm for clustering and two stochastic versions", 1992).
std::vector<std::int32_t> trainErrorWeights(RefinementPass pass, std::span<TrainingBlock> blocks,
                                            std::span<const std::vector<double>> errors) {
    const auto terms = static_cast<std::size_t>(errorTermCount(pass));
    std::vector<ErrorSamples> samples(blocks.size());
    parallelFor(blocks.size(),
                [&](std::size_t i) { samples[i] = errorSamplesOf(pass, blocks[i], errors[i]); });
    std::vector<ErrorWeights> sets = scatteredSets(fitOneSet(samples, terms));
    constexpr std::size_t rounds = 7;
    for (std::size_t round = 0; round < rounds; ++round) refitSets(samples, terms, round, sets);
    std::vector<std::int32_t> weights;
    for (const ErrorWeights& set : sets)
        for (std::size_t i = 0; i < terms; ++i)
            weights.push_back(static_cast<std::int32_t>(std::lround(set[i] * (1 << errorWeightBits))));
    return weights;
}

}  // namespace planet::training
