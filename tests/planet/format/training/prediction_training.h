// Trains the weights of predictions: their mean over many blocks, and the directions in which they vary.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planet/format/height_prediction.h"
#include "tests/planet/format/training/training_blocks.h"

namespace planet::training {

struct TrainedPredictions {
    // These are the numbers of FittedTables.
    std::vector<std::int32_t> meanWeights;
    std::vector<std::int32_t> directions;
    std::vector<std::int32_t> coefficientWidths;
    // For each block the errors of its own best weights, for each sample of the pass, in steps.
    std::vector<std::vector<double>> errors;
};

// Trains a pass. The blocks' predictors must have the samples of the passes before it, and keep those of this one.
TrainedPredictions trainPredictions(RefinementPass pass, std::span<TrainingBlock> blocks);

}  // namespace planet::training
