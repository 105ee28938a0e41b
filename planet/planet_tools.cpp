#include "planet/planet_tools.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "planet/planet_state.h"

namespace planet {

std::vector<PagingRequest> PlanetInspector::pendingRequests(PagingType type) const {
    return state_.pager->readQueue([&](const PagingQueue& queue) { return queue.sorted(type); });
}

std::vector<PagingRequest> PlanetInspector::pendingRequests(PagingType type, std::size_t view) const {
    assert(view < state_.views.size());
    std::vector<PagingRequest> pending = pendingRequests(type);
    std::erase_if(pending, [&](const PagingRequest& request) { return request.viewPriority[view] == 0; });
    std::stable_sort(pending.begin(), pending.end(), [&](const PagingRequest& a, const PagingRequest& b) {
        return a.viewPriority[view] > b.viewPriority[view];
    });
    return pending;
}

std::vector<LoadInProgress> PlanetInspector::loadingNow() const {
    return state_.pager->loadingNow();
}

const std::deque<PagingEvent>& PlanetInspector::pagingHistory() const {
    return state_.run.log.history;
}

std::uint64_t PlanetInspector::pagingEventCount() const {
    return state_.run.log.events;
}

std::vector<FailedBlock> PlanetInspector::failedBlocks() const {
    std::vector<FailedBlock> all;
    for (const BlockPaging* kind : state_.kinds())
        kind->failures().appendTo(all, kind->kind(), state_.run.sinceResetS);
    return all;
}

double PlanetInspector::sinceResetS() const {
    return state_.run.sinceResetS;
}

bool PlanetInspector::normalsArePending() const {
    return state_.normalsArePending();
}

void PlanetTools::loadOne() {
    state_.pager->loadOne();
}

void PlanetTools::retryFailed() {
    state_.changed = true;
    for (BlockPaging* kind : state_.kinds()) kind->retryAll();
    if (state_.normals.isOn() && state_.normalRoots.deriveMissing(state_.normals, state_.run.log))
        state_.resizeTiles(state_.normals, state_.normals.capacity());
    state_.count();
}

void PlanetTools::retryFailed(const BlockId& block) {
    state_.changed = true;
    state_.of(block.kind).retryOne(block.parent);
    state_.count();
}

void PlanetTools::dropAll() {
    state_.changed = true;
    state_.dropAll();
    state_.count();
}

void PlanetTools::reset() {
    state_.lastStepAt = PlanetState::Clock::now();
    state_.reset();
    state_.count();
}

void PlanetTools::forgetSelections() {
    for (PlanetView& view : state_.views) view.selection = {};
    for (ViewCourse& course : state_.courses) course.history.clear();
    state_.changed = true;
}

void PlanetTools::keepMoves(bool kept) {
    if (kept && state_.normalsArePending()) {
        state_.finishNormalRoots();
        state_.count();
    }
    state_.run.log.keepsMoves = kept;
    state_.run.log.moves = {};
}

PagingMoves PlanetTools::takeMoves() {
    return std::exchange(state_.run.log.moves, {});
}

bool PlanetTools::follow(const PagingMoves& moves) {
    assert(state_.settings.time == PagingTime::Recorded);
    Pager& pager = *state_.pager;
    if (moves.gaveUp) state_.requeue(pager.abandonReads());
    bool whole = true;
    for (const BlockId& block : moves.taken) whole &= pager.take(block);
    for (const PagingMoves::Arrival& arrival : moves.arrived) {
        std::optional<ErrorKind> failure;
        if (arrival.outcome == PagingOutcome::Failed)
            failure = arrival.badData ? ErrorKind::BadInput : ErrorKind::Io;
        whole &= pager.finish(arrival.block, failure, arrival.outcome != PagingOutcome::Cancelled);
    }
    return whole;
}

}  // namespace planet
