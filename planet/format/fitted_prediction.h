// Predicts the samples of a refinement with weights that the encoder fits to each block and pass.
//
// The passes are those of height_prediction.h. A prediction is a weighted sum of about 20 samples nearby that are known
// already, those of the same pass in earlier rows among them. The expected size of an error is a weighted sum of the
// errors and of the curvature nearby. fitted_tables.h describes where the weights come from. Only integers are used, so
// the results are bit-identical on every machine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planet/format/height_prediction.h"

namespace planet {

// Return the number of samples that a prediction weighs, and of the terms that an expected error weighs.
int predictionTermCount(RefinementPass pass);
int errorTermCount(RefinementPass pass);
inline constexpr int maxPredictionTerms = 23;
inline constexpr int maxErrorTerms = 10;

// Weights of samples are in 1/16384. Those of a prediction sum to 16384.
inline constexpr int fittedWeightBits = 14;
// Weights of error terms are in 1/1024.
inline constexpr int errorWeightBits = 10;

// Holds the known samples and errors of one block, for the encoder and the decoder.
class FittedPredictor {
public:
    explicit FittedPredictor(int coarseCells);  // c in [2, 128]

    // Sets the coarse grid: (c + 1)^2, row-major.
    void setCoarse(std::span<const std::int16_t> coarse);

    // Starts or restarts a pass. The previous passes must be complete.
    void beginPass(RefinementPass pass);

    // Set the weights of the pass, one for each term.
    void setWeights(std::span<const std::int32_t> weights);
    void setErrorWeights(std::span<const std::int32_t> weights);

    // Predict one row, and its expected |error| in 1/256 steps. Process rows in order: set the errors and the samples of
    // a row before predicting the next one.
    void predictRow(int row, std::span<std::int16_t> predicted) const;
    void expectErrors(int row, std::span<float> expected256) const;
    void setErrors(int row, std::span<const std::int16_t> errors);
    void setSamples(int row, std::span<const std::int16_t> samples);

    // Read what a term weighs, for each sample of a row. The encoder fits weights to it.
    void readPredictionTerm(int term, int row, std::span<std::int32_t> values) const;
    void readErrorTerm(int term, int row, std::span<std::int32_t> values) const;

private:
    BorderedPlane& plane(int index) { return planes_[static_cast<std::size_t>(index)]; }
    const BorderedPlane& plane(int index) const { return planes_[static_cast<std::size_t>(index)]; }
    void beginMiddle();
    void beginOddRow();
    void beginOddColumn();
    void extendMiddle();

    int cells_;
    RefinementPass pass_ = RefinementPass::Middle;
    std::vector<BorderedPlane> planes_;
    std::vector<std::int32_t> weights_;
    std::vector<std::int32_t> errorWeights_;
};

}  // namespace planet
