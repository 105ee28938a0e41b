// The blocks to load and to drop next, in order of urgency (paging queues after Zhu, MSV 2004).
//
// A request pages a block in or out. At most one is pending for a block. An equal request is merged with the
// pending one: in the same frame the higher priority holds, in a later frame the new one, because the eye has
// moved. The opposite request cancels both, because the block then stays as it is. Not safe for several
// threads at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "planet/sphere/block_id.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Hysteresis: a block used in one of these last frames is not dropped, so that a shaking camera does not load
// and drop it in turns.
inline constexpr std::uint64_t framesKept = 4;

// If all resident blocks are in use, a block yields to one with a priority this many times as high; the
// factor keeps the two from taking turns.
inline constexpr float yieldFactor = 1.5f;

enum class PagingType : std::uint8_t { PageIn, PageOut };
inline constexpr int pagingTypeCount = 2;

inline constexpr std::size_t maxViews = 4;  // of one planet at a time

struct PagingRequest {
    ChunkId parent;  // whose children are meant
    BlockKind kind = BlockKind::Heights;
    PagingType type = PagingType::PageIn;
    double priority = 0;             // larger first; ties in order of block. Not NaN
    std::uint64_t renewedFrame = 0;  // last frame it was asked for
    double askedAtS = 0;             // when it was first asked for, seconds since the planet was opened
    std::uint32_t timesAsked = 1;    // merged ones included
    // The priorities by view; 0 if the view does not want the block. `priority` is the largest.
    std::array<float, maxViews> viewPriority{};

    // Only for page-ins: the fields for a loader, and a unique number.
    BlockLocation location{};
    SharedHeights parentHeights{};  // null for tiles
    std::uint64_t ticket = 0;

    BlockId block() const { return {parent, kind}; }
};

// Totals over both types, unless they are by type.
struct PagingQueueCounters {
    std::array<std::uint64_t, pagingTypeCount> added{};      // by type
    std::array<std::uint64_t, pagingTypeCount> popped{};     // by type
    std::uint64_t merged = 0;                                // asked for again while pending
    std::uint64_t opposed = 0;                               // cancelled by the opposite request
    std::uint64_t withdrawn = 0;                             // cancelled by cancel() or for not being renewed
    std::array<std::uint64_t, pagingTypeCount> cancelled{};  // either way, by type
};

enum class SubmitOutcome {
    Added,
    Merged,   // was pending: renewed
    Opposed,  // the opposite was pending: that is gone, and this was not added
};

class PagingQueue {
public:
    SubmitOutcome submit(PagingRequest request);

    // Return the request with the highest or lowest priority of a type; null if there is none. Valid until
    // the next change.
    const PagingRequest* best(PagingType type) const;
    const PagingRequest* worst(PagingType type) const;
    // Returns the worst request for one kind of block; visits all requests that are worse.
    const PagingRequest* worst(PagingType type, BlockKind kind) const;
    // Returns the pending request for a block, of either type.
    const PagingRequest* find(const BlockId& block) const;

    // Takes a request out to serve it.
    std::optional<PagingRequest> popBest(PagingType type);
    std::optional<PagingRequest> pop(BlockId block);
    // Takes out the request with the smallest place, to serve it; visits all.
    std::optional<PagingRequest> popFirst(PagingType type,
                                          const std::function<std::uint64_t(const BlockId&)>& placeOf);
    // Takes a request out unserved.
    std::optional<PagingRequest> cancel(BlockId block);
    // Takes out all requests of a type that were last renewed before a frame.
    std::vector<PagingRequest> cancelNotRenewed(PagingType type, std::uint64_t sinceFrame);

    std::size_t count(PagingType type) const { return order(type).size(); }
    // Returns a copy for display, best first.
    std::vector<PagingRequest> sorted(PagingType type) const;
    const PagingQueueCounters& counters() const { return counters_; }

private:
    struct Place {
        double priority;
        BlockId block;
        bool operator<(const Place& other) const {
            return priority != other.priority ? priority > other.priority : block < other.block;
        }
    };
    using Order = std::set<Place>;

    const Order& order(PagingType type) const { return orders_[static_cast<std::size_t>(type)]; }
    Order& order(PagingType type) { return orders_[static_cast<std::size_t>(type)]; }
    PagingRequest take(BlockId block);
    void merge(PagingRequest& pending, const PagingRequest& again);

    std::unordered_map<BlockId, PagingRequest> pending_;
    std::array<Order, pagingTypeCount> orders_;
    PagingQueueCounters counters_;
};

}  // namespace planet
