// Tools for editors, tests and recordings of a Planet: they inspect the paging, repeat it, and record and
// replay it. Both classes are handles, valid as long as the planet; use them
// from the thread that steps it.
#pragma once

#include <cstddef>
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

    // The pending requests of a type, most urgent first: a copy, for display. Page-outs are the blocks out of
    // use, least recently used first; they stay resident until their room is needed.
    std::vector<PagingRequest> pendingRequests(PagingType type) const;
    // The pending requests of one view, by its own priorities. No view requests a page-out.
    std::vector<PagingRequest> pendingRequests(PagingType type, std::size_t view) const;
    std::vector<LoadInProgress> loadingNow() const;
    // Returns the ends of the last 1000 requests, oldest first.
    const std::deque<PagingEvent>& pagingHistory() const;
    // The blocks that could not be read and have not been since, of heights, then of colours, then of
    // normals, each in their order; of the latest 4096 of each kind.
    std::vector<FailedBlock> failedBlocks() const;
    // Returns whether normals will begin as soon as a thread has derived the tiles of the whole faces.
    bool normalsArePending() const;

private:
    const PlanetState& state_;
};

class PlanetTools {
public:
    explicit PlanetTools(PlanetState& state) : state_(state) {}

    // While paused: lets the most urgent request through.
    void loadOne();
    // Lets blocks that failed be requested again at once, as if they never had: all, or one.
    void retryFailed();
    void retryFailed(const BlockId& block);
    // Drops all blocks and every request; the roots stay, and may be refined again if that failed. Results of
    // reads in progress are discarded. The selections are made again. The injected faults of a bad disk come
    // again as they came.
    void dropAll();
    // Chooses and loads from here on as if just opened with the present settings and exaggeration: all blocks
    // but the roots, all requests and reads, the selections and what they remember are gone, and simulated
    // time begins again. Totals, history and lastStep().nowS go on. Nothing is selected until the next step.
    void startAnew();
    // Forgets the selections, which hysteresis and fades refer to: the next step selects as the first one
    // does. Resident blocks and requests stay. Nothing is selected until the next step.
    void forgetSelections();

    // Sets whether moves are kept for takeMoves(); off by default.
    void keepMoves(bool kept);
    // Returns those since the last call. Call it after each step and each other call while moves are kept: a
    // call that gives reads up begins them again.
    PagingMoves takeMoves();
    // In recorded time: repeats what takeMoves() returned for a call, before that call, or for a step, before
    // that step. Returns false where something in it has no request, because what went before was not the
    // same; that is left out.
    bool follow(const PagingMoves& moves);

private:
    PlanetState& state_;
};

}  // namespace planet
