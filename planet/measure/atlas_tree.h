// Records the chunks of a planet in an atlas, so that every chunk that a later bake changes is found, whether a viewpoint
// sees it or not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "planet/base/result.h"
#include "planet/measure/atlas.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

struct PlanetSource;

// Chunks below this level are summarised in the digest of their ancestor of this level.
inline constexpr int deepestAtlasTreeLevel = 8;

// Reads all chunks of a planet, on all cores. goOn is called often, from any thread; if it returns false, the result is an
// Error of kind Cancelled. Other Errors name the file and the chunk that could not be read.
Result<AtlasTree> atlasTreeOf(const PlanetSource& source, const std::function<bool()>& goOn);

// Calls visit for each chunk with its id, in their order. Returns false if the list is not that of six quadtrees.
bool forEachChunk(const AtlasTree& tree,
                  const std::function<void(const ChunkId& id, const AtlasChunk& chunk)>& visit);

enum class AtlasChange : std::uint8_t {
    Error,    // another δc
    Heights,  // the same δc, but other heights, extremes or tight metric
    Below,    // something in the chunks below it that are not listed
    Added,
    Removed
};
inline constexpr std::size_t atlasChangeCount = 5;
inline constexpr std::array<const char*, atlasChangeCount> atlasChangeNames = {"error", "heights", "below",
                                                                               "added", "removed"};

struct AtlasChunkChange {
    ChunkId chunk;
    AtlasChange change = AtlasChange::Error;
    float oldDeltaCM = 0;  // 0 for an added one
    float newDeltaCM = 0;  // 0 for a removed one
};

// The changes between two trees, in the order of the chunks; each chunk has one, and the first that applies.
std::vector<AtlasChunkChange> changesBetween(const AtlasTree& old, const AtlasTree& now);

// Changes that lie together: all those at and below one cell of a level.
struct AtlasChangedArea {
    ChunkId cell;  // of the level, or a coarser chunk
    std::array<std::uint64_t, atlasChangeCount> chunks{};
    double leastRatio = 1;  // of new to old δc, over the chunks with another δc
    double mostRatio = 1;

    std::uint64_t sum() const;
};
// Returns the areas, those with the most changed chunks first. A chunk above the level is an area of its own if it was
// added or removed, or if no chunk below it has changed, as with the leaves of a planet or place that ends above the level.
std::vector<AtlasChangedArea> changedAreas(const std::vector<AtlasChunkChange>& changes, int level);

}  // namespace planet
