// Prefetching, in simulated time: what is read early, and what it never costs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <set>

#include "tests/support/planet_fixture.h"

namespace planet {
namespace {

constexpr double prefetchFrameS = 1.0 / 64;

// A disk of about 50 reads a second.
PagingSettings slowDisk(PrefetchMode mode, double latencyMs = 20, std::size_t budgetChunks = 100'000) {
    PagingSettings settings;
    settings.budgetBytes = bytesOf(budgetChunks);
    settings.badDisk.latencyMs = latencyMs;
    settings.time = PagingTime::Simulated;
    settings.prefetch = {.mode = mode, .horizonS = 4};
    return settings;
}

std::unique_ptr<Planet> openSlow(const PagingSettings& settings) {
    return Planet::open(fakePyramid().source(), settings).value();
}

void stepFrame(Planet& planet, const View& view, double elapsedS = prefetchFrameS) {
    const ViewInput only{view, fineSettings()};
    planet.step(std::span(&only, 1), noUpload, elapsedS);
}

void settleFor(Planet& planet, const View& view) {
    ASSERT_TRUE(planet.settle(view, fineSettings(), noUpload, timeoutS));
}

// Eastwards along a parallel.
View alongTheWay(double timeS) {
    return viewAt(5, 10 + 12 * timeS, 5000, -30);
}

// Flies for some seconds from a settled start. Returns the chunk-seconds that are drawn too coarse.
double flyFor(Planet& planet, double seconds, const std::function<View(double)>& viewAtTime = alongTheWay) {
    double lateChunkS = 0;
    for (int frame = 0; frame * prefetchFrameS < seconds; ++frame) {
        stepFrame(planet, viewAtTime(frame * prefetchFrameS));
        lateChunkS += prefetchFrameS * planet.selection().counters.waiting;
    }
    return lateChunkS;
}

std::vector<AnnouncedView> wayAhead(double fromS, double untilS) {
    std::vector<AnnouncedView> views;
    for (double timeS = fromS; timeS <= untilS; timeS += 0.25)
        views.push_back({alongTheWay(timeS), timeS - fromS});
    return views;
}

TEST(PlanetPrefetch, WhatIsAnnouncedIsThereOnArrival) {
    const View here = viewAt(15, 40), there = viewAt(-20, 160);
    for (const PrefetchMode mode : {PrefetchMode::Off, PrefetchMode::Announced}) {
        const auto planet = openSlow(slowDisk(mode, 5));
        settleFor(*planet, here);
        const std::array<AnnouncedView, 1> destination = {{{there, 3}}};
        planet->announce(destination);
        for (int frame = 0; frame < 3 * 64; ++frame) stepFrame(*planet, here);
        EXPECT_EQ(planet->paging().prefetch().hits, 0u);
        stepFrame(*planet, there);
        if (mode == PrefetchMode::Off) {
            EXPECT_GT(planet->selection().counters.waiting, 0u);
            EXPECT_EQ(planet->paging().prefetch(), PrefetchCounters{});
            continue;
        }
        EXPECT_EQ(planet->selection().counters.waiting, 0u);
        EXPECT_EQ(drawn(*planet), drawnOfWhole(there, fineSettings()));
        const PrefetchCounters prefetch = planet->paging().prefetch();
        EXPECT_GT(prefetch.blocks, 5u);
        EXPECT_EQ(prefetch.hits, prefetch.blocks);
        EXPECT_EQ(prefetch.hitBytes, prefetch.bytes);
        EXPECT_EQ(prefetch.wasted, 0u);
        EXPECT_EQ(prefetch.unused(), 0u);
    }
}

TEST(PlanetPrefetch, AStandingCameraPrefetchesNothing) {
    for (const PrefetchMode mode : {PrefetchMode::Motion, PrefetchMode::Announced}) {
        const auto planet = openSlow(slowDisk(mode));
        flyFor(*planet, 4, [](double) { return viewAt(15, 40); });
        EXPECT_TRUE(planet->settled());
        EXPECT_EQ(planet->paging().prefetch(), PrefetchCounters{});
    }
}

TEST(PlanetPrefetch, WhatIsNeverWantedIsWasteOnceItIsEvicted) {
    const auto planet = openSlow(slowDisk(PrefetchMode::Announced, 5));
    const View here = viewAt(15, 40);
    settleFor(*planet, here);
    const std::array<AnnouncedView, 1> destination = {{{viewAt(-20, 160), 3}}};
    planet->announce(destination);
    for (int frame = 0; frame < 4 * 64; ++frame) stepFrame(*planet, here);
    const PrefetchCounters unused = planet->paging().prefetch();
    EXPECT_GT(unused.blocks, 5u);
    EXPECT_EQ(unused.hits, 0u);
    EXPECT_EQ(unused.wasted, 0u);
    EXPECT_EQ(unused.unused(), unused.blocks);
    EXPECT_EQ(unused.pending, 0u);
    planet->tools().dropAll();
    const PrefetchCounters dropped = planet->paging().prefetch();
    EXPECT_EQ(dropped.wasted, unused.blocks);
    EXPECT_EQ(dropped.wastedBytes, unused.bytes);
    EXPECT_EQ(dropped.hits, 0u);
}

TEST(PlanetPrefetch, AFlightWaitsForLess) {
    const auto off = openSlow(slowDisk(PrefetchMode::Off, 60));
    settleFor(*off, alongTheWay(0));
    const double lateChunkS = flyFor(*off, 6);
    EXPECT_GT(lateChunkS, 1);
    const auto moving = openSlow(slowDisk(PrefetchMode::Motion, 60));
    settleFor(*moving, alongTheWay(0));
    EXPECT_LT(flyFor(*moving, 6), lateChunkS / 2);
    EXPECT_GT(moving->paging().prefetch().hits, 10u);
    const auto announced = openSlow(slowDisk(PrefetchMode::Announced, 60));
    settleFor(*announced, alongTheWay(0));
    announced->announce(wayAhead(0, 10));
    EXPECT_LT(flyFor(*announced, 6), lateChunkS / 2);
    EXPECT_GT(announced->paging().prefetch().hits, 10u);
}

TEST(PlanetPrefetch, APrefetchBeginsOnlyWhileNothingElseIsQueued) {
    PagingSettings settings = slowDisk(PrefetchMode::Motion, 60);
    settings.loaderThreads = 2;
    const auto planet = openSlow(settings);
    planet->tools().keepMoves(true);
    std::set<BlockId> prefetches;
    std::size_t taken = 0;
    for (int frame = 0; frame < 6 * 64; ++frame) {
        std::set<BlockId> wantedBefore;
        for (const PagingRequest& one : planet->inspect().pendingRequests(PagingType::PageIn)) {
            if (one.isPrefetch())
                prefetches.insert(one.block());
            else
                wantedBefore.insert(one.block()), prefetches.erase(one.block());
        }
        stepFrame(*planet, alongTheWay(frame * prefetchFrameS));
        // All reads since the last step began before this step queued anything.
        const PagingMoves moves = planet->tools().takeMoves();
        std::set<BlockId> left = wantedBefore;
        for (const BlockId& block : moves.taken) {
            left.erase(block);
            if (!prefetches.contains(block) || wantedBefore.contains(block)) continue;
            ++taken;
            EXPECT_TRUE(left.empty()) << frame;
        }
    }
    EXPECT_GT(taken, 5u);
}

TEST(PlanetPrefetch, SettledMeansWhatIsWantedAndNotWhatIsPredicted) {
    const auto planet = openSlow(slowDisk(PrefetchMode::Announced, 1000));
    const View here = viewAt(15, 40), there = viewAt(-20, 160);
    settleFor(*planet, here);
    const std::array<AnnouncedView, 1> destination = {{{there, 4}}};
    planet->announce(destination);
    stepFrame(*planet, here);
    EXPECT_GT(planet->paging().prefetch().pending, 0u);
    EXPECT_EQ(planet->paging().queued, 0u);
    EXPECT_TRUE(planet->settled());
    // One is being read, and is wanted now: it has to arrive.
    stepFrame(*planet, there);
    EXPECT_FALSE(planet->settled());
    settleFor(*planet, there);
    EXPECT_EQ(planet->selection().counters.waiting, 0u);
    EXPECT_EQ(drawn(*planet), drawnOfWhole(there, fineSettings()));
}

TEST(PlanetPrefetch, NothingThatIsUsedIsEvictedForIt) {
    const View here = viewAt(15, 40), there = viewAt(-20, 160);
    const auto large = openSlow(slowDisk(PrefetchMode::Off));
    settleFor(*large, here);
    const std::size_t needed = large->tree().residentChunks;
    // Room for what is used and eight chunks more.
    const auto planet = openSlow(slowDisk(PrefetchMode::Announced, 5, needed + 8));
    settleFor(*planet, here);
    ASSERT_EQ(planet->selection().counters.waiting, 0u);
    const std::vector<ChunkId> drawnBefore = drawn(*planet);
    const std::array<AnnouncedView, 1> destination = {{{there, 4}}};
    planet->announce(destination);
    for (int frame = 0; frame < 3 * 64; ++frame) {
        stepFrame(*planet, here);
        ASSERT_EQ(drawn(*planet), drawnBefore) << frame;
        ASSERT_EQ(planet->selection().counters.waiting, 0u);
    }
    EXPECT_LE(planet->paging().prefetch().blocks, 2u);
    EXPECT_GT(planet->paging().prefetch().blocks, 0u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].evicted, 0u);
}

TEST(PlanetPrefetch, PrefetchedBlocksDoNotEvictOneAnother) {
    const View here = viewAt(15, 40);
    const auto large = openSlow(slowDisk(PrefetchMode::Off));
    settleFor(*large, here);
    const auto planet = openSlow(slowDisk(PrefetchMode::Announced, 5, large->tree().residentChunks + 16));
    settleFor(*planet, here);
    for (int frame = 0; frame < 6 * 64; ++frame) {
        const std::array<AnnouncedView, 1> destination = {{{viewAt(-20, 160), 4}}};
        if (frame % 64 == 0) planet->announce(destination);
        stepFrame(*planet, here);
    }
    EXPECT_LE(planet->paging().prefetch().blocks, 4u);
    EXPECT_EQ(planet->paging().prefetch().wasted, 0u);
}

TEST(PlanetPrefetch, WhatIsWantedGetsTheRoomOfWhatIsOnlyPredicted) {
    const View here = viewAt(15, 40), predicted = viewAt(-20, 160), instead = viewAt(50, -80);
    const auto large = openSlow(slowDisk(PrefetchMode::Off));
    settleFor(*large, here);
    settleFor(*large, instead);
    const std::size_t both = large->tree().residentChunks;
    const auto planet = openSlow(slowDisk(PrefetchMode::Announced, 5, both));
    settleFor(*planet, here);
    const std::array<AnnouncedView, 1> destination = {{{predicted, 4}}};
    planet->announce(destination);
    for (int frame = 0; frame < 2 * 64; ++frame) stepFrame(*planet, here);
    EXPECT_GT(planet->paging().prefetch().blocks, 5u);
    settleFor(*planet, instead);
    EXPECT_EQ(planet->selection().counters.waiting, 0u);
    EXPECT_EQ(drawn(*planet), drawnOfWhole(instead, fineSettings()));
}

TEST(PlanetPrefetch, TheOldestBlocksOfTheWayMakeRoom) {
    const auto large = openSlow(slowDisk(PrefetchMode::Off));
    settleFor(*large, alongTheWay(0));
    const auto planet = openSlow(slowDisk(PrefetchMode::Motion, 10, 2 * large->tree().residentChunks));
    settleFor(*planet, alongTheWay(0));
    flyFor(*planet, 12);
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 20u);
    EXPECT_GT(planet->paging().prefetch().hits, 50u);
    EXPECT_LT(planet->paging().prefetch().wasted, planet->paging().prefetch().hits / 4);
}

TEST(PlanetPrefetch, TheShareOfTheLoadersIsKept) {
    PagingSettings settings = slowDisk(PrefetchMode::Announced, 100);
    settings.prefetch.share = 0.25;
    const auto planet = openSlow(settings);
    const View here = viewAt(15, 40);
    settleFor(*planet, here);
    const double readBefore = planet->paging().loadSeconds;
    std::vector<AnnouncedView> everywhere;
    for (int i = 0; i < 12; ++i)
        everywhere.push_back({viewAt(-40 + 7 * i, 100 + 15 * i, 4000, -50), 0.3 * i});
    constexpr double seconds = 3;
    planet->announce(everywhere);
    for (int frame = 0; frame < seconds * 64; ++frame) stepFrame(*planet, here);
    ASSERT_GT(planet->paging().prefetch().pending, 0u);  // there was always more to read
    const double readS = planet->paging().loadSeconds - readBefore;
    constexpr double longestReadS = 0.15;
    EXPECT_LE(readS, settings.prefetch.share * seconds + longestReadS);
    EXPECT_GT(readS, settings.prefetch.share * seconds - longestReadS);
}

// All that a flight shows of itself.
struct PrefetchTrace {
    std::vector<std::vector<ChunkId>> drawn;
    std::vector<PagingMoves> moves;

    bool operator==(const PrefetchTrace&) const = default;
};

PrefetchTrace prefetchTraceOf(const PagingSettings& settings) {
    const auto planet = openSlow(settings);
    planet->tools().keepMoves(true);
    PrefetchTrace trace;
    for (int frame = 0; frame < 3 * 64; ++frame) {
        if (frame == 20) planet->announce(wayAhead(frame * prefetchFrameS, 8));
        stepFrame(*planet, alongTheWay(frame * prefetchFrameS));
        trace.drawn.push_back(drawn(*planet));
        trace.moves.push_back(planet->tools().takeMoves());
    }
    return trace;
}

TEST(PlanetPrefetch, OffIgnoresEveryOtherSettingOfIt) {
    PagingSettings off = slowDisk(PrefetchMode::Off, 40);
    const PrefetchTrace without = prefetchTraceOf(off);
    off.prefetch = {.mode = PrefetchMode::Off, .horizonS = 30, .share = 0.1, .lastingFirst = false};
    EXPECT_EQ(prefetchTraceOf(off), without);
    EXPECT_NE(prefetchTraceOf(slowDisk(PrefetchMode::Motion, 40)), without);
}

TEST(PlanetPrefetch, TheSameStepsGiveTheSamePrefetches) {
    EXPECT_EQ(prefetchTraceOf(slowDisk(PrefetchMode::Motion, 40)),
              prefetchTraceOf(slowDisk(PrefetchMode::Motion, 40)));
    EXPECT_EQ(prefetchTraceOf(slowDisk(PrefetchMode::Announced, 40)),
              prefetchTraceOf(slowDisk(PrefetchMode::Announced, 40)));
}

// A disk that falls behind: what is passed before it arrives comes last.
TEST(PlanetPrefetch, WhatLastsIsReadFirstWhileTheDiskFallsBehind) {
    PagingSettings settings = slowDisk(PrefetchMode::Motion, 250);
    const auto lasting = openSlow(settings);
    settings.prefetch.lastingFirst = false;
    const auto largest = openSlow(settings);
    double lateLasting = 0, lateLargest = 0;
    std::size_t passing = 0;
    for (int frame = 0; frame < 8 * 64; ++frame) {
        for (auto* planet : {lasting.get(), largest.get()})
            stepFrame(*planet, alongTheWay(frame * prefetchFrameS));
        lateLasting += lasting->selection().counters.waiting;
        lateLargest += largest->selection().counters.waiting;
        const auto pending = lasting->inspect().pendingRequests(PagingType::PageIn);
        EXPECT_TRUE(std::ranges::is_sorted(pending, {}, &PagingRequest::urgency));
        for (const PagingRequest& one : pending) passing += one.urgency == PagingUrgency::Passing;
        for (const PagingRequest& one : largest->inspect().pendingRequests(PagingType::PageIn))
            EXPECT_NE(one.urgency, PagingUrgency::Passing);
    }
    EXPECT_GT(passing, 100u);
    EXPECT_LT(lateLasting, lateLargest);
}

TEST(PlanetPrefetch, AnnouncementsRunOutAndCanBeTakenBack) {
    const auto planet = openSlow(slowDisk(PrefetchMode::Announced, 1000));
    const View here = viewAt(15, 40);
    settleFor(*planet, here);
    const std::array<AnnouncedView, 1> destination = {{{viewAt(-20, 160), 0.5}}};
    planet->announce(destination);
    stepFrame(*planet, here);
    EXPECT_GT(planet->paging().prefetch().pending, 1u);
    for (int frame = 0; frame < 33; ++frame) stepFrame(*planet, here);
    EXPECT_LE(planet->paging().prefetch().pending, 1u);  // the one that is being read
    planet->announce(destination);
    stepFrame(*planet, here);
    EXPECT_GT(planet->paging().prefetch().pending, 1u);
    planet->announce({});
    stepFrame(*planet, here);
    EXPECT_LE(planet->paging().prefetch().pending, 1u);
}

TEST(PlanetPrefetch, SettingsOutOfRangeAreNamed) {
    PagingSettings settings;
    settings.prefetch.share = 0;
    EXPECT_THAT(Planet::open(fakePyramid().source(), settings).error().message,
                testing::HasSubstr("prefetch share"));
    settings.prefetch = {.horizonS = 61};
    EXPECT_THAT(Planet::open(fakePyramid().source(), settings).error().message,
                testing::HasSubstr("prefetch horizon"));
}

}  // namespace
}  // namespace planet
