// The ranks of a job tell each other what they have, and go on only if none has failed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "planet/bake/job/ranks.h"
#include "planet/base/result.h"

namespace planet {

// A rank, and how long it has waited for others. One thread.
class Team {
public:
    explicit Team(Ranks& ranks);  // ranks: must outlive this

    Ranks& ranks() { return ranks_; }
    int rank() const { return ranks_.rank(); }
    int count() const { return ranks_.count(); }
    const std::string& name() const { return name_; }  // "rank 3 on node17"
    double waitedS() const { return waitedS_; }

    std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> toEach);
    // Returns the bytes of each rank.
    std::vector<std::vector<std::byte>> tellAll(const std::vector<std::byte>& bytes);
    std::uint64_t sumBefore(std::uint64_t value);
    std::uint64_t sumOf(std::uint64_t value);
    // Returns the same outcome on all ranks: the Error of the lowest rank that has one, which names the rank. A rank that
    // was cancelled counts only if no other has an Error.
    Result<void> agree(const Result<void>& own);

private:
    Ranks& ranks_;
    std::string name_;
    double waitedS_ = 0;
};

// Returns the Error with the name of the rank that has it before its message, unless it was cancelled.
Error namedError(const Team& team, const Error& error);

}  // namespace planet
