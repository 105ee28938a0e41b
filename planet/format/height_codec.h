// The lossless height codec of the chunk file: one refinement of a square grid.
//
// A coarse grid of (c + 1)^2 steps is every other row and column of a fine grid of (2c + 1)^2. The codec
// stores only the other fine samples: each is predicted from the samples known before it
// (height_prediction.h), and the differences are entropy coded (height_residual_coder.h). A block depends
// only on its coarse grid. Grids are row-major.
//
// Where the quantum of a file has fractions (planet_shape.h), most blocks are coarser than its finest fraction. A
// block is coded in multiples of 2^shift steps, the largest that all its samples are multiples of, relative to a
// base that follows from the coarse grid. Both let the samples of most blocks fit into 16 bits. A block of which a
// part is coarse may be split: its samples are coded without their low bits, and the low bits apart. A block that
// fits in neither way is stored uncoded, with 4 bytes a sample.
//
// Pure functions, any thread. Encoding and decoding are bit-identical on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"

namespace planet {

// The effort of the encoder.
//   0  the samples uncoded, 2 bytes each
//   1  one predictor; measures the spread of its errors
//   2  tries the likelier half of the predictors, and estimates their cost from every 8th sample
//   3  tries every predictor with its exact cost, and fits weights to each block (fitted_block.h): about 1/50 of the
//      speed of 2, for 1 to 9 % fewer bytes, which are decoded at half the speed
inline constexpr int minCompressionLevel = 0;
inline constexpr int defaultCompressionLevel = 2;
inline constexpr int maxCompressionLevel = 3;

inline constexpr int maxCoarseCells = 128;
inline constexpr int maxGridSize = 2 * maxCoarseCells + 1;

// Appends the coded refinement to out: at most 2 bytes for each missing sample, and 1 more; with fractions, 4 bytes and
// 1 more. fine: (2c + 1)^2 samples, c in [1, maxCoarseCells]. fractionBits: of the planet's shape; the samples lie
// within its limits (lowestStepOf, highestStepOf).
void encodeRefinement(std::span<const std::int32_t> fine, int coarseCells, int compressionLevel,
                      int fractionBits, std::vector<std::byte>& out);

// Rebuilds the fine grid from the coarse grid and exactly the coded bytes. Malicious bytes give an Error or a
// wrong grid within the limits of the planet's steps, never a read out of bounds.
Result<Steps> decodeRefinement(std::span<const std::byte> coded, const StepsView& coarse, int coarseCells,
                               int fractionBits);

// Code a whole grid of size x size samples without a coarser grid, as for the six root chunks. size: a power
// of two plus one, [2, maxGridSize].
void encodeGrid(std::span<const std::int32_t> grid, int size, int fractionBits, std::vector<std::byte>& out);
Result<Steps> decodeGrid(std::span<const std::byte> coded, int size, int fractionBits);

// Returns log2 of the largest power of two that all steps are multiples of, at most fractionBits: the shift of a block
// with these samples.
int sharedShift(const StepsView& steps, int fractionBits);

}  // namespace planet
