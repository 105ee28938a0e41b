// The plain types of the streamed chunk file (chunk_file.h), for its reader, its writer and the trees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planet/format/colour_tile.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"

namespace planet {

inline constexpr std::size_t chunkFileHeaderBytes = 512;
inline constexpr std::uint32_t chunkFileVersion = 6;

// The location of a block in the file. Offset 0 is the header, so it means "none".
struct BlockLocation {
    std::uint64_t offset = 0;  // bytes from the file's start
    std::uint32_t size = 0;    // bytes, including the checksum

    bool exists() const { return offset != 0; }
    bool operator==(const BlockLocation&) const = default;
};

// A chunk as stored in the file.
struct ChunkData {
    ChunkId id;
    float deltaCM = 0;  // metres, finite, >= 0; 0 at a leaf
    // The tight metric: the largest distance of the surfaces of this chunk and its descendants from the
    // finest data at the same place; metres, [0, deltaCM]; 0 at a leaf.
    float deltaTightM = 0;
    std::int32_t minStep = 0;  // lowest and highest finest sample under this chunk
    std::int32_t maxStep = 0;
    BlockLocation children;  // none at a leaf
    Steps heights;           // chunkSize x chunkSize steps, row-major, rows upwards along v
};

// The index entry of a chunk with children. The file stores no entry for a leaf: its δc and tight metric are
// 0, and its extremes are those of its heights. Without children, an entry stands for a leaf.
struct ChunkEntry {
    float deltaCM = 0;      // metres, finite, >= 0
    float deltaTightM = 0;  // metres, [0, deltaCM]
    std::int32_t minStep = 0;
    std::int32_t maxStep = 0;
    BlockLocation children;
};

// A tile of colours as stored in the file, or of normals as derived from heights.
struct TileData {
    ChunkId id;
    BlockLocation children;  // none at the finest level, and none for derived tiles
    // In the GPU's format: colourTileBytes, or normalTileBytes.
    std::vector<std::byte> texels;
    bool isRefined = true;  // of normals: the heights are finer somewhere under the tile
};

// The index entry of a colour tile.
struct ColourEntry {
    BlockLocation children;
    std::uint32_t packedBytes = 0;
};

// The colour quadtree of a file. Its levels are independent of those of the chunks.
struct ColourPyramid {
    ColourFormat format = ColourFormat::Bc1;
    int leafLevel = 0;  // [0, maxColourLevel]
    std::array<BlockLocation, faceCount> roots;
    std::string source;  // description of the baked source, for users; at most 60 bytes of UTF-8
};

struct ChunkFileInfo {
    PlanetShape shape;
    std::uint64_t chunks = faceCount;  // of all levels
    int coarsestLeafLevel = 0;         // [0, deepestLevelOf(shape)]; equal to it if the tree is dense
    std::int32_t minStep = 0;          // over the whole planet
    std::int32_t maxStep = 0;
    std::uint64_t missingSamples = 0;  // source samples without data that were filled
    std::array<BlockLocation, faceCount> roots;
    std::string source;  // description of the baked source, for users; at most 200 bytes of UTF-8
    std::optional<ColourPyramid> colour;
    bool hasSourceRecord = false;  // the file ends with a SourceRecord
};

// Returns whether every leaf is at the deepest level.
constexpr bool isDense(const ChunkFileInfo& info) {
    return info.chunks == chunkCountOf(info.shape);
}
// Returns the samples of all leaves: each counts those on two of its edges, so that a dense tree counts every
// sample once.
constexpr std::uint64_t sampleCountOf(const ChunkFileInfo& info) {
    return leafCountOf(info.chunks) * chunkCellCount(info.shape) + 2;
}

}  // namespace planet
