#include "planet/paging/paging_queue.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace planet {

PagingQueue::PagingQueue(const PagingQueue& other)
    : pending_(other.pending_, &pool_), prefetches_(other.prefetches_), counters_(other.counters_) {
    for (auto& [block, request] : pending_) order(request.type).emplace(placeOf(request), &request);
}

SubmitOutcome PagingQueue::submit(PagingRequest request) {
    assert(!std::isnan(request.priority));
    const auto [found, isNew] = pending_.try_emplace(request.block());
    PagingRequest& pending = found->second;
    if (isNew) {
        pending = std::move(request);
        order(pending.type).emplace(placeOf(pending), &pending);
        prefetches_ += pending.isPrefetch();
        ++counters_.added[static_cast<std::size_t>(pending.type)];
        return SubmitOutcome::Added;
    }
    if (pending.type != request.type) {
        ++counters_.cancelled[static_cast<std::size_t>(pending.type)];
        take(found);
        ++counters_.opposed;
        return SubmitOutcome::Opposed;
    }
    ++counters_.merged;
    ++pending.timesAsked;
    merge(pending, request);
    return SubmitOutcome::Merged;
}

void PagingQueue::merge(PagingRequest& pending, const PagingRequest& again) {
    const Place before = placeOf(pending);
    double priority = again.priority;
    PagingUrgency urgency = again.urgency;
    if (again.renewedFrame > pending.renewedFrame) {
        pending.renewedFrame = again.renewedFrame;
        pending.viewPriority = again.viewPriority;
    } else {
        priority = std::max(priority, pending.priority);
        urgency = std::min(urgency, pending.urgency);
        for (std::size_t view = 0; view < maxViews; ++view) {
            pending.viewPriority[view] = std::max(pending.viewPriority[view], again.viewPriority[view]);
        }
    }
    if (priority == pending.priority && urgency == pending.urgency) return;
    prefetches_ -= pending.isPrefetch();
    auto node = order(pending.type).extract(before);
    pending.priority = priority;
    pending.urgency = urgency;
    prefetches_ += pending.isPrefetch();
    node.key() = placeOf(pending);
    order(pending.type).insert(std::move(node));
}

const PagingRequest* PagingQueue::best(PagingType type) const {
    return order(type).empty() ? nullptr : order(type).begin()->second;
}

const PagingRequest* PagingQueue::worst(PagingType type) const {
    return order(type).empty() ? nullptr : order(type).rbegin()->second;
}

const PagingRequest* PagingQueue::worst(PagingType type, BlockKind kind) const {
    const auto found = std::find_if(order(type).rbegin(), order(type).rend(),
                                    [&](const auto& one) { return one.second->kind == kind; });
    return found == order(type).rend() ? nullptr : found->second;
}

const PagingRequest* PagingQueue::find(const BlockId& block) const {
    const auto found = pending_.find(block);
    return found == pending_.end() ? nullptr : &found->second;
}

std::optional<PagingRequest> PagingQueue::popBest(PagingType type) {
    const PagingRequest* first = best(type);
    if (!first) return std::nullopt;
    return pop(first->block());
}

std::optional<PagingRequest> PagingQueue::pop(BlockId block) {
    const auto found = pending_.find(block);
    if (found == pending_.end()) return std::nullopt;
    ++counters_.popped[static_cast<std::size_t>(found->second.type)];
    return take(found);
}

std::optional<PagingRequest> PagingQueue::popFirst(
    PagingType type, const std::function<std::uint64_t(const BlockId&)>& placeOf) {
    std::optional<std::pair<std::uint64_t, BlockId>> first;
    for (const auto& [place, request] : order(type)) {
        if (place.urgency != order(type).begin()->first.urgency) break;
        const std::pair here{placeOf(place.block), place.block};
        if (!first || here < *first) first = here;
    }
    if (!first) return std::nullopt;
    return pop(first->second);
}

std::optional<PagingRequest> PagingQueue::cancel(BlockId block) {
    const auto found = pending_.find(block);
    if (found == pending_.end()) return std::nullopt;
    ++counters_.withdrawn;
    ++counters_.cancelled[static_cast<std::size_t>(found->second.type)];
    return take(found);
}

std::vector<PagingRequest> PagingQueue::cancelNotRenewed(PagingType type, std::uint64_t sinceFrame) {
    std::vector<BlockId> stale;
    for (const auto& [place, request] : order(type)) {
        if (request->renewedFrame < sinceFrame) stale.push_back(place.block);
    }
    std::vector<PagingRequest> cancelled;
    cancelled.reserve(stale.size());
    for (const BlockId& block : stale) cancelled.push_back(take(pending_.find(block)));
    counters_.withdrawn += cancelled.size();
    counters_.cancelled[static_cast<std::size_t>(type)] += cancelled.size();
    return cancelled;
}

std::vector<PagingRequest> PagingQueue::sorted(PagingType type) const {
    std::vector<PagingRequest> requests;
    requests.reserve(order(type).size());
    for (const auto& [place, request] : order(type)) requests.push_back(*request);
    return requests;
}

PagingRequest PagingQueue::take(Pending::iterator found) {
    assert(found != pending_.end());
    PagingRequest request = std::move(found->second);
    order(request.type).erase(placeOf(request));
    prefetches_ -= request.isPrefetch();
    pending_.erase(found);
    return request;
}

}  // namespace planet
