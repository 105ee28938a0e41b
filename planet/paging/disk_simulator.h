// Fault injection: a slow or failing disk. The seed alone determines the fault of each read, so the same seed
// repeats the same faults. Pure functions, any thread.
#pragma once

#include <cstdint>

#include "planet/base/result.h"
#include "planet/sphere/block_id.h"

namespace planet {

struct BadDiskSettings {
    double latencyMs = 0;     // [0, 10000], added to each read, varied by a factor in [0.5, 1.5]
    double bandwidthMBs = 0;  // [0, 100000] MB/s (10^6 bytes) per loader thread; 0: unlimited
    double failureRate = 0;   // [0, 1] share of the reads that fail
    // Serves reads in a shuffled order instead of by priority.
    bool shuffledOrder = false;
    std::uint32_t seed = 1;  // of everything random above

    bool operator==(const BadDiskSettings&) const = default;
};

// Returns whether any read is delayed or fails.
bool isTrouble(const BadDiskSettings& settings);
// Checks the ranges. The Error names the setting that is out of range, and the range.
Result<void> checkBadDisk(const BadDiskSettings& settings);

struct DiskFault {
    bool fails = false;
    double waitS = 0;  // delay before the read, at most a day
};

// Returns the fault of a block's read. attempt: from 0.
DiskFault diskFault(const BadDiskSettings& settings, const BlockId& block, std::uint32_t attempt,
                    std::uint64_t bytes);

// Returns the sort key of a block in the shuffled order; the smallest is served first.
std::uint64_t shuffledPlace(const BadDiskSettings& settings, const BlockId& block);

}  // namespace planet
