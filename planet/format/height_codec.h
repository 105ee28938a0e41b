// The lossless height codec of the chunk file: one refinement of a square grid.
//
// A coarse grid of (c + 1)^2 steps is every other row and column of a fine grid of (2c + 1)^2. The codec
// stores only the other fine samples: each is predicted from the samples known before it
// (height_prediction.h), and the differences are entropy coded (height_residual_coder.h). A block depends
// only on its coarse grid. Grids are row-major.
//
// Pure functions, any thread. Encoding and decoding are bit-identical on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/result.h"

namespace planet {

// The effort of the encoder. It does not affect the decoding speed.
//   0  the samples uncoded, 2 bytes each
//   1  one predictor; measures the spread of its errors
//   2  tries the likelier half of the predictors, and estimates their cost from every 8th sample
//   3  tries every predictor with its exact cost: about 1/5 of the speed of 2, for 0.3 to 1 % fewer bytes
inline constexpr int minCompressionLevel = 0;
inline constexpr int defaultCompressionLevel = 2;
inline constexpr int maxCompressionLevel = 3;

inline constexpr int maxCoarseCells = 128;
inline constexpr int maxGridSize = 2 * maxCoarseCells + 1;

// Appends the coded refinement to out: at most 2 bytes for each missing sample, and 1 more. fine: (2c + 1)^2
// samples, c in [1, maxCoarseCells].
void encodeRefinement(std::span<const std::int16_t> fine, int coarseCells, int compressionLevel,
                      std::vector<std::byte>& out);

// Rebuilds the fine grid from the coarse grid and exactly the coded bytes. Malicious bytes give an Error or a
// wrong grid, never a read out of bounds. After an Error the content of fine is undefined.
Result<void> decodeRefinement(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                              int coarseCells, std::span<std::int16_t> fine);

// Code a whole grid of size x size samples without a coarser grid, as for the six root chunks. size: a power
// of two plus one, [2, maxGridSize].
void encodeGrid(std::span<const std::int16_t> grid, int size, std::vector<std::byte>& out);
Result<void> decodeGrid(std::span<const std::byte> coded, int size, std::span<std::int16_t> grid);

}  // namespace planet
