// Bakes a unit of the tree into chunks and their blocks, for the bake and its estimate. Pure functions
// apart from the source; any thread, each with its own scratch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planet/bake/bake_settings.h"
#include "planet/bake/bake_tree.h"
#include "planet/bake/finest_distance.h"
#include "planet/bake/quantise.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file_types.h"
#include "planet/format/height_codec.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/geometric_error.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

// Blocks are made before their location in the file is known, as if the first one were here.
inline constexpr std::uint64_t provisionalOrigin = chunkFileHeaderBytes;

struct BakedChunk {
    ChunkId id;
    ChunkEntry entry;
    std::vector<std::int32_t> heights;
};

struct BakedTile {
    BakedChunk root;
    std::vector<std::byte> blocks;  // of all descendants of the root, the root's children last
    // The largest distances of the unit's finest samples from the chunks above it, metres: by level from
    // coarsestLevelOfTiles of its root to the one above the root, but at most to two above its leaves.
    std::vector<double> offAboveM;
    int deepestUnitLevel = 0;  // of the roots of all units in it; the root's own level in a unit
};

// Memory reused between calls.
struct BakeScratch {
    SampledHeights sampled;
    std::vector<std::int32_t> steps;
    std::vector<std::int32_t> refined;
    GeometricErrorScratch geometry;
    TileDistances distances;
};

struct BakeContext {
    const HeightSource& source;
    PlanetShape shape;
    int compressionLevel = defaultCompressionLevel;
};

// Checks the settings that do not depend on a source. The Error names the setting and its range.
Result<void> checkBakeSettings(const BakeSettings& settings);

// Chooses the shape for a source and settings. The Error names the setting and its range.
Result<PlanetShape> chooseShape(const HeightSource& source, const BakeSettings& settings);

// Returns the number of threads; one per core if the setting is 0.
int bakeThreads(const BakeSettings& settings);

// Samples the square of a unit on the grid of its leaves, and bakes it bottom-up. The Error names the
// source's file, or a height that exceeds the limits of steps.
Result<BakedTile> bakeTile(const BakeContext& bake, const TreeUnit& unit, BakeScratch& scratch);

// Measures the largest distances of a unit's finest samples from the chunks above it, as BakedTile::offAboveM has them,
// and those within it, in scratch.distances. scratch.steps: the samples of its square on the grid of its leaves, whose
// positions are left in scratch.geometry.
std::vector<double> measureUnit(const PlanetShape& shape, const TreeUnit& unit, BakeScratch& scratch);

// The errors of a chunk that are known before its children are merged, metres.
struct ChunkErrors {
    std::optional<double> deltaGM;  // measured from the children's heights if it is not known
    double finestDistanceM = 0;     // from the finest samples two or more levels below it
};

// Appends the block of four children and returns their parent, made of every other row and column. Locations
// in the file count from origin, the location of the first block.
BakedChunk mergeChildren(const BakeContext& bake, const ChunkId& parent,
                         std::span<const BakedChunk, quadrantCount> children, const ChunkErrors& errors,
                         std::uint64_t origin, BakeScratch& scratch, std::vector<std::byte>& blocks);

}  // namespace planet
