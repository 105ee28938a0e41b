// How deep the quadtree goes under each chunk of a file, for tints: the resident part of a tree does not say.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>

#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

struct LeafDepths {
    int everywhere = -1;  // of a dense file, whose leaves all have one level; -1: below counts
    // The level of the deepest leaf under chunks with grandchildren.
    std::unordered_map<planet::ChunkId, std::uint8_t> below{};
};

// Reads the index of a file, without heights. A chunk of which nothing is known after mostChunks entries counts as one
// without grandchildren. goOn is called for each block that is read; if it returns false, the result is an Error of
// kind Cancelled. Any thread.
planet::Result<LeafDepths> leafDepthsOf(const planet::ChunkFile& file, const std::function<bool()>& goOn = {},
                                        std::size_t mostChunks = std::size_t{4} << 20);

// Returns the level of the deepest leaf under a chunk, or of the chunk itself if it is a leaf.
int deepestLeaf(const LeafDepths& depths, const planet::ChunkId& chunk, bool isLeaf);

}  // namespace worldy
