// Reports and verifies the colours of a chunk file. Both functions read the file once, depth first, and keep
// one path of blocks in memory, for each face that is verified at the same time.
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

// Returns the levels of a file with colours, the roots first. Reads only the index.
Result<std::vector<ColourLevelReport>> reportColours(const ChunkFile& file);

struct ColourVerifyReport {
    std::uint64_t tiles = 0;     // read and checked
    std::uint64_t edges = 0;     // compared edges between two tiles of a face
    std::uint64_t compared = 0;  // tiles compared with the source; 0 without one
    std::uint64_t problemCount = 0;
    std::uint64_t sourceProblems = 0;   // compared tiles whose colours differ from the source
    std::vector<std::string> problems;  // the first 100, each naming its tile
};

// Verifies every block's checksum, that its texels unpack, and that neighbouring tiles of a face have the
// same texels on their shared edge. With a source, it compares every texel. Damage is a problem in the
// report; the Error is for an unreadable source, or Cancelled. Calls goOn before each tile. Verifies the
// faces in parallel on oneTBB's threads, and calls goOn on any of them.
Result<ColourVerifyReport> verifyColours(const ChunkFile& file, const ColourSource* source,
                                         const std::function<bool()>& goOn = {});

}  // namespace planet
