// Records the paging: the outcomes of requests, problems for the log, and the moves for a recording. Internal
// to the library; one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "planet/paging/pager.h"
#include "planet/paging/paging_types.h"

namespace planet {

struct PagingLog {
    std::deque<PagingEvent> history;    // outcomes of the last 1000 requests, oldest first
    std::uint64_t events = 0;           // all that ever were in the history
    std::vector<std::string> problems;  // at most 1000, for Planet::takeProblems()
    bool keepsMoves = false;
    PagingMoves moves;
    std::uint64_t discarded = 0;  // reads with unused results

    // Records that a request ended at nowS, seconds since the planet was opened. load: its read, if any.
    void ended(const PagingRequest& request, PagingOutcome outcome, double nowS,
               const FinishedLoad* load = nullptr);
    // Records that a read ended. badData: it failed because the block is corrupt.
    void arrived(const FinishedLoad& load, PagingOutcome outcome, double nowS, bool badData = false);
    // Records that the result of a read, if any, is discarded.
    void discardedRead(const PagingRequest& request, double nowS);
    void report(std::string problem);
};

}  // namespace planet
