// The bytes of the chunk file, shared by its reader and its writer. README.md beside it has the table.
// Pure functions, any thread.
//
// Version 3 has colours, or zeros in their place; all else is version 2's, which is read as without. Header:
// after the source's text the kind of colours (u8, 0 none), their finest level (u8), six root blocks (u64
// offset, u32 size) and their source's text. Colour block: entries of 16 bytes, packed tiles, checksum.
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

inline constexpr std::size_t chunkEntryBytes = 24;
inline constexpr std::size_t checksumBytes = 8;
inline constexpr std::size_t colourEntryBytes = 16;

// Blocks point back to earlier ones by distance, so that a run of blocks can be made before it is known where
// in the file it will lie.
void putEntry(std::vector<std::byte>& block, const ChunkEntry& entry, std::uint64_t blockOffset);
ChunkEntry entryFrom(std::span<const std::byte, chunkEntryBytes> bytes, std::uint64_t blockOffset);

void putColourEntry(std::vector<std::byte>& block, const ColourEntry& entry, std::uint64_t blockOffset);
ColourEntry colourEntryFrom(std::span<const std::byte, colourEntryBytes> bytes, std::uint64_t blockOffset);

// XXH3 of the bytes, seeded by whose block it is: a root block is its own chunk's, a sibling block its
// parent's.
std::uint64_t rootChecksum(std::span<const std::byte> bytes, Face face);
std::uint64_t siblingChecksum(std::span<const std::byte> bytes, const ChunkId& parent);
std::uint64_t colourRootChecksum(std::span<const std::byte> bytes, Face face);
std::uint64_t colourSiblingChecksum(std::span<const std::byte> bytes, const ChunkId& parent);

// Of the header, all but its last checksumBytes.
std::uint64_t headerChecksum(std::span<const std::byte> bytes);
std::array<std::byte, chunkFileHeaderBytes> headerBytes(const ChunkFileInfo& info, std::uint64_t fileBytes);

// The Error names the file.
Result<ChunkFileInfo> infoFromHeader(std::span<const std::byte, chunkFileHeaderBytes> header,
                                     const std::string& name, std::uint64_t fileBytes);

}  // namespace planet
