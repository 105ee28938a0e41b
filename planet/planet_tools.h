// Tools for editors, tests and recordings of a Planet: they inspect its paging, change it, and record and
// replay it. Both classes are handles that are valid as long as the planet. Use them on the thread that steps
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "planet/paging/block_failures.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_queue.h"
#include "planet/paging/paging_types.h"

namespace planet {

struct PlanetState;

class PlanetInspector {
public:
    explicit PlanetInspector(const PlanetState& state) : state_(state) {}

    // Returns a copy of the pending requests of a type, most urgent first, for display. Page-outs are the
    // unused blocks, least recently used first; they stay resident until others need room.
    std::vector<PagingRequest> pendingRequests(PagingType type) const;
    // Returns the pending requests of one view, by its own priorities. Views do not request page-outs.
    std::vector<PagingRequest> pendingRequests(PagingType type, std::size_t view) const;
    std::vector<LoadInProgress> loadingNow() const;
    // Returns the outcomes of the last 1000 requests, oldest first.
    const std::deque<PagingEvent>& pagingHistory() const;
    // Returns the number of requests that have ended since the planet was opened. Between two calls, as many new events are
    // at the end of the history, unless it keeps fewer.
    std::uint64_t pagingEventCount() const;
    // Returns the blocks whose last read failed, at most the latest 4096 of each kind: heights, then colours,
    // then normals, each in the order of failure.
    std::vector<FailedBlock> failedBlocks() const;
    // Returns the seconds that steps have taken since the planet was opened or reset.
    double sinceResetS() const;
    // Returns whether normals will begin once a thread has derived the tiles of the whole faces.
    bool normalsArePending() const;

private:
    const PlanetState& state_;
};

class PlanetTools {
public:
    explicit PlanetTools(PlanetState& state) : state_(state) {}

    // Lets the most urgent request through while paused.
    void loadOne();
    // Allow failed blocks to be requested again at once, with their failures forgotten: all, or one.
    void retryFailed();
    void retryFailed(const BlockId& block);
    // Drops all blocks except the roots, and every request. Roots whose refinement failed may be refined
    // again. Discards the results of reads in progress, makes the selections again, and repeats the injected
    // faults from their beginning.
    void dropAll();
    // Restarts selection and loading as after opening, with the current settings and exaggeration: removes
    // all blocks except the roots, all requests and reads, the selections and their memory, and resets
    // simulated time to 0. Totals, history and lastStep().nowS continue. Nothing is selected until the next
    // step.
    void reset();
    // Forgets the selections, on which hysteresis and fades depend, so that the next step selects as the
    // first one does. Resident blocks and requests stay. Nothing is selected until the next step.
    void forgetSelections();

    // Sets whether moves are kept for takeMoves(); off by default.
    void keepMoves(bool kept);
    // Returns the moves since the last call. Call it after each step and each other call while moves are
    // kept; a call that abandons reads clears them first.
    PagingMoves takeMoves();
    // Replays moves from takeMoves(), in recorded time. Call it before the call or step for which they were
    // recorded. Returns false if a move has no request, because the earlier calls differed; such moves are
    // skipped.
    bool follow(const PagingMoves& moves);

private:
    PlanetState& state_;
};

}  // namespace planet
