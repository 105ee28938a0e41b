// The streamed chunk file: reading.
//
//   header     512 bytes: magic, version, shape, where the six root blocks are, checksum
//   blocks     children's before their parents', root blocks last
//   colours    where there are any: the colour quadtree's blocks (colour_tile.h), the finest level's first
//
// A sibling block holds the four children of one chunk as one refinement of that chunk's grid: of the
// (2^(k+1) + 1)^2 samples that the four cover together, only those the parent does not have (see
// height_codec.h). A root block holds a face's root chunk whole. Each block says, for its chunks, delta_c,
// the tight metric (finest_distance.h), the lowest and highest finest height under them, and where their own
// children lie; so the index is paged with the data. Everything is little-endian; each block ends in an XXH3
// checksum seeded with the chunk's key, so that a block read for the wrong chunk fails too. README.md beside it
// has the layout byte by byte.
//
// A colour block holds the four tiles that are the children of one tile, or a root tile alone: for each tile
// where its own children lie and how many bytes it takes, then the packed tiles, then such a checksum.
//
// The file is hostile until checked: every offset, size and count is checked before use, and a bad one is an
// Error that names the file and the chunk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file_types.h"
#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Reads exactly out.size() bytes at an offset; called from any thread, several at once.
using ReadAt = std::function<Result<void>(std::uint64_t offset, std::span<std::byte> out)>;

// An open file. Reading is const and may be done by several threads at once.
class ChunkFile {
public:
    static Result<ChunkFile> open(const std::filesystem::path& path,
                                  const FileCalls& calls = systemFileCalls());
    // The same over any bytes. The name is for messages.
    static Result<ChunkFile> open(std::string name, std::uint64_t sizeBytes, ReadAt readAt);

    const ChunkFileInfo& info() const { return info_; }
    const std::string& name() const { return name_; }
    std::uint64_t sizeBytes() const { return sizeBytes_; }

    Result<ChunkData> readRoot(Face face) const;

    // The four children of a chunk whose heights and children's place are known, in quadrant order.
    Result<std::array<ChunkData, quadrantCount>> readChildren(
        const ChunkId& parent, BlockLocation location, std::span<const std::int16_t> parentHeights) const;

    // The index alone, not the heights and unchecked by the checksum: what the block of a chunk's children
    // says of each. The children must not be leaves, which have no entries.
    Result<std::array<ChunkEntry, quadrantCount>> readEntries(const ChunkId& parent,
                                                              BlockLocation location) const;

    // Of a file with colours. As for chunks: where its children lie is known of a tile that has been read.
    Result<TileData> readColourRoot(Face face) const;
    Result<std::array<TileData, quadrantCount>> readColourChildren(const ChunkId& parent,
                                                                   BlockLocation location) const;
    // As readEntries: where the four tiles' own children lie, of tiles above the finest level.
    Result<std::array<ColourEntry, quadrantCount>> readColourEntries(const ChunkId& parent,
                                                                     BlockLocation location) const;

private:
    ChunkFile() = default;
    // bytes: what the block needs at least, and what no honest one exceeds.
    struct BlockBytes {
        std::uint64_t least;
        std::uint64_t most;
    };
    Result<std::vector<std::byte>> readBlock(const BlockId& id, BlockLocation location,
                                             const BlockBytes& bytes) const;
    Result<std::vector<TileData>> readColourBlock(const ChunkId& block, BlockLocation location,
                                                  std::span<const ChunkId> tiles) const;
    Result<std::span<const std::byte>> checkedContent(const BlockId& id, std::span<const std::byte> block,
                                                      std::uint64_t expectedChecksum) const;
    Error nonsense(const BlockId& id, std::string_view what) const;

    ChunkFileInfo info_;
    std::string name_;
    std::uint64_t sizeBytes_ = 0;
    ReadAt readAt_;
};

// Bounds a walk of the index, which no checksum covers: a hostile one leads to the same block by many ways,
// or in circles. Subtracts a block from the bytes that the file's blocks can have in all, sizeBytes() at
// first; the Error says that the index tells of more.
Result<void> spendOn(const ChunkFile& file, BlockLocation block, std::uint64_t& bytesLeft);

}  // namespace planet
