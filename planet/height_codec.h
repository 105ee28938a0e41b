// The lossless height codec of the chunk file: one refinement of a square grid.
//
// A coarse grid of (c + 1)^2 steps and the fine grid of (2c + 1)^2 that it is every other row and column of.
// Only the fine samples that the coarse grid lacks are coded, as residuals against a prediction from samples
// known by then. Grids are row-major.
//
// Pure functions, any thread. Encoding and decoding are bit-identical on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/result.h"

namespace planet {

inline constexpr int minCompressionLevel = 0;  // stores residuals plainly
inline constexpr int defaultCompressionLevel = 3;
inline constexpr int maxCompressionLevel = 9;  // slowest bake, smallest file; decoding speed does not change

// Appends the coded refinement to out. fine has (2c + 1)^2 samples, c in [1, 128].
void encodeRefinement(std::span<const std::int16_t> fine, int coarseCells, int compressionLevel,
                      std::vector<std::byte>& out);

// Rebuilds the fine grid from the coarse grid and the coded bytes, which must be all of them and nothing
// more. Hostile bytes give an Error, never a read outside.
Result<void> decodeRefinement(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                              int coarseCells, std::span<std::int16_t> fine);

// A whole grid of size x size samples that nothing coarser is known of: the six root chunks.
void encodeGrid(std::span<const std::int16_t> grid, int size, std::vector<std::byte>& out);
Result<void> decodeGrid(std::span<const std::byte> coded, int size, std::span<std::int16_t> grid);

}  // namespace planet
