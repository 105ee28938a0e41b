#include "planet/paging/block_paging.h"

#include <cassert>
#include <utility>

namespace planet {

namespace {

// Bounds the cost of a step, and the blocks that are requested too early. Loaders never wait for a step with so
// many in the queue.
constexpr std::size_t mostPrefetches = 64;

}  // namespace

void BlockPaging::renew(PagingQueue& queue, const std::vector<MergedRequest>& wanted,
                        const PagingRun& run) const {
    for (const MergedRequest& one : wanted) {
        if (!queue.find({one.parentId, kind_})) continue;
        queue.submit({.parent = one.parentId,
                      .kind = kind_,
                      .urgency = one.urgency,
                      .priority = one.priority,
                      .renewedFrame = run.frame,
                      .viewPriority = one.viewPriority});
    }
}

void BlockPaging::renewPrefetches(PagingQueue& queue, const std::vector<MergedRequest>& predicted,
                                  const PagingRun& run) {
    for (const MergedRequest& one : predicted) {
        const PagingRequest* pending = queue.find({one.parentId, kind_});
        if (!pending || pending->renewedFrame == run.frame) continue;  // a view wants it
        queue.submit({.parent = one.parentId,
                      .kind = kind_,
                      .urgency = PagingUrgency::Prefetch,
                      .priority = one.priority,
                      .renewedFrame = run.frame});
        pendingPrefetches_.insert(one.parentId);
    }
}

void BlockPaging::request(PagingQueue& queue, const MergedRequests& requests, PagingRun& run) {
    counters_.budgetWaits = 0;
    failures_.beginStep();
    beginRequests();
    for (const MergedRequest& one : requests.wanted) {
        if (!pendingPrefetches_.empty()) pendingPrefetches_.erase(one.parentId);
        if (!failures_.mayAsk(one.parentId, stateOf(one.parent), run.sinceResetS)) continue;
        if (!reserveRoom(queue, one, requests.splits, run)) {
            ++counters_.budgetWaits;
            continue;
        }
        changeState(stateOf(one.parent), ChildrenState::Requested);
        if (failures_.isPermanent(one.parentId)) {
            --reserved_;
            addStandIn(one.parent, run);
            continue;
        }
        queuePageIn(queue, one, one.urgency, run);
    }
}

void BlockPaging::queuePageIn(PagingQueue& queue, const MergedRequest& one, PagingUrgency urgency,
                              PagingRun& run) {
    PagingRequest request{.parent = one.parentId,
                          .kind = kind_,
                          .urgency = urgency,
                          .priority = one.priority,
                          .renewedFrame = run.frame,
                          .askedAtS = run.nowS,
                          .viewPriority = one.viewPriority,
                          .ticket = run.nextTicket++};
    describe(one.parent, request);
    if (run.log.keepsMoves) run.log.moves.requested.push_back(request.block());
    queue.submit(std::move(request));
}

void BlockPaging::prefetch(PagingQueue& queue, const std::vector<MergedRequest>& predicted, PagingRun& run) {
    for (const MergedRequest& one : predicted) {
        if (pendingPrefetches_.size() >= mostPrefetches) return;
        // A failed block waits until a view wants it.
        if (stateOf(one.parent) != ChildrenState::Absent || failures_.isPermanent(one.parentId)) continue;
        if (free_.size() <= reserved_ && !makeRoomForPrefetch(queue, run)) return;
        ++reserved_;
        changeState(stateOf(one.parent), ChildrenState::Requested);
        pendingPrefetches_.insert(one.parentId);
        queuePageIn(queue, one, PagingUrgency::Prefetch, run);
    }
}

// Reserves free slots first, then those of a queued prefetch, then those of a block that may be evicted, then
// those of a less urgent page-in.
bool BlockPaging::reserveRoom(PagingQueue& queue, const MergedRequest& wanted,
                              const std::vector<MergedRequest>& splits, PagingRun& run) {
    if (free_.size() <= reserved_) {
        const PagingRequest* least = queue.worst(PagingType::PageIn, kind_);
        const bool yieldsPrefetch = least && least->isPrefetch();
        if (yieldsPrefetch || !makeRoom(queue, wanted, splits, run)) {
            if (!least || !isMoreUrgent(wanted.urgency, wanted.priority, least->urgency, least->priority))
                return false;
            withdraw(*queue.cancel(least->block()), run);
        }
    }
    ++reserved_;
    return true;
}

void BlockPaging::withdraw(const PagingRequest& cancelled, PagingRun& run) {
    const NodeIndex parent = find(cancelled.parent);
    assert(parent != noNode && reserved_ > 0);
    changeState(stateOf(parent), ChildrenState::Absent);
    --reserved_;
    pendingPrefetches_.erase(cancelled.parent);
    run.log.ended(cancelled, PagingOutcome::Cancelled, run.nowS);
}

void BlockPaging::finish(FinishedLoad&& load, PagingRun& run, const UploadChunk& upload) {
    counters_.bytesRead += load.bytes;
    if (load.request.isPrefetch()) counters_.prefetch.bytes += load.bytes;
    if (!isKept(load.request)) {
        if (load.request.isPrefetch()) counters_.prefetch.wastedBytes += load.bytes;
        return run.log.arrived(load, PagingOutcome::Cancelled, run.nowS);
    }
    // The parent is still resident, because dropping it would have discarded the load.
    const NodeIndex parent = find(load.request.parent);
    assert(parent != noNode && stateOf(parent) == ChildrenState::Requested && reserved_ > 0);
    --reserved_;
    const bool isUnwanted = pendingPrefetches_.erase(load.request.parent) > 0;
    if (!load.block) return fail(parent, load, std::move(load.block.error()), run);
    if (auto checked = check(parent, *load.block); !checked)
        return fail(parent, load, std::move(checked.error()), run);
    failures_.forget(load.request.parent);
    // A wanted block counts as used by the frame that requested it, in case this frame no longer uses it.
    addResident(parent, *std::move(load.block), isUnwanted ? predictedUse(run) : run.frame - 1, run, upload);
    ++counters_.loaded;
    if (load.request.isPrefetch()) {
        ++counters_.prefetch.blocks;
        unusedPrefetches_[load.request.parent] = load.bytes;
    }
    run.log.arrived(load, PagingOutcome::Loaded, run.nowS);
}

// Handles a failed read. Reports the block only if it will not be retried.
void BlockPaging::fail(NodeIndex parent, const FinishedLoad& load, Error error, PagingRun& run) {
    ++counters_.failed;
    const bool badData = error.kind == ErrorKind::BadInput;
    const bool permanent =
        failures_.failed(load.request.parent, std::move(error), run.sinceResetS, run.retry);
    if (permanent && hasStandIn())
        addStandIn(parent, run);
    else
        changeState(stateOf(parent), permanent ? ChildrenState::Failed : ChildrenState::AwaitingRetry);
    if (permanent) run.log.report(failures_.messageOf(load.request.parent));
    run.log.arrived(load, PagingOutcome::Failed, run.nowS, badData);
}

void BlockPaging::discardRequests(PagingQueue& queue, PagingRun& run) {
    while (const PagingRequest* pending = queue.worst(PagingType::PageIn, kind_))
        withdraw(*queue.cancel(pending->block()), run);
    discardReads(run);
}

void BlockPaging::discardReads(const PagingRun& run) {
    for (NodeIndex i = 0; i < nodeCount(); ++i) {
        if (stateOf(i) == ChildrenState::Requested) changeState(stateOf(i), ChildrenState::Absent);
    }
    oldestTicketKept_ = run.nextTicket;
    reserved_ = 0;
    pendingPrefetches_.clear();
}

void BlockPaging::reset(PagingRun& run) {
    failures_.clear();
    reserved_ = 0;
    pendingPrefetches_.clear();
    wastePrefetches();
    if (isOn()) resetBlocks(run);
    oldestTicketKept_ = run.nextTicket;
    counters_.budgetWaits = 0;
}

void BlockPaging::retry(NodeIndex parent) {
    dropStandIn(parent);
    ChildrenState& state = stateOf(parent);
    if (state == ChildrenState::Failed || state == ChildrenState::AwaitingRetry)
        changeState(state, ChildrenState::Absent);
}

void BlockPaging::retryAll() {
    failures_.clear();
    for (NodeIndex i = 0; i < nodeCount(); ++i) retry(i);
}

void BlockPaging::retryOne(const ChunkId& parent) {
    failures_.forget(parent);
    if (!isOn()) return;
    if (const NodeIndex node = find(parent); node != noNode) retry(node);
}

void BlockPaging::count() {
    counters_.failedPermanently = static_cast<std::uint32_t>(failures_.countPermanent());
    counters_.awaitingRetry = static_cast<std::uint32_t>(failures_.count() - failures_.countPermanent());
    counters_.resident = residentCount();
    counters_.capacity = capacity_;
    counters_.prefetch.pending = static_cast<std::uint32_t>(pendingPrefetches_.size());
}

void BlockPaging::resetSlots(std::uint32_t capacity, std::uint32_t firstFree) {
    capacity_ = capacity;
    free_.clear();
    for (std::uint32_t end = capacity; end > firstFree; end -= quadrantCount)
        free_.push_back(end - quadrantCount);
    assert(free_.size() >= reserved_);
}

std::uint32_t BlockPaging::takeSlots() {
    assert(!free_.empty());
    const std::uint32_t first = free_.back();
    free_.pop_back();
    return first;
}

void BlockPaging::recallFailure(const ChunkId& id, ChildrenState& state, double sinceResetS) const {
    if (state != ChildrenState::Absent) return;
    const ChildrenState known = failures_.stateAt(id, sinceResetS);
    // Blocks with a stand-in are requested again, so that the stand-in appears once there is room.
    if (known == ChildrenState::AwaitingRetry || (known == ChildrenState::Failed && !hasStandIn()))
        changeState(state, known);
}

void BlockPaging::noteEviction(const PagingRequest& request, bool wasLoaded, PagingRun& run) {
    if (wasLoaded) ++counters_.evicted;
    dropUnused(request.parent);
    run.log.ended(request, PagingOutcome::Evicted, run.nowS);
}

void BlockPaging::noteUse(const ChunkId& parent) {
    if (unusedPrefetches_.empty()) return;
    const auto found = unusedPrefetches_.find(parent);
    if (found == unusedPrefetches_.end()) return;
    ++counters_.prefetch.hits;
    counters_.prefetch.hitBytes += found->second;
    unusedPrefetches_.erase(found);
}

void BlockPaging::dropUnused(const ChunkId& parent) {
    const auto found = unusedPrefetches_.find(parent);
    if (found == unusedPrefetches_.end()) return;
    ++counters_.prefetch.wasted;
    counters_.prefetch.wastedBytes += found->second;
    unusedPrefetches_.erase(found);
}

void BlockPaging::wastePrefetches() {
    while (!unusedPrefetches_.empty()) dropUnused(unusedPrefetches_.begin()->first);
}

}  // namespace planet
