// The paging of one kind of blocks: decides which blocks are resident, which are requested, and which are
// evicted for others. The classes for heights (chunk_paging.h), colours and normals (tile_paging.h) derive
// from it. Internal to the library; one thread.
//
// Slots of the pool come in groups of four, one group per block. Each page-in that is queued or being read
// reserves a group, but no particular one: free_.size() >= reserved_. So a loaded block always finds room.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "planet/base/result.h"
#include "planet/paging/block_failures.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_log.h"
#include "planet/paging/paging_queue.h"
#include "planet/paging/paging_types.h"
#include "planet/tree/block_state.h"
#include "planet/tree/node_index.h"

namespace planet {

// A request for a block, or a split, merged over all views.
struct MergedRequest {
    NodeIndex parent = noNode;
    ChunkId parentId;
    float priority = 0;  // the largest of viewPriority
    std::array<float, maxViews> viewPriority{};
    PagingUrgency urgency = PagingUrgency::Lasting;
};

// The requests of a step, sorted by priority, highest first.
struct MergedRequests {
    std::vector<MergedRequest> wanted;  // blocks that a view lacks
    std::vector<MergedRequest> splits;  // resident blocks that a view uses
};

// State that is shared by the paging of all kinds.
struct PagingRun {
    std::uint64_t frame = 0;       // of the current step; the first is 1
    double nowS = 0;               // seconds since the planet was opened, as of the current step
    double sinceResetS = 0;        // seconds since PlanetTools::reset(), the time of retries
    std::uint64_t nextTicket = 1;  // of the next page-in
    RetryRules retry{};
    PagingLog log{};
};

class BlockPaging {
public:
    explicit BlockPaging(BlockKind kind) : kind_(kind) {}
    virtual ~BlockPaging() = default;
    BlockPaging(const BlockPaging&) = delete;
    BlockPaging& operator=(const BlockPaging&) = delete;

    BlockKind kind() const { return kind_; }
    std::uint32_t capacity() const { return capacity_; }  // slots of the pool, including the six roots
    bool isOn() const { return capacity_ > 0; }
    const BlockFailures& failures() const { return failures_; }
    const BlockCounters& counters() const { return counters_; }
    BlockCounters& counters() { return counters_; }

    // Updates the priorities of pending page-ins of blocks that are still wanted.
    void renew(PagingQueue& queue, const std::vector<MergedRequest>& wanted, const PagingRun& run) const;
    // Queues page-ins for the wanted blocks that are not pending, as far as there is room.
    void request(PagingQueue& queue, const MergedRequests& requests, PagingRun& run);
    // Keeps pending page-ins of blocks that are only predicted to be wanted, as prefetches. Call it after
    // renew().
    void renewPrefetches(PagingQueue& queue, const std::vector<MergedRequest>& predicted,
                         const PagingRun& run);
    // Queues prefetches for predicted blocks, as far as there is room without the blocks that a view or the
    // prediction uses. Call it after request().
    void prefetch(PagingQueue& queue, const std::vector<MergedRequest>& predicted, PagingRun& run);
    // Returns the number of prefetches that are queued or being read, and that no view has wanted since.
    std::size_t pendingPrefetches() const { return pendingPrefetches_.size(); }
    // Reverts request() or prefetch() for a page-in of this kind that was removed from the queue before its read.
    void withdraw(const PagingRequest& cancelled, PagingRun& run);
    // Returns whether the read of a request of this kind will be used.
    bool isKept(const PagingRequest& request) const { return request.ticket >= oldestTicketKept_; }
    // Handles a finished read of this kind: makes its block resident, or records the failure.
    void finish(FinishedLoad&& load, PagingRun& run, const UploadChunk& upload);

    // Withdraws the page-ins of this kind; results of reads in progress will be discarded.
    void discardRequests(PagingQueue& queue, PagingRun& run);
    // Evicts every block and discards all reads. No request of this kind may be queued.
    virtual void dropAll(PagingQueue& queue, PagingRun& run) = 0;
    // Resets to the state after opening and forgets failures. No request may be queued, and no read in
    // progress.
    void reset(PagingRun& run);

    // Allow failed blocks to be requested again: all, or one.
    void retryAll();
    void retryOne(const ChunkId& parent);

    // Returns whether a block that waits for room may still get it, because another one will be evicted.
    virtual bool roomIsComing() const = 0;
    // Updates the counters of the current state.
    void count();

protected:
    // Frees every slot from firstFree on. The lowest slots are used first.
    void resetSlots(std::uint32_t capacity, std::uint32_t firstFree);
    void freeSlots(std::uint32_t firstSlot) { free_.push_back(firstSlot); }
    std::uint32_t takeSlots();
    std::size_t reserved() const { return reserved_; }
    // Discards the requests that are being read or have finished.
    void discardReads(const PagingRun& run);
    // Sets the children's state of a node that has just become resident from their known failures.
    void recallFailure(const ChunkId& id, ChildrenState& state, double sinceResetS) const;
    void forgetRetryTime() { failures_.beginStep(); }
    void noteEviction(const PagingRequest& request, bool wasLoaded, PagingRun& run);
    // Notes that a view uses the children of a node, for the counters of prefetches.
    void noteUse(const ChunkId& parent);
    // Counts all prefetched blocks that no view has wanted as wasted, because they are dropped without
    // noteEviction().
    void wastePrefetches();
    // Returns the frame of last use for a block that is only predicted to be used: views may take its room at
    // once, but every block of earlier frames goes first.
    static std::uint64_t predictedUse(const PagingRun& run) {
        return run.frame > framesKept + 1 ? run.frame - framesKept - 1 : 0;
    }
    // Returns the earliest frame of last use that a block has while it is predicted to be used. It is renewed
    // only when it gets older, because that moves a page-out in the queue.
    static std::uint64_t oldestPredictedUse(const PagingRun& run) {
        constexpr std::uint64_t frames = 16;
        return predictedUse(run) > frames ? predictedUse(run) - frames : 0;
    }

private:
    virtual NodeIndex find(const ChunkId& id) const = 0;  // noNode if it is not resident
    virtual std::size_t nodeCount() const = 0;            // including free nodes
    virtual std::size_t residentCount() const = 0;
    virtual ChildrenState& stateOf(NodeIndex parent) = 0;
    // Fills in the fields of a page-in that a loader needs.
    virtual void describe(NodeIndex parent, PagingRequest& request) const = 0;
    // Evicts a block in favour of a wanted one. Returns false if none may be evicted.
    virtual bool makeRoom(PagingQueue& queue, const MergedRequest& wanted,
                          const std::vector<MergedRequest>& splits, PagingRun& run) = 0;
    // Evicts a block in favour of a prefetch. Returns false if only blocks are left that are in use or predicted
    // to be.
    virtual bool makeRoomForPrefetch(PagingQueue& queue, PagingRun& run) = 0;
    // Checks a block before it becomes resident.
    virtual Result<void> check(NodeIndex parent, const LoadedBlock& block) const = 0;
    virtual void addResident(NodeIndex parent, LoadedBlock&& block, std::uint64_t lastUsedFrame,
                             PagingRun& run, const UploadChunk& upload) = 0;
    virtual void beginRequests() {}  // called at the beginning of request()
    // Shows a stand-in for a block that has failed for good. Heights and normals have none.
    virtual bool hasStandIn() const { return false; }
    virtual void addStandIn(NodeIndex, PagingRun&) {}
    virtual void dropStandIn(NodeIndex) {}
    virtual void resetBlocks(PagingRun& run) = 0;  // this kind's part of reset()

    void queuePageIn(PagingQueue& queue, const MergedRequest& one, PagingUrgency urgency, PagingRun& run);
    void dropUnused(const ChunkId& parent);
    bool reserveRoom(PagingQueue& queue, const MergedRequest& wanted,
                     const std::vector<MergedRequest>& splits, PagingRun& run);
    void fail(NodeIndex parent, const FinishedLoad& load, Error error, PagingRun& run);
    void retry(NodeIndex parent);

    const BlockKind kind_;
    std::uint32_t capacity_ = 0;
    std::vector<std::uint32_t> free_;     // first slots of groups
    std::size_t reserved_ = 0;            // groups reserved for page-ins that are queued or being read
    std::uint64_t oldestTicketKept_ = 1;  // results of older reads are discarded
    BlockFailures failures_;
    BlockCounters counters_;
    std::unordered_set<ChunkId> pendingPrefetches_;
    std::unordered_map<ChunkId, std::uint32_t> unusedPrefetches_;  // resident; their bytes
};

// Returns whether no node of a group of four has children that are resident or requested.
template <class Tree>
bool isBottom(const Tree& tree, NodeIndex firstChild) {
    for (NodeIndex child = firstChild; child < firstChild + quadrantCount; ++child) {
        const ChildrenState below = tree.nodes[child].childrenState;
        if (below == ChildrenState::Resident || below == ChildrenState::Requested) return false;
    }
    return true;
}

}  // namespace planet
