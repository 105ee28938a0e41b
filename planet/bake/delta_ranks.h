// Exact percentiles of the δc of a level's chunks, in memory that does not grow with their number. Those of a level with many
// chunks are counted in two passes: the first finds out in which of 65536 ranges a percentile lies, the second which value of the
// range it is.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace planet {

// Takes up to 1.5 MB.
class DeltaRanks {
public:
    static constexpr std::size_t shareCount = 2;

    // shares: [0, 1], as percentileOf has them.
    explicit DeltaRanks(const std::array<double, shareCount>& shares) : shares_(shares) {}

    // The first pass. Values are finite and at least 0. Any thread.
    void add(float value);
    // Ends the first pass, on one thread. Returns whether a second is necessary, in which every value is added again.
    bool needsSecondPass();
    // The second pass. Any thread.
    void addAgain(float value);

    // Returns the percentile of a share, as percentileOf does; 0 without values. One thread, when the passes are over.
    float percentile(std::size_t share) const;

private:
    static constexpr std::size_t rangeCount = 1u << 16;
    using Counts = std::vector<std::atomic<std::uint64_t>>;
    struct Target {
        std::size_t range = 0;   // the upper bits of the percentile
        std::uint64_t rank = 0;  // its place among the values of the range, from 1 on
    };

    std::array<double, shareCount> shares_;
    std::mutex mutex_;
    std::vector<float> few_;  // all values, while there are no more than rangeCount; guarded by mutex_
    std::atomic<bool> isMany_ = false;
    Counts ranges_;  // by upper bits, once there are many
    std::array<Target, shareCount> targets_{};
    std::array<Counts, shareCount> values_;  // by lower bits, of the target's range
};

}  // namespace planet
