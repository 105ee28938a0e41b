// The lossless height codec of the chunk file: one refinement of a square grid.
//
// A coarse grid of (c + 1)^2 steps is every other row and column of a fine grid of (2c + 1)^2. The codec
// stores only the other fine samples: each is predicted from samples known by then (height_prediction.h), and
// the differences are entropy coded (height_residual_coder.h). A block needs only its coarse grid. Grids are
// row-major.
//
// Pure functions, any thread. Encoding and decoding are bit-identical on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/result.h"

namespace planet {

// The effort of the encoder. Decoding speed does not change.
//   0  the samples as they are, 2 bytes each
//   1  one predictor; how widely its errors spread is measured
//   2  the likelier half of the predictors tried, their cost judged from every 8th sample
//   3  every predictor tried, the cost counted in full: about 1/5 of the speed of 2, for 0.3 to 1 % fewer
//   bytes
inline constexpr int minCompressionLevel = 0;
inline constexpr int defaultCompressionLevel = 2;
inline constexpr int maxCompressionLevel = 3;

inline constexpr int maxCoarseCells = 128;
inline constexpr int maxGridSize = 2 * maxCoarseCells + 1;

// Appends the coded refinement to out: at most 1 byte more than 2 for each missing sample. fine has (2c +
// 1)^2 samples, c in [1, maxCoarseCells].
void encodeRefinement(std::span<const std::int16_t> fine, int coarseCells, int compressionLevel,
                      std::vector<std::byte>& out);

// Rebuilds the fine grid from the coarse grid and exactly the coded bytes. Hostile bytes give an Error or a
// wrong grid, never a read out of bounds. After an Error the content of fine is undefined.
Result<void> decodeRefinement(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                              int coarseCells, std::span<std::int16_t> fine);

// Code a whole grid of size x size samples without a coarser grid, as of the six root chunks. size is a power
// of two plus one, in [2, maxGridSize].
void encodeGrid(std::span<const std::int16_t> grid, int size, std::vector<std::byte>& out);
Result<void> decodeGrid(std::span<const std::byte> coded, int size, std::span<std::int16_t> grid);

}  // namespace planet
