// A planet whose settings change while it runs: budget, threads, pause, bad disk, exaggeration; and what it
// remembers of its paging.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "tests/support/planet_fixture.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

using testing::HasSubstr;

// What a renderer would hold.
struct RendererSlots {
    std::map<std::uint32_t, std::vector<std::int32_t>> heights;

    UploadChunk upload() {
        return
            [this](std::uint32_t slot, StepsView steps) { heights[slot].assign(steps.begin(), steps.end()); };
    }
    void recreate(const Planet& planet) {
        heights.clear();
        planet.uploadAll(upload());
    }
};

// Each resident chunk has a slot of its own that holds its heights; what is drawn is resident.
void expectWhole(const Planet& planet, const RendererSlots& pool) {
    std::set<std::uint32_t> slots;
    forEachNode(planet.tree(), [&](NodeIndex index, const ChunkNode& node) {
        EXPECT_TRUE(slots.insert(node.slot).second);
        EXPECT_LT(node.slot, planet.paging()[BlockKind::Heights].capacity);
        if (index < faceCount) {
            EXPECT_EQ(node.slot, index);
        }
        const auto found = pool.heights.find(node.slot);
        ASSERT_TRUE(found != pool.heights.end()) << toString(node.id);
        EXPECT_EQ(found->second, node.heights->view().toVector());
    });
    EXPECT_LE(slots.size(), planet.paging()[BlockKind::Heights].capacity);
    EXPECT_EQ(slots.size(), planet.tree().residentChunks);
    for (std::size_t v = 0; v < planet.views().size(); ++v) {
        for (const DrawItem& item : planet.selection(v).draw) {
            EXPECT_EQ(findNode(planet.tree(), item.id), item.node);
            EXPECT_EQ(planet.tree().nodes[item.node].slot, item.slot);
        }
    }
}

LodSettings pixelSettings() {
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    return settings;
}

// The same view settles to the same draw list as on a planet that was never changed.
void expectSettlesAsFresh(Planet& planet, const View& view, const LodSettings& settings,
                          RendererSlots& pool) {
    ASSERT_TRUE(planet.settle(view, settings, pool.upload(), timeoutS));
    expectWhole(planet, pool);
    PagingSettings fresh = planet.pagingSettings();
    fresh.badDisk = {};
    const auto other = Planet::open(fakePyramid().source(), fresh).value();
    ASSERT_TRUE(other->settle(view, settings, noUpload, timeoutS));
    EXPECT_EQ(other->paging()[BlockKind::Heights].budgetWaits, 0u);
    EXPECT_EQ(drawn(planet), drawn(*other));
}

PagingSettings budgetOf(std::size_t chunks, int loaderThreads = 1) {
    PagingSettings settings;
    settings.budgetBytes = bytesOf(chunks);
    settings.loaderThreads = loaderThreads;
    return settings;
}

TEST(Planet, AGrownBudgetTakesWhatHadNoRoom) {
    const auto planet = openFake(fakePyramid().source(), 70);
    RendererSlots pool;
    LodSettings settings = suddenLod();
    settings.tauPx = 0.01;
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 3e4, -90), settings, pool.upload(), timeoutS));
    EXPECT_GT(planet->paging()[BlockKind::Heights].budgetWaits, 0u);
    const std::uint64_t evicted = planet->paging()[BlockKind::Heights].evicted;
    EXPECT_TRUE(planet->setPaging(budgetOf(1500)).value());
    EXPECT_EQ(planet->paging()[BlockKind::Heights].capacity, 1498u);
    EXPECT_FALSE(planet->settled());
    pool.recreate(*planet);
    expectWhole(*planet, pool);
    expectSettlesAsFresh(*planet, viewAt(10, 20, 3e4, -90), settings, pool);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].evicted, evicted);
}

TEST(Planet, AShrunkBudgetDropsWhatIsOutOfUseFirst) {
    const auto planet = openFake(fakePyramid().source(), 1000);
    RendererSlots pool;
    for (int i = 0; i < 6; ++i) {
        ASSERT_TRUE(planet->settle(viewAt(-10, 70 + i * 45), pixelSettings(), pool.upload(), timeoutS));
    }
    ASSERT_TRUE(planet->settle(viewAt(10, 20), pixelSettings(), pool.upload(), timeoutS));
    const auto before = drawn(*planet);
    EXPECT_GT(planet->tree().residentChunks, 90u);
    EXPECT_TRUE(planet->setPaging(budgetOf(90)).value());
    EXPECT_EQ(planet->tree().residentChunks,
              planet->paging()[BlockKind::Heights].capacity);  // no more than had to go
    EXPECT_EQ(drawn(*planet), before);
    pool.recreate(*planet);
    expectWhole(*planet, pool);
    const std::uint64_t loaded = planet->paging()[BlockKind::Heights].loaded;
    expectSettlesAsFresh(*planet, viewAt(10, 20), pixelSettings(), pool);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, loaded);
}

TEST(Planet, AShrunkBudgetDropsEvenWhatIsDrawn) {
    const auto planet = openFake(fakePyramid().source(), 1000);
    RendererSlots pool;
    LodSettings settings = suddenLod();
    settings.tauPx = 0.01;
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 3e4, -90), settings, pool.upload(), timeoutS));
    EXPECT_GT(planet->tree().residentChunks, 100u);
    EXPECT_TRUE(planet->setPaging(budgetOf(70)).value());
    EXPECT_EQ(planet->paging()[BlockKind::Heights].capacity, 70u);
    pool.recreate(*planet);
    expectWhole(*planet, pool);
    EXPECT_FALSE(planet->selection().draw.empty());
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 3e4, -90), settings, pool.upload(), timeoutS));
    EXPECT_GT(planet->paging()[BlockKind::Heights].budgetWaits, 0u);
    EXPECT_EQ(planet->tree().residentChunks, 70u);
    expectSettlesAsFresh(*planet, viewAt(40, 100), suddenLod(4), pool);
}

TEST(Planet, ABudgetMayShrinkWhileBlocksAreBeingRead) {
    Gated gated;
    gated.gate.open();
    const auto planet = openFake(gated.source(), 1000, 3);
    RendererSlots pool;
    for (int i = 0; i < 6; ++i) {
        ASSERT_TRUE(planet->settle(viewAt(-10, 70 + i * 45), pixelSettings(), pool.upload(), timeoutS));
    }
    gated.gate.shut();
    const auto arrived = static_cast<int>(gated.asked.size());
    planet->step(viewAt(10, 20), fineSettings(), pool.upload());
    gated.gate.waitForArrivals(arrived + 1);
    const std::uint64_t failed = planet->paging()[BlockKind::Heights].failed;
    const std::uint64_t loaded = planet->paging()[BlockKind::Heights].loaded;
    EXPECT_TRUE(planet->setPaging(budgetOf(90, 3)).value());
    pool.recreate(*planet);
    expectWhole(*planet, pool);
    const PagingCounters& paging = planet->paging();
    EXPECT_LE(planet->tree().residentChunks + 4 * (paging.queued + paging.loading), 90u);
    gated.gate.open();
    expectSettlesAsFresh(*planet, viewAt(10, 20), pixelSettings(), pool);
    EXPECT_GT(planet->paging()[BlockKind::Heights].loaded, loaded);  // what was being read has come
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, failed);
}

// More blocks on their way than the new budget has room for: some have to be thrown away when they arrive.
TEST(Planet, ABudgetMayShrinkBelowWhatIsBeingRead) {
    Gated gated;
    gated.gate.open();
    const auto planet = openFake(gated.source(), 1000, 40);
    RendererSlots pool;
    LodSettings whole = suddenLod();
    whole.frustumCulling = whole.horizonCulling = false;
    whole.tauPx = 1e-3;
    whole.maxLevel = 2;
    ASSERT_TRUE(planet->settle(viewAt(10, 20), whole, pool.upload(), timeoutS));
    gated.gate.shut();
    const auto arrived = static_cast<int>(gated.asked.size());
    whole.maxLevel = 4;
    planet->step(viewAt(10, 20), whole, pool.upload());
    gated.gate.waitForArrivals(arrived + 40);
    EXPECT_TRUE(planet->setPaging(budgetOf(70, 40)).value());
    pool.recreate(*planet);
    expectWhole(*planet, pool);
    // Asked for again while the first readings of the same blocks are still on their way.
    for (int i = 0; i < 3; ++i) planet->step(viewAt(10, 20), whole, pool.upload());
    EXPECT_EQ(planet->paging().loading, 40u);
    gated.gate.open();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), whole, pool.upload(), timeoutS));
    expectWhole(*planet, pool);
    EXPECT_EQ(planet->tree().residentChunks, 70u);
    const auto& history = planet->inspect().pagingHistory();
    const auto thrownAway = std::count_if(history.begin(), history.end(), [](const PagingEvent& event) {
        return event.outcome == PagingOutcome::Cancelled && event.bytes > 0;
    });
    EXPECT_EQ(thrownAway, 40);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
    expectSettlesAsFresh(*planet, viewAt(40, 100), suddenLod(4), pool);
}

TEST(Planet, ABudgetMayChangeInEveryStep) {
    const auto planet = openFake(fakePyramid().source(), 100, 3);
    RendererSlots pool;
    std::mt19937 random(53);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.3;
    for (int i = 0; i < 800; ++i) {
        planet->step(viewAt(15, i * 0.7), settings, pool.upload());
        if (planet->setPaging(budgetOf(70 + random() % 300, 1 + i % 5)).value()) pool.recreate(*planet);
        if (i % 20 == 0) expectWhole(*planet, pool);
        if (i % 50 == 25) planet->tools().dropAll();
    }
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
    planet->setPaging(budgetOf(400)).value();
    pool.recreate(*planet);
    expectSettlesAsFresh(*planet, viewAt(15, 3), settings, pool);
}

TEST(Planet, ThreadsMayChangeWhileBlocksAreBeingRead) {
    Gated gated;
    const auto planet = openFake(gated.source(), 1000, 1);
    RendererSlots pool;
    const View view = viewAt(0, 0, 4e5, -90);
    LodSettings settings = fineSettings();
    settings.frustumCulling = settings.horizonCulling = false;
    planet->step(view, settings, pool.upload());
    gated.gate.waitForArrivals(1);
    EXPECT_FALSE(planet->setPaging(budgetOf(1000, 4)).value());
    gated.gate.waitForArrivals(4);
    EXPECT_EQ(planet->inspect().loadingNow().size(), 4u);
    EXPECT_FALSE(planet->setPaging(budgetOf(1000, 1)).value());
    EXPECT_EQ(planet->paging().loading, 4u);
    gated.gate.open();
    expectSettlesAsFresh(*planet, view, settings, pool);
    EXPECT_EQ(planet->paging().cancelled, 0u);
    EXPECT_EQ(planet->pagingSettings().loaderThreads, 1);
}

TEST(Planet, PausedItLoadsOnlyWhatIsLetThrough) {
    const auto planet = openPaused();
    RendererSlots pool;
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), pool.upload(), timeoutS));  // and at once
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
    EXPECT_GT(planet->paging().queued, 0u);
    EXPECT_FALSE(planet->settled());
    for (std::uint64_t i = 1; i <= 3; ++i) {
        const ChunkId first = planet->inspect().pendingRequests(PagingType::PageIn)[0].parent;
        planet->tools().loadOne();
        EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), pool.upload(), timeoutS));
        EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, i);
        EXPECT_EQ(planet->inspect().pagingHistory().back().parent, first);
    }
    EXPECT_FALSE(planet->setPaging({}).value());
    expectSettlesAsFresh(*planet, viewAt(10, 20), fineSettings(), pool);
}

TEST(Planet, DropAllLeavesTheRoots) {
    const auto planet = openFake();
    RendererSlots pool;
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), pool.upload(), timeoutS));
    ASSERT_TRUE(planet->settle(viewAt(-20, 80), fineSettings(), pool.upload(), timeoutS));
    EXPECT_FALSE(planet->inspect().pendingRequests(PagingType::PageOut).empty());
    const std::uint64_t loaded = planet->paging()[BlockKind::Heights].loaded;
    planet->tools().dropAll();
    EXPECT_EQ(planet->tree().residentChunks, 6u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].evicted, loaded);
    EXPECT_TRUE(planet->inspect().pendingRequests(PagingType::PageIn).empty());
    EXPECT_TRUE(planet->inspect().pendingRequests(PagingType::PageOut).empty());
    EXPECT_FALSE(planet->settled());
    for (const DrawItem& item : planet->selection().draw) EXPECT_EQ(item.id.level, 0);
    expectWhole(*planet, pool);
    expectSettlesAsFresh(*planet, viewAt(-20, 80), fineSettings(), pool);
}

TEST(Planet, DropAllThrowsAwayWhatIsBeingRead) {
    Gated gated;
    const auto planet = openFake(gated.source(), 1000, 4);
    RendererSlots pool;
    LodSettings settings = fineSettings();
    settings.frustumCulling = settings.horizonCulling = false;
    planet->step(viewAt(10, 20), settings, pool.upload());
    gated.gate.waitForArrivals(4);
    planet->tools().dropAll();
    EXPECT_EQ(planet->paging().queued, 0u);
    EXPECT_EQ(planet->paging().loading, 4u);
    // The same blocks are asked for again before the first readings arrive.
    planet->step(viewAt(10, 20), settings, pool.upload());
    EXPECT_EQ(planet->paging().queued, 6u);
    planet->tools().dropAll();
    planet->step(viewAt(10, 20), settings, pool.upload());
    gated.gate.open();
    expectSettlesAsFresh(*planet, viewAt(10, 20), settings, pool);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].bytesRead,
              (planet->paging()[BlockKind::Heights].loaded + 4) * 100);
    EXPECT_EQ(planet->paging().cancelled, 2u + 6u + 4u);
}

// Their parents go too.
TEST(Planet, DropAllThrowsAwayWhatIsBeingReadDeepInTheTree) {
    Gated gated;
    gated.gate.open();
    const auto planet = openFake(gated.source(), 1000, 2);
    RendererSlots pool;
    const View view = viewAt(10, 20, 3e4, -90);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.01;
    settings.maxLevel = 2;
    ASSERT_TRUE(planet->settle(view, settings, pool.upload(), timeoutS));
    gated.gate.shut();
    const auto arrived = static_cast<int>(gated.asked.size());
    settings.maxLevel = 4;
    planet->step(view, settings, pool.upload());
    gated.gate.waitForArrivals(arrived + 2);
    EXPECT_EQ(planet->inspect().loadingNow()[0].parent.level, 2);
    planet->tools().dropAll();
    EXPECT_EQ(planet->tree().residentChunks, 6u);
    gated.gate.open();
    expectSettlesAsFresh(*planet, view, settings, pool);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
}

TEST(Planet, BadSettingsAreRefusedAndChangeNothing) {
    const auto planet = openFake(fakePyramid().source(), 1000, 2);
    ASSERT_TRUE(planet->settle(viewAt(10, 20), pixelSettings(), noUpload, timeoutS));
    const PagingSettings before = planet->pagingSettings();
    std::vector<PagingSettings> bad(6, before);
    bad[0].loaderThreads = 65;
    bad[1].budgetBytes = bytesOf(70) - 1;
    bad[2].uploadLimitMs = -1;
    bad[3].badDisk.latencyMs = -1;
    bad[4].badDisk.failureRate = 1.1;
    bad[5].uploadLimitMs = std::numeric_limits<double>::quiet_NaN();
    for (const PagingSettings& settings : bad) {
        EXPECT_FALSE(planet->setPaging(settings));
        EXPECT_FALSE(Planet::open(fakePyramid().source(), settings));
        EXPECT_EQ(planet->pagingSettings(), before);
    }
    EXPECT_TRUE(planet->settled());
    EXPECT_FALSE(planet->setPaging(before).value());
    EXPECT_TRUE(planet->settled());
}

TEST(Planet, ABadDisksFailuresAreRetriedByHandUntilAllIsThere) {
    PagingSettings settings;
    settings.loaderThreads = 2;
    settings.badDisk = {.latencyMs = 0.05, .failureRate = 0.4, .shuffledOrder = true, .seed = 11};
    settings.retry.retries = 0;
    const auto planet = Planet::open(fakePyramid().source(), settings).value();
    RendererSlots pool;
    int rounds = 0;
    do {
        planet->tools().retryFailed();
        ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), pool.upload(), timeoutS));
        expectWhole(*planet, pool);
    } while (planet->selection().counters.waiting > 0 && ++rounds < 100);
    EXPECT_GT(rounds, 1);
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
    EXPECT_GT(planet->paging()[BlockKind::Heights].failed, 0u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].bytesRead,
              100 * planet->paging()[BlockKind::Heights].loaded);
    const auto problems = planet->takeProblems();
    ASSERT_EQ(problems.size(), planet->paging()[BlockKind::Heights].failed);
    EXPECT_THAT(problems[0], HasSubstr("injected read failure (seed 11)"));
}

// Which blocks fail depends on the seed alone, not on threads or on what came before.
TEST(Planet, ABadDiskFailsTheSameBlocksForTheSameSeed) {
    const auto failuresWith = [](int threads, std::uint32_t seed) {
        PagingSettings settings;
        settings.loaderThreads = threads;
        settings.badDisk = {.failureRate = 0.3, .seed = seed};
        settings.retry.retries = 0;
        const auto planet = Planet::open(fakePyramid().source(), settings).value();
        std::vector<std::set<std::string>> rounds(2);
        for (auto& round : rounds) {
            EXPECT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
            const auto problems = planet->takeProblems();
            round.insert(problems.begin(), problems.end());
            planet->tools().dropAll();
        }
        EXPECT_EQ(rounds[0], rounds[1]);
        return rounds[0];
    };
    const auto one = failuresWith(1, 4);
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(failuresWith(4, 4), one);
    EXPECT_NE(failuresWith(1, 5), one);
}

TEST(Planet, ALatencySwitchedOffHoldsNothingUp) {
    PagingSettings settings;
    settings.badDisk = {.latencyMs = 10'000, .bandwidthMBs = 1e-12};  // a day for each read
    const auto planet = Planet::open(fakePyramid().source(), settings).value();
    planet->step(viewAt(10, 20), fineSettings(), noUpload);
    while (planet->inspect().loadingNow().empty()) std::this_thread::yield();
    EXPECT_FALSE(planet->setPaging({}).value());
    EXPECT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
}

std::size_t countOf(const Planet& planet, PagingOutcome outcome) {
    const auto& history = planet.inspect().pagingHistory();
    return static_cast<std::size_t>(std::count_if(
        history.begin(), history.end(), [&](const PagingEvent& event) { return event.outcome == outcome; }));
}

TEST(Planet, HistoryTellsHowEachRequestEnded) {
    Faulty faulty;
    const auto planet = openFake(faulty.source(), 90);
    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(planet->settle(viewAt(0, i * 50), pixelSettings(), noUpload, timeoutS));
    }
    const PagingCounters& paging = planet->paging();
    ASSERT_LT(planet->inspect().pagingHistory().size(), 1000u);
    EXPECT_EQ(countOf(*planet, PagingOutcome::Loaded), paging[BlockKind::Heights].loaded);
    EXPECT_EQ(countOf(*planet, PagingOutcome::Failed), paging[BlockKind::Heights].failed);
    EXPECT_EQ(countOf(*planet, PagingOutcome::Evicted), paging[BlockKind::Heights].evicted);
    EXPECT_EQ(countOf(*planet, PagingOutcome::Cancelled), paging.cancelled);
    for (const PagingOutcome outcome :
         {PagingOutcome::Loaded, PagingOutcome::Failed, PagingOutcome::Evicted}) {
        EXPECT_GT(countOf(*planet, outcome), 0u);
    }
    double beforeS = 0;
    for (const PagingEvent& event : planet->inspect().pagingHistory()) {
        EXPECT_GE(event.atS, beforeS);
        EXPECT_GE(event.waitedS, 0);
        EXPECT_LE(event.waitedS, event.atS);
        EXPECT_GE(event.timesAsked, 1u);
        const bool read = event.outcome == PagingOutcome::Loaded || event.outcome == PagingOutcome::Failed;
        EXPECT_EQ(event.bytes, read ? 100u : 0u);
        EXPECT_EQ(event.readS > 0, read);
        if (read) {
            EXPECT_EQ(event.type, PagingType::PageIn);
            EXPECT_GT(event.priority, 1);
        }
        EXPECT_TRUE(event.outcome != PagingOutcome::Failed || Faulty::affects(event.parent));
        beforeS = event.atS;
    }
    EXPECT_LE(beforeS, planet->lastStep().nowS);
}

TEST(Planet, HistoryKeepsTheLastThousand) {
    const auto planet = openFake();
    LodSettings all = suddenLod();
    all.frustumCulling = all.horizonCulling = false;
    all.tauPx = 1e-3;
    while (planet->paging()[BlockKind::Heights].loaded + planet->paging()[BlockKind::Heights].evicted <
           1500) {
        ASSERT_TRUE(planet->settle(viewAt(0, 0), all, noUpload, timeoutS));
        planet->tools().dropAll();
    }
    EXPECT_EQ(planet->inspect().pagingHistory().size(), 1000u);
    EXPECT_EQ(planet->inspect().pagingHistory().back().outcome, PagingOutcome::Evicted);
}

TEST(Planet, PendingRequestsKnowHowOftenAndSinceWhenTheyAreAskedFor) {
    const auto planet = openPaused();
    planet->step(viewAt(10, 20), fineSettings(), noUpload);
    const double firstS = planet->lastStep().nowS;
    for (int i = 0; i < 4; ++i) planet->step(viewAt(10, 20), fineSettings(), noUpload);
    EXPECT_GT(planet->lastStep().nowS, firstS);
    const auto pending = planet->inspect().pendingRequests(PagingType::PageIn);
    ASSERT_FALSE(pending.empty());
    for (const PagingRequest& request : pending) {
        EXPECT_EQ(request.askedAtS, firstS);
        EXPECT_EQ(request.timesAsked, 5u);
    }
    planet->step(viewAt(10, 20, 8000, 90), fineSettings(), noUpload);  // up, at the stars
    ASSERT_FALSE(planet->inspect().pagingHistory().empty());
    EXPECT_EQ(planet->inspect().pagingHistory().size() +
                  planet->inspect().pendingRequests(PagingType::PageIn).size(),
              pending.size());
    for (const PagingEvent& event : planet->inspect().pagingHistory()) {
        EXPECT_EQ(event.outcome, PagingOutcome::Cancelled);
        EXPECT_EQ(event.timesAsked, 5u);
        EXPECT_EQ(event.atS, planet->lastStep().nowS);
        EXPECT_EQ(event.waitedS, planet->lastStep().nowS - firstS);
    }
}

TEST(Planet, APageOutTakenBackIsCancelled) {
    const auto planet = openFake();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), pixelSettings(), noUpload, timeoutS));
    planet->step(viewAt(10, 20, 8000, 90), pixelSettings(), noUpload);
    const std::size_t outOfUse = planet->inspect().pendingRequests(PagingType::PageOut).size();
    ASSERT_GT(outOfUse, 0u);
    planet->step(viewAt(10, 20), pixelSettings(), noUpload);
    EXPECT_TRUE(planet->inspect().pendingRequests(PagingType::PageOut).empty());
    EXPECT_EQ(countOf(*planet, PagingOutcome::Cancelled), outOfUse);
    EXPECT_EQ(planet->inspect().pagingHistory().back().type, PagingType::PageOut);
}

TEST(Planet, ChunksKnowWhenAndInWhatOrderTheyCame) {
    const auto planet = openFake();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
    std::map<std::uint32_t, int> byOrder;
    forEachNode(planet->tree(), [&](NodeIndex, const ChunkNode& node) {
        ++byOrder[node.loadOrder];
        EXPECT_LE(node.loadedAtS, planet->lastStep().nowS);
        if (node.parent == noNode) {
            EXPECT_EQ(node.loadOrder, 0u);
            return;
        }
        const ChunkNode& above = planet->tree().nodes[node.parent];
        EXPECT_GT(node.loadOrder, above.loadOrder);
        EXPECT_GE(node.loadedAtS, above.loadedAtS);
    });
    EXPECT_EQ(byOrder.size(), planet->paging()[BlockKind::Heights].loaded + 1);
    EXPECT_EQ(byOrder.rbegin()->first, planet->paging()[BlockKind::Heights].loaded);
    for (const auto& [order, chunks] : byOrder) EXPECT_EQ(chunks, order == 0 ? 6 : 4);
}

TEST(Planet, ExaggerationChangesWhatIsDrawnAndNoSlot) {
    const auto planet = openFake();
    LodSettings settings = suddenLod();
    settings.tauPx = 4;
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 2e5, -90), settings, noUpload, timeoutS));
    std::map<ChunkId, std::uint32_t> slots;
    forEachNode(planet->tree(), [&](NodeIndex, const ChunkNode& node) { slots[node.id] = node.slot; });
    planet->setExaggeration(8);
    EXPECT_FALSE(planet->settled());
    EXPECT_EQ(planet->tree().shape.quantumM, 8 * fakePyramid().shape.quantumM);
    forEachNode(planet->tree(),
                [&](NodeIndex, const ChunkNode& node) { EXPECT_EQ(node.slot, slots.at(node.id)); });
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 2e5, -90), settings, noUpload, timeoutS));
    ChunkTree whole = residentTree(fakePyramid(), 4);
    setExaggeration(whole, 8);
    Selection expected;
    selectChunks(whole, viewAt(10, 20, 2e5, -90), settings, expected);
    std::vector<ChunkId> ids;
    for (const DrawItem& item : expected.draw) ids.push_back(item.id);
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(drawn(*planet), ids);
    EXPECT_NE(ids, drawnOfWhole(viewAt(10, 20, 2e5, -90), settings));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
}

TEST(Planet, ExaggerationStopsShortOfTheCentre) {
    const auto planet = openFake();
    planet->setExaggeration(100);
    EXPECT_EQ(planet->tree().exaggeration, largestExaggeration(planet->tree()));
    EXPECT_LT(planet->tree().exaggeration, 100);
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 3e5), pixelSettings(), noUpload, timeoutS));
    EXPECT_FALSE(planet->selection().draw.empty());
}

}  // namespace
}  // namespace planet
