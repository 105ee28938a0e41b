// All chunks of a chunk file, and their meshes.
#pragma once

#include <unordered_map>

#include "planet/format/chunk_file.h"
#include "planet/select/drawn_surface.h"

namespace planet::test {

using Chunks = std::unordered_map<ChunkId, ChunkData>;

inline void addAll(const ChunkFile& file, const ChunkData& chunk, Chunks& chunks) {
    chunks.emplace(chunk.id, chunk);
    if (!chunk.children.exists()) return;
    const auto children = file.readChildren(chunk.id, chunk.children, chunk.heights).value();
    for (const ChunkData& child : children) addAll(file, child, chunks);
}

inline Chunks chunksOf(const ChunkFile& file) {
    Chunks chunks;
    for (const Face face : allFaces) addAll(file, file.readRoot(face).value(), chunks);
    return chunks;
}

inline DrawnGrid unmorphed(const PlanetShape& shape, const ChunkData& chunk) {
    DrawItem item;
    item.id = chunk.id;
    return drawnGrid(shape, item, chunk.heights, false);
}

}  // namespace planet::test
