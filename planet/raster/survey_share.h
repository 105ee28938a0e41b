// Lets several processes that open the same source share the reading that this takes: each reads its part of the samples, and
// they tell each other what they have found.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace planet {

// Tells one of the processes its part. All open the same source with the same settings, each on one thread, so they meet at the
// same surveys in the same order.
struct SurveyShare {
    int part = 0;  // [0, parts): this process reads the blocks whose number leaves this remainder
    int parts = 1;

    // Gives the others what this process has found and how many seconds that took, and returns what each has found, by
    // part. Nothing: another process has not come to this survey, for example because it could not open a file, so this one
    // must read all blocks itself.
    std::function<std::optional<std::vector<std::vector<std::byte>>>(std::span<const std::byte> own,
                                                                     double tookS)>
        exchange;

    bool reads(std::size_t block) const {
        return block % static_cast<std::size_t>(parts) == static_cast<std::size_t>(part);
    }
};

}  // namespace planet
