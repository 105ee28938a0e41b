// The paging of tiles of colours or of normals. Internal to the library; one thread.
//
// A tile that is dropped is no longer drawn in the very step that drops it, since the renderer looks its
// tiles up in every frame. So blocks are dropped at once where others are wanted, without page-outs.
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
    // Off, until begin().
    explicit TilePaging(BlockKind kind) : BlockPaging(kind) {}

    int leafLevel = -1;  // of the pyramid; -1: the planet has none
    // Set for colours: a block that has failed for good is resident as a checker pattern of this format.
    // Blocks of normals that fail have no stand-in.
    std::optional<ColourFormat> checkers;
    // The tiles of whole faces, kept so that they can be shown again. One without texels could not be read
    // or derived.
    std::array<TileData, faceCount> roots;
    TileTree tree;                    // empty if the kind is off
    std::vector<TileChange> changes;  // for Planet::takeTileChanges()

    // Evicts every block and begins with the roots alone, in a pool of so many slots; with nothing if the
    // capacity is 0. Keeps failures. To be called with no request pending.
    void begin(std::uint32_t capacity, double sinceAnewS);

    // Marks what views have looked at in a frame.
    void use(const std::vector<NodeIndex>& touched, std::uint64_t frame);

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
    Result<void> check(NodeIndex, const LoadedBlock&) const override { return {}; }
    void addResident(NodeIndex parent, LoadedBlock&& block, PagingRun& run,
                     const UploadChunk& upload) override;
    void beginRequests() override { roomIsComing_ = false; }
    bool hasStandIn() const override { return checkers.has_value(); }
    void addStandIn(NodeIndex parent, PagingRun& run) override;
    void dropStandIn(NodeIndex parent) override;
    void reset(PagingRun& run) override { begin(capacity(), run.sinceAnewS); }

    bool evictUnused(PagingRun& run);
    bool evictLessWanted(const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                         PagingRun& run);
    bool mayBeEvicted(NodeIndex parent) const;
    void evict(NodeIndex parent, PagingRun& run);
    void remove(NodeIndex parent);
    void addTilesUnder(NodeIndex parent, TileBlock&& tiles, const PagingRun& run);

    // In the last step something waited for a block that has not been out of use for long enough yet.
    bool roomIsComing_ = false;
};

// The tiles that a share of a budget pays for: the roots' six and then whole blocks, no more than there are
// or than `most`. The Error says what the least is: enough that the finest level can be reached in one place.
struct TilePyramid {
    const char* name = "";  // "colour tiles"
    int leafLevel = 0;
    std::size_t tileBytes = 0;
};
Result<std::uint32_t> tileSlotsFor(const TilePyramid& pyramid, std::size_t budgetBytes, std::uint32_t most);

}  // namespace planet
