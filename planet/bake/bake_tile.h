// The pieces of a bake: what turns a square of the source into chunks and their blocks. The bake and its
// estimate share them. Pure functions but for the source; any thread, each with a scratch of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/bake/bake_settings.h"
#include "planet/bake/finest_distance.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file_types.h"
#include "planet/format/height_codec.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/geometric_error.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Blocks are made before their place in the file is known, as if their run began here.
inline constexpr std::uint64_t provisionalOrigin = chunkFileHeaderBytes;

struct BakedChunk {
    ChunkId id;
    ChunkEntry entry;
    std::vector<std::int16_t> heights;
};

struct BakedTile {
    BakedChunk root;
    std::vector<std::byte> blocks;  // of everything under the root, the root's children last
    // What the tile's finest samples lie off the chunks above it, metres: by level from coarsestLevelOfTiles
    // to the one above the root, two above the finest at most.
    std::vector<double> offAboveM;
};

// Kept between calls so that nothing is allocated.
struct BakeScratch {
    std::vector<float> sampledM;
    std::vector<std::int16_t> steps;
    std::vector<std::int16_t> refined;
    GeometricErrorScratch geometry;
    TileDistances distances;
};

struct BakeContext {
    const HeightSource& source;
    PlanetShape shape;
    int compressionLevel = defaultCompressionLevel;
};

// Settings that no source can change: compression level and threads. The Error says what would be right.
Result<void> checkBakeSettings(const BakeSettings& settings);

// The shape that a source and settings give. The Error names the setting and its range.
Result<PlanetShape> chooseShape(const HeightSource& source, const BakeSettings& settings);

// 0 threads: one a core.
int bakeThreads(const BakeSettings& settings);

// A tile is the subtree that one task bakes: samples its square and bakes it bottom-up. The Error names the
// source's file, or a height that 16 bits cannot hold.
Result<BakedTile> bakeTile(const BakeContext& bake, const ChunkId& root, BakeScratch& scratch);

// Removes every other row and column: appends the block of the four children, returns their parent. Places in
// the file count from origin, where the first of the blocks lies. finestDistanceM is the parent's; of a
// leaf's parent it is found here.
BakedChunk mergeChildren(const BakeContext& bake, const ChunkId& parent,
                         std::span<const BakedChunk, quadrantCount> children, double finestDistanceM,
                         std::uint64_t origin, BakeScratch& scratch, std::vector<std::byte>& blocks);

}  // namespace planet
