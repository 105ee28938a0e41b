// Reads the streamed chunk file.
//
//   header     512 bytes: magic, version, shape, locations of the six root blocks, checksum
//   blocks     blocks of children before those of their parents, root blocks last
//   colours    if any: the blocks of the colour quadtree (colour_tile.h), the finest level first
//   record     if any: what the file was baked from (source_record.h)
//
// A sibling block holds the four children of a chunk as a refinement of its grid (height_codec.h); a root
// block holds a face's complete root chunk. Each block also says which of its chunks have children, and
// stores their errors, extremes and the locations of their children, so the index is paged with the data. A
// chunk of any level may be a leaf. Each block ends in a checksum seeded with the chunk's key, so reading a
// block for the wrong chunk also fails. README.md has the layout byte by byte.
//
// A colour block holds the four children of a tile, or a root tile.
//
// The file is untrusted: every offset, size and count is checked before use, and the Error names the file and
// the chunk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file_types.h"
#include "planet/format/source_record.h"
#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"

namespace planet {

// Reads exactly out.size() bytes at an offset. Called from several threads at once.
using ReadAt = std::function<Result<void>(std::uint64_t offset, std::span<std::byte> out)>;

// An open file. Const functions may be called by several threads at once.
class ChunkFile {
public:
    static Result<ChunkFile> open(const std::filesystem::path& path,
                                  const FileCalls& calls = systemFileCalls());
    // Opens any bytes as a chunk file. name: for messages.
    static Result<ChunkFile> open(std::string name, std::uint64_t sizeBytes, ReadAt readAt);

    const ChunkFileInfo& info() const { return info_; }
    const std::string& name() const { return name_; }
    std::uint64_t sizeBytes() const { return sizeBytes_; }

    Result<ChunkData> readRoot(Face face) const;

    // Reads the four children of a chunk above the deepest level, in quadrant order. location: of their
    // block.
    Result<std::array<ChunkData, quadrantCount>> readChildren(const ChunkId& parent, BlockLocation location,
                                                              StepsView parentHeights) const;

    // Reads only the entries of a chunk's four children, without the heights and the checksum. The entry of a
    // leaf has no children; its extremes are unknown without its heights.
    Result<std::array<ChunkEntry, quadrantCount>> readEntries(const ChunkId& parent,
                                                              BlockLocation location) const;

    // Read the tiles of a file with colours. As with chunks, a tile that has been read gives the location of
    // its children.
    Result<TileData> readColourRoot(Face face) const;
    Result<std::array<TileData, quadrantCount>> readColourChildren(const ChunkId& parent,
                                                                   BlockLocation location) const;
    // Reads what the file was baked from; nothing if the file does not say. The Error says that the record is
    // damaged, and names the file.
    Result<std::optional<SourceRecord>> readSourceRecord() const;

    // Checks the block of a chunk's four children that lies in memory, without decoding its heights: its
    // checksum and its index. block: its bytes, which lie at location.offset in the file. Returns the entries, as
    // readEntries does.
    Result<std::array<ChunkEntry, quadrantCount>> checkedEntries(const ChunkId& parent,
                                                                 BlockLocation location,
                                                                 std::span<const std::byte> block) const;
    // Does the same for a block of colours; a block of a root tile has one entry. firstTile: the first of its
    // tiles.
    Result<std::vector<ColourEntry>> checkedColourEntries(const ChunkId& firstTile, BlockLocation location,
                                                          std::span<const std::byte> block) const;
    // Reads bytes as they are stored.
    Result<void> readBytes(std::uint64_t offset, std::span<std::byte> out) const;

    // Reads only the entries of a tile's four children, without the checksum. The children must lie above the
    // finest level.
    Result<std::array<ColourEntry, quadrantCount>> readColourEntries(const ChunkId& parent,
                                                                     BlockLocation location) const;

private:
    ChunkFile() = default;
    // The sizes of a block, including the checksum.
    struct BlockBytes {
        std::uint64_t least;
        std::uint64_t most;
    };
    Result<std::vector<std::byte>> readBlock(const BlockId& id, BlockLocation location,
                                             const BlockBytes& bytes) const;
    // Returns the content of a block after verifying its checksum. isRoot: the id is a root's own.
    Result<std::vector<std::byte>> readContent(const BlockId& id, bool isRoot, BlockLocation location,
                                               const BlockBytes& bytes) const;
    // Returns the same of a block in memory, at least checksumBytes long.
    Result<std::span<const std::byte>> checkedContent(const BlockId& id, bool isRoot,
                                                      std::span<const std::byte> block) const;
    // Decodes the index at the beginning of a block, and checks its entries.
    Result<std::array<ChunkEntry, quadrantCount>> entriesFrom(const ChunkId& parent, BlockLocation location,
                                                              std::span<const std::byte> bytes) const;
    Result<std::vector<TileData>> readColourBlock(const ChunkId& block, BlockLocation location,
                                                  std::span<const ChunkId> tiles) const;
    tl::unexpected<Error> invalid(const BlockId& id, std::string_view what) const;

    ChunkFileInfo info_;
    std::string name_;
    std::uint64_t sizeBytes_ = 0;
    ReadAt readAt_;
};

// Bounds a walk of the index, which no checksum covers: a malicious index can name a block many times, or
// form a cycle. Subtracts the size of a block from bytesLeft, which starts at sizeBytes(). The Error says
// that the index names more bytes than the file has.
Result<void> spendOn(const ChunkFile& file, BlockLocation block, std::uint64_t& bytesLeft);

}  // namespace planet
