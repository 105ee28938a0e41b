// The paging of tiles of colours or of normals. Internal to the library; one thread.
//
// The renderer looks up its tiles in every frame, so a step stops drawing a tile as soon as it drops it. So
// blocks are dropped at once when others need room, without page-outs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planet/paging/block_paging.h"
#include "planet/tree/tile_tree.h"

namespace planet {

class TilePaging final : public BlockPaging {
public:
    // Paging is off until begin().
    explicit TilePaging(BlockKind kind) : BlockPaging(kind) {}

    int leafLevel = -1;     // of the pyramid; -1: the planet has none
    bool unpacked = false;  // of colours: as BlockCounters::unpacked
    // Set for colours: a block that has failed for good is replaced by a checker pattern of this format.
    // Failed blocks of normals have no stand-in.
    std::optional<ColourFormat> checkers;
    // The tiles of whole faces, kept to show them again. A tile without texels could not be read or derived.
    std::array<TileData, faceCount> roots;
    TileTree tree;                    // empty if the kind is off
    std::vector<TileChange> changes;  // for Planet::takeTileChanges()

    // Evicts every block and begins with only the roots, in a pool of `capacity` slots; 0 turns paging off.
    // Keeps failures. No request may be pending.
    void begin(std::uint32_t capacity, double sinceResetS);

    // Marks the tiles that a view used in a frame.
    void use(const std::vector<NodeIndex>& touched, std::uint64_t frame);
    // Lets the tiles that views are predicted to use be evicted last among those that no view uses.
    void markPredicted(const std::vector<NodeIndex>& predicted, const PagingRun& run);

    void dropAll(PagingQueue& queue, PagingRun& run) override;
    bool roomIsComing() const override { return roomIsComing_; }

private:
    NodeIndex find(const ChunkId& id) const override { return findTile(tree, id); }
    std::size_t nodeCount() const override { return tree.nodes.size(); }
    std::size_t residentCount() const override { return tree.residentTiles; }
    ChildrenState& stateOf(NodeIndex parent) override { return tree.nodes[parent].childrenState; }
    void describe(NodeIndex parent, PagingRequest& request) const override;
    bool makeRoom(PagingQueue& queue, const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                  PagingRun& run) override;
    bool makeRoomForPrefetch(PagingQueue& queue, PagingRun& run) override;
    Result<void> check(NodeIndex, const LoadedBlock&) const override { return {}; }
    void addResident(NodeIndex parent, LoadedBlock&& block, std::uint64_t lastUsedFrame, PagingRun& run,
                     const UploadChunk& upload) override;
    void beginRequests() override { roomIsComing_ = false; }
    bool hasStandIn() const override { return checkers.has_value(); }
    void addStandIn(NodeIndex parent, PagingRun& run) override;
    void dropStandIn(NodeIndex parent) override;
    void resetBlocks(PagingRun& run) override { begin(capacity(), run.sinceResetS); }

    struct Unused {
        NodeIndex oldest = noNode;  // parent of the least recently used block
        bool hasRecent = false;     // a block may be evicted once it is out of use for longer
    };
    Unused findUnused(std::uint64_t usedBefore, const PagingRun& run) const;
    bool evictUnused(PagingRun& run);
    bool evictLessWanted(const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                         PagingRun& run);
    bool mayBeEvicted(NodeIndex parent) const;
    void evict(NodeIndex parent, PagingRun& run);
    void remove(NodeIndex parent);
    void addTilesUnder(NodeIndex parent, TileBlock&& tiles, std::uint64_t lastUsedFrame,
                       const PagingRun& run);

    // A request of the last step waits for a block to be out of use for long enough.
    bool roomIsComing_ = false;
};

// Returns the number of tiles that fit a share of the budget: six roots and the rest in whole blocks, at most
// as many as there are, and at most `most`. The Error names the smallest number: it allows the finest level
// at one place.
struct TilePyramid {
    const char* name = "";  // "colour tiles"
    int leafLevel = 0;
    std::size_t tileBytes = 0;
};
Result<std::uint32_t> tileSlotsFor(const TilePyramid& pyramid, std::size_t budgetBytes, std::uint32_t most);

}  // namespace planet
