#include "planet/planet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "planet/planet_tools.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

using testing::HasSubstr;

TEST(Planet, SettlesOnWhatAWholeTreeWouldDraw) {
    std::mt19937 random(41);
    const auto planet = openFake(fakePyramid().source(), 100'000, 2);
    for (int i = 0; i < 12; ++i) {
        const View view = randomView(random, 1e5);
        ASSERT_TRUE(planet->settle(view, fineSettings(), noUpload, timeoutS));
        EXPECT_TRUE(planet->settled());
        EXPECT_EQ(drawn(*planet), drawnOfWhole(view, fineSettings()));
        EXPECT_EQ(planet->selection().counters.waiting, 0u);
        EXPECT_LE(planet->selection().counters.worstEpsPx, 0.5 * (1 + 1e-6));
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].loaded, 50u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].bytesRead,
              planet->paging()[BlockKind::Heights].loaded * 100);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].resident,
              6 + 4 * planet->paging()[BlockKind::Heights].loaded);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed + planet->paging()[BlockKind::Heights].evicted, 0u);
    EXPECT_TRUE(planet->takeProblems().empty());
}

TEST(Planet, ForgottenSelectionsDoNotKeepChunksSplit) {
    const auto planet = openFake();
    LodSettings settings = fineSettings();
    settings.hysteresis = 0.5;
    double altitudeM = 2000;
    View far = viewAt(10, 20, altitudeM);
    ASSERT_TRUE(planet->settle(far, settings, noUpload, timeoutS));
    // Away from the ground until hysteresis keeps something split.
    while (drawn(*planet) == drawnOfWhole(far, settings)) {
        altitudeM *= 1.1;
        ASSERT_LT(altitudeM, 1e6);
        far = viewAt(10, 20, altitudeM);
        ASSERT_TRUE(planet->settle(far, settings, noUpload, timeoutS));
    }
    const std::size_t resident = planet->tree().residentChunks;
    planet->tools().forgetSelections();
    EXPECT_FALSE(planet->settled());
    EXPECT_EQ(planet->tree().residentChunks, resident);
    ASSERT_TRUE(planet->settle(far, settings, noUpload, timeoutS));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(far, settings));
}

TEST(Planet, EachResidentChunkIsUploadedToASlotOfItsOwn) {
    const auto planet = openFake(fakePyramid().source(), 120);
    std::map<std::uint32_t, std::vector<std::int32_t>> pool;
    const UploadChunk upload = [&](std::uint32_t slot, StepsView heights) {
        ASSERT_LT(slot, planet->paging()[BlockKind::Heights].capacity);
        pool[slot].assign(heights.begin(), heights.end());
    };
    std::mt19937 random(42);
    for (int i = 0; i < 15; ++i) {
        ASSERT_TRUE(planet->settle(randomView(random, 1e5), fineSettings(), upload, timeoutS));
        std::set<std::uint32_t> slots;
        forEachNode(planet->tree(), [&](NodeIndex, const ChunkNode& node) {
            EXPECT_TRUE(slots.insert(node.slot).second);
            EXPECT_EQ(pool.at(node.slot), node.heights->view().toVector());
            EXPECT_EQ(*node.heights, fakePyramid().at(node.id).heights);
        });
        std::set<std::uint32_t> again;
        planet->uploadAll([&](std::uint32_t slot, auto heights) {
            again.insert(slot);
            EXPECT_TRUE(
                std::equal(heights.begin(), heights.end(), pool.at(slot).begin(), pool.at(slot).end()));
        });
        EXPECT_EQ(again, slots);
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 0u);
}

// Steps until settled, calling afterStep after each.
template <class AfterStep>
void stepUntilSettled(Planet& planet, const View& view, const LodSettings& settings, AfterStep&& afterStep) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeoutS);
    do {
        planet.step(view, settings, noUpload);
        afterStep();
        std::this_thread::yield();
        ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    } while (!planet.settled());
}

TEST(Planet, SiblingsLoadTogether) {
    const auto planet = openFake();
    LodSettings settings = fineSettings();
    settings.tauPx = 0.05;
    std::size_t before = planet->tree().residentChunks;
    stepUntilSettled(*planet, viewAt(30, 40), settings, [&] {
        EXPECT_EQ((planet->tree().residentChunks - before) % 4, 0u);
        before = planet->tree().residentChunks;
        for (const DrawItem& item : planet->selection().draw) {
            if (item.id.level == 0) continue;
            for (int q = 0; q < quadrantCount; ++q) {
                EXPECT_NE(findNode(planet->tree(), childOf(parentOf(item.id), q)), noNode);
            }
        }
    });
    EXPECT_GT(before, 6u);
}

TEST(Planet, DrawsTheParentUntilItsChildrenHaveCome) {
    Gated gated;
    const auto planet = openFake(gated.source());
    for (int i = 0; i < 3; ++i) {
        planet->step(viewAt(10, 20), fineSettings(), noUpload);
        for (const DrawItem& item : planet->selection().draw) EXPECT_EQ(item.id.level, 0);
        EXPECT_GT(planet->selection().counters.waiting, 0u);
        EXPECT_FALSE(planet->settled());
    }
    gated.gate.waitForArrivals(1);
    EXPECT_FALSE(planet->settled());
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
    gated.gate.open();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
    EXPECT_EQ(planet->selection().counters.waiting, 0u);
}

TEST(Planet, SettlingGivesUpInTime) {
    Gated gated;
    const auto planet = openFake(gated.source());
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 0.01));
    gated.gate.open();
}

TEST(Planet, AtLeastOneBlockIsUploadedAStep) {
    PagingSettings settings;
    settings.uploadLimitMs = 0;
    const auto planet = Planet::open(fakePyramid().source(), settings).value();
    std::uint64_t loaded = 0;
    stepUntilSettled(*planet, viewAt(10, 20), fineSettings(), [&] {
        EXPECT_LE(planet->paging()[BlockKind::Heights].loaded, loaded + 1);
        loaded = planet->paging()[BlockKind::Heights].loaded;
    });
    EXPECT_GT(loaded, 3u);
}

TEST(Planet, RequestsAreCancelledWhenTheCameraTurnsAway) {
    Gated gated;
    const auto planet = openFake(gated.source());
    LodSettings settings = fineSettings();
    settings.horizonCulling = false;
    planet->step(viewAt(0, 0, 2e5, -90), settings, noUpload);
    gated.gate.waitForArrivals(1);
    planet->step(viewAt(0, 0, 2e5, -90), settings, noUpload);
    const auto pending = planet->inspect().pendingRequests(PagingType::PageIn);
    ASSERT_GT(pending.size(), 1u);
    EXPECT_EQ(planet->paging().queued, pending.size());
    EXPECT_EQ(planet->paging().loading, 1u);
    planet->step(viewAt(0, 0, 2e5, 90), settings, noUpload);  // up, at the stars
    EXPECT_TRUE(planet->inspect().pendingRequests(PagingType::PageIn).empty());
    EXPECT_EQ(planet->paging().cancelled, pending.size());
    EXPECT_EQ(planet->paging().queued, 0u);
    gated.gate.open();
    ASSERT_TRUE(planet->settle(viewAt(0, 0, 2e5, 90), settings, noUpload, timeoutS));
    EXPECT_EQ(gated.asked.size(), 1u);
    // And they come when it turns back.
    ASSERT_TRUE(planet->settle(viewAt(0, 0, 2e5, -90), settings, noUpload, timeoutS));
    EXPECT_EQ(planet->selection().counters.waiting, 0u);
}

TEST(Planet, TheMostWantedIsPendingFirst) {
    Gated gated;
    const auto planet = openFake(gated.source());
    planet->step(viewAt(0, 0, 3e5, -90), fineSettings(), noUpload);
    gated.gate.waitForArrivals(1);
    EXPECT_EQ(gated.asked[0], planet->selection().requests[0].parentId);
    const auto pending = planet->inspect().pendingRequests(PagingType::PageIn);
    for (std::size_t i = 0; i < pending.size(); ++i) {
        EXPECT_EQ(pending[i].parent, planet->selection().requests[i + 1].parentId);
        EXPECT_EQ(pending[i].priority, planet->selection().requests[i + 1].priority);
    }
    gated.gate.open();
}

TEST(Planet, ABudgetBelowTheLeastSaysWhatTheLeastIs) {
    PagingSettings settings;
    settings.budgetBytes = bytesOf(70) - 1;  // six roots, and on four levels the siblings of four chunks
    const auto refused = Planet::open(fakePyramid().source(), settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(refused.error().message, HasSubstr(std::to_string(bytesOf(70))));
    settings.budgetBytes = bytesOf(70);
    EXPECT_EQ(Planet::open(fakePyramid().source(), settings).value()->paging()[BlockKind::Heights].capacity,
              70u);
}

TEST(Planet, TheNumberOfLoaderThreadsHasARange) {
    for (const int threads : {0, -1, 65}) {
        PagingSettings settings;
        settings.loaderThreads = threads;
        EXPECT_FALSE(Planet::open(fakePyramid().source(), settings)) << threads;
    }
}

TEST(Planet, HasNoMoreSlotsThanThePlanetHasChunks) {
    EXPECT_EQ(openFake()->paging()[BlockKind::Heights].capacity, fakePyramid().chunks.size());
}

TEST(Planet, TheLeastBudgetReachesTheFinestLevelAnywhere) {
    const auto planet = openFake(fakePyramid().source(), 70);
    // Within a chunk, where four meet, and where three faces do.
    for (const auto& [latitude, longitude] : {std::pair{11.0, 23.0}, {0.0, 0.0}, {35.2644, 45.0}}) {
        View view = viewAt(latitude, longitude, 1e4, -90);
        view.horizontalFovRad = 1e-4;
        LodSettings settings = suddenLod();
        settings.tauPx = 1e-3;
        ASSERT_TRUE(planet->settle(view, settings, noUpload, timeoutS));
        EXPECT_EQ(planet->selection().counters.deepestLevel, 4u);
        EXPECT_EQ(planet->selection().counters.waiting, 0u);
        EXPECT_LE(planet->tree().residentChunks, 70u);
    }
}

TEST(Planet, ATinyBudgetSettlesCoarserAndSaysSo) {
    const auto planet = openFake(fakePyramid().source(), 70);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.01;
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 3e4, -90), settings, noUpload, timeoutS));
    EXPECT_GT(planet->paging()[BlockKind::Heights].budgetWaits, 0u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].budgetWaits, planet->selection().counters.waiting);
    EXPECT_EQ(planet->tree().residentChunks, planet->paging()[BlockKind::Heights].capacity);
    // Settled means at rest: what is resident is neither dropped nor read again.
    const PagingCounters before = planet->paging();
    for (int i = 0; i < 20; ++i) planet->step(viewAt(10, 20, 3e4, -90), settings, noUpload);
    EXPECT_EQ(planet->paging().requested, before.requested);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].evicted, before[BlockKind::Heights].evicted);
}

TEST(Planet, ALongFlightNeverExceedsATinyBudget) {
    constexpr std::size_t budget = 70;
    const auto planet = openFake(fakePyramid().source(), budget, 2);
    std::mt19937 random(43);
    std::uniform_real_distribution<double> turn(-8, 8);
    double latitude = 0;
    double longitude = 0;
    std::set<std::uint32_t> slots;
    for (int i = 0; i < 6000; ++i) {
        latitude = std::clamp(latitude + turn(random), -80.0, 80.0);
        longitude += turn(random);
        if (i % 500 == 0) longitude += 150;
        LodSettings settings = suddenLod();
        settings.tauPx = 0.3 + i % 3;
        planet->step(viewAt(latitude, longitude, 3000 + i % 7 * 3000), settings,
                     [&](std::uint32_t slot, auto) { ASSERT_LT(slot, budget); });
        const PagingCounters& paging = planet->paging();
        // Those on their way have slots of their own.
        ASSERT_LE(planet->tree().residentChunks + 4 * (paging.queued + paging.loading), budget);
        ASSERT_LE(paging.residentBytesCpu + paging.residentBytesGpu, bytesOf(budget));
        ASSERT_FALSE(planet->selection().draw.empty());
        slots.clear();
        forEachNode(planet->tree(),
                    [&](NodeIndex, const ChunkNode& node) { ASSERT_TRUE(slots.insert(node.slot).second); });
        ASSERT_EQ(slots.size(), planet->tree().residentChunks);
        // Now and then all of it arrives, however slow the machine.
        if (i % 50 == 0) {
            ASSERT_TRUE(planet->settle(viewAt(latitude, longitude), settings, noUpload, timeoutS));
        }
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 200u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
}

TEST(Planet, WhatWasDroppedIsLoadedAgain) {
    const auto planet = openFake(fakePyramid().source(), 90);
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    ASSERT_TRUE(planet->settle(viewAt(10, 20), settings, noUpload, timeoutS));
    const auto first = drawn(*planet);
    for (int i = 0; i < 6; ++i)
        ASSERT_TRUE(planet->settle(viewAt(-10, 70 + i * 45), settings, noUpload, timeoutS));
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 0u);
    const bool gone = std::any_of(first.begin(), first.end(),
                                  [&](const ChunkId& id) { return findNode(planet->tree(), id) == noNode; });
    EXPECT_TRUE(gone);
    ASSERT_TRUE(planet->settle(viewAt(10, 20), settings, noUpload, timeoutS));
    EXPECT_EQ(drawn(*planet), first);
    EXPECT_EQ(first, drawnOfWhole(viewAt(10, 20), settings));
}

TEST(Planet, TheLongestUnusedIsDroppedFirst) {
    const auto planet = openFake(fakePyramid().source(), 90);
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    std::vector<std::uint64_t> lastUsed;
    for (int i = 0; i < 12; ++i) {
        ASSERT_TRUE(planet->settle(viewAt(0, i * 50), settings, noUpload, timeoutS));
        const auto pending = planet->inspect().pendingRequests(PagingType::PageOut);
        for (std::size_t k = 1; k < pending.size(); ++k) {
            const auto frameOf = [&](const PagingRequest& request) {
                const ChunkNode& above = planet->tree().nodes[findNode(planet->tree(), request.parent)];
                return planet->tree().nodes[above.firstChild].lastUsedFrame;
            };
            const std::uint64_t a = frameOf(pending[k - 1]);
            const std::uint64_t b = frameOf(pending[k]);
            EXPECT_TRUE(a < b || (a == b && pending[k - 1].parent.level >= pending[k].parent.level));
        }
        // Exactly what this view does not use.
        EXPECT_EQ(6 + 4 * pending.size() + planet->selection().touched.size() - 6,
                  planet->tree().residentChunks);
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 0u);
}

TEST(Planet, WhatIsDrawnIsNotDroppedBeforeTheNextStep) {
    const auto planet = openFake(fakePyramid().source(), 70);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.5;
    for (int i = 0; i < 1500; ++i) {
        const View view = viewAt(20, i / 40 * 9.0, 5000 + i % 3);
        planet->step(view, settings, noUpload);
        for (const auto& [index, fate] : planet->selection().touched) {
            EXPECT_NE(planet->tree().nodes[index].heights, nullptr);
        }
        for (const DrawItem& item : planet->selection().draw) {
            EXPECT_EQ(planet->tree().nodes[item.node].id, item.id);
            EXPECT_EQ(planet->tree().nodes[item.node].slot, item.slot);
        }
        if (i % 40 == 20) {
            ASSERT_TRUE(planet->settle(view, settings, noUpload, timeoutS));
        }
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 10u);
}

TEST(Planet, WhatWasUsedInTheLastFramesIsNotDropped) {
    const auto planet = openFake(fakePyramid().source(), 90);
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    for (int i = 0; i < 300; ++i) {
        const View view = viewAt(10, i * 7.0);
        std::vector<ChunkId> before;
        for (const auto& [index, fate] : planet->selection().touched) {
            before.push_back(planet->tree().nodes[index].id);
        }
        planet->step(view, settings, noUpload);
        for (const ChunkId& id : before) EXPECT_NE(findNode(planet->tree(), id), noNode);
        if (i % 10 == 0) {
            ASSERT_TRUE(planet->settle(view, settings, noUpload, timeoutS));
            EXPECT_EQ(planet->paging()[BlockKind::Heights].budgetWaits,
                      0u);  // else blocks in use might have to yield
        }
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 10u);
}

// At rest no block that waits for room is wanted much more than one that has it, whatever was in view before.
TEST(Planet, ATinyBudgetGoesToTheLargestErrors) {
    const auto planet = openFake(fakePyramid().source(), 110);
    std::mt19937 random(46);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.1;
    int waiting = 0;
    for (int i = 0; i < 60; ++i) {
        ASSERT_TRUE(planet->settle(randomView(random, 1e5), settings, noUpload, timeoutS));
        const Selection& selection = planet->selection();
        if (selection.requests.empty()) continue;
        ++waiting;
        for (const ChildrenRequest& split : selection.splits) {
            const auto first = planet->tree().nodes.begin() + planet->tree().nodes[split.parent].firstChild;
            const bool finest = std::none_of(first, first + quadrantCount, [](const ChunkNode& node) {
                return node.childrenState == ChildrenState::Resident;
            });
            if (!finest) continue;
            EXPECT_LE(selection.requests[0].priority, 1.5f * split.priority);
        }
    }
    EXPECT_GT(waiting, 10);
    EXPECT_LT(waiting, 60);
}

TEST(Planet, AShakingCameraReadsNothingTwice) {
    const auto planet = openFake(fakePyramid().source(), 90);
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    ASSERT_TRUE(planet->settle(viewAt(10, 20), settings, noUpload, timeoutS));
    ASSERT_TRUE(planet->settle(viewAt(10, 45), settings, noUpload, timeoutS));
    const std::uint64_t loaded = planet->paging()[BlockKind::Heights].loaded;
    for (int i = 0; i < 100; ++i) planet->step(viewAt(10, i % 2 ? 20 : 45), settings, noUpload);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, loaded);
    EXPECT_GT(planet->paging().cancelled, 0u);  // page-outs, taken back by the next frame
}

TEST(Planet, ABlockThatFailsIsReportedOnceAndDrawnAsItsParent) {
    Faulty faulty;
    const auto planet = openFake(faulty.source());
    LodSettings settings = fineSettings();
    settings.frustumCulling = settings.horizonCulling = false;
    settings.tauPx = 0.02;
    const View view = viewAt(10, 20, 2e4);
    ASSERT_TRUE(planet->settle(view, settings, noUpload, timeoutS));
    const int failures = faulty.failures;
    EXPECT_GT(failures, 0);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, static_cast<std::uint64_t>(failures));
    EXPECT_EQ(planet->selection().counters.waiting, planet->paging()[BlockKind::Heights].failed);
    const auto problems = planet->takeProblems();
    EXPECT_EQ(problems.size(), static_cast<std::size_t>(failures));
    for (const std::string& problem : problems) EXPECT_THAT(problem, HasSubstr("the disk is bad"));
    EXPECT_TRUE(planet->takeProblems().empty());
    int drawnAsParents = 0;
    for (const DrawItem& item : planet->selection().draw) drawnAsParents += Faulty::affects(item.id);
    EXPECT_EQ(drawnAsParents, failures);

    for (int i = 0; i < 20; ++i) planet->step(view, settings, noUpload);
    EXPECT_EQ(faulty.failures, failures);

    faulty.broken = false;
    planet->tools().retryFailed();
    ASSERT_TRUE(planet->settle(view, settings, noUpload, timeoutS));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(view, settings));
}

TEST(Planet, FailedBlocksGiveTheirSlotsBack) {
    Faulty faulty;
    const auto planet = openFake(faulty.source(), 70);
    std::mt19937 random(45);
    for (int i = 0; i < 40; ++i) {
        ASSERT_TRUE(planet->settle(randomView(random, 1e5), fineSettings(), noUpload, timeoutS));
        planet->tools().retryFailed();
    }
    EXPECT_GT(faulty.failures, 7);
    faulty.broken = false;
    planet->tools().retryFailed();
    LodSettings settings = suddenLod();
    settings.tauPx = 0.01;
    ASSERT_TRUE(planet->settle(viewAt(10, 20, 3e4, -90), settings, noUpload, timeoutS));
    EXPECT_EQ(planet->tree().residentChunks, planet->paging()[BlockKind::Heights].capacity);
}

TEST(Planet, ABlockThatIsNotWhatItShouldBeIsAFailure) {
    PlanetSource source = fakePyramid().source();
    source.loadChildren = [](const ChunkId& parent, BlockLocation, StepsView) {
        SiblingBlock block = fakePyramid().childrenOf(parent);
        block[1].heights = Steps(block[1].heights.view().narrow().first(3));
        return Result<SiblingBlock>(block);
    };
    const auto planet = openFake(std::move(source));
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
    EXPECT_GT(planet->paging()[BlockKind::Heights].failed, 0u);
    EXPECT_EQ(planet->tree().residentChunks, 6u);
    EXPECT_THAT(planet->takeProblems()[0], HasSubstr("3 heights; expected 289"));
}

TEST(Planet, ABadRootIsAnError) {
    PlanetSource source = fakePyramid().source();
    source.roots[3].heights = {};
    const auto refused = Planet::open(std::move(source), {});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("y_neg/0/0/0"));
}

TEST(Planet, MayBeClosedWhileBlocksAreOnTheirWay) {
    for (int i = 0; i < 30; ++i) {
        const auto planet = openFake(fakePyramid().source(), 1000, 3);
        for (int k = 0; k < i % 5; ++k) planet->step(viewAt(10 * k, 20 * i), fineSettings(), noUpload);
    }
}

std::vector<ChunkId> drawnBy(const Planet& planet, std::size_t view) {
    std::vector<ChunkId> ids;
    for (const DrawItem& item : planet.selection(view).draw) ids.push_back(item.id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

TEST(Planet, EachOfSeveralViewsSettlesOnWhatItWouldDrawAlone) {
    std::mt19937 random(51);
    const auto planet = openFake(fakePyramid().source(), 100'000, 2);
    for (int i = 0; i < 12; ++i) {
        std::vector<ViewInput> views;
        for (int v = 0; v <= i % 4; ++v) {
            LodSettings lod = fineSettings();
            lod.tauPx = 0.5 + v;
            views.push_back({randomView(random, 1e5), lod, 1.0 + v});
        }
        ASSERT_TRUE(planet->settle(views, noUpload, timeoutS));
        ASSERT_EQ(planet->views().size(), views.size());
        for (std::size_t v = 0; v < views.size(); ++v) {
            EXPECT_EQ(drawnBy(*planet, v), drawnOfWhole(views[v].lodView, views[v].lod));
            EXPECT_EQ(planet->views()[v].input.lod.tauPx, views[v].lod.tauPx);
            EXPECT_EQ(planet->views()[v].input.lodView.eyeM, views[v].lodView.eyeM);
        }
    }
    EXPECT_EQ(planet->paging()[BlockKind::Heights].resident,
              6 + 4 * planet->paging()[BlockKind::Heights].loaded);  // nothing twice
}

// A paused planet with the roots' children resident, so that there is more to want.
std::unique_ptr<Planet> openPausedAtLevelOne() {
    auto planet = openFake();
    LodSettings coarse = suddenLod();
    coarse.maxLevel = 1;
    coarse.frustumCulling = coarse.horizonCulling = false;
    coarse.tauPx = 1e-3;
    EXPECT_TRUE(planet->settle(viewAt(0, 0), coarse, noUpload, timeoutS));
    PagingSettings paused = planet->pagingSettings();
    paused.paused = true;
    EXPECT_FALSE(planet->setPaging(paused).value());
    return planet;
}

// Each sees something that the other does not, and both the middle of a face.
std::array<ViewInput, 2> overlappingViews() {
    return {ViewInput{viewAt(0, -20, 6e4, -90), fineSettings(), 1},
            ViewInput{viewAt(0, 30, 4e4, -90), fineSettings(), 3}};
}

TEST(Planet, RequestsOfAllViewsAreMergedAndKeepAPriorityForEach) {
    const auto planet = openPausedAtLevelOne();
    const auto views = overlappingViews();
    planet->step(views, noUpload);
    const auto pending = planet->inspect().pendingRequests(PagingType::PageIn);
    int ofBoth = 0;
    std::size_t wishes = 0;
    for (const PagingRequest& request : pending) {
        double highest = 0;
        for (std::size_t v = 0; v < views.size(); ++v) {
            const auto& own = planet->selection(v).requests;
            const auto found = std::find_if(own.begin(), own.end(), [&](const ChildrenRequest& one) {
                return one.parentId == request.parent;
            });
            const double expected = found == own.end() ? 0 : found->priority * views[v].priorityFactor;
            EXPECT_FLOAT_EQ(request.viewPriority[v], static_cast<float>(expected));
            highest = std::max<double>(highest, request.viewPriority[v]);
        }
        EXPECT_EQ(request.priority, highest);
        ofBoth += request.viewPriority[0] > 0 && request.viewPriority[1] > 0;
    }
    for (std::size_t v = 0; v < views.size(); ++v) wishes += planet->selection(v).requests.size();
    EXPECT_EQ(wishes, pending.size() + static_cast<std::size_t>(ofBoth));
    EXPECT_GT(ofBoth, 0);
    EXPECT_EQ(planet->paging().queued, pending.size());
}

TEST(Planet, AViewsPendingRequestsAreThoseItWantsByItsOwnPriorities) {
    const auto planet = openPausedAtLevelOne();
    const auto views = overlappingViews();
    planet->step(views, noUpload);
    for (std::size_t v = 0; v < views.size(); ++v) {
        const auto pending = planet->inspect().pendingRequests(PagingType::PageIn, v);
        const auto& own = planet->selection(v).requests;
        ASSERT_GT(own.size(), 2u);
        ASSERT_EQ(pending.size(), own.size());
        for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(pending[i].parent, own[i].parentId);
        EXPECT_TRUE(planet->inspect().pendingRequests(PagingType::PageOut, v).empty());
    }
    EXPECT_LT(planet->inspect().pendingRequests(PagingType::PageIn, 0).size(),
              planet->inspect().pendingRequests(PagingType::PageIn).size());
}

TEST(Planet, AViewThatGoesAwayFreesItsWishes) {
    const auto planet = openPausedAtLevelOne();
    const auto views = overlappingViews();
    planet->step(views, noUpload);
    const std::size_t ofBoth = planet->inspect().pendingRequests(PagingType::PageIn).size();
    const std::uint64_t cancelled = planet->paging().cancelled;
    planet->step(std::span(views).first(1), noUpload);
    const auto pending = planet->inspect().pendingRequests(PagingType::PageIn);
    EXPECT_EQ(planet->views().size(), 1u);
    EXPECT_EQ(pending.size(), planet->selection().requests.size());
    EXPECT_LT(pending.size(), ofBoth);
    for (std::size_t i = 0; i < pending.size(); ++i) {
        EXPECT_EQ(pending[i].viewPriority[1], 0);
        EXPECT_EQ(pending[i].priority, planet->selection().requests[i].priority);
    }
    EXPECT_EQ(planet->paging().cancelled - cancelled, ofBoth - pending.size());
}

TEST(Planet, WhatAnyViewUsesIsNotOutOfUse) {
    const auto planet = openFake(fakePyramid().source(), 200);
    LodSettings settings = suddenLod();
    settings.tauPx = 1;
    for (int i = 0; i < 10; ++i) {
        const std::array<ViewInput, 2> views = {ViewInput{viewAt(10, 20), settings},
                                                ViewInput{viewAt(-5, 60 + i * 40), settings}};
        ASSERT_TRUE(planet->settle(views, noUpload, timeoutS));
        std::set<NodeIndex> used;
        for (std::size_t v = 0; v < 2; ++v) {
            for (const VisitedNode& visited : planet->selection(v).touched) used.insert(visited.node);
            EXPECT_EQ(drawnBy(*planet, v), drawnOfWhole(views[v].lodView, settings));
        }
        const auto outOfUse = planet->inspect().pendingRequests(PagingType::PageOut);
        EXPECT_EQ(used.size() + 4 * outOfUse.size(), planet->tree().residentChunks);
        for (const PagingRequest& request : outOfUse) {
            const NodeIndex parent = findNode(planet->tree(), request.parent);
            EXPECT_FALSE(used.contains(planet->tree().nodes[parent].firstChild));
        }
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].evicted, 0u);
}

// At rest a tiny budget has gone to what any of the views wants most.
TEST(Planet, ViewsShareATinyBudgetByTheirLargestPriorities) {
    const auto planet = openFake(fakePyramid().source(), 110);
    std::mt19937 random(52);
    LodSettings settings = suddenLod();
    settings.tauPx = 0.1;
    int waiting = 0;
    for (int i = 0; i < 40; ++i) {
        const std::array<ViewInput, 2> views = {ViewInput{randomView(random, 1e5), settings, 1},
                                                ViewInput{randomView(random, 1e5), settings, 0.25}};
        ASSERT_TRUE(planet->settle(views, noUpload, timeoutS));
        std::map<NodeIndex, double> splits;
        double mostWanted = 0;
        for (std::size_t v = 0; v < 2; ++v) {
            const double factor = views[v].priorityFactor;
            for (const ChildrenRequest& split : planet->selection(v).splits) {
                double& worth = splits[split.parent];
                worth = std::max(worth, split.priority * factor);
            }
            for (const ChildrenRequest& wanted : planet->selection(v).requests) {
                mostWanted = std::max(mostWanted, wanted.priority * factor);
            }
        }
        waiting += mostWanted > 0;
        for (const auto& [parent, worth] : splits) {
            const auto first = planet->tree().nodes.begin() + planet->tree().nodes[parent].firstChild;
            const bool finest = std::none_of(first, first + quadrantCount, [](const ChunkNode& node) {
                return node.childrenState == ChildrenState::Resident;
            });
            if (finest) {
                EXPECT_LE(mostWanted, 1.5f * worth * (1 + 1e-6));
            }
        }
    }
    EXPECT_GT(waiting, 10);
}

}  // namespace
}  // namespace planet
