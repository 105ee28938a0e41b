// Encodes and decodes the parts of the chunk file, for its reader and its writer. README.md in this folder
// has the tables. Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/chunk_file_types.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

inline constexpr std::size_t largestEntryBytes = 29;
inline constexpr std::size_t checksumBytes = 8;
inline constexpr std::size_t colourEntryBytes = 16;

// The index at the beginning of a block of heights: a byte whose bit q says that chunk q of the block has
// children, then an entry for each chunk that has.
struct BlockIndex {
    std::array<ChunkEntry, quadrantCount> entries;  // without children: a leaf
    std::size_t bytes = 1;
};
inline constexpr std::size_t largestIndexBytes = 1 + quadrantCount * largestEntryBytes;

// Appends the index of a block's chunks: four, or one for a root block. Entries name earlier blocks by
// distance, so a run of blocks can be made before its location in the file is known. The size of the index does not
// depend on the distances, which are below 2^48.
void putIndex(std::vector<std::byte>& block, std::span<const ChunkEntry> entries, std::uint64_t blockOffset);

// Decodes the index of a block of some chunks, [1, 4]. block: at least the index, or all of a shorter block.
// mayHaveChildren: the chunks lie above the deepest level. The Error does not name the block. The values of
// the entries are not checked.
Result<BlockIndex> indexFrom(std::span<const std::byte> block, int chunks, bool mayHaveChildren,
                             std::uint64_t blockOffset);

void putColourEntry(std::vector<std::byte>& block, const ColourEntry& entry, std::uint64_t blockOffset);
ColourEntry colourEntryFrom(std::span<const std::byte, colourEntryBytes> bytes, std::uint64_t blockOffset);

// Return XXH3 of the bytes, seeded with the key of the root or, for a sibling block, of the parent.
std::uint64_t rootChecksum(std::span<const std::byte> bytes, Face face);
std::uint64_t siblingChecksum(std::span<const std::byte> bytes, const ChunkId& parent);
std::uint64_t colourRootChecksum(std::span<const std::byte> bytes, Face face);
std::uint64_t colourSiblingChecksum(std::span<const std::byte> bytes, const ChunkId& parent);
// Returns the checksum of a record of the source (source_record.h). bytes: all before the checksum.
std::uint64_t sourceRecordChecksum(std::span<const std::byte> bytes);

// Returns the checksum of the header. bytes: the header without its last checksumBytes.
std::uint64_t headerChecksum(std::span<const std::byte> bytes);
std::array<std::byte, chunkFileHeaderBytes> headerBytes(const ChunkFileInfo& info, std::uint64_t fileBytes);

// Decodes the header. The Error names the file.
Result<ChunkFileInfo> infoFromHeader(std::span<const std::byte, chunkFileHeaderBytes> header,
                                     const std::string& name, std::uint64_t fileBytes);

}  // namespace planet
