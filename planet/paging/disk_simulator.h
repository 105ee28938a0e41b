// Fault injection: a slow or failing disk, whose effect on each read depends on a seed alone, so that the
// same seed repeats the same faults. Pure functions, any thread.
#pragma once

#include <cstdint>

#include "planet/base/result.h"
#include "planet/sphere/block_id.h"

namespace planet {

struct BadDiskSettings {
    double latencyMs = 0;     // [0, 10000] added to each read, half as much to half as much again
    double bandwidthMBs = 0;  // [0, 100000] MB (10^6 bytes) a second and loader thread; 0: unlimited
    double failureRate = 0;   // [0, 1] share of the reads that fail
    // Serves reads in an order of the seed, instead of the most urgent first.
    bool shuffledOrder = false;
    std::uint32_t seed = 1;  // of all that is random above

    bool operator==(const BadDiskSettings&) const = default;
};

// Returns whether any read is slowed or fails.
bool isTrouble(const BadDiskSettings& settings);
// The Error names the setting that is out of range, and the range.
Result<void> checkBadDisk(const BadDiskSettings& settings);

struct DiskFault {
    bool fails = false;
    double waitS = 0;  // before the read; at most a day
};

// Returns the fault of the attempt-th read (from 0) of a block.
DiskFault diskFault(const BadDiskSettings& settings, const BlockId& block, std::uint32_t attempt,
                    std::uint64_t bytes);

// Returns the place of a block in the shuffled order; the smallest is served first.
std::uint64_t shuffledPlace(const BadDiskSettings& settings, const BlockId& block);

}  // namespace planet
