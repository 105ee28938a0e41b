#include "planet/paging/disk_simulator.h"

#include <xxhash.h>

#include <algorithm>
#include <array>

#include "planet/base/check_range.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr double mostLatencyMs = 10'000;
constexpr double mostBandwidthMBs = 100'000;
constexpr double mostWaitS = 24 * 3600;

enum class Purpose : std::uint64_t { Failure, Latency, Order };

std::uint64_t draw(std::uint32_t seed, Purpose purpose, const BlockId& block, std::uint32_t attempt) {
    const std::uint64_t kindAndPurpose =
        static_cast<std::uint64_t>(block.kind) << 8 | static_cast<std::uint64_t>(purpose);
    const std::array<std::uint64_t, 3> what = {keyOf(block.parent), attempt, kindAndPurpose};
    return XXH3_64bits_withSeed(what.data(), sizeof what, seed);
}

// Converts random bits to a uniform value in [0, 1).
double share(std::uint64_t drawn) {
    return static_cast<double>(drawn >> 11) * 0x1p-53;
}

}  // namespace

bool isTrouble(const BadDiskSettings& settings) {
    return settings.latencyMs > 0 || settings.bandwidthMBs > 0 || settings.failureRate > 0;
}

Result<void> checkBadDisk(const BadDiskSettings& settings) {
    TRY(checkRange("injected latency", settings.latencyMs, 0.0, mostLatencyMs, "ms"));
    TRY(checkRange("injected bandwidth", settings.bandwidthMBs, 0.0, mostBandwidthMBs, "MB/s"));
    return checkRange("injected failure rate", settings.failureRate, 0.0, 1.0);
}

DiskFault diskFault(const BadDiskSettings& settings, const BlockId& block, std::uint32_t attempt,
                    std::uint64_t bytes) {
    DiskFault fault;
    fault.fails = share(draw(settings.seed, Purpose::Failure, block, attempt)) < settings.failureRate;
    const double unevenness = 0.5 + share(draw(settings.seed, Purpose::Latency, block, attempt));
    fault.waitS = settings.latencyMs / 1000 * unevenness;
    if (settings.bandwidthMBs > 0) fault.waitS += static_cast<double>(bytes) / (settings.bandwidthMBs * 1e6);
    fault.waitS = std::min(fault.waitS, mostWaitS);
    return fault;
}

std::uint64_t shuffledPlace(const BadDiskSettings& settings, const BlockId& block) {
    return draw(settings.seed, Purpose::Order, block, 0);
}

}  // namespace planet
