// The paging of heights: the resident chunks, their page-outs, and the blocks that yield when the budget is
// full. Internal to the library; one thread.
//
// A chunk that is dropped may be in this step's draw lists, so during a step blocks in use are dropped only
// before the selection (dropYielding). After resize and dropAll the views must be selected again.
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

// The Error with the name of the file that the chunks come from, if any: for chunks whose checksums match but
// whose contents are wrong.
Error namingFile(const ChunkFile* file, Error error);

class ChunkPaging final : public BlockPaging {
public:
    // The roots are resident. capacity: slots, from chunkSlotsFor(). file: for errors; may be null.
    ChunkPaging(ChunkTree&& chunks, std::uint32_t capacity, std::shared_ptr<const ChunkFile> file);

    ChunkTree tree;

    // Keeps as page-outs the blocks that no view uses. Least recently used first; of those the deepest first,
    // so that children go before their parents. A block that is used again leaves the queue.
    void markUsed(PagingQueue& queue, std::span<const Selection* const> views, PagingRun& run);
    // Whether blocks that are wanted have to wait, and no block is out of use.
    bool lacksRoom() const { return counters().budgetWaits > 0 && tree.residentChunks <= usedChunks_; }
    // Chooses blocks that the next step drops, since others are wanted yieldFactor times as much. Call it if
    // room is lacking. This evens out the errors of views that the budget cannot pay for: without it, chunks
    // that came first would stay fine, and those that the camera has approached since would stay coarse.
    void chooseYielding(const MergedRequests& requests);
    bool isYielding() const { return !yielding_.empty(); }
    void dropYielding(PagingQueue& queue, PagingRun& run);
    // No block yields any more, since the selections are made again.
    void cancelYielding();

    // Another number of slots. Evicts down to it and renumbers every slot.
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

// The slots that a budget pays for: the roots' six and then whole sibling blocks, and no more than the planet
// has chunks. The Error says what the least is: enough that the finest level can be reached in one place,
// even where four chunks meet.
Result<std::uint32_t> chunkSlotsFor(const PlanetShape& shape, std::size_t budgetBytes);

}  // namespace planet
