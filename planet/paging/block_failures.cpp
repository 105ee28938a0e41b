#include "planet/paging/block_failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace planet {

namespace {

// Bounds the memory if all reads fail. A forgotten block is read again when it is wanted.
constexpr std::size_t mostKnown = 4096;

}  // namespace

bool BlockFailures::failed(const ChunkId& parent, Error error, double nowS, const RetryRules& rules) {
    assert(rules.retries >= 0 && rules.delayS >= 0);
    Known& known = blocks_[parent];
    assert(known.attempts == 0 || known.retryAtS);
    ++known.attempts;
    known.message = std::move(error.message);
    known.order = nextOrder_++;
    known.retryAtS.reset();
    const int attempts = static_cast<int>(known.attempts);
    const bool permanent = error.kind == ErrorKind::BadInput || attempts > rules.retries;
    if (permanent)
        ++forGood_;
    else
        known.retryAtS = nowS + std::ldexp(rules.delayS, attempts - 1);
    if (blocks_.size() > mostKnown) forgetOldest();
    return permanent;
}

void BlockFailures::forgetOldest() {
    const auto oldest = std::min_element(blocks_.begin(), blocks_.end(), [](const auto& a, const auto& b) {
        return a.second.order < b.second.order;
    });
    forget(ChunkId(oldest->first));
}

void BlockFailures::forget(const ChunkId& parent) {
    const auto found = blocks_.find(parent);
    if (found == blocks_.end()) return;
    if (!found->second.retryAtS) --forGood_;
    blocks_.erase(found);
}

void BlockFailures::clear() {
    *this = {};
}

bool BlockFailures::isPermanent(const ChunkId& parent) const {
    const auto found = blocks_.find(parent);
    return found != blocks_.end() && !found->second.retryAtS;
}

std::string BlockFailures::messageOf(const ChunkId& parent) const {
    const Known& known = blocks_.at(parent);
    return known.attempts == 1 ? known.message
                               : fmt::format("{} (tried {} times)", known.message, known.attempts);
}

ChildrenState BlockFailures::stateAt(const ChunkId& parent, double nowS) const {
    const auto found = blocks_.find(parent);
    if (found == blocks_.end()) return ChildrenState::Absent;
    const Known& known = found->second;
    if (!known.retryAtS) return ChildrenState::Failed;
    return *known.retryAtS > nowS ? ChildrenState::AwaitingRetry : ChildrenState::Absent;
}

void BlockFailures::beginStep() {
    nextRetryS_.reset();
}

bool BlockFailures::mayAsk(const ChunkId& parent, ChildrenState& state, double nowS) {
    if (state == ChildrenState::AwaitingRetry) {
        const auto found = blocks_.find(parent);
        const double retryAtS = found == blocks_.end() ? nowS : found->second.retryAtS.value_or(nowS);
        if (retryAtS <= nowS)
            changeState(state, ChildrenState::Absent);
        else
            nextRetryS_ = std::min(nextRetryS_.value_or(retryAtS), retryAtS);
    }
    return state == ChildrenState::Absent;
}

void BlockFailures::appendTo(std::vector<FailedBlock>& out, BlockKind kind, double nowS) const {
    for (const auto& [parent, known] : blocks_) {
        FailedBlock& block = out.emplace_back();
        block.block = {parent, kind};
        block.attempts = known.attempts;
        block.message = known.message;
        if (known.retryAtS) block.retryInS = std::max(*known.retryAtS - nowS, 0.0);
    }
}

}  // namespace planet
