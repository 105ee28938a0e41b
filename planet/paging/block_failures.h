// What is known of the blocks of one kind that could not be read: how often each was tried, why it failed,
// and when it may be asked for again. It outlives the nodes, so that a block whose parent is dropped and
// comes back is not tried anew. Inside the library only; one thread.
//
// A read that fails is tried again after the delay, after twice the delay, after four times, ...; as often as
// the rules say, then the block has failed for good. What was read and is wrong has failed for good at once:
// it would be as wrong again.
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
    std::uint32_t attempts = 0;        // reads that failed
    std::string message;               // of the last
    std::optional<double> retryInS{};  // seconds until it may be asked for again, as soon as it is wanted;
                                       // none: it has failed for good
    bool operator==(const FailedBlock&) const = default;
};

struct RetryRules {
    int retries = 4;       // [0, 10]
    double delayS = 0.25;  // [0, 60], before the first

    bool operator==(const RetryRules&) const = default;
};

class BlockFailures {
public:
    // Times are seconds of one clock, from one call to the next never less, until clear().

    // A read has failed. True: for good.
    bool failed(const ChunkId& parent, Error error, double nowS, const RetryRules& rules);
    // Forgets it: it was read after all, or is to be tried as if it had never failed.
    void forget(const ChunkId& parent);
    void clear();

    bool isForGood(const ChunkId& parent) const;
    // The message of the last failure, with the number of attempts where there were several.
    std::string messageOf(const ChunkId& parent) const;
    // Of a block whose node has just become resident, and is Absent.
    ChildrenState stateAt(const ChunkId& parent, double nowS) const;

    // What is wanted is asked about once a step: whether it is Absent, to be asked for. One that awaits its
    // retry becomes that once its time has come.
    void beginStep();
    bool mayAsk(const ChunkId& parent, ChildrenState& state, double nowS);
    // When the first of those that had to wait, in this step, may be asked for.
    std::optional<double> nextRetryS() const { return nextRetryS_; }

    std::size_t count() const { return blocks_.size(); }
    std::size_t countForGood() const { return forGood_; }
    // In the order of the blocks.
    void appendTo(std::vector<FailedBlock>& out, BlockKind kind, double nowS) const;

private:
    struct Known {
        std::uint32_t attempts = 0;
        std::string message;
        std::optional<double> retryAtS{};  // none: not until told to
        std::uint64_t order = 0;           // rises with each failure
    };

    void forgetOldest();

    std::map<ChunkId, Known> blocks_;
    std::size_t forGood_ = 0;
    std::uint64_t nextOrder_ = 0;
    std::optional<double> nextRetryS_;
};

}  // namespace planet
