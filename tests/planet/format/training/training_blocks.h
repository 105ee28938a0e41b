// The terrain that the tables of fitted blocks are trained on (planet/format/fitted_tables.h).
//
// It is a third of the blocks of the western part of ETOPO5 (columns 20 to 2068 of 4320), the blocks of the tile N49W124 of SRTM
// that are not flat, and half of the blocks of two pieces of that part of ETOPO5 that are made twice as dense, as a bake finer
// than its source has them. The eastern part of ETOPO5 and the tiles S33W071 and N49W123 are kept for testing. N49W124 is
// trained on, so its size in tests/PERFORMANCE.md is not that of unknown terrain.
#pragma once

#include <cstdint>
#include <vector>

#include "planet/format/fitted_prediction.h"

namespace planet::training {

inline constexpr int trainingCells = 32;  // of the coarse grids, per side

struct TrainingBlock {
    std::vector<std::int16_t> fine;  // (2 * trainingCells + 1)^2 samples, row-major
    FittedPredictor predictor;       // has the coarse grid
};

// Returns the blocks, always in the same order. Throws where a raster cannot be read.
std::vector<TrainingBlock> trainingBlocks();

}  // namespace planet::training
