// The blocks of a chunk file's bytes, found by following its index whatever the checksums say, and checksums
// made right again after bytes were changed. For the mutation test and the fuzzer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/format/chunk_file_format.h"
#include "planet/format/source_record.h"
#include "planet/sphere/block_id.h"

namespace planet::test {

struct FileBlock {
    BlockId id;  // as messages name it: of a root block its own chunk, of the others the parent
    bool isRoot = false;
    BlockLocation at;
    std::size_t entriesBytes = 0;  // at its beginning, with the byte that says which chunks have one
};

template <class T>
void putAt(std::span<std::byte> bytes, std::size_t offset, T value) {
    std::vector<std::byte> encoded;
    ByteWriter(encoded).put(value);
    std::copy(encoded.begin(), encoded.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
}

// Calls visit for each block that the index tells of and the file can hold, parents first, as often as it is
// told of, but not more than `most` times. The header must be good.
template <class Visit>
void forEachBlock(std::span<const std::byte> file, const ChunkFileInfo& info, std::size_t most,
                  const Visit& visit) {
    std::vector<FileBlock> open;
    const int leaf = deepestLevelOf(info.shape);
    // The index of a block of heights; empty if it is not valid.
    const auto indexOf = [&](const BlockId& id, bool isRoot, const BlockLocation& at) {
        const auto bytes = file.subspan(static_cast<std::size_t>(at.offset), at.size - checksumBytes);
        const int level = id.parent.level + (isRoot ? 0 : 1);
        return indexFrom(bytes, isRoot ? 1 : quadrantCount, level < leaf, at.offset).value_or(BlockIndex{});
    };
    const auto add = [&](const BlockId& id, bool isRoot, const BlockLocation& at) {
        const bool colours = id.kind == BlockKind::Colours;
        const std::size_t least = colours ? (isRoot ? 1 : quadrantCount) * colourEntryBytes : 1;
        const bool fits = at.offset >= chunkFileHeaderBytes && at.offset <= file.size() &&
                          at.size <= file.size() - at.offset && at.size >= least + checksumBytes;
        if (fits) open.push_back({id, isRoot, at, colours ? least : indexOf(id, isRoot, at).bytes});
    };
    for (const Face face : allFaces) {
        const ChunkId root{face, 0, 0, 0};
        const auto f = static_cast<std::size_t>(face);
        add(root, true, info.roots[f]);
        if (info.colour) add({root, BlockKind::Colours}, true, info.colour->roots[f]);
    }
    for (std::size_t done = 0; done < open.size() && done < most; ++done) {
        const FileBlock block = open[done];
        visit(block);
        const bool colours = block.id.kind == BlockKind::Colours;
        const BlockIndex index = colours ? BlockIndex{} : indexOf(block.id, block.isRoot, block.at);
        const auto bytes = file.subspan(static_cast<std::size_t>(block.at.offset), block.at.size);
        for (int q = 0; q < (block.isRoot ? 1 : quadrantCount); ++q) {
            const ChunkId chunk = block.isRoot ? block.id.parent : childOf(block.id.parent, q);
            if (colours && chunk.level >= info.colour->leafLevel) continue;
            const auto i = static_cast<std::size_t>(q);
            const BlockLocation children =
                colours
                    ? colourEntryFrom(bytes.subspan(i * colourEntryBytes).template first<colourEntryBytes>(),
                                      block.at.offset)
                          .children
                    : index.entries[i].children;
            if (colours || children.exists()) add({chunk, block.id.kind}, false, children);
        }
    }
}

inline std::uint64_t checksumOf(const FileBlock& block, std::span<const std::byte> summed) {
    const ChunkId& id = block.id.parent;
    if (block.id.kind == BlockKind::Colours)
        return block.isRoot ? colourRootChecksum(summed, id.face) : colourSiblingChecksum(summed, id);
    return block.isRoot ? rootChecksum(summed, id.face) : siblingChecksum(summed, id);
}

inline void resealBlock(std::span<std::byte> file, const FileBlock& block) {
    const auto bytes = file.subspan(static_cast<std::size_t>(block.at.offset), block.at.size);
    const std::size_t summed = bytes.size() - checksumBytes;
    putAt(bytes, summed, checksumOf(block, bytes.first(summed)));
}

// The header's checksum, and the file's length in it.
inline void resealHeader(std::span<std::byte> file) {
    constexpr std::size_t lengthAt = 16;
    constexpr std::size_t summed = chunkFileHeaderBytes - checksumBytes;
    if (file.size() < chunkFileHeaderBytes) return;
    putAt(file, lengthAt, static_cast<std::uint64_t>(file.size()));
    putAt(file, summed, headerChecksum(file.first(summed)));
}

inline Result<ChunkFileInfo> infoOf(std::span<const std::byte> file) {
    if (file.size() < chunkFileHeaderBytes) return badInput("too short");
    return infoFromHeader(file.first<chunkFileHeaderBytes>(), "file", file.size());
}

// The checksum of the record of the source, if its length can be right.
inline void resealRecord(std::span<std::byte> file) {
    const auto tail = file.last<sourceRecordTailBytes>();
    const auto length = sourceRecordLength(tail);
    if (!length || *length + tail.size() > file.size()) return;
    const auto record = file.last(*length + tail.size());
    putAt(record, record.size() - checksumBytes,
          sourceRecordChecksum(record.first(record.size() - checksumBytes)));
}

// All that is checked by checksums: what is nonsense then has to be found by looking.
inline void reseal(std::span<std::byte> file, std::size_t mostBlocks = 1000) {
    resealHeader(file);
    const Result<ChunkFileInfo> info = infoOf(file);
    if (!info) return;
    std::vector<FileBlock> blocks;
    forEachBlock(file, *info, mostBlocks, [&](const FileBlock& block) { blocks.push_back(block); });
    for (const FileBlock& block : blocks) resealBlock(file, block);
    if (info->hasSourceRecord) resealRecord(file);
}

}  // namespace planet::test
