// The queue of blocks to load and to drop, in order of urgency (after the paging queues of Zhu, MSV 2004).
//
// A request pages a block in or out. At most one request is pending per block. An equal request is merged
// with the pending one. In the same frame the higher priority is kept; in a later frame the new one replaces
// it, because the eye has moved. The urgency comes before the priority. An opposite request cancels both, because the block then stays as it is. Not
// thread-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory_resource>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planet/sphere/block_id.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Hysteresis: a block that was used within this many frames is not dropped, so that a shaking camera does not
// load and drop it in turns.
inline constexpr std::uint64_t framesKept = 4;

// If all resident blocks are in use, a block yields to one with a priority this many times as high. The
// factor keeps the two from replacing each other in turns.
inline constexpr float yieldFactor = 1.5f;

enum class PagingType : std::uint8_t { PageIn, PageOut };
inline constexpr int pagingTypeCount = 2;

// In the order in which requests are served.
enum class PagingUrgency : std::uint8_t {
    Lasting,   // a view wants the block
    Passing,   // a view wants the block, but is predicted not to want it any more when it arrives
    Prefetch,  // no view wants the block yet
};

inline constexpr std::size_t maxViews = 4;  // at a time, per planet

struct PagingRequest {
    ChunkId parent;  // of the four blocks to load or drop
    BlockKind kind = BlockKind::Heights;
    PagingType type = PagingType::PageIn;
    PagingUrgency urgency = PagingUrgency::Lasting;
    double priority = 0;             // larger first; ties in order of block; not NaN
    std::uint64_t renewedFrame = 0;  // last frame in which it was requested
    double askedAtS = 0;             // first request, seconds since the planet was opened
    std::uint32_t timesAsked = 1;    // including merged requests
    // The priorities by view; 0 if the view does not want the block. `priority` is the largest.
    std::array<float, maxViews> viewPriority{};

    // Only for page-ins: input of the loader, and a unique number.
    BlockLocation location{};
    SharedHeights parentHeights{};  // null for tiles
    std::uint64_t ticket = 0;

    BlockId block() const { return {parent, kind}; }
    bool isPrefetch() const { return urgency == PagingUrgency::Prefetch; }
};

// Returns whether a request is served before another one, apart from ties.
inline bool isMoreUrgent(PagingUrgency urgency, double priority, PagingUrgency otherUrgency,
                         double otherPriority) {
    return urgency != otherUrgency ? urgency < otherUrgency : priority > otherPriority;
}

// Totals over both types, or by type where noted.
struct PagingQueueCounters {
    std::array<std::uint64_t, pagingTypeCount> added{};      // by type
    std::array<std::uint64_t, pagingTypeCount> popped{};     // by type
    std::uint64_t merged = 0;                                // requested again while pending
    std::uint64_t opposed = 0;                               // cancelled by an opposite request
    std::uint64_t withdrawn = 0;                             // cancelled by cancel() or for not being renewed
    std::array<std::uint64_t, pagingTypeCount> cancelled{};  // all cancelled requests, by type
};

enum class SubmitOutcome {
    Added,
    Merged,   // was pending and is renewed
    Opposed,  // the opposite request was pending: it is removed, and this one is not added
};

class PagingQueue {
public:
    PagingQueue() = default;
    PagingQueue(const PagingQueue& other);
    PagingQueue& operator=(const PagingQueue&) = delete;

    SubmitOutcome submit(PagingRequest request);

    // Return the request with the highest or lowest priority of a type; null if there is none. Valid until
    // the next change.
    const PagingRequest* best(PagingType type) const;
    const PagingRequest* worst(PagingType type) const;
    // Returns the worst request for one kind of block. Visits all requests that are worse.
    const PagingRequest* worst(PagingType type, BlockKind kind) const;
    // Returns the pending request for a block, of either type.
    const PagingRequest* find(const BlockId& block) const;

    // Remove a request to serve it.
    std::optional<PagingRequest> popBest(PagingType type);
    std::optional<PagingRequest> pop(BlockId block);
    // Removes the request with the smallest place among the most urgent ones, to serve it. Visits all of those.
    std::optional<PagingRequest> popFirst(PagingType type,
                                          const std::function<std::uint64_t(const BlockId&)>& placeOf);
    // Removes a request unserved.
    std::optional<PagingRequest> cancel(BlockId block);
    // Removes all requests of a type that were last renewed before a frame.
    std::vector<PagingRequest> cancelNotRenewed(PagingType type, std::uint64_t sinceFrame);

    std::size_t count(PagingType type) const { return order(type).size(); }
    std::size_t prefetches() const { return prefetches_; }  // of count(PageIn)
    // Returns a copy for display, best first.
    std::vector<PagingRequest> sorted(PagingType type) const;
    const PagingQueueCounters& counters() const { return counters_; }

private:
    struct Place {
        PagingUrgency urgency;
        double priority;
        BlockId block;
        bool operator<(const Place& other) const {
            if (urgency == other.urgency && priority == other.priority) return block < other.block;
            return isMoreUrgent(urgency, priority, other.urgency, other.priority);
        }
    };
    static Place placeOf(const PagingRequest& request) {
        return {request.urgency, request.priority, request.block()};
    }
    using Pending = std::pmr::unordered_map<BlockId, PagingRequest>;
    using Order = std::pmr::map<Place, PagingRequest*>;  // those in pending_

    const Order& order(PagingType type) const { return orders_[static_cast<std::size_t>(type)]; }
    Order& order(PagingType type) { return orders_[static_cast<std::size_t>(type)]; }
    PagingRequest take(Pending::iterator found);
    void merge(PagingRequest& pending, const PagingRequest& again);

    // Loaders remove what the owner has added. Without a pool, they would free memory of its heap, and lock it.
    std::pmr::unsynchronized_pool_resource pool_;
    Pending pending_{&pool_};
    std::array<Order, pagingTypeCount> orders_{Order(&pool_), Order(&pool_)};
    std::size_t prefetches_ = 0;
    PagingQueueCounters counters_;
};

}  // namespace planet
