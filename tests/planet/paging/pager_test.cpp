#include "planet/paging/pager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <stdexcept>

#include "tests/support/fake_pyramid.h"
#include "tests/support/gate.h"

namespace planet {
namespace {

using namespace std::chrono_literals;

PagingRequest rootRequest(Face face, double priority = 1) {
    const ChunkData& root = fakePyramid().at({face, 0, 0, 0});
    PagingRequest request;
    request.parent = root.id;
    request.priority = priority;
    request.location = root.children;
    request.parentHeights = std::make_shared<const Steps>(root.heights);
    return request;
}

void submit(Pager& pager, const PagingRequest& request) {
    pager.withQueue([&](PagingQueue& queue) { queue.submit(request); });
}

// Longer than any machine takes; a test that waits so long fails.
std::chrono::steady_clock::time_point muchLater() {
    return std::chrono::steady_clock::now() + 60s;
}

Result<SiblingBlock> loadFake(const ChunkId& parent, BlockLocation location, StepsView heights) {
    return fakePyramid().load(parent, location, heights);
}

TEST(Pager, LoadsWhatIsAskedFor) {
    Pager pager({loadFake}, 1);
    submit(pager, rootRequest(Face::NegY));
    ASSERT_TRUE(pager.waitForFinished(muchLater()));
    const auto load = pager.takeFinished();
    ASSERT_TRUE(load && load->block);
    EXPECT_EQ(load->request.parent, (ChunkId{Face::NegY, 0, 0, 0}));
    EXPECT_GE(load->seconds, 0);
    for (int q = 0; q < quadrantCount; ++q) {
        const ChunkData& child = std::get<SiblingBlock>(*load->block)[static_cast<std::size_t>(q)];
        EXPECT_EQ(child.heights, fakePyramid().at(childOf(load->request.parent, q)).heights);
    }
    EXPECT_FALSE(pager.takeFinished());
    EXPECT_TRUE(pager.status().idle());
}

TEST(Pager, OneLoaderTakesTheMostUrgentFirst) {
    Gate gate;
    Pager pager({[&](const ChunkId& parent, BlockLocation location, StepsView heights) {
                    gate.pass();
                    return loadFake(parent, location, heights);
                }},
                1);
    submit(pager, rootRequest(Face::PosX));
    gate.waitForArrivals(1);  // its loader is busy: the others are put in order behind it
    pager.withQueue([](PagingQueue& queue) {
        for (const Face face : {Face::NegX, Face::PosY, Face::NegY}) {
            queue.submit(rootRequest(face, static_cast<double>(face)));
        }
    });
    EXPECT_EQ(pager.status().queued, 3u);
    EXPECT_EQ(pager.status().loading, 1u);
    gate.open();
    std::vector<Face> order;
    while (order.size() < 4) {
        ASSERT_TRUE(pager.waitForFinished(muchLater()));
        while (const auto load = pager.takeFinished()) order.push_back(load->request.parent.face);
    }
    EXPECT_THAT(order, testing::ElementsAre(Face::PosX, Face::NegY, Face::PosY, Face::NegX));
}

TEST(Pager, waitingForSeveralLoadsEndsWithTheLastOfThem) {
    Pager pager({loadFake}, 1);
    pager.setPaused(true);
    for (const Face face : {Face::NegX, Face::PosY, Face::NegY}) submit(pager, rootRequest(face));
    for (int i = 0; i < 3; ++i) pager.loadOne();
    EXPECT_TRUE(pager.waitForFinished(muchLater(), 3));
    EXPECT_EQ(pager.status().finished, 3u);
}

TEST(Pager, waitingForMoreLoadsThanThereAreEndsWithTheLastOne) {
    Pager pager({loadFake}, 2);
    for (const Face face : {Face::NegX, Face::PosY, Face::NegY}) submit(pager, rootRequest(face));
    EXPECT_TRUE(pager.waitForFinished(muchLater(), 100));
    EXPECT_EQ(pager.status().finished, 3u);
}

// Loads three faces, and takes the first load.
void loadThreeAndTakeOne(Pager& pager) {
    for (const Face face : {Face::PosX, Face::NegX, Face::PosY})
        submit(pager, rootRequest(face, -static_cast<double>(face)));
    ASSERT_TRUE(pager.waitForFinished(muchLater(), 3));
    ASSERT_TRUE(pager.takeFinished());
    EXPECT_EQ(pager.status().finished, 2u);
}

TEST(Pager, finishedLoadsCountUntilTheyAreTaken) {
    Pager pager({loadFake}, 1);
    loadThreeAndTakeOne(pager);
    EXPECT_TRUE(pager.waitForFinished(muchLater(), 2));
    EXPECT_TRUE(pager.waitForFinished(muchLater(), 100));  // although no loader has anything to do
    submit(pager, rootRequest(Face::NegY));
    EXPECT_TRUE(pager.waitForFinished(muchLater(), 3));
    EXPECT_EQ(pager.status().finished, 3u);
    std::vector<Face> order;
    while (const auto load = pager.takeFinished()) order.push_back(load->request.parent.face);
    EXPECT_EQ(order.back(), Face::NegY);
    EXPECT_EQ(order.size(), 3u);
    EXPECT_TRUE(pager.status().idle());
}

TEST(Pager, abandonedReadsIncludeTheLoadsThatWereNotTaken) {
    Pager pager({loadFake}, 1);
    loadThreeAndTakeOne(pager);
    EXPECT_EQ(pager.abandonReads().size(), 2u);
    EXPECT_TRUE(pager.status().idle());
    EXPECT_FALSE(pager.takeFinished());
}

TEST(Pager, SeveralLoadersReadAtOnce) {
    Gate gate;
    Pager pager({[&](const ChunkId& parent, BlockLocation location, StepsView heights) {
                    gate.pass();
                    return loadFake(parent, location, heights);
                }},
                3);
    for (const Face face : {Face::NegX, Face::PosY, Face::NegY}) submit(pager, rootRequest(face));
    gate.waitForArrivals(3);  // would never come with fewer
    EXPECT_EQ(pager.status().loading, 3u);
    gate.open();
}

TEST(Pager, PageOutsAreLeftAlone) {
    Pager pager({loadFake}, 2);
    PagingRequest request = rootRequest(Face::PosX);
    request.type = PagingType::PageOut;
    submit(pager, request);
    submit(pager, rootRequest(Face::PosZ));
    ASSERT_TRUE(pager.waitForFinished(muchLater()));
    EXPECT_EQ(pager.takeFinished()->request.parent.face, Face::PosZ);
    EXPECT_EQ(pager.withQueue([](PagingQueue& queue) { return queue.count(PagingType::PageOut); }), 1u);
}

TEST(Pager, WaitingForNothingReturnsAtOnce) {
    Pager pager({loadFake}, 1);
    EXPECT_FALSE(pager.waitForFinished(muchLater()));
}

TEST(Pager, ALoaderThatThrowsIsAnError) {
    Pager pager({[](const ChunkId&, BlockLocation, StepsView) -> Result<SiblingBlock> {
                    throw std::runtime_error("the disk is gone");
                }},
                1);
    submit(pager, rootRequest(Face::PosZ));
    ASSERT_TRUE(pager.waitForFinished(muchLater()));
    const auto load = pager.takeFinished();
    ASSERT_FALSE(load->block);
    EXPECT_THAT(load->block.error().message, testing::HasSubstr("z_pos/0/0/0"));
    EXPECT_THAT(load->block.error().message, testing::HasSubstr("the disk is gone"));
}

TEST(Pager, EndsWithWorkLeftUndone) {
    std::atomic<int> loads = 0;
    for (int round = 0; round < 200; ++round) {
        Pager pager({[&](const ChunkId& parent, BlockLocation location, StepsView heights) {
                        ++loads;
                        return loadFake(parent, location, heights);
                    }},
                    1 + round % 4);
        for (const Face face : allFaces) {
            if (round % 3 != 0) submit(pager, rootRequest(face));
        }
        if (round % 5 == 0) pager.waitForFinished(muchLater());
    }
    EXPECT_GT(loads, 0);
}

TEST(Pager, ManyRequestsFromManyRoundsAllFinishOnce) {
    Pager pager({loadFake}, 4);
    int finished = 0;
    for (int round = 0; round < 300; ++round) {
        for (const Face face : allFaces) submit(pager, rootRequest(face));
        while (!pager.status().idle()) {
            pager.waitForFinished(muchLater());
            while (const auto load = pager.takeFinished()) {
                EXPECT_TRUE(load->block);
                ++finished;
            }
        }
    }
    const auto counters = pager.withQueue([](PagingQueue& queue) { return queue.counters(); });
    EXPECT_EQ(static_cast<std::uint64_t>(finished), counters.added[0]);
    EXPECT_EQ(counters.added[0] + counters.merged, 300u * 6);
}

// A loader that waits at a gate and then loads.
LoadChildren through(Gate& gate) {
    return [&gate](const ChunkId& parent, BlockLocation location, StepsView heights) {
        gate.pass();
        return loadFake(parent, location, heights);
    };
}

// All that are still to come, in the order they finish.
std::vector<FinishedLoad> takeAll(Pager& pager) {
    std::vector<FinishedLoad> all;
    while (!pager.status().idle()) {
        if (!pager.waitForFinished(muchLater())) break;
        while (auto load = pager.takeFinished()) all.push_back(std::move(*load));
    }
    return all;
}

TEST(Pager, MoreThreadsStartAtOnceAndFewerWaitForNoRead) {
    Gate gate;
    Pager pager({through(gate)}, 1);
    for (const Face face : allFaces) submit(pager, rootRequest(face));
    gate.waitForArrivals(1);
    pager.setThreads(4);
    gate.waitForArrivals(4);
    EXPECT_EQ(pager.status().loading, 4u);
    pager.setThreads(1);  // returns though four are being read
    EXPECT_EQ(pager.status().loading, 4u);
    EXPECT_EQ(pager.status().queued, 2u);
    gate.open();
    EXPECT_EQ(takeAll(pager).size(), 6u);
}

TEST(Pager, LoadersSentHomeTakeNothingMore) {
    Gate gate;
    std::atomic<int> reading = 0;
    std::atomic<int> most = 0;
    Pager pager({[&](const ChunkId& parent, BlockLocation location, StepsView heights) {
                    const int now = ++reading;
                    most = std::max<int>(most, now);
                    gate.pass();
                    auto block = loadFake(parent, location, heights);
                    --reading;
                    return block;
                }},
                4);
    for (const Face face : {Face::PosX, Face::NegX, Face::PosY, Face::NegY}) submit(pager, rootRequest(face));
    gate.waitForArrivals(4);
    pager.setThreads(1);
    gate.open();
    EXPECT_EQ(takeAll(pager).size(), 4u);
    most = 0;
    for (int round = 0; round < 50; ++round) {
        for (const Face face : allFaces) submit(pager, rootRequest(face));
        EXPECT_EQ(takeAll(pager).size(), 6u);
    }
    EXPECT_EQ(most, 1);
}

TEST(Pager, ThreadsMayChangeAtAnyMoment) {
    Pager pager({loadFake}, 1);
    std::size_t finished = 0;
    std::size_t submitted = 0;
    for (int round = 0; round < 200; ++round) {
        pager.setThreads(1 + round * 7 % 5);
        for (const Face face : allFaces) submit(pager, rootRequest(face));
        if (round % 3 == 0) pager.setThreads(1 + round % 4);
        finished += takeAll(pager).size();
        submitted += 6;
    }
    EXPECT_EQ(finished, submitted);
}

TEST(Pager, PausedItTakesNothingButWhatIsLetThrough) {
    Pager pager({loadFake}, 3);
    pager.setPaused(true);
    pager.loadOne();  // nothing to let through, and nothing kept for later
    for (const Face face : allFaces) submit(pager, rootRequest(face, static_cast<double>(face)));
    EXPECT_TRUE(pager.status().held);
    EXPECT_TRUE(pager.status().atRest());
    EXPECT_FALSE(pager.waitForFinished(muchLater()));
    EXPECT_EQ(pager.status().queued, 6u);
    for (int i = 0; i < 2; ++i) {
        pager.loadOne();
        ASSERT_TRUE(pager.waitForFinished(muchLater()));
        EXPECT_EQ(pager.takeFinished()->request.parent.face, allFaces[static_cast<std::size_t>(5 - i)]);
        EXPECT_FALSE(pager.waitForFinished(muchLater()));
        EXPECT_EQ(pager.status().queued, static_cast<std::uint32_t>(5 - i));
    }
    pager.setPaused(false);
    EXPECT_EQ(takeAll(pager).size(), 4u);
}

TEST(Pager, SaysWhatIsBeingRead) {
    Gate gate;
    Pager pager({through(gate)}, 2);
    EXPECT_TRUE(pager.loadingNow().empty());
    submit(pager, rootRequest(Face::NegX, 7));
    gate.waitForArrivals(1);
    submit(pager, rootRequest(Face::PosZ, 9));
    gate.waitForArrivals(2);
    const std::vector<LoadInProgress> loading = pager.loadingNow();
    ASSERT_EQ(loading.size(), 2u);
    EXPECT_EQ(loading[0].parent.face, Face::NegX);
    EXPECT_EQ(loading[0].priority, 7);
    EXPECT_EQ(loading[0].bytes, rootRequest(Face::NegX).location.size);
    EXPECT_GE(loading[0].seconds, loading[1].seconds);
    gate.open();
    takeAll(pager);
    EXPECT_TRUE(pager.loadingNow().empty());
}

TEST(Pager, ABadDiskFailsReadsAndSaysThatItDoes) {
    std::atomic<int> reads = 0;
    Pager pager({[&](const ChunkId& parent, BlockLocation location, StepsView heights) {
                    ++reads;
                    return loadFake(parent, location, heights);
                }},
                1);
    pager.setBadDisk({.failureRate = 1, .seed = 42});
    submit(pager, rootRequest(Face::PosZ));
    const auto loads = takeAll(pager);
    ASSERT_EQ(loads.size(), 1u);
    ASSERT_FALSE(loads[0].block);
    EXPECT_EQ(loads[0].block.error().message, "z_pos/0/0/0: injected read failure (seed 42)");
    EXPECT_EQ(loads[0].bytes, 0u);
    EXPECT_EQ(reads, 0);
}

// Which of the six faces fail in a round.
std::vector<bool> failuresOfARound(Pager& pager) {
    for (const Face face : allFaces) submit(pager, rootRequest(face));
    std::vector<bool> fails(6);
    for (const FinishedLoad& load : takeAll(pager)) {
        fails[static_cast<std::size_t>(load.request.parent.face)] = !load.block;
    }
    return fails;
}

TEST(Pager, TheSameSeedFailsTheSameReadsHoweverManyThreads) {
    const BadDiskSettings settings{.failureRate = 0.5, .seed = 5};
    std::vector<std::vector<bool>> rounds;
    {
        Pager pager({loadFake}, 1);
        pager.setBadDisk(settings);
        for (int round = 0; round < 6; ++round) rounds.push_back(failuresOfARound(pager));
    }
    EXPECT_NE(rounds[0], rounds[1]);  // attempts are counted
    Pager pager({loadFake}, 4);
    pager.setBadDisk(settings);
    for (const auto& round : rounds) EXPECT_EQ(failuresOfARound(pager), round);
    pager.forgetAttempts();
    for (const auto& round : rounds) EXPECT_EQ(failuresOfARound(pager), round);
    for (std::uint32_t attempt = 0; attempt < rounds.size(); ++attempt) {
        for (const Face face : allFaces) {
            EXPECT_EQ(rounds[attempt][static_cast<std::size_t>(face)],
                      diskFault(settings, ChunkId{face, 0, 0, 0}, attempt, 100).fails);
        }
    }
}

TEST(Pager, ABadDiskServesInItsOwnOrder) {
    const BadDiskSettings settings{.shuffledOrder = true, .seed = 3};
    Pager pager({loadFake}, 1);
    pager.setBadDisk(settings);
    pager.setPaused(true);
    for (const Face face : allFaces) submit(pager, rootRequest(face, static_cast<double>(face)));
    pager.setPaused(false);
    std::vector<ChunkId> order;
    for (const FinishedLoad& load : takeAll(pager)) order.push_back(load.request.parent);
    std::vector<ChunkId> expected = order;
    std::sort(expected.begin(), expected.end(), [&](const ChunkId& a, const ChunkId& b) {
        return shuffledPlace(settings, a) < shuffledPlace(settings, b);
    });
    EXPECT_EQ(order, expected);
    std::vector<ChunkId> byUrgency = order;
    std::sort(byUrgency.begin(), byUrgency.end(), std::greater<>());
    EXPECT_NE(order, byUrgency);
}

TEST(Pager, ALoadTakesAsLongAsTheBadDiskWants) {
    Pager pager({loadFake}, 1);
    const BadDiskSettings settings{.latencyMs = 4, .bandwidthMBs = 0.05};  // 100 bytes take 2 ms
    pager.setBadDisk(settings);
    submit(pager, rootRequest(Face::PosX));
    const auto loads = takeAll(pager);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_TRUE(loads[0].block);
    EXPECT_GE(loads[0].seconds, diskFault(settings, loads[0].request.parent, 0, 100).waitS);
    EXPECT_EQ(loads[0].bytes, 100u);
}

// A day a read: a test that has to wait for one fails.
constexpr BadDiskSettings stuckDisk{.latencyMs = 10'000, .bandwidthMBs = 1e-12};

TEST(Pager, SwitchingTheLatencyOffFreesWhoeverWaits) {
    Pager pager({loadFake}, 2);
    pager.setBadDisk(stuckDisk);
    for (const Face face : allFaces) submit(pager, rootRequest(face));
    while (pager.status().loading < 2) std::this_thread::yield();
    EXPECT_EQ(pager.status().finished, 0u);
    pager.setBadDisk({});
    const auto loads = takeAll(pager);
    EXPECT_EQ(loads.size(), 6u);
    for (const FinishedLoad& load : loads) EXPECT_TRUE(load.block);
}

TEST(Pager, WhoeverWaitsFollowsTheBadDisksNewWord) {
    Pager pager({loadFake}, 1);
    pager.setBadDisk(stuckDisk);
    submit(pager, rootRequest(Face::PosY));
    while (pager.status().loading < 1) std::this_thread::yield();
    pager.setBadDisk({.failureRate = 1});
    const auto loads = takeAll(pager);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_FALSE(loads[0].block);
}

TEST(Pager, EndsWhileABadDiskKeepsItWaiting) {
    Pager pager({loadFake}, 4);
    pager.setBadDisk(stuckDisk);
    for (const Face face : allFaces) submit(pager, rootRequest(face));
    while (pager.status().loading < 4) std::this_thread::yield();
    pager.setThreads(2);
}

}  // namespace
}  // namespace planet
