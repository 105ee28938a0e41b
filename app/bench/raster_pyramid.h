// A raster as a chunk file stores a face: the blocks of all its levels with their index. For comparisons of the height codec
// with other formats, which store the finest level alone.
#pragma once

#include <cstddef>
#include <vector>

#include "app/bench/square_formats.h"
#include "planet/base/result.h"
#include "planet/sphere/steps.h"

namespace worldy {

// A coded refinement and the grid that it refines.
struct PyramidBlock {
    std::vector<std::byte> coded;
    planet::Steps coarse;
};

struct RasterPyramid {
    std::vector<PyramidBlock> blocks;
    std::size_t fileBytes = 0;  // with the header, the indices and the checksums
    int chunkCells = 0;
};

// Codes a square of 2^n + 1 samples a side, which is larger than a chunk. chunkCells: a power of two, [16, 128].
// compressionLevel: of the height codec.
RasterPyramid codePyramid(const HeightSquare& square, int chunkCells, int compressionLevel);

// Decodes all blocks on this thread.
planet::Result<void> decodePyramid(const RasterPyramid& pyramid);

}  // namespace worldy
