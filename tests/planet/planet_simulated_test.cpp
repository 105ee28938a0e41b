// Paging by simulated time, and by recorded time: the same calls give the same planet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <random>
#include <thread>

#include "tests/support/planet_fixture.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

constexpr double simulatedStepS = 1.0 / 64;  // exact

PagingSettings simulated(const BadDiskSettings& badDisk, int loaders = 1) {
    PagingSettings settings;
    settings.loaderThreads = loaders;
    settings.badDisk = badDisk;
    settings.time = PagingTime::Simulated;
    return settings;
}

std::unique_ptr<Planet> openWith(const PagingSettings& settings,
                                 PlanetSource source = fakePyramid().source()) {
    auto planet = Planet::open(std::move(source), settings).value();
    planet->tools().keepMoves(true);
    return planet;
}

void stepOnce(Planet& planet, const View& view, double elapsedS = simulatedStepS,
              const LodSettings& lod = fineSettings()) {
    const ViewInput only{view, lod};
    planet.step(std::span(&only, 1), noUpload, elapsedS);
}

// All that one step shows of itself.
struct Trace {
    std::vector<std::vector<ChunkId>> drawn;
    std::vector<float> morphs;
    PagingMoves moves;

    bool operator==(const Trace&) const = default;
};

Trace traceOf(Planet& planet) {
    Trace trace;
    for (std::size_t v = 0; v < planet.views().size(); ++v) {
        trace.drawn.emplace_back();
        for (const DrawItem& item : planet.selection(v).draw) {
            trace.drawn.back().push_back(item.id);
            trace.morphs.push_back(item.morph);
        }
    }
    trace.moves = planet.tools().takeMoves();
    return trace;
}

LodSettings morphing() {
    LodSettings lod = fineSettings();
    lod.hysteresis = 0.2;
    lod.morph = true;
    return lod;
}

// Flies, and changes one thing or another now and then. what is told each call and its moves.
template <class Told>
void flyAbout(Planet& planet, int frames, bool changesTime, const Told& told) {
    std::mt19937 random(7);
    PagingSettings settings = planet.pagingSettings();
    for (int frame = 0; frame < frames; ++frame) {
        const auto change = random() % 40;
        if (change == 0) planet.tools().dropAll();
        if (change == 1) planet.tools().retryFailed();
        if (change == 2) settings.budgetBytes = bytesOf(70 + random() % 200);
        if (change == 3) settings.loaderThreads = 1 + static_cast<int>(random() % 4);
        if (change == 4) settings.badDisk.seed = static_cast<std::uint32_t>(random());
        if (change == 5) settings.paused = !settings.paused;
        if (change == 6 && changesTime)
            settings.time = settings.time == PagingTime::Clock ? PagingTime::Simulated : PagingTime::Clock;
        if (settings.paused && change == 7) planet.tools().loadOne();
        if (change > 1 && change < 7) planet.setPaging(settings).value();
        told(frame, planet);
        const std::array<ViewInput, 2> views = {
            {{viewAt(15, frame * 0.4), morphing()}, {viewAt(-40, -frame * 0.3), fineSettings(), 0.5}}};
        planet.step(std::span(views).first(frame / 50 % 2 ? 2 : 1), noUpload, 0.001 * (1 + frame % 30));
        told(frame, planet);
    }
}

std::vector<Trace> simulatedFlight(Planet& planet) {
    std::vector<Trace> traces;
    flyAbout(planet, 400, false, [&](int, Planet& p) { traces.push_back(traceOf(p)); });
    return traces;
}

PagingSettings troubled() {
    PagingSettings settings =
        simulated({.latencyMs = 20, .bandwidthMBs = 0.01, .failureRate = 0.1, .shuffledOrder = true}, 3);
    settings.budgetBytes = bytesOf(200);
    return settings;
}

PlanetSource slowSource() {
    PlanetSource source = fakePyramid().source();
    source.loadChildren = [](const ChunkId& parent, BlockLocation location, StepsView heights) {
        std::this_thread::sleep_for(std::chrono::microseconds(keyOf(parent) % 400));
        return fakePyramid().load(parent, location, heights);
    };
    return source;
}

std::vector<ChunkId> loadedIn(const Planet& planet) {
    std::vector<ChunkId> ids;
    for (const PagingEvent& event : planet.inspect().pagingHistory()) {
        if (event.outcome == PagingOutcome::Loaded) ids.push_back(event.parent);
    }
    return ids;
}

TEST(SimulatedPaging, IsTheSameEachTimeHoweverSlowTheMachine) {
    const auto first = openWith(troubled());
    const auto second = openWith(troubled(), slowSource());
    const std::vector<Trace> a = simulatedFlight(*first), b = simulatedFlight(*second);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i], b[i]) << i;
    EXPECT_GT(first->paging()[BlockKind::Heights].loaded, 100u);
    EXPECT_GT(first->paging()[BlockKind::Heights].failed, 0u);
    EXPECT_GT(first->paging()[BlockKind::Heights].evicted, 0u);
    EXPECT_EQ(first->paging().loadSeconds, second->paging().loadSeconds);
}

TEST(SimulatedPaging, AnotherSeedIsAnotherFlight) {
    PagingSettings other = troubled();
    other.badDisk.seed = 2;
    const auto a = openWith(troubled()), b = openWith(other);
    EXPECT_NE(simulatedFlight(*a), simulatedFlight(*b));
}

// 100 bytes a block at 1000 a second: a tenth of a second, 6.4 steps.
TEST(SimulatedPaging, BandwidthDelaysABlockToTheVeryStep) {
    const auto planet = openWith(simulated({.bandwidthMBs = 0.001}));
    stepOnce(*planet, viewAt(10, 20));
    for (int frame = 1; frame <= 21; ++frame) {
        stepOnce(*planet, viewAt(10, 20));
        // Loads follow each other without a gap: 0.1 s, 0.2 s, 0.3 s.
        EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded,
                  static_cast<std::uint64_t>(frame * simulatedStepS / 0.1))
            << frame;
    }
    const PagingEvent& event = planet->inspect().pagingHistory().front();
    EXPECT_DOUBLE_EQ(event.readS, 0.1);
    EXPECT_DOUBLE_EQ(event.waitedS, 7 * simulatedStepS);
}

// Half as much to half as much again of 100 ms, as the seed says for the block.
TEST(SimulatedPaging, LatencyDelaysABlockToTheVeryStep) {
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
        const BadDiskSettings disk{.latencyMs = 100, .seed = seed};
        const auto planet = openWith(simulated(disk));
        stepOnce(*planet, viewAt(10, 20));
        ASSERT_EQ(planet->inspect().loadingNow().size(), 1u);
        const LoadInProgress loading = planet->inspect().loadingNow()[0];
        const double waitS = diskFault(disk, loading.parent, 0, loading.bytes).waitS;
        const int expected = static_cast<int>(std::ceil(waitS / simulatedStepS));
        EXPECT_GE(expected, 3);
        EXPECT_LE(expected, 10);
        for (int frame = 1; frame < expected; ++frame) {
            stepOnce(*planet, viewAt(10, 20));
            ASSERT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
            EXPECT_DOUBLE_EQ(planet->inspect().loadingNow()[0].seconds, frame * simulatedStepS);
        }
        stepOnce(*planet, viewAt(10, 20));
        EXPECT_THAT(loadedIn(*planet), testing::ElementsAre(loading.parent));
    }
}

TEST(SimulatedPaging, TwoLoadersReadSideBySide) {
    const auto planet = openWith(simulated({.bandwidthMBs = 0.001}, 2));
    stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->inspect().loadingNow().size(), 2u);
    for (int frame = 1; frame <= 6; ++frame) stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
    stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 2u);
    EXPECT_DOUBLE_EQ(planet->paging().loadSeconds, 0.2);
}

TEST(SimulatedPaging, TheSeedSaysWhatFails) {
    const BadDiskSettings disk{.failureRate = 0.4, .seed = 5};
    const auto planet = openWith(simulated(disk));
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 100));
    EXPECT_GT(planet->paging()[BlockKind::Heights].failed, 0u);
    EXPECT_GT(planet->paging()[BlockKind::Heights].loaded, 0u);
    std::map<ChunkId, std::uint32_t> attempts;
    for (const PagingEvent& event : planet->inspect().pagingHistory()) {
        const bool fails = diskFault(disk, event.parent, attempts[event.parent]++, 100).fails;
        EXPECT_EQ(event.outcome, fails ? PagingOutcome::Failed : PagingOutcome::Loaded);
    }
}

TEST(SimulatedPaging, TheSeedsOrderIsKept) {
    const BadDiskSettings disk{.bandwidthMBs = 0.001, .shuffledOrder = true, .seed = 9};
    const auto planet = openWith(simulated(disk));
    LodSettings all = suddenLod();
    all.frustumCulling = all.horizonCulling = false;
    all.tauPx = 1e-3;
    all.maxLevel = 1;
    ASSERT_TRUE(planet->settle(viewAt(10, 20), all, noUpload, 100));
    const std::vector<ChunkId> loaded = loadedIn(*planet);
    ASSERT_EQ(loaded.size(), 6u);
    EXPECT_TRUE(std::is_sorted(loaded.begin(), loaded.end(), [&](const ChunkId& a, const ChunkId& b) {
        return shuffledPlace(disk, a) < shuffledPlace(disk, b);
    }));
}

TEST(SimulatedPaging, SettlesToWhatTheClockSettlesTo) {
    const auto planet = openWith(simulated({.latencyMs = 500}, 2));
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 1000));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
    EXPECT_GT(planet->lastStep().nowS, 2);  // of the simulation
    const auto slow = openWith(simulated({.latencyMs = 500}, 2));
    EXPECT_FALSE(slow->settle(viewAt(10, 20), fineSettings(), noUpload, 1));
    EXPECT_LE(slow->lastStep().nowS, 1);
}

TEST(SimulatedPaging, SettlingInShortStretchesGoesOnFromTheLast) {
    const auto planet = openWith(simulated({.latencyMs = 500}));
    int stretches = 0;
    while (!planet->settle(viewAt(10, 20), fineSettings(), noUpload, 0.2) && stretches < 10'000) ++stretches;
    EXPECT_GT(stretches, 2);
    EXPECT_LT(stretches, 10'000);
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
}

TEST(SimulatedPaging, SwitchedOnWithAPauseNothingIsTaken) {
    PagingSettings settings = simulated({}, 4);
    settings.paused = true;
    Gated gated;
    const auto planet = openWith({}, gated.source());
    stepOnce(*planet, viewAt(10, 20));
    gated.gate.waitForArrivals(1);
    EXPECT_FALSE(planet->setPaging(settings).value());
    EXPECT_TRUE(planet->inspect().loadingNow().empty());
    gated.gate.open();
    for (int frame = 0; frame < 4; ++frame) stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
}

TEST(SimulatedPaging, PausesLetsOneThroughAndDropsAll) {
    PagingSettings settings = simulated({.latencyMs = 10});
    settings.paused = true;
    const auto planet = openWith(settings);
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 100));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
    planet->tools().loadOne();
    EXPECT_EQ(planet->inspect().loadingNow().size(), 1u);
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 100));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 1u);
    settings.paused = false;
    EXPECT_FALSE(planet->setPaging(settings).value());
    EXPECT_EQ(planet->inspect().loadingNow().size(), 1u);
    planet->tools().dropAll();
    const std::uint64_t cancelled = planet->paging().cancelled;
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 100));
    EXPECT_EQ(planet->paging().cancelled, cancelled + 1);  // what was being read, when it came
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
}

TEST(SimulatedPaging, ABadDiskThatChangesHoldsForReadsUnderWay) {
    const auto planet = openWith(simulated({.latencyMs = 10'000}));
    stepOnce(*planet, viewAt(10, 20));
    stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
    planet->setPaging(simulated({})).value();
    stepOnce(*planet, viewAt(10, 20));
    EXPECT_GT(planet->paging()[BlockKind::Heights].loaded, 0u);
}

TEST(SimulatedPaging, SwitchedOnWhatThreadsWereReadingIsReadAgain) {
    Gated gated;
    const auto planet = openWith({}, gated.source());
    stepOnce(*planet, viewAt(10, 20));
    gated.gate.waitForArrivals(1);
    EXPECT_FALSE(planet->setPaging(simulated({.bandwidthMBs = 0.001})).value());
    EXPECT_EQ(planet->inspect().loadingNow().size(), 1u);
    gated.gate.open();
    for (int frame = 1; frame <= 7; ++frame) {
        EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
        stepOnce(*planet, viewAt(10, 20));
    }
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 1u);
    // And back.
    EXPECT_FALSE(planet->setPaging({}).value());
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
}

TEST(Planet, AfterResetItIsAsIfJustOpened) {
    const auto used = openWith(troubled()), fresh = openWith(troubled());
    simulatedFlight(*used);
    used->setPaging(troubled()).value();
    used->setExaggeration(1);
    used->tools().reset();
    EXPECT_EQ(used->tree().residentChunks, 6u);
    EXPECT_TRUE(used->inspect().pendingRequests(PagingType::PageIn).empty());
    EXPECT_EQ(simulatedFlight(*used), simulatedFlight(*fresh));
}

TEST(Planet, ResetWhilePausedLetsNothingThrough) {
    PagingSettings settings = simulated({.latencyMs = 1000});
    settings.paused = true;
    const auto planet = openWith(settings);
    stepOnce(*planet, viewAt(10, 20));
    for (int i = 0; i < 3; ++i) planet->tools().loadOne();
    planet->tools().reset();
    for (int frame = 0; frame < 200; ++frame) stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
    EXPECT_TRUE(planet->inspect().loadingNow().empty());
}

TEST(Planet, AStepByTheClockGoesOnFromAStepOfAGivenLength) {
    const auto planet = openWith({});
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto since = std::chrono::steady_clock::now();
    stepOnce(*planet, viewAt(10, 20), 3);
    EXPECT_EQ(planet->lastStep().elapsedS, 3);
    const ViewInput only{viewAt(10, 20), fineSettings()};
    planet->step(std::span(&only, 1), noUpload);
    const std::chrono::duration<double> atMost = std::chrono::steady_clock::now() - since;
    EXPECT_LE(planet->lastStep().elapsedS, atMost.count());  // without what was before the given one
}

TEST(Planet, ResetDiscardsWhatThreadsAreReading) {
    Gated gated;
    const auto planet = openWith({}, gated.source());
    stepOnce(*planet, viewAt(10, 20));
    gated.gate.waitForArrivals(1);
    planet->tools().reset();
    EXPECT_TRUE(planet->inspect().loadingNow().empty());
    EXPECT_EQ(planet->paging().cancelled, planet->paging().requested);
    gated.gate.open();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
}

// Threads, by the clock, with everything changing: what they did is done again to the letter.
TEST(RecordedPaging, RepeatsWhatTheClockDecided) {
    PagingSettings settings = troubled();
    settings.time = PagingTime::Clock;
    settings.badDisk.latencyMs = 0.5;
    settings.badDisk.bandwidthMBs = 0;
    const auto live = openWith(settings, slowSource());
    std::vector<Trace> traces;
    flyAbout(*live, 500, true, [&](int, Planet& p) {
        std::this_thread::sleep_for(std::chrono::microseconds(300));
        traces.push_back(traceOf(p));
    });
    EXPECT_GT(live->paging()[BlockKind::Heights].loaded, 50u);
    EXPECT_GT(live->paging().cancelled, 0u);

    settings.time = PagingTime::Recorded;
    const auto replay = openWith(settings);
    std::mt19937 random(7);
    std::size_t at = 0;
    for (int frame = 0; frame < 500; ++frame) {
        ASSERT_TRUE(replay->tools().follow(traces[at].moves)) << frame;
        const auto change = random() % 40;
        if (change == 0) replay->tools().dropAll();
        if (change == 1) replay->tools().retryFailed();
        if (change == 2) settings.budgetBytes = bytesOf(70 + random() % 200);
        if (change == 3) settings.loaderThreads = 1 + static_cast<int>(random() % 4);
        if (change == 4) settings.badDisk.seed = static_cast<std::uint32_t>(random());
        if (change == 5) settings.paused = !settings.paused;
        if (change > 1 && change < 6) replay->setPaging(settings).value();
        EXPECT_EQ(traceOf(*replay).drawn, traces[at].drawn) << frame;
        ASSERT_TRUE(replay->tools().follow(traces[++at].moves)) << frame;
        const std::array<ViewInput, 2> views = {
            {{viewAt(15, frame * 0.4), morphing()}, {viewAt(-40, -frame * 0.3), fineSettings(), 0.5}}};
        replay->step(std::span(views).first(frame / 50 % 2 ? 2 : 1), noUpload, 0.001 * (1 + frame % 30));
        const Trace again = traceOf(*replay);
        ASSERT_EQ(again.drawn, traces[at].drawn) << frame;
        ASSERT_EQ(again.morphs, traces[at].morphs) << frame;
        ASSERT_EQ(again.moves.requested, traces[at].moves.requested) << frame;
        ASSERT_EQ(again.moves.arrived, traces[at].moves.arrived) << frame;
        ++at;
    }
}

TEST(RecordedPaging, SaysWhatItCannotFollow) {
    PagingSettings settings;
    settings.time = PagingTime::Recorded;
    const auto planet = openWith(settings);
    stepOnce(*planet, viewAt(10, 20));
    const ChunkId queued = planet->inspect().pendingRequests(PagingType::PageIn)[0].parent;
    const ChunkId other{Face::PosX, 3, 1, 1};
    EXPECT_FALSE(planet->tools().follow({.taken = {other}}));
    EXPECT_FALSE(planet->tools().follow({.arrived = {{queued}}}));
    EXPECT_TRUE(planet->tools().follow({.taken = {queued}, .arrived = {{queued, PagingOutcome::Failed}}}));
    stepOnce(*planet, viewAt(10, 20));
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 1u);
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));  // at once
}

}  // namespace
}  // namespace planet
