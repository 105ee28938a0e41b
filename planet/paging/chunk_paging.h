// The paging of heights: the resident chunks, their page-outs, and the blocks that yield when the budget is
// full. Internal to the library; one thread.
//
// A chunk that is dropped may be in this step's draw lists, so a step drops blocks in use only before the
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

// Adds the name of the chunks' file, if any, to an Error: for chunks with matching checksums and wrong
// contents.
Error namingFile(const ChunkFile* file, Error error);

class ChunkPaging final : public BlockPaging {
public:
    // The roots are resident. capacity: slots, from chunkSlotsFor(). file: for errors; may be null.
    ChunkPaging(ChunkTree&& chunks, std::uint32_t capacity, std::shared_ptr<const ChunkFile> file);

    ChunkTree tree;

    // Keeps a page-out for each block that no view uses: least recently used first, then deepest first, so
    // that children go before their parents. A block that is used again leaves the queue.
    void markUsed(PagingQueue& queue, std::span<const Selection* const> views, PagingRun& run);
    // Returns whether wanted blocks wait while every resident block is in use.
    bool lacksRoom() const { return counters().budgetWaits > 0 && tree.residentChunks <= usedChunks_; }
    // Chooses blocks that the next step drops, because others are wanted more than yieldFactor times as much.
    // Call it if lacksRoom(). This evens out the errors of views that exceed the budget: otherwise the chunks
    // that came first would stay fine, and those that the camera has approached since would stay coarse.
    void chooseYielding(const MergedRequests& requests);
    bool isYielding() const { return !yielding_.empty(); }
    void dropYielding(PagingQueue& queue, PagingRun& run);
    // Keeps the blocks that were to yield, because the selections are made again.
    void cancelYielding();

    // Sets the number of slots. Evicts down to it and renumbers every slot.
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
    Result<void> check(NodeIndex parent, const LoadedBlock& block) const override;
    void addResident(NodeIndex parent, LoadedBlock&& block, PagingRun& run,
                     const UploadChunk& upload) override;
    void reset(PagingRun& run) override;

    void use(PagingQueue& queue, NodeIndex index, PagingRun& run);
    void evict(PagingQueue& queue, NodeIndex parent, PagingRun& run);
    bool isOver(std::size_t blocks) const;
    void evictLeastUsed(PagingQueue& queue, std::size_t blocks, std::uint64_t usedBefore, PagingRun& run);
    void forgetGone();
    void renumber(std::uint32_t capacity);

    std::shared_ptr<const ChunkFile> file_;
    std::vector<NodeIndex> watched_;  // first nodes of resident blocks that have no page-out pending
    std::vector<ChunkId> yielding_;   // parents of blocks that the next step drops before it selects
    std::size_t usedChunks_ = 0;      // visited by any view in the last step
    std::uint32_t blocksLoaded_ = 0;  // for ChunkNode::loadOrder
};

// Returns the number of slots that fit a budget: six for the roots and then whole sibling blocks, at most as
// many as the planet has chunks. The Error names the smallest budget: it allows the finest level at one
// place, even where four chunks meet.
Result<std::uint32_t> chunkSlotsFor(const PlanetShape& shape, std::size_t budgetBytes);

}  // namespace planet
