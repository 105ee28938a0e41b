#include "tests/planet/format/training/prediction_training.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "planet/base/parallel.h"
#include "planet/format/fitted_equations.h"
#include "planet/format/fitted_prediction.h"
#include "planet/format/height_residual_coder.h"
#include "tests/planet/format/training/principal_axes.h"

namespace planet::training {

namespace {

using Weights = std::vector<double>;

// A coefficient of 1 changes the prediction by this part of the error's scale, and so grows the expected square of the error by
// the square of this part.
constexpr double coefficientUnit = 0.1;

std::vector<FitSamples> fitSamplesOfAll(RefinementPass pass, std::span<TrainingBlock> blocks) {
    std::vector<FitSamples> samples(blocks.size());
    parallelFor(blocks.size(), [&](std::size_t i) {
        samples[i] = fitSamplesOf(blocks[i].predictor, pass, blocks[i].fine, trainingCells);
    });
    return samples;
}

std::vector<double> errorsOf(const FitSamples& samples, const Weights& weights) {
    std::vector<double> errors = samples.targets;
    for (std::size_t i = 0; i < errors.size(); ++i)
        for (std::size_t k = 0; k < weights.size(); ++k)
            errors[i] -= weights[k] * samples.differences[i * samples.terms + k];
    return errors;
}

double meanError(const FitSamples& samples, const Weights& weights) {
    double sum = 0;
    for (const double error : errorsOf(samples, weights)) sum += std::abs(error);
    return sum / static_cast<double>(samples.targets.size());
}

// Returns the equations of a block's weights. All its samples expect the mean error of the block.
NormalEquations equationsOfBlock(const FitSamples& samples, const Weights& weights) {
    const std::vector<double> expected(samples.targets.size(), meanError(samples, weights));
    return robustEquations(samples, weights, expected);
}

void addTo(Weights& weights, const Weights& change) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] += change[i];
}

Weights solutionOf(NormalEquations equations) {
    auto solution = solved(std::move(equations));
    if (!solution) throw std::runtime_error("the equations of the weights have no single solution");
    return *std::move(solution);
}

// Returns the sum of the equations of all blocks, always in the same order.
NormalEquations equationsOfAll(std::span<const FitSamples> blocks, const Weights& weights) {
    std::vector<NormalEquations> each(blocks.size());
    parallelFor(blocks.size(), [&](std::size_t i) { each[i] = equationsOfBlock(blocks[i], weights); });
    const std::size_t size = weights.size();
    NormalEquations sum{size, std::vector<double>(size * size), std::vector<double>(size)};
    for (const NormalEquations& one : each) {
        for (std::size_t i = 0; i < sum.matrix.size(); ++i) sum.matrix[i] += one.matrix[i];
        for (std::size_t i = 0; i < size; ++i) sum.right[i] += one.right[i];
    }
    return sum;
}

struct MeanFit {
    Weights weights;
    // The metric of changes of the weights: how much a change grows the expected square of an error, relative to its scale.
    SquareMatrix metric;
};

// Fits one set of weights to all blocks: robust least squares, iteratively reweighted (Holland and Welsch, "Robust
// regression using iteratively reweighted least-squares", 1977).
MeanFit fitMean(std::span<const FitSamples> blocks) {
    const std::size_t size = blocks.front().terms;
    MeanFit fit{Weights(size, 1 / static_cast<double>(size + 1)), SquareMatrix(size)};
    std::size_t count = 0;
    for (const FitSamples& samples : blocks) count += samples.targets.size();
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round) {
        NormalEquations equations = equationsOfAll(blocks, fit.weights);
        fit.metric.values = equations.matrix;
        for (double& value : fit.metric.values) value /= static_cast<double>(count);
        constexpr double damping = 1e-5;
        for (std::size_t i = 0; i < size; ++i) equations.at(i, i) *= 1 + damping;
        addTo(fit.weights, solutionOf(std::move(equations)));
    }
    return fit;
}

// Fits weights to one block. They stay near the mean, as if the block had 100 samples more that the mean fits best: otherwise
// blocks that determine a direction badly would have arbitrary weights along it (ridge regression).
Weights fitBlock(const FitSamples& samples, const MeanFit& mean) {
    constexpr double priorSamples = 100;
    const std::size_t size = samples.terms;
    Weights weights = mean.weights;
    constexpr int rounds = 3;
    for (int round = 0; round < rounds; ++round) {
        NormalEquations equations = equationsOfBlock(samples, weights);
        for (std::size_t i = 0; i < size; ++i) {
            double pull = 0;
            for (std::size_t j = 0; j < size; ++j) {
                equations.at(i, j) += priorSamples * mean.metric.at(i, j);
                pull += priorSamples * mean.metric.at(i, j) * (mean.weights[j] - weights[j]);
            }
            equations.right[i] += pull;
            equations.at(i, i) += 1e-6;
        }
        addTo(weights, solutionOf(std::move(equations)));
    }
    return weights;
}

// Coordinates of changes of the weights, in which their metric is the identity.
class WhiteSpace {
public:
    explicit WhiteSpace(const SquareMatrix& metric) : axes_(principalAxes(metric)) {
        constexpr double leastLength = 1e-4;
        for (const double length : axes_.lengths) scales_.push_back(std::sqrt(std::max(length, leastLength)));
    }

    std::vector<double> coordinates(const Weights& weights, const Weights& origin) const {
        std::vector<double> result(scales_.size());
        for (std::size_t j = 0; j < result.size(); ++j) {
            for (std::size_t i = 0; i < result.size(); ++i)
                result[j] += axes_.axes.at(i, j) * (weights[i] - origin[i]);
            result[j] *= scales_[j];
        }
        return result;
    }

    // Returns columns of coordinates as columns of changes.
    SquareMatrix changes(const SquareMatrix& columns) const {
        const std::size_t size = columns.size;
        SquareMatrix result(size);
        for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k < size; ++k)
                for (std::size_t j = 0; j < size; ++j)
                    result.at(i, j) += axes_.axes.at(i, k) / scales_[k] * columns.at(k, j);
        return result;
    }

private:
    PrincipalAxes axes_;
    std::vector<double> scales_;
};

// Returns the covariance of the blocks' weights around the mean. A block counts less the farther away it is, so that single
// blocks determine no direction (Maronna, "Robust M-estimators of multivariate location and scatter", 1976). Blocks with a
// mean error below one step say nothing, because the rounding of their samples prevails.
SquareMatrix robustCovariance(std::span<const FitSamples> blocks, std::span<const Weights> weights,
                              const Weights& mean, const WhiteSpace& space) {
    SquareMatrix sum(mean.size());
    double count = 0;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        if (meanError(blocks[block], mean) < 1) continue;
        const std::vector<double> place = space.coordinates(weights[block], mean);
        double square = 0;
        for (const double coordinate : place) square += coordinate * coordinate;
        const double importance = 1 / (1 + square / 4);
        for (std::size_t i = 0; i < place.size(); ++i)
            for (std::size_t j = 0; j < place.size(); ++j) sum.at(i, j) += importance * place[i] * place[j];
        ++count;
    }
    for (double& value : sum.values) value /= count;
    return sum;
}

// Returns the width of the coefficients with a variance. Their mean magnitude is less than the 0.8 deviations of a normal
// distribution, because a few are far larger than the others.
std::int32_t coefficientWidth(double variance) {
    const double meanMagnitude = std::max(0.6 * std::sqrt(std::max(variance, 0.0)) / coefficientUnit, 0.15);
    return static_cast<std::int32_t>(std::lround(residualWidthOfOne + 4 * std::log2(meanMagnitude)));
}

std::vector<std::int32_t> roundedValues(const std::vector<double>& values, double scale) {
    std::vector<std::int32_t> result;
    for (const double value : values) result.push_back(static_cast<std::int32_t>(std::lround(value * scale)));
    return result;
}

}  // namespace

TrainedPredictions trainPredictions(RefinementPass pass, std::span<TrainingBlock> blocks) {
    const std::vector<FitSamples> samples = fitSamplesOfAll(pass, blocks);
    const MeanFit mean = fitMean(samples);
    std::vector<Weights> weights(blocks.size());
    TrainedPredictions trained;
    trained.errors.resize(blocks.size());
    parallelFor(blocks.size(), [&](std::size_t i) {
        weights[i] = fitBlock(samples[i], mean);
        trained.errors[i] = errorsOf(samples[i], weights[i]);
    });
    const WhiteSpace space(mean.metric);
    const PrincipalAxes directions = principalAxes(robustCovariance(samples, weights, mean.weights, space));
    constexpr double weightScale = 1 << fittedWeightBits;
    trained.meanWeights = roundedValues(mean.weights, weightScale);
    trained.directions =
        roundedValues(space.changes(directions.axes).values, coefficientUnit * 16 * weightScale);
    for (const double variance : directions.lengths)
        trained.coefficientWidths.push_back(coefficientWidth(variance));
    return trained;
}

}  // namespace planet::training
