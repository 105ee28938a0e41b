#include "planet/paging/paging_log.h"

#include <utility>

namespace planet {

namespace {

constexpr std::size_t eventsKept = 1000;
constexpr std::size_t problemsKept = 1000;  // bounds the memory of a program that never takes them

}  // namespace

void PagingLog::ended(const PagingRequest& request, PagingOutcome outcome, double nowS,
                      const FinishedLoad* load) {
    PagingEvent event;
    event.parent = request.parent;
    event.kind = request.kind;
    event.outcome = outcome;
    event.atS = nowS;
    event.waitedS = nowS - request.askedAtS;
    if (load) {
        event.readS = load->seconds;
        event.bytes = load->bytes;
    }
    event.timesAsked = request.timesAsked;
    event.priority = request.priority;
    event.isPrefetch = request.isPrefetch();
    event.type = request.type;
    history.push_back(event);
    ++events;
    if (history.size() > eventsKept) history.pop_front();
}

void PagingLog::arrived(const FinishedLoad& load, PagingOutcome outcome, double nowS, bool badData) {
    if (keepsMoves) moves.arrived.push_back({load.request.block(), outcome, badData});
    if (outcome == PagingOutcome::Cancelled) ++discarded;
    ended(load.request, outcome, nowS, &load);
}

void PagingLog::discardedRead(const PagingRequest& request, double nowS) {
    ++discarded;
    ended(request, PagingOutcome::Cancelled, nowS);
}

void PagingLog::report(std::string problem) {
    if (problems.size() < problemsKept) problems.push_back(std::move(problem));
}

}  // namespace planet
