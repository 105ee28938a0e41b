// Merges baked subtrees, from the units of a bake up to the roots of the faces.
//
// Subtrees come in quadtree order, and four siblings are merged as soon as they are complete. So the blocks under a
// chunk lie together in the file: those of its four children one after the other, then the block of the four. Blocks name
// each other by distance, so a subtree can be merged before its location in the file is known.
//
// The tight metric of a chunk above its units needs the distances of all finest samples under it. Units measure them for
// the chunks whose cells are no wider than a unit (coarsestLevelOfTiles). Those above are searched for in the finished
// file (finest_distance.h). They and their siblings are held back until then, and so are the chunks above them.
//
// No locks: each object has one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "planet/bake/bake_tile.h"
#include "planet/base/result.h"

namespace planet {

// A chunk whose whole subtree is baked, and what the chunks above it need to know.
struct Subtree {
    BakedChunk
        root;  // its location in the file counts as if the subtree's first block were at provisionalOrigin
    std::uint64_t bytes = 0;   // of all blocks under the root
    int deepestUnitLevel = 0;  // of the roots of all units in it
    // The largest distances of its finest samples from the chunks above it, metres: by level from
    // coarsestLevelOfTiles(deepestUnitLevel). Those that are missing at the end are 0.
    std::vector<double> offAboveM;
    // The tiles that it was merged from, as the caller counts them.
    std::uint64_t firstTile = 0;
    std::uint64_t lastTile = 0;
    bool isUnknown = false;              // the tight metric of the root has to be searched for
    std::optional<float> deltaTightM{};  // of the root, if it is known from an earlier bake
    bool isLater = false;                // only the id of the root is known: chunks under it are held back
};

// Returns the subtree of a baked tile, without its blocks.
Subtree subtreeOf(BakedTile&& tile, std::uint64_t number);

// Takes merged subtrees.
class SubtreeSink {
public:
    // Takes the block of the children of a merged subtree, which follows the blocks under them in the file.
    virtual Result<void> takeBlock(const Subtree& parent, std::span<const std::byte> block) = 0;
    // Takes a subtree that is held back.
    virtual void hold(Subtree&& subtree) = 0;

protected:
    ~SubtreeSink() = default;
};

// The subtrees that wait for their siblings: at most three a level, if they come in quadtree order without gaps.
class SubtreeStack {
public:
    // bake, sink: must outlive the stack.
    SubtreeStack(const BakeContext& bake, SubtreeSink& sink) : bake_(bake), sink_(sink) {}

    // Says what the tight metric of a chunk above the next subtree is.
    void know(const ChunkId& id, float deltaTightM) { known_[id] = deltaTightM; }
    // Returns the tight metric of a chunk that is known.
    std::optional<float> known(const ChunkId& id) const;

    Result<void> push(Subtree&& subtree);

    const std::vector<Subtree>& waiting() const { return waiting_; }
    std::vector<Subtree> takeWaiting() { return std::move(waiting_); }

private:
    bool endsWithSiblings() const;
    Result<Subtree> merge(std::span<Subtree, quadrantCount> children);
    Subtree holdBack(std::span<Subtree, quadrantCount> children);

    const BakeContext& bake_;
    SubtreeSink& sink_;
    std::vector<Subtree> waiting_;
    std::unordered_map<ChunkId, float> known_;
    BakeScratch scratch_;
};

// A chunk that was held back. Its blocks are in the file: its location counts from the beginning of the file.
struct DeferredChunk {
    BakedChunk baked;
    bool isUnknown = false;
    std::optional<float> deltaTightM{};
};

// Returns a subtree's root, of which the first block lies at an offset in the file.
DeferredChunk deferredChunk(Subtree&& subtree, std::uint64_t offset);

// Sorts by quadtree order, for chunks of one level.
void sortInQuadtreeOrder(std::vector<DeferredChunk>& chunks);

// Raises the tight metrics of those chunks that need it to their distance from the finest samples. readChildren: of the
// unfinished file; any thread. Calls goOn before each block is read, from one thread at a time.
Result<void> searchTightMetrics(const BakeContext& bake, std::span<DeferredChunk> chunks, int threads,
                                const ReadChildren& readChildren, const std::function<bool()>& goOn);

// Returns the parent of four siblings, whose tight metric has to be searched for, and their block for a location.
struct DeferredParent {
    BakedChunk parent;
    std::vector<std::byte> block;
};
DeferredParent mergeDeferred(const BakeContext& bake, std::span<DeferredChunk, quadrantCount> children,
                             std::uint64_t offset, BakeScratch& scratch);

}  // namespace planet
