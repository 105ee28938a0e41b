// The paging of heights: the resident chunks, their page-outs, and the blocks that are dropped for more
// urgent ones when the budget is exhausted. Internal to the library; one thread.
//
// A chunk may be in this step's draw lists when it is dropped, so a step drops blocks in use only before the
// selection (dropYielding). Select the views again after resize and dropAll.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "planet/format/chunk_file.h"
#include "planet/paging/block_paging.h"
#include "planet/select/lod_types.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Adds the name of the chunks' file, if any, to an Error. Used for chunks with matching checksums and invalid
// contents.
Error namingFile(const ChunkFile* file, Error error);

class ChunkPaging final : public BlockPaging {
public:
    // chunks: with resident roots. capacity: slots, from chunkSlotsFor(). file: for errors; may be null.
    ChunkPaging(ChunkTree&& chunks, std::uint32_t capacity, std::shared_ptr<const ChunkFile> file);

    ChunkTree tree;

    // Queues a page-out for each block that no view uses, least recently used first, then deepest first, so
    // that children precede their parents. A block that is used again leaves the queue.
    void markUsed(PagingQueue& queue, std::span<const Selection* const> views, PagingRun& run);
    // Lets the blocks that views are predicted to use be evicted last among those that no view uses. Call it
    // after markUsed().
    void markPredicted(PagingQueue& queue, std::span<const NodeIndex> predicted, const PagingRun& run);
    // Returns whether wanted blocks wait although every resident block is in use.
    bool lacksRoom() const { return counters().budgetWaits > 0 && tree.residentChunks <= usedChunks_; }
    // Chooses blocks for the next step to drop, because others have more than yieldFactor times their
    // priority. Call it if lacksRoom(). This evens out the errors of views that exceed the budget. Without
    // it, the chunks that came first would stay fine, and those that the camera has approached since would
    // stay coarse.
    void chooseYielding(const MergedRequests& requests);
    bool isYielding() const { return !yielding_.empty(); }
    void dropYielding(PagingQueue& queue, PagingRun& run);
    // Cancels chooseYielding(), because the selections are made again.
    void cancelYielding();

    // Sets the number of slots, evicts down to it and renumbers every slot.
    void resize(PagingQueue& queue, std::uint32_t capacity, PagingRun& run);
    void dropAll(PagingQueue& queue, PagingRun& run) override;
    bool roomIsComing() const override;

private:
    NodeIndex find(const ChunkId& id) const override { return findNode(tree, id); }
    std::size_t nodeCount() const override { return tree.nodes.size(); }
    std::size_t residentCount() const override { return tree.residentChunks; }
    ChildrenState& stateOf(NodeIndex parent) override { return tree.nodes[parent].childrenState; }
    void describe(NodeIndex parent, PagingRequest& request) const override;
    bool makeRoom(PagingQueue& queue, const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                  PagingRun& run) override;
    bool makeRoomForPrefetch(PagingQueue& queue, PagingRun& run) override;
    Result<void> check(NodeIndex parent, const LoadedBlock& block) const override;
    void addResident(NodeIndex parent, LoadedBlock&& block, std::uint64_t lastUsedFrame, PagingRun& run,
                     const UploadChunk& upload) override;
    void resetBlocks(PagingRun& run) override;

    void use(PagingQueue& queue, NodeIndex index, PagingRun& run);
    void queuePageOut(PagingQueue& queue, const ChunkNode& first, const PagingRun& run) const;
    bool evictUsedBefore(PagingQueue& queue, std::uint64_t frame, PagingRun& run);
    void evict(PagingQueue& queue, NodeIndex parent, PagingRun& run);
    bool isOver(std::size_t blocks) const;
    void evictLeastUsed(PagingQueue& queue, std::size_t blocks, std::uint64_t usedBefore, PagingRun& run);
    void forgetGone();
    void renumber(std::uint32_t capacity);

    std::shared_ptr<const ChunkFile> file_;
    std::vector<NodeIndex> watched_;  // first nodes of resident blocks without a pending page-out
    std::vector<ChunkId> yielding_;   // parents of blocks that the next step drops before it selects
    std::size_t usedChunks_ = 0;      // visited by any view in the last step
    std::uint32_t blocksLoaded_ = 0;  // for ChunkNode::loadOrder
};

// Returns the number of slots that fit a budget: six for the roots and the rest in whole blocks, at most as
// many as the planet has chunks, allChunks. The Error names the smallest budget: it allows the finest level
// at one place, even where four chunks meet.
Result<std::uint32_t> chunkSlotsFor(const PlanetShape& shape, std::uint64_t allChunks,
                                    std::size_t budgetBytes);

}  // namespace planet
