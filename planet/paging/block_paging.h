// The paging of one kind of blocks: it decides which are resident, which are requested, and which make room.
// Heights (chunk_paging.h), colours and normals (tile_paging.h) share this class; virtual functions hold the
// differences. Internal to the library; one thread.
//
// Slots of the pool come in groups of four, one group per block. Each page-in that is queued or being read
// has a group reserved, but no particular one: free_.size() >= reserved_. So a block that arrives always
// finds room.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
};

// The requests of a step, sorted by priority, highest first.
struct MergedRequests {
    std::vector<MergedRequest> wanted;  // blocks that a view lacks
    std::vector<MergedRequest> splits;  // resident blocks that a view uses
};

// The state that the paging of all kinds shares.
struct PagingRun {
    std::uint64_t frame = 0;       // of the current step; the first is 1
    double nowS = 0;               // seconds since the planet was opened, as of the current step
    double sinceAnewS = 0;         // seconds since PlanetTools::startAnew(); retries are timed by it
    std::uint64_t nextTicket = 1;  // of page-ins
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
    std::uint32_t capacity() const { return capacity_; }  // slots of the pool, the six roots' included
    bool isOn() const { return capacity_ > 0; }
    const BlockFailures& failures() const { return failures_; }
    const BlockCounters& counters() const { return counters_; }
    BlockCounters& counters() { return counters_; }

    // Gives pending page-ins of blocks that are still wanted their new priority.
    void renew(PagingQueue& queue, const std::vector<MergedRequest>& wanted, const PagingRun& run) const;
    // Queues page-ins for the wanted blocks that are not pending, while there is room.
    void request(PagingQueue& queue, const MergedRequests& requests, PagingRun& run);
    // Undoes request() for a page-in of this kind that was taken out of the queue before its read.
    void withdraw(const PagingRequest& cancelled, PagingRun& run);
    // Returns whether the read of a request of this kind will be used.
    bool isKept(const PagingRequest& request) const { return request.ticket >= oldestTicketKept_; }
    // Takes a finished read of this kind: makes its block resident, or notes the failure.
    void finish(FinishedLoad&& load, PagingRun& run, const UploadChunk& upload);

    // Withdraws the page-ins of this kind; results of reads in progress will be discarded.
    void discardRequests(PagingQueue& queue, PagingRun& run);
    // Evicts every block and discards all reads. No request of this kind may be queued.
    virtual void dropAll(PagingQueue& queue, PagingRun& run) = 0;
    // Resets to the state just after opening and forgets failures. No request may be queued, and no read in
    // progress.
    void startAnew(PagingRun& run);

    // Lets blocks that failed be requested again: all, or one.
    void retryAll();
    void retryOne(const ChunkId& parent);

    // Returns whether a block that waits for room may still get it, because another is about to make room.
    virtual bool roomIsComing() const = 0;
    // Updates the counters of the present state.
    void count();

protected:
    // Frees every slot from firstFree on; the lowest are taken first.
    void resetSlots(std::uint32_t capacity, std::uint32_t firstFree);
    void freeSlots(std::uint32_t firstSlot) { free_.push_back(firstSlot); }
    std::uint32_t takeSlots();
    std::size_t reserved() const { return reserved_; }
    // Discards the requests that are being read or have finished.
    void discardReads(const PagingRun& run);
    // Sets the state of a node that has just become resident, given the known failures of its children.
    void recallFailure(const ChunkId& id, ChildrenState& state, double sinceAnewS) const;
    void forgetRetryTime() { failures_.beginStep(); }
    void noteEviction(const PagingRequest& request, bool wasLoaded, PagingRun& run);

private:
    virtual NodeIndex find(const ChunkId& id) const = 0;  // noNode if it is not resident
    virtual std::size_t nodeCount() const = 0;            // free nodes included
    virtual std::size_t residentCount() const = 0;
    virtual ChildrenState& stateOf(NodeIndex parent) = 0;
    // Adds the fields that a loader needs to a page-in.
    virtual void describe(NodeIndex parent, PagingRequest& request) const = 0;
    // Evicts a block in favour of one that is wanted, if there is one to evict.
    virtual bool makeRoom(PagingQueue& queue, const MergedRequest& wanted,
                          const std::vector<MergedRequest>& splits, PagingRun& run) = 0;
    // Checks a block before it becomes resident.
    virtual Result<void> check(NodeIndex parent, const LoadedBlock& block) const = 0;
    virtual void addResident(NodeIndex parent, LoadedBlock&& block, PagingRun& run,
                             const UploadChunk& upload) = 0;
    virtual void beginRequests() {}  // request() begins
    // Shows a stand-in in place of a block that has failed for good. Heights and normals have none.
    virtual bool hasStandIn() const { return false; }
    virtual void addStandIn(NodeIndex, PagingRun&) {}
    virtual void dropStandIn(NodeIndex) {}
    virtual void reset(PagingRun& run) = 0;  // startAnew()'s part of it

    bool reserveRoom(PagingQueue& queue, const MergedRequest& wanted,
                     const std::vector<MergedRequest>& splits, PagingRun& run);
    void fail(NodeIndex parent, const FinishedLoad& load, Error error, PagingRun& run);
    void retry(NodeIndex parent);

    const BlockKind kind_;
    std::uint32_t capacity_ = 0;
    std::vector<std::uint32_t> free_;     // first slots of fours
    std::size_t reserved_ = 0;            // fours, for page-ins that are queued or being read
    std::uint64_t oldestTicketKept_ = 1;  // results of older reads are discarded
    BlockFailures failures_;
    BlockCounters counters_;
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
