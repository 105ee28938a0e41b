// The weights of fitted_prediction.h.
//
// The weights of a prediction are the mean of the best weights of many blocks, plus a sum of directions, each times a
// coefficient that the encoder chooses for its block and pass. The directions are the principal components of the best
// weights, in the metric in which a coefficient of 1 grows the expected square of the error by 1 %. So the first ones say
// most, and most of the others are 0 in a block. An expected error has one of several sets of weights.
//
// tests/planet/format/train_fitted_tables.cpp trains all of them on parts of data/earth and data/regions, and prints
// fitted_table_numbers.h. The blocks' weights are robust least squares. The sets of weights of errors are of maximum likelihood
// over clusters of blocks. After a change of the terms in fitted_prediction.cpp, train them again:
//
//   cmake --build build --target train_fitted_tables
//   build/train_fitted_tables | clang-format > planet/format/fitted_table_numbers.h
#pragma once

#include <cstdint>
#include <span>

#include "planet/format/height_prediction.h"

namespace planet {

struct FittedTables {
    // One weight for each sample but the first, in 1/16384. The first one has the rest up to 1.
    std::span<const std::int32_t> meanWeights;
    // For each of these samples one row, with a number for each direction, in 1/16 of 1/16384.
    std::span<const std::int32_t> directions;
    // For each direction the width of its coefficient (height_residual_coder.h).
    std::span<const std::uint8_t> coefficientWidths;
    // For each set the weights of all terms, in 1/1024.
    std::span<const std::int32_t> errorWeights;
};

inline constexpr int errorWeightSetCount = 8;

const FittedTables& fittedTables(RefinementPass pass);

// Returns the number of directions of a pass: as many as there are samples but one.
int directionCount(RefinementPass pass);

inline constexpr int maxCoefficientPrecision = 3;

// Computes the weights of all samples from the coefficients of the first directions, which are multiples of 2^-precision;
// those of the others are 0. The weights sum to 16384 modulo 2^32.
void fittedWeights(RefinementPass pass, std::span<const std::int16_t> coefficients, int precision,
                   std::span<std::int32_t> weights);

// Returns a set of weights of errors. set: [0, errorWeightSetCount).
std::span<const std::int32_t> errorWeightSet(RefinementPass pass, int set);

}  // namespace planet
