#include "planet/paging/paging_queue.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace planet {

SubmitOutcome PagingQueue::submit(PagingRequest request) {
    assert(!std::isnan(request.priority));
    const auto found = pending_.find(request.block());
    if (found == pending_.end()) {
        order(request.type).insert(placeOf(request));
        prefetches_ += request.isPrefetch();
        ++counters_.added[static_cast<std::size_t>(request.type)];
        const BlockId block = request.block();
        pending_.emplace(block, std::move(request));
        return SubmitOutcome::Added;
    }
    PagingRequest& pending = found->second;
    if (pending.type != request.type) {
        ++counters_.cancelled[static_cast<std::size_t>(pending.type)];
        take(request.block());
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
    node.value() = placeOf(pending);
    order(pending.type).insert(std::move(node));
}

const PagingRequest* PagingQueue::best(PagingType type) const {
    return order(type).empty() ? nullptr : find(order(type).begin()->block);
}

const PagingRequest* PagingQueue::worst(PagingType type) const {
    return order(type).empty() ? nullptr : find(order(type).rbegin()->block);
}

const PagingRequest* PagingQueue::worst(PagingType type, BlockKind kind) const {
    const auto found = std::find_if(order(type).rbegin(), order(type).rend(),
                                    [&](const Place& place) { return place.block.kind == kind; });
    return found == order(type).rend() ? nullptr : find(found->block);
}

const PagingRequest* PagingQueue::find(const BlockId& block) const {
    const auto found = pending_.find(block);
    return found == pending_.end() ? nullptr : &found->second;
}

std::optional<PagingRequest> PagingQueue::popBest(PagingType type) {
    if (order(type).empty()) return std::nullopt;
    return pop(order(type).begin()->block);
}

std::optional<PagingRequest> PagingQueue::pop(BlockId block) {
    const PagingRequest* found = find(block);
    if (!found) return std::nullopt;
    ++counters_.popped[static_cast<std::size_t>(found->type)];
    return take(block);
}

std::optional<PagingRequest> PagingQueue::popFirst(
    PagingType type, const std::function<std::uint64_t(const BlockId&)>& placeOf) {
    std::optional<std::pair<std::uint64_t, BlockId>> first;
    for (const Place& place : order(type)) {
        if (place.urgency != order(type).begin()->urgency) break;
        const std::pair here{placeOf(place.block), place.block};
        if (!first || here < *first) first = here;
    }
    if (!first) return std::nullopt;
    return pop(first->second);
}

std::optional<PagingRequest> PagingQueue::cancel(BlockId block) {
    const PagingRequest* found = find(block);
    if (!found) return std::nullopt;
    ++counters_.withdrawn;
    ++counters_.cancelled[static_cast<std::size_t>(found->type)];
    return take(block);
}

std::vector<PagingRequest> PagingQueue::cancelNotRenewed(PagingType type, std::uint64_t sinceFrame) {
    std::vector<BlockId> stale;
    for (const Place& place : order(type)) {
        if (find(place.block)->renewedFrame < sinceFrame) stale.push_back(place.block);
    }
    std::vector<PagingRequest> cancelled;
    cancelled.reserve(stale.size());
    for (const BlockId& block : stale) cancelled.push_back(take(block));
    counters_.withdrawn += cancelled.size();
    counters_.cancelled[static_cast<std::size_t>(type)] += cancelled.size();
    return cancelled;
}

std::vector<PagingRequest> PagingQueue::sorted(PagingType type) const {
    std::vector<PagingRequest> requests;
    requests.reserve(order(type).size());
    for (const Place& place : order(type)) requests.push_back(*find(place.block));
    return requests;
}

PagingRequest PagingQueue::take(BlockId block) {
    const auto found = pending_.find(block);
    assert(found != pending_.end());
    PagingRequest request = std::move(found->second);
    order(request.type).erase(placeOf(request));
    prefetches_ -= request.isPrefetch();
    pending_.erase(found);
    return request;
}

}  // namespace planet
