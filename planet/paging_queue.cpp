#include "planet/paging_queue.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace planet {

SubmitOutcome PagingQueue::submit(PagingRequest request) {
    assert(!std::isnan(request.priority));
    const auto found = pending_.find(request.parent);
    if (found == pending_.end()) {
        order(request.type).insert({request.priority, request.parent});
        ++counters_.added[static_cast<std::size_t>(request.type)];
        const ChunkId parent = request.parent;
        pending_.emplace(parent, std::move(request));
        return SubmitOutcome::Added;
    }
    PagingRequest& pending = found->second;
    if (pending.type != request.type) {
        take(request.parent);
        ++counters_.opposed;
        return SubmitOutcome::Opposed;
    }
    ++counters_.merged;
    ++pending.timesAsked;
    merge(pending, request);
    return SubmitOutcome::Merged;
}

void PagingQueue::merge(PagingRequest& pending, const PagingRequest& again) {
    double priority = again.priority;
    if (again.renewedFrame > pending.renewedFrame) {
        pending.renewedFrame = again.renewedFrame;
        pending.viewPriority = again.viewPriority;
    } else {
        priority = std::max(priority, pending.priority);
        for (std::size_t view = 0; view < maxViews; ++view) {
            pending.viewPriority[view] = std::max(pending.viewPriority[view], again.viewPriority[view]);
        }
    }
    if (priority == pending.priority) return;
    auto node = order(pending.type).extract({pending.priority, pending.parent});
    pending.priority = node.value().priority = priority;
    order(pending.type).insert(std::move(node));
}

const PagingRequest* PagingQueue::best(PagingType type) const {
    return order(type).empty() ? nullptr : find(order(type).begin()->parent);
}

const PagingRequest* PagingQueue::worst(PagingType type) const {
    return order(type).empty() ? nullptr : find(order(type).rbegin()->parent);
}

const PagingRequest* PagingQueue::find(const ChunkId& parent) const {
    const auto found = pending_.find(parent);
    return found == pending_.end() ? nullptr : &found->second;
}

std::optional<PagingRequest> PagingQueue::popBest(PagingType type) {
    if (order(type).empty()) return std::nullopt;
    return pop(order(type).begin()->parent);
}

std::optional<PagingRequest> PagingQueue::pop(ChunkId parent) {
    const PagingRequest* found = find(parent);
    if (!found) return std::nullopt;
    ++counters_.popped[static_cast<std::size_t>(found->type)];
    return take(parent);
}

std::optional<PagingRequest> PagingQueue::popFirst(
    PagingType type, const std::function<std::uint64_t(const ChunkId&)>& placeOf) {
    std::optional<std::pair<std::uint64_t, ChunkId>> first;
    for (const Place& place : order(type)) {
        const std::pair here{placeOf(place.parent), place.parent};
        if (!first || here < *first) first = here;
    }
    if (!first) return std::nullopt;
    return pop(first->second);
}

std::optional<PagingRequest> PagingQueue::cancel(ChunkId parent) {
    if (!find(parent)) return std::nullopt;
    ++counters_.withdrawn;
    return take(parent);
}

std::vector<PagingRequest> PagingQueue::cancelNotRenewed(PagingType type, std::uint64_t sinceFrame) {
    std::vector<ChunkId> stale;
    for (const Place& place : order(type)) {
        if (find(place.parent)->renewedFrame < sinceFrame) stale.push_back(place.parent);
    }
    std::vector<PagingRequest> cancelled;
    cancelled.reserve(stale.size());
    for (const ChunkId& parent : stale) cancelled.push_back(take(parent));
    counters_.withdrawn += cancelled.size();
    return cancelled;
}

std::vector<PagingRequest> PagingQueue::sorted(PagingType type) const {
    std::vector<PagingRequest> requests;
    requests.reserve(order(type).size());
    for (const Place& place : order(type)) requests.push_back(*find(place.parent));
    return requests;
}

PagingRequest PagingQueue::take(ChunkId parent) {
    const auto found = pending_.find(parent);
    assert(found != pending_.end());
    PagingRequest request = std::move(found->second);
    order(request.type).erase({request.priority, request.parent});
    pending_.erase(found);
    return request;
}

}  // namespace planet
