// The mesh that all chunks share: a square grid and the skirt around it. Plain data, thread-safe.
#pragma once

#include <cstdint>
#include <vector>

namespace planet::gl {

struct GridVertex {
    std::uint8_t column = 0;  // [0, cells], along u
    std::uint8_t row = 0;     // [0, cells], along v
    std::uint8_t skirt = 0;   // 1: lowered by the skirt's depth
    std::uint8_t unused = 0;
};

// Triangles wind counter-clockwise: the grid's as seen from above, the skirt's as seen from outside the
// chunk. Each cell's diagonal runs from its south-west to its north-east corner.
struct ChunkGrid {
    std::vector<GridVertex> vertices;    // row by row, then the skirt's lower end around the border
    std::vector<std::uint16_t> indices;  // of triangles: the grid's first, then the skirt's
    std::uint32_t gridIndexCount = 0;
};

ChunkGrid chunkGrid(int cells);  // cells: [16, 128]

}  // namespace planet::gl
