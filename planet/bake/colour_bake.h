// Bakes a colour source into the colour quadtree of a chunk file, level by level from the finest, so that
// blocks of children precede those of their parents. Uses memory for a few tiles per thread, 12 bytes for each tile,
// and 12 for each block of one level.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "planet/bake/bake_settings.h"
#include "planet/base/atomic_file.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file_types.h"
#include "planet/source/colour_source.h"

namespace planet {

// Returns the finest level of a source's tiles. The Error names the setting and its range.
Result<int> colourLeafLevel(const ColourSource& source, const ColourBakeSettings& settings);

// The tiles of a source: a tile has children while the source is finer there, up to the finest level.
struct ColourTree {
    // By level, in quadtree order: the ids, and whether each has children.
    struct Level {
        std::vector<ChunkId> ids;
        std::vector<bool> hasChildren;
    };
    std::vector<Level> levels;

    std::uint64_t tileCount() const;
};

// Returns the tree of a source. The Error is that of colourLeafLevel.
Result<ColourTree> colourTreeOf(const ColourSource& source, const ColourBakeSettings& settings);

struct PackedColourTile {
    ColourEntry entry;  // without the location of its children
    std::vector<std::byte> bytes;
};

// Bakes a tile. Any thread. The Error names the source's file.
Result<PackedColourTile> packColourTile(const ColourSource& source, ColourFormat format, const ChunkId& id);

// Returns the block of one root, or of four siblings, for its location in the file.
std::vector<std::byte> colourBlock(const ChunkId& firstTile, std::span<const PackedColourTile> tiles,
                                   std::uint64_t offset);

// Called by the calling thread after every few tiles, with the number of new tiles. Returning false cancels.
using ColourProgress = std::function<bool(std::uint64_t moreTiles)>;

// Bakes and appends the blocks. The same source and settings give the same bytes with any number of threads.
Result<ColourPyramid> bakeColour(const ColourSource& source, const ColourTree& tree, ColourFormat format,
                                 int threads, AtomicFile& file, const ColourProgress& progress);

}  // namespace planet
