#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "planet/format/fitted_block.h"
#include "planet/format/fitted_equations.h"
#include "planet/format/fitted_pass.h"
#include "planet/format/fitted_tables.h"

namespace planet {

namespace {

// The weights of a pass as numbers: mean + directions * coefficients.
class WeightSpace {
public:
    explicit WeightSpace(RefinementPass pass) : size_(static_cast<std::size_t>(directionCount(pass))) {
        const FittedTables& tables = fittedTables(pass);
        constexpr double weightUnit = 1.0 / (1 << fittedWeightBits);
        for (const std::int32_t weight : tables.meanWeights) mean_.push_back(weight * weightUnit);
        for (const std::int32_t weight : tables.directions) directions_.push_back(weight * weightUnit / 16);
        for (const std::uint8_t width : tables.coefficientWidths) {
            // A width is a mean magnitude in quarter octaves. A normal distribution's deviation is 1.25 times as large.
            double variance = 1.6;
            for (int step = residualWidthOfOne; step < width; ++step) variance *= 1.41421356;
            for (int step = width; step < residualWidthOfOne; ++step) variance /= 1.41421356;
            variances_.push_back(variance);
        }
    }

    std::size_t size() const { return size_; }
    double variance(std::size_t direction) const { return variances_[direction]; }

    std::vector<double> weights(std::span<const double> coefficients) const {
        std::vector<double> all = mean_;
        for (std::size_t i = 0; i < size_; ++i)
            for (std::size_t j = 0; j < size_; ++j) all[i] += directions_[i * size_ + j] * coefficients[j];
        return all;
    }

    // Returns equations in weights as equations in coefficients.
    NormalEquations projected(const NormalEquations& inWeights) const {
        std::vector<double> half(size_ * size_);
        for (std::size_t i = 0; i < size_; ++i)
            for (std::size_t k = 0; k < size_; ++k)
                for (std::size_t j = 0; j < size_; ++j)
                    half[i * size_ + j] += inWeights.at(i, k) * directions_[k * size_ + j];
        NormalEquations result{size_, std::vector<double>(size_ * size_), std::vector<double>(size_)};
        for (std::size_t k = 0; k < size_; ++k)
            for (std::size_t i = 0; i < size_; ++i) {
                const double direction = directions_[k * size_ + i];
                for (std::size_t j = 0; j < size_; ++j) result.at(i, j) += direction * half[k * size_ + j];
                result.right[i] += direction * inWeights.right[k];
            }
        return result;
    }

private:
    std::size_t size_;
    std::vector<double> mean_;
    std::vector<double> directions_;
    std::vector<double> variances_;
};

// Rounds the coefficients one after the other, and lets those that follow make up for what rounding one of them changed.
std::vector<std::int16_t> roundedCoefficients(const NormalEquations& equations, int precision,
                                              std::vector<double> coefficients) {
    const std::size_t size = equations.size;
    // Rounding to 0 saves bits.
    constexpr double deadZone = 0.65;
    const double scale = 1 << precision;
    std::vector<std::int16_t> rounded(size);
    for (std::size_t k = 0; k < size; ++k) {
        const double limited = std::clamp(scale * coefficients[k], -1000.0, 1000.0);
        const double nearest = std::abs(limited) < deadZone ? 0 : std::floor(limited + 0.5);
        rounded[k] = static_cast<std::int16_t>(nearest);
        const double changed = nearest / scale - coefficients[k];
        const std::size_t left = size - k - 1;
        if (left == 0) break;
        NormalEquations rest{left, std::vector<double>(left * left), std::vector<double>(left)};
        for (std::size_t i = 0; i < left; ++i) {
            for (std::size_t j = 0; j < left; ++j) rest.at(i, j) = equations.at(k + 1 + i, k + 1 + j);
            rest.right[i] = -equations.at(k + 1 + i, k) * changed;
        }
        const auto change = solved(std::move(rest));
        if (!change) continue;
        for (std::size_t i = 0; i < left; ++i) coefficients[k + 1 + i] += (*change)[i];
    }
    return rounded;
}

// A pass with its parameters, and its cost in 1/256 bit.
struct TriedPass {
    FittedPass parameters;
    std::vector<std::int16_t> residuals;
    std::vector<float> expected256;
    std::int64_t cost256 = std::numeric_limits<std::int64_t>::max();
};

ParameterRow parameterRow(const FittedPass& pass) {
    const std::array<int, parameterCount> values = {pass.shape, pass.errorSet, pass.widthShift,
                                                    pass.precision, pass.coefficientCount};
    ParameterRow row;
    for (std::size_t i = 0; i < parameterCount; ++i)
        row[i] = static_cast<std::int16_t>(values[i] - parameterMiddles[i]);
    return row;
}

std::int64_t parametersCost(const FittedPass& parameters, RefinementPass pass) {
    const std::span coefficients = parameters.usedCoefficients();
    return residualsCost(parameterRow(parameters), parameterWidths) +
           residualsCost(coefficients, coefficientWidths(pass, parameters));
}

// Predicts a pass of known samples: its residuals, and the expected errors with each set of weights.
class PassTrial {
public:
    PassTrial(FittedPredictor& predictor, RefinementPass pass, std::span<const std::int16_t> fine,
              int coarseCells)
        : predictor_(predictor),
          pass_(pass),
          fine_(fine),
          coarseCells_(coarseCells),
          rows_(static_cast<std::size_t>(passRows(pass, coarseCells))),
          columns_(static_cast<std::size_t>(passColumns(pass, coarseCells))) {}

    // Returns the pass with the coefficients and the best other parameters. like: the shape and the set of weights of errors
    // are those of this pass, which saves time.
    TriedPass tried(std::span<const std::int16_t> coefficients, int precision,
                    const FittedPass* like = nullptr) {
        FittedPass parameters;
        parameters.precision = precision;
        std::ranges::copy(coefficients, parameters.coefficients.begin());
        parameters.coefficientCount = static_cast<int>(coefficients.size());
        while (parameters.coefficientCount > 0 && parameters.usedCoefficients().back() == 0)
            --parameters.coefficientCount;
        TriedPass best;
        const std::vector<std::int16_t> residuals = predict(parameters);
        for (int set = 0; set < errorWeightSetCount; ++set) {
            if (like && set != like->errorSet) continue;
            const std::vector<float> expected = expect(set);
            parameters.errorSet = set;
            for (int shape = 0; shape < residualShapeCount; ++shape) {
                if (like && shape != like->shape) continue;
                parameters.shape = shape;
                const std::int64_t cost = chooseShift(residuals, expected, parameters);
                if (cost >= best.cost256) continue;
                best = {parameters, residuals, expected, cost};
            }
        }
        return best;
    }

    // Leaves the predictor with the errors of a pass, for the passes that follow.
    void keep(const TriedPass& pass) {
        predictor_.beginPass(pass_);
        setRows(pass.residuals);
    }

    // Leaves the errors of the residuals with the predictor.
    void setRows(std::span<const std::int16_t> residuals) {
        std::vector<std::int16_t> samples(columns_);
        for (std::size_t y = 0; y < rows_; ++y) {
            const int row = static_cast<int>(y);
            readSamples(row, samples);
            predictor_.setErrors(row, residuals.subspan(y * columns_, columns_));
            predictor_.setSamples(row, samples);
        }
    }

private:
    void readSamples(int row, std::span<std::int16_t> samples) const {
        const std::int16_t* const in = fine_.data() + rowStart(pass_, row, coarseCells_);
        for (std::size_t x = 0; x < columns_; ++x) samples[x] = in[2 * x];
    }

    std::vector<std::int16_t> predict(const FittedPass& parameters) {
        std::vector<std::int32_t> weights(static_cast<std::size_t>(predictionTermCount(pass_)));
        fittedWeights(pass_, parameters.usedCoefficients(), parameters.precision, weights);
        predictor_.beginPass(pass_);
        predictor_.setWeights(weights);
        std::vector<std::int16_t> residuals(rows_ * columns_);
        std::vector<std::int16_t> samples(columns_);
        std::vector<std::int16_t> predicted(columns_);
        for (std::size_t y = 0; y < rows_; ++y) {
            const int row = static_cast<int>(y);
            predictor_.predictRow(row, predicted);
            readSamples(row, samples);
            const std::span ofRow = std::span(residuals).subspan(y * columns_, columns_);
            for (std::size_t x = 0; x < columns_; ++x)
                ofRow[x] = static_cast<std::int16_t>(samples[x] - predicted[x]);
            predictor_.setErrors(row, ofRow);
            predictor_.setSamples(row, samples);
        }
        return residuals;
    }

    // The errors of the pass are set already.
    std::vector<float> expect(int set) {
        predictor_.setErrorWeights(errorWeightSet(pass_, set));
        std::vector<float> expected(rows_ * columns_);
        for (std::size_t y = 0; y < rows_; ++y)
            predictor_.expectErrors(static_cast<int>(y), std::span(expected).subspan(y * columns_, columns_));
        return expected;
    }

    // Descends to the shift of the least cost, and returns that.
    std::int64_t chooseShift(std::span<const std::int16_t> residuals, std::span<const float> expected,
                             FittedPass& parameters) const {
        std::vector<std::uint8_t> widths(residuals.size());
        const auto cost = [&](int shift) {
            FittedPass shifted = parameters;
            shifted.widthShift = shift;
            residualWidths(expected, shift, widths);
            return residualsCost(residuals, widths, parameters.shape) + parametersCost(shifted, pass_);
        };
        return descendShift(cost, parameters.widthShift);
    }

    FittedPredictor& predictor_;
    RefinementPass pass_;
    std::span<const std::int16_t> fine_;
    int coarseCells_;
    std::size_t rows_;
    std::size_t columns_;
};

// Returns the expected |error| of each sample, by the parameters of a pass.
std::vector<double> expectedErrors(const TriedPass& pass) {
    double factor = 1.0 / 256;
    for (int step = 0; step < pass.parameters.widthShift; ++step) factor *= 1.18920712;
    for (int step = pass.parameters.widthShift; step < 0; ++step) factor /= 1.18920712;
    std::vector<double> expected(pass.expected256.begin(), pass.expected256.end());
    for (double& value : expected) value = std::max(0.0, value * factor);
    return expected;
}

// Fits the coefficients to a pass, beginning with those of the mean weights. Returns them rounded to each precision.
std::array<std::vector<std::int16_t>, maxCoefficientPrecision + 1> fittedCoefficients(
    const WeightSpace& space, const FitSamples& samples, std::span<const double> expected) {
    constexpr int rounds = 3;
    std::vector<double> coefficients(space.size());
    NormalEquations equations;
    for (int round = 0; round < rounds; ++round) {
        equations = space.projected(robustEquations(samples, space.weights(coefficients), expected));
        // The coefficients are likely to be as small as they are in most blocks.
        for (std::size_t i = 0; i < space.size(); ++i) {
            const double prior = 1 / space.variance(i);
            equations.at(i, i) += prior;
            equations.right[i] -= prior * coefficients[i];
        }
        const auto change = solved(equations);
        if (!change) break;
        for (std::size_t i = 0; i < space.size(); ++i) coefficients[i] += (*change)[i];
    }
    std::array<std::vector<std::int16_t>, maxCoefficientPrecision + 1> rounded;
    for (int precision = 0; precision <= maxCoefficientPrecision; ++precision)
        rounded[static_cast<std::size_t>(precision)] =
            roundedCoefficients(equations, precision, coefficients);
    return rounded;
}

TriedPass bestPass(FittedPredictor& predictor, RefinementPass pass, std::span<const std::int16_t> fine,
                   int coarseCells) {
    static const std::array spaces = {WeightSpace(RefinementPass::Middle),
                                      WeightSpace(RefinementPass::OddRow),
                                      WeightSpace(RefinementPass::OddColumn)};
    const FitSamples samples = fitSamplesOf(predictor, pass, fine, coarseCells);
    PassTrial trial(predictor, pass, fine, coarseCells);
    TriedPass best = trial.tried({}, 0);
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round) {
        const auto coefficients =
            fittedCoefficients(spaces[static_cast<std::size_t>(pass)], samples, expectedErrors(best));
        TriedPass likely;
        for (int precision = 0; precision <= maxCoefficientPrecision; ++precision) {
            TriedPass rounded =
                trial.tried(coefficients[static_cast<std::size_t>(precision)], precision, &best.parameters);
            if (rounded.cost256 < likely.cost256) likely = std::move(rounded);
        }
        likely = trial.tried(likely.parameters.usedCoefficients(), likely.parameters.precision);
        if (likely.cost256 >= best.cost256) break;
        best = std::move(likely);
    }
    trial.keep(best);
    return best;
}

}  // namespace

void encodeFitted(std::span<const std::int16_t> fine, int coarseCells, std::vector<std::byte>& out) {
    assert(coarseCells >= minFittedCells && coarseCells < static_cast<int>(maxRowSamples));
    FittedPredictor predictor(coarseCells);
    predictor.setCoarse(thinned(fine, 2 * coarseCells + 1, coarseCells + 1, 2));
    ResidualEncoder encoder(missingSamples(coarseCells) + passCount * (parameterCount + maxPredictionTerms),
                            fittedStates);
    for (const RefinementPass pass : allRefinementPasses) {
        const TriedPass best = bestPass(predictor, pass, fine, coarseCells);
        const std::span coefficients = best.parameters.usedCoefficients();
        encoder.addRow(parameterRow(best.parameters), parameterWidths);
        encoder.addRow(coefficients, coefficientWidths(pass, best.parameters));
        std::vector<std::uint8_t> widths(best.residuals.size());
        residualWidths(best.expected256, best.parameters.widthShift, widths);
        const auto columns = static_cast<std::size_t>(passColumns(pass, coarseCells));
        for (std::size_t i = 0; i < widths.size(); i += columns)
            encoder.addRow(std::span(best.residuals).subspan(i, columns),
                           std::span(widths).subspan(i, columns), best.parameters.shape);
    }
    encoder.finish(out);
}

}  // namespace planet
