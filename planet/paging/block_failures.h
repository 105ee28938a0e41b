// Remembers the blocks of one kind that could not be read: the number of attempts, the error, and the time of
// the next retry. It outlives the nodes, so a block keeps its attempts when its parent is dropped and loaded
// again. Internal to the library; one thread.
//
// A failed read is retried after the delay, then after twice the delay, four times the delay and so on, up to
// the number of retries in the rules; then the block has failed for good. Corrupt blocks are never retried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/sphere/block_id.h"
#include "planet/tree/block_state.h"

namespace planet {

// A block that could not be read, for display.
struct FailedBlock {
    BlockId block;
    std::uint32_t attempts = 0;        // failed reads
    std::string message;               // of the last failed read
    std::optional<double> retryInS{};  // seconds until it may be requested again
                                       // unset: it has failed for good
    bool operator==(const FailedBlock&) const = default;
};

struct RetryRules {
    int retries = 4;       // [0, 10]
    double delayS = 0.25;  // [0, 60], before the first retry

    bool operator==(const RetryRules&) const = default;
};

class BlockFailures {
public:
    // Times are seconds of one clock, which is monotonic until clear().

    // Records a failed read. Returns true if the block has failed for good.
    bool failed(const ChunkId& parent, Error error, double nowS, const RetryRules& rules);
    // Forgets the failures of a block.
    void forget(const ChunkId& parent);
    void clear();

    bool isPermanent(const ChunkId& parent) const;
    // Returns the error message of the last failure, with the number of attempts if there were several.
    std::string messageOf(const ChunkId& parent) const;
    // Returns the state of a block whose parent has just become resident.
    ChildrenState stateAt(const ChunkId& parent, double nowS) const;

    // Call mayAsk once per step for each wanted block, after beginStep. It returns true if the block is
    // Absent. A block that awaits its retry becomes Absent when the time of the retry has come.
    void beginStep();
    bool mayAsk(const ChunkId& parent, ChildrenState& state, double nowS);
    // Returns the earliest retry time among the blocks wanted in this step.
    std::optional<double> nextRetryS() const { return nextRetryS_; }

    std::size_t count() const { return blocks_.size(); }
    std::size_t countPermanent() const { return forGood_; }
    // Appends the failed blocks in the order of their failures.
    void appendTo(std::vector<FailedBlock>& out, BlockKind kind, double nowS) const;

private:
    struct Known {
        std::uint32_t attempts = 0;
        std::string message;
        std::optional<double> retryAtS{};  // unset: only on request
        std::uint64_t order = 0;           // increases with each failure
    };

    void forgetOldest();

    std::map<ChunkId, Known> blocks_;
    std::size_t forGood_ = 0;
    std::uint64_t nextOrder_ = 0;
    std::optional<double> nextRetryS_;
};

}  // namespace planet
