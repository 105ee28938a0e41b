#include "planet/pager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "tests/fake_pyramid.h"
#include "tests/gate.h"

namespace planet {
namespace {

using namespace std::chrono_literals;

PagingRequest rootRequest(Face face, double priority = 1) {
    const ChunkData& root = fakePyramid().at({face, 0, 0, 0});
    PagingRequest request;
    request.parent = root.id;
    request.priority = priority;
    request.location = root.children;
    request.parentHeights = std::make_shared<const std::vector<std::int16_t>>(root.heights);
    return request;
}

void submit(Pager& pager, const PagingRequest& request) {
    pager.withQueue([&](PagingQueue& queue) { queue.submit(request); });
}

// Longer than any machine takes; a test that waits so long fails.
std::chrono::steady_clock::time_point muchLater() {
    return std::chrono::steady_clock::now() + 60s;
}

Result<SiblingBlock> loadFake(const ChunkId& parent, BlockLocation location,
                              std::span<const std::int16_t> heights) {
    return fakePyramid().load(parent, location, heights);
}

TEST(Pager, LoadsWhatIsAskedFor) {
    Pager pager(loadFake, 1);
    submit(pager, rootRequest(Face::NegY));
    ASSERT_TRUE(pager.waitForFinished(muchLater()));
    const auto load = pager.takeFinished();
    ASSERT_TRUE(load && load->children);
    EXPECT_EQ(load->request.parent, (ChunkId{Face::NegY, 0, 0, 0}));
    EXPECT_GE(load->seconds, 0);
    for (int q = 0; q < quadrantCount; ++q) {
        const ChunkData& child = (*load->children)[static_cast<std::size_t>(q)];
        EXPECT_EQ(child.heights, fakePyramid().at(childOf(load->request.parent, q)).heights);
    }
    EXPECT_FALSE(pager.takeFinished());
    EXPECT_TRUE(pager.status().idle());
}

TEST(Pager, OneLoaderTakesTheMostUrgentFirst) {
    Gate gate;
    Pager pager(
        [&](const ChunkId& parent, BlockLocation location, std::span<const std::int16_t> heights) {
            gate.pass();
            return loadFake(parent, location, heights);
        },
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

TEST(Pager, SeveralLoadersReadAtOnce) {
    Gate gate;
    Pager pager(
        [&](const ChunkId& parent, BlockLocation location, std::span<const std::int16_t> heights) {
            gate.pass();
            return loadFake(parent, location, heights);
        },
        3);
    for (const Face face : {Face::NegX, Face::PosY, Face::NegY}) submit(pager, rootRequest(face));
    gate.waitForArrivals(3);  // would never come with fewer
    EXPECT_EQ(pager.status().loading, 3u);
    gate.open();
}

TEST(Pager, PageOutsAreLeftAlone) {
    Pager pager(loadFake, 2);
    PagingRequest request = rootRequest(Face::PosX);
    request.type = PagingType::PageOut;
    submit(pager, request);
    submit(pager, rootRequest(Face::PosZ));
    ASSERT_TRUE(pager.waitForFinished(muchLater()));
    EXPECT_EQ(pager.takeFinished()->request.parent.face, Face::PosZ);
    EXPECT_EQ(pager.withQueue([](PagingQueue& queue) { return queue.count(PagingType::PageOut); }), 1u);
}

TEST(Pager, WaitingForNothingReturnsAtOnce) {
    Pager pager(loadFake, 1);
    EXPECT_FALSE(pager.waitForFinished(muchLater()));
}

TEST(Pager, ALoaderThatThrowsIsAnError) {
    Pager pager(
        [](const ChunkId&, BlockLocation, std::span<const std::int16_t>) -> Result<SiblingBlock> {
            throw std::runtime_error("the disk is gone");
        },
        1);
    submit(pager, rootRequest(Face::PosZ));
    ASSERT_TRUE(pager.waitForFinished(muchLater()));
    const auto load = pager.takeFinished();
    ASSERT_FALSE(load->children);
    EXPECT_THAT(load->children.error().message, testing::HasSubstr("z_pos/0/0/0"));
    EXPECT_THAT(load->children.error().message, testing::HasSubstr("the disk is gone"));
}

TEST(Pager, EndsWithWorkLeftUndone) {
    std::atomic<int> loads = 0;
    for (int round = 0; round < 200; ++round) {
        Pager pager(
            [&](const ChunkId& parent, BlockLocation location, std::span<const std::int16_t> heights) {
                ++loads;
                return loadFake(parent, location, heights);
            },
            1 + round % 4);
        for (const Face face : allFaces) {
            if (round % 3 != 0) submit(pager, rootRequest(face));
        }
        if (round % 5 == 0) pager.waitForFinished(muchLater());
    }
    EXPECT_GT(loads, 0);
}

TEST(Pager, ManyRequestsFromManyRoundsAllFinishOnce) {
    Pager pager(loadFake, 4);
    int finished = 0;
    for (int round = 0; round < 300; ++round) {
        for (const Face face : allFaces) submit(pager, rootRequest(face));
        while (!pager.status().idle()) {
            pager.waitForFinished(muchLater());
            while (const auto load = pager.takeFinished()) {
                EXPECT_TRUE(load->children);
                ++finished;
            }
        }
    }
    const auto counters = pager.withQueue([](PagingQueue& queue) { return queue.counters(); });
    EXPECT_EQ(static_cast<std::uint64_t>(finished), counters.added[0]);
    EXPECT_EQ(counters.added[0] + counters.merged, 300u * 6);
}

}  // namespace
}  // namespace planet
