#include "planet/paging/disk_simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace planet {
namespace {

constexpr std::uint32_t chunkCount = 10'000;

ChunkId chunkOfMany(std::uint32_t number) {
    return {allFaces[number % 6], 9, number / 6 % 64, number / 384};
}

std::uint32_t failuresOf(const BadDiskSettings& settings, std::uint32_t attempt = 0) {
    std::uint32_t failures = 0;
    for (std::uint32_t i = 0; i < chunkCount; ++i) {
        failures += diskFault(settings, chunkOfMany(i), attempt, 1000).fails;
    }
    return failures;
}

TEST(BadDisk, failsAsManyReadsAsItsRateSays) {
    for (const double rate : {0.01, 0.1, 0.5, 0.93}) {
        for (const std::uint32_t seed : {0u, 1u, 77u}) {
            const double share = failuresOf({.failureRate = rate, .seed = seed}) / double{chunkCount};
            // Five standard deviations.
            EXPECT_NEAR(share, rate, 5 * std::sqrt(rate * (1 - rate) / chunkCount)) << seed;
        }
    }
}

TEST(BadDisk, rateZeroNeverFailsAndRateOneAlways) {
    EXPECT_EQ(failuresOf({.failureRate = 0}), 0u);
    EXPECT_EQ(failuresOf({.failureRate = 1}), chunkCount);
}

TEST(BadDisk, theSameSeedGivesTheSameTroubleAndAnotherSeedOther) {
    const BadDiskSettings one{.latencyMs = 100, .failureRate = 0.5, .seed = 1};
    BadDiskSettings other = one;
    other.seed = 2;
    std::uint32_t sameFailures = 0;
    std::uint32_t samePlaces = 0;
    for (std::uint32_t i = 0; i < chunkCount; ++i) {
        const DiskFault first = diskFault(one, chunkOfMany(i), 3, 1000);
        const DiskFault again = diskFault(one, chunkOfMany(i), 3, 1000);
        EXPECT_EQ(first.fails, again.fails);
        EXPECT_EQ(first.waitS, again.waitS);
        EXPECT_EQ(shuffledPlace(one, chunkOfMany(i)), shuffledPlace(one, chunkOfMany(i)));
        const DiskFault elsewhere = diskFault(other, chunkOfMany(i), 3, 1000);
        EXPECT_NE(first.waitS, elsewhere.waitS);
        sameFailures += first.fails == elsewhere.fails;
        samePlaces += shuffledPlace(one, chunkOfMany(i)) == shuffledPlace(other, chunkOfMany(i));
    }
    EXPECT_NEAR(sameFailures, chunkCount / 2, 250);
    EXPECT_EQ(samePlaces, 0u);
}

TEST(BadDisk, aLaterAttemptMaySucceed) {
    const BadDiskSettings settings{.failureRate = 0.5};
    std::uint32_t succeeded = 0;
    std::uint32_t failed = 0;
    for (std::uint32_t i = 0; i < chunkCount; ++i) {
        if (!diskFault(settings, chunkOfMany(i), 0, 1000).fails) continue;
        ++failed;
        succeeded += !diskFault(settings, chunkOfMany(i), 1, 1000).fails;
    }
    EXPECT_NEAR(succeeded / static_cast<double>(failed), 0.5, 0.04);
}

TEST(BadDisk, latencyIsHalfAsMuchToHalfAsMuchAgain) {
    const BadDiskSettings settings{.latencyMs = 80};
    double least = 1;
    double most = 0;
    double sum = 0;
    for (std::uint32_t i = 0; i < chunkCount; ++i) {
        const double waitS = diskFault(settings, chunkOfMany(i), 0, 1'000'000).waitS;
        least = std::min(least, waitS);
        most = std::max(most, waitS);
        sum += waitS;
    }
    EXPECT_GE(least, 0.040);
    EXPECT_LT(least, 0.041);
    EXPECT_LE(most, 0.120);
    EXPECT_GT(most, 0.119);
    EXPECT_NEAR(sum / chunkCount, 0.080, 0.002);
}

TEST(BadDisk, bandwidthAddsTheTimeOfTheBytes) {
    const BadDiskSettings slow{.bandwidthMBs = 0.5};
    EXPECT_DOUBLE_EQ(diskFault(slow, chunkOfMany(1), 0, 50'000).waitS, 0.1);
    EXPECT_EQ(diskFault(slow, chunkOfMany(1), 0, 0).waitS, 0);
    const BadDiskSettings both{.latencyMs = 20, .bandwidthMBs = 0.5};
    const BadDiskSettings latencyOnly{.latencyMs = 20};
    EXPECT_DOUBLE_EQ(diskFault(both, chunkOfMany(1), 0, 50'000).waitS,
                     diskFault(latencyOnly, chunkOfMany(1), 0, 50'000).waitS + 0.1);
    EXPECT_EQ(diskFault({}, chunkOfMany(1), 0, 50'000).waitS, 0);
    EXPECT_EQ(diskFault({.bandwidthMBs = 1e-300}, chunkOfMany(1), 0, 50'000).waitS, 86'400);
}

TEST(BadDisk, shuffledPlacesAreAllDifferent) {
    std::set<std::uint64_t> places;
    for (std::uint32_t i = 0; i < chunkCount; ++i) places.insert(shuffledPlace({}, chunkOfMany(i)));
    EXPECT_EQ(places.size(), chunkCount);
}

TEST(BadDisk, settingsOutOfRangeAreRefused) {
    EXPECT_TRUE(checkBadDisk({}));
    EXPECT_TRUE(checkBadDisk({.latencyMs = 10'000, .bandwidthMBs = 100'000, .failureRate = 1}));
    for (const double bad : {-1.0, 1e6, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_FALSE(checkBadDisk({.latencyMs = bad}));
        EXPECT_FALSE(checkBadDisk({.bandwidthMBs = bad}));
        EXPECT_FALSE(checkBadDisk({.failureRate = bad}));
    }
}

TEST(BadDisk, orderAloneIsNoTrouble) {
    EXPECT_FALSE(isTrouble({.shuffledOrder = true, .seed = 9}));
    EXPECT_TRUE(isTrouble({.latencyMs = 1}));
    EXPECT_TRUE(isTrouble({.bandwidthMBs = 1}));
    EXPECT_TRUE(isTrouble({.failureRate = 0.01}));
}

}  // namespace
}  // namespace planet
