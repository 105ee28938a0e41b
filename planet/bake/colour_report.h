// Reports and verifies the colours of a chunk file. Both functions read the file once, depth first, and hold
// one path of blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/source/colour_source.h"

namespace planet {

struct ColourLevelReport {
    int level = 0;
    std::uint64_t tiles = 0;
    std::uint64_t bytes = 0;  // of the blocks that hold them
};

// Returns the levels of a file with colours, the roots first. Reads the index alone.
Result<std::vector<ColourLevelReport>> reportColours(const ChunkFile& file);

struct ColourVerifyReport {
    std::uint64_t tiles = 0;     // read and checked
    std::uint64_t edges = 0;     // that two tiles of a face share, compared
    std::uint64_t compared = 0;  // tiles compared with the source; 0 without one
    std::uint64_t problemCount = 0;
    std::uint64_t sourceProblems = 0;   // of those: tiles whose colours differ from the source
    std::vector<std::string> problems;  // the first 100, each naming its tile
};

// Checks every block's checksum, that its texels unpack, and that tiles beside each other on a face have the
// same texels on the edge they share. With its source it compares every texel. Damage is a problem in the
// report; the Error is for a source that cannot be read, or Cancelled: goOn is called before each tile.
Result<ColourVerifyReport> verifyColours(const ChunkFile& file, const ColourSource* source,
                                         const std::function<bool()>& goOn = {});

}  // namespace planet
