// Trains the sets of weights of expected errors.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planet/format/height_prediction.h"
#include "tests/planet/format/training/training_blocks.h"

namespace planet::training {

// Returns the weights of all sets of a pass, as in FittedTables. The blocks' predictors must have the samples and the errors of
// the passes before it, and keep the errors of this one. errors: for each block those of the pass, in steps.
std::vector<std::int32_t> trainErrorWeights(RefinementPass pass, std::span<TrainingBlock> blocks,
                                            std::span<const std::vector<double>> errors);

}  // namespace planet::training
