// The id of a block of the chunk file, which is paged as a whole: the four children of a node of a quadtree.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <string>

#include "planet/sphere/chunk_id.h"

namespace planet {

// The quadtrees of a planet. Normals are derived from heights and have no blocks in the file.
enum class BlockKind : std::uint8_t { Heights, Colours, Normals };
inline constexpr int blockKindCount = 3;

struct BlockId {
    ChunkId parent;  // whose four children it holds: chunks, or tiles of colours or normals
    BlockKind kind = BlockKind::Heights;

    BlockId() = default;
    // The block is one of heights by default.
    BlockId(const ChunkId& parentId, BlockKind blockKind = BlockKind::Heights)
        : parent(parentId), kind(blockKind) {}

    auto operator<=>(const BlockId&) const = default;
};

// Returns "z_pos/3/5/2" for heights, and "z_pos/3/5/2 (colours)" for colours.
inline std::string toString(const BlockId& id) {
    const char* kind = id.kind == BlockKind::Heights   ? ""
                       : id.kind == BlockKind::Colours ? " (colours)"
                                                       : " (normals)";
    return toString(id.parent) + kind;
}

}  // namespace planet

template <>
struct std::hash<planet::BlockId> {
    std::size_t operator()(const planet::BlockId& id) const noexcept {
        return std::hash<planet::ChunkId>{}(id.parent) ^ static_cast<std::size_t>(id.kind);
    }
};
