// Records the paging: how requests ended, problems for a log, and the moves for a recording. Internal to the
// library; one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "planet/paging/pager.h"
#include "planet/paging/paging_types.h"

namespace planet {

struct PagingLog {
    std::deque<PagingEvent> history;    // how the last 1000 requests ended, oldest first
    std::vector<std::string> problems;  // at most 1000, for Planet::takeProblems()
    bool keepsMoves = false;
    PagingMoves moves;
    std::uint64_t discarded = 0;  // reads whose result was not used

    // Notes that a request ended at nowS, seconds since the planet was opened. load: its read, if there was
    // one.
    void ended(const PagingRequest& request, PagingOutcome outcome, double nowS,
               const FinishedLoad* load = nullptr);
    // Notes that a read ended. badData: it failed because the block is corrupt.
    void arrived(const FinishedLoad& load, PagingOutcome outcome, double nowS, bool badData = false);
    // Notes that the result of a read, if any, is discarded.
    void discardedRead(const PagingRequest& request, double nowS);
    void report(std::string problem);
};

}  // namespace planet
