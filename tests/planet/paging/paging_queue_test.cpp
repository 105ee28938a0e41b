#include "planet/paging/paging_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace planet {
namespace {

ChunkId chunkNumber(std::uint32_t number) {
    return {allFaces[number % 6], 7, number / 6, 3};
}

PagingRequest makeRequest(std::uint32_t number, PagingType type, double priority, std::uint64_t frame = 0) {
    PagingRequest request;
    request.parent = chunkNumber(number);
    request.type = type;
    request.priority = priority;
    request.renewedFrame = frame;
    return request;
}

TEST(PagingQueue, TheMostUrgentComesFirst) {
    PagingQueue queue;
    queue.submit(makeRequest(1, PagingType::PageIn, 2));
    queue.submit(makeRequest(2, PagingType::PageIn, 5));
    queue.submit(makeRequest(3, PagingType::PageOut, 9));
    queue.submit(makeRequest(4, PagingType::PageIn, 3));
    EXPECT_EQ(queue.best(PagingType::PageIn)->parent, chunkNumber(2));
    EXPECT_EQ(queue.worst(PagingType::PageIn)->parent, chunkNumber(1));
    EXPECT_EQ(queue.popBest(PagingType::PageIn)->parent, chunkNumber(2));
    EXPECT_EQ(queue.popBest(PagingType::PageIn)->parent, chunkNumber(4));
    EXPECT_EQ(queue.popBest(PagingType::PageIn)->parent, chunkNumber(1));
    EXPECT_FALSE(queue.popBest(PagingType::PageIn));
    EXPECT_EQ(queue.best(PagingType::PageIn), nullptr);
    EXPECT_EQ(queue.popBest(PagingType::PageOut)->parent, chunkNumber(3));
}

TEST(PagingQueue, AskingAgainInTheSameFrameRaisesThePriorityAndNeverLowersIt) {
    PagingQueue queue;
    queue.submit(makeRequest(1, PagingType::PageIn, 2));
    queue.submit(makeRequest(2, PagingType::PageIn, 3));
    EXPECT_EQ(queue.submit(makeRequest(1, PagingType::PageIn, 5)), SubmitOutcome::Merged);
    EXPECT_EQ(queue.submit(makeRequest(2, PagingType::PageIn, 1)), SubmitOutcome::Merged);
    EXPECT_EQ(queue.count(PagingType::PageIn), 2u);
    EXPECT_EQ(queue.find(chunkNumber(1))->priority, 5);
    EXPECT_EQ(queue.find(chunkNumber(2))->priority, 3);
    EXPECT_EQ(queue.best(PagingType::PageIn)->parent, chunkNumber(1));
}

PagingRequest makeUrgent(std::uint32_t number, PagingUrgency urgency, double priority,
                         std::uint64_t frame = 0) {
    PagingRequest request = makeRequest(number, PagingType::PageIn, priority, frame);
    request.urgency = urgency;
    return request;
}

TEST(PagingQueue, PrefetchesComeAfterAllThatIsWanted) {
    PagingQueue queue;
    queue.submit(makeUrgent(1, PagingUrgency::Prefetch, 1000));
    queue.submit(makeUrgent(2, PagingUrgency::Passing, 100));
    queue.submit(makeUrgent(3, PagingUrgency::Lasting, 1));
    EXPECT_EQ(queue.prefetches(), 1u);
    EXPECT_EQ(queue.worst(PagingType::PageIn)->parent, chunkNumber(1));
    for (const std::uint32_t number : {3u, 2u, 1u})
        EXPECT_EQ(queue.popBest(PagingType::PageIn)->parent, chunkNumber(number));
    EXPECT_EQ(queue.prefetches(), 0u);
}

TEST(PagingQueue, APrefetchThatIsWantedIsNoPrefetchAnyMore) {
    PagingQueue queue;
    queue.submit(makeUrgent(1, PagingUrgency::Prefetch, 9, 5));
    queue.submit(makeUrgent(2, PagingUrgency::Prefetch, 8, 5));
    queue.submit(makeUrgent(2, PagingUrgency::Lasting, 1, 5));  // in the same frame
    EXPECT_EQ(queue.best(PagingType::PageIn)->parent, chunkNumber(2));
    EXPECT_EQ(queue.prefetches(), 1u);
    queue.submit(makeUrgent(2, PagingUrgency::Prefetch, 1, 6));  // no longer wanted
    EXPECT_EQ(queue.best(PagingType::PageIn)->parent, chunkNumber(1));
    EXPECT_EQ(queue.prefetches(), 2u);
}

TEST(PagingQueue, ShuffledOrderLeavesPrefetchesLast) {
    PagingQueue queue;
    queue.submit(makeUrgent(1, PagingUrgency::Prefetch, 1));
    queue.submit(makeUrgent(2, PagingUrgency::Lasting, 1));
    queue.submit(makeUrgent(3, PagingUrgency::Lasting, 2));
    const auto placeOf = [](const BlockId& block) -> std::uint64_t {
        return block == chunkNumber(1) ? 0 : block == chunkNumber(2) ? 1 : 2;
    };
    for (const std::uint32_t number : {2u, 3u, 1u})
        EXPECT_EQ(queue.popFirst(PagingType::PageIn, placeOf)->parent, chunkNumber(number));
}

TEST(PagingQueue, AskingInALaterFrameSetsThePriority) {
    PagingQueue queue;
    PagingRequest request = makeRequest(1, PagingType::PageIn, 5, 10);
    request.viewPriority = {5, 2};
    queue.submit(request);
    queue.submit(makeRequest(2, PagingType::PageIn, 3, 10));
    request = makeRequest(1, PagingType::PageIn, 2, 11);
    request.viewPriority = {0, 2};
    EXPECT_EQ(queue.submit(request), SubmitOutcome::Merged);
    EXPECT_EQ(queue.best(PagingType::PageIn)->parent, chunkNumber(2));
    EXPECT_EQ(queue.find(chunkNumber(1))->priority, 2);
    EXPECT_EQ(queue.find(chunkNumber(1))->viewPriority, (std::array<float, maxViews>{0, 2}));
    EXPECT_EQ(queue.find(chunkNumber(1))->timesAsked, 2u);
}

TEST(PagingQueue, ViewsThatAskInTheSameFrameKeepAPriorityEach) {
    PagingQueue queue;
    PagingRequest request = makeRequest(1, PagingType::PageIn, 5, 10);
    request.viewPriority = {5, 0};
    queue.submit(request);
    request.priority = 3;
    request.viewPriority = {0, 3};
    queue.submit(request);
    EXPECT_EQ(queue.find(chunkNumber(1))->priority, 5);
    EXPECT_EQ(queue.find(chunkNumber(1))->viewPriority, (std::array<float, maxViews>{5, 3}));
}

TEST(PagingQueue, WhatIsFirstInAnotherOrderCanBeServedFirst) {
    PagingQueue queue;
    for (std::uint32_t i = 0; i < 5; ++i) queue.submit(makeRequest(i, PagingType::PageIn, i));
    const auto byFace = [](const BlockId& id) {
        return static_cast<std::uint64_t>((id.parent.face == Face::NegY));
    };
    // Of those with the same place the first in order of parent.
    EXPECT_EQ(queue.popFirst(PagingType::PageIn, byFace)->parent, chunkNumber(0));
    const auto reversed = [](const BlockId& id) { return 100 - static_cast<std::uint64_t>(id.parent.face); };
    EXPECT_EQ(queue.popFirst(PagingType::PageIn, reversed)->parent, chunkNumber(4));
    EXPECT_EQ(queue.pop(chunkNumber(2))->parent, chunkNumber(2));
    EXPECT_FALSE(queue.pop(chunkNumber(2)));
    EXPECT_FALSE(queue.popFirst(PagingType::PageOut, reversed));
    EXPECT_EQ(queue.count(PagingType::PageIn), 2u);
    EXPECT_EQ(queue.counters().popped[0], 3u);
    EXPECT_EQ(queue.counters().withdrawn, 0u);
}

TEST(PagingQueue, OppositeRequestsCancelEachOther) {
    PagingQueue queue;
    queue.submit(makeRequest(1, PagingType::PageOut, 2));
    EXPECT_EQ(queue.submit(makeRequest(1, PagingType::PageIn, 5)), SubmitOutcome::Opposed);
    EXPECT_EQ(queue.count(PagingType::PageOut), 0u);
    EXPECT_EQ(queue.count(PagingType::PageIn), 0u);
    EXPECT_EQ(queue.find(chunkNumber(1)), nullptr);
    EXPECT_EQ(queue.submit(makeRequest(1, PagingType::PageIn, 5)), SubmitOutcome::Added);
    EXPECT_EQ(queue.submit(makeRequest(1, PagingType::PageOut, 5)), SubmitOutcome::Opposed);
    EXPECT_EQ(queue.counters().opposed, 2u);
    EXPECT_EQ(queue.counters().cancelled, (std::array<std::uint64_t, 2>{1, 1}));
}

TEST(PagingQueue, WhatIsNotAskedForAgainIsCancelled) {
    PagingQueue queue;
    queue.submit(makeRequest(1, PagingType::PageIn, 1, 10));
    queue.submit(makeRequest(2, PagingType::PageIn, 2, 10));
    queue.submit(makeRequest(3, PagingType::PageOut, 2, 10));
    queue.submit(makeRequest(2, PagingType::PageIn, 0, 11));
    const auto cancelled = queue.cancelNotRenewed(PagingType::PageIn, 11);
    ASSERT_EQ(cancelled.size(), 1u);
    EXPECT_EQ(cancelled[0].parent, chunkNumber(1));
    EXPECT_NE(queue.find(chunkNumber(2)), nullptr);
    EXPECT_NE(queue.find(chunkNumber(3)), nullptr);
    ASSERT_TRUE(queue.cancel(chunkNumber(3)));
    EXPECT_EQ(queue.counters().cancelled, (std::array<std::uint64_t, 2>{1, 1}));  // by type
}

TEST(PagingQueue, ARequestKeepsWhatItCarries) {
    PagingQueue queue;
    PagingRequest request = makeRequest(1, PagingType::PageIn, 1);
    request.location = {77, 5};
    request.askedAtS = 3.5;
    request.ticket = 4;
    request.parentHeights = std::make_shared<const Steps>(std::vector<std::int16_t>(9));
    queue.submit(request);
    queue.submit(makeRequest(1, PagingType::PageIn, 8));  // says only that it is still wanted
    const auto popped = queue.popBest(PagingType::PageIn);
    EXPECT_EQ(popped->location, request.location);
    EXPECT_EQ(popped->askedAtS, 3.5);
    EXPECT_EQ(popped->ticket, 4u);
    EXPECT_EQ(popped->parentHeights, request.parentHeights);
}

// The rules again, without any thought for speed: one list in the order of arrival.
struct SimpleQueue {
    std::vector<PagingRequest> requests;
    PagingQueueCounters counters;

    static bool before(const PagingRequest& a, const PagingRequest& b) {
        if (a.urgency != b.urgency) return a.urgency < b.urgency;
        return a.priority != b.priority ? a.priority > b.priority : a.parent < b.parent;
    }
    auto at(const ChunkId& parent) {
        return std::find_if(requests.begin(), requests.end(),
                            [&](const PagingRequest& request) { return request.parent == parent; });
    }
    SubmitOutcome submit(const PagingRequest& request) {
        const auto same = at(request.parent);
        if (same == requests.end()) {
            requests.push_back(request);
            ++counters.added[static_cast<std::size_t>(request.type)];
            return SubmitOutcome::Added;
        }
        if (same->type != request.type) {
            requests.erase(same);
            ++counters.opposed;
            return SubmitOutcome::Opposed;
        }
        const bool later = request.renewedFrame > same->renewedFrame;
        same->priority = later ? request.priority : std::max(same->priority, request.priority);
        same->urgency = later ? request.urgency : std::min(same->urgency, request.urgency);
        same->renewedFrame = std::max(same->renewedFrame, request.renewedFrame);
        ++counters.merged;
        return SubmitOutcome::Merged;
    }
    std::vector<PagingRequest> sorted(PagingType type) const {
        std::vector<PagingRequest> found;
        for (const PagingRequest& request : requests) {
            if (request.type == type) found.push_back(request);
        }
        std::sort(found.begin(), found.end(), before);
        return found;
    }
    const PagingRequest* extreme(PagingType type, bool best) const {
        const PagingRequest* found = nullptr;
        for (const PagingRequest& request : requests) {
            if (request.type == type && (!found || before(request, *found) == best)) found = &request;
        }
        return found;
    }
    std::optional<PagingRequest> popBest(PagingType type) {
        const PagingRequest* best = extreme(type, true);
        if (!best) return std::nullopt;
        const PagingRequest popped = *best;
        requests.erase(at(popped.parent));
        ++counters.popped[static_cast<std::size_t>(type)];
        return popped;
    }
    bool cancel(const ChunkId& parent) {
        const auto found = at(parent);
        if (found == requests.end()) return false;
        requests.erase(found);
        ++counters.withdrawn;
        return true;
    }
    std::vector<PagingRequest> cancelNotRenewed(PagingType type, std::uint64_t since) {
        std::vector<PagingRequest> stale = sorted(type);
        std::erase_if(stale, [&](const PagingRequest& request) { return request.renewedFrame >= since; });
        for (const PagingRequest& request : stale) cancel(request.parent);
        return stale;
    }
};

bool same(const PagingRequest& a, const PagingRequest& b) {
    return a.parent == b.parent && a.type == b.type && a.urgency == b.urgency && a.priority == b.priority &&
           a.renewedFrame == b.renewedFrame;
}

bool same(const PagingRequest* a, const PagingRequest* b) {
    return a && b ? same(*a, *b) : a == b;
}

bool same(const std::vector<PagingRequest>& a, const std::vector<PagingRequest>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const PagingRequest& p, const PagingRequest& q) { return same(p, q); });
}

// One random operation on both; false where they differ.
bool operateOnBoth(PagingQueue& queue, SimpleQueue& simple, std::mt19937& random, std::uint64_t frame) {
    const auto type = static_cast<PagingType>(random() % 2);
    const auto number = static_cast<std::uint32_t>(random() % 40);
    const auto kind = random() % 100;
    if (kind < 60) {
        PagingRequest request = makeRequest(number, type, static_cast<double>(random() % 16), frame);
        if (type == PagingType::PageIn) request.urgency = static_cast<PagingUrgency>(random() % 3);
        return queue.submit(request) == simple.submit(request);
    }
    if (kind < 80) {
        const auto a = queue.popBest(type);
        const auto b = simple.popBest(type);
        return a && b ? same(*a, *b) : a.has_value() == b.has_value();
    }
    if (kind < 90) {
        return same(queue.best(type), simple.extreme(type, true)) &&
               same(queue.worst(type), simple.extreme(type, false));
    }
    if (kind < 98) return queue.cancel(chunkNumber(number)).has_value() == simple.cancel(chunkNumber(number));
    const std::uint64_t since = frame - random() % 20;
    return same(queue.cancelNotRenewed(type, since), simple.cancelNotRenewed(type, since));
}

TEST(PagingQueue, AMillionRandomOperationsAgreeWithASimpleModel) {
    std::mt19937 random(31);
    PagingQueue queue;
    SimpleQueue simple;
    for (std::uint64_t i = 0; i < 1'000'000; ++i) {
        ASSERT_TRUE(operateOnBoth(queue, simple, random, 100 + i / 8)) << "operation " << i;
        if (i % 64 != 0) continue;
        for (const PagingType type : {PagingType::PageIn, PagingType::PageOut}) {
            ASSERT_TRUE(same(queue.sorted(type), simple.sorted(type))) << "after operation " << i;
        }
        const std::vector<PagingRequest> loads = simple.sorted(PagingType::PageIn);
        ASSERT_EQ(queue.prefetches(), static_cast<std::size_t>(std::ranges::count_if(
                                          loads, [](const auto& load) { return load.isPrefetch(); })));
    }
    EXPECT_EQ(queue.counters().added, simple.counters.added);
    EXPECT_EQ(queue.counters().popped, simple.counters.popped);
    EXPECT_EQ(queue.counters().merged, simple.counters.merged);
    EXPECT_EQ(queue.counters().opposed, simple.counters.opposed);
    EXPECT_EQ(queue.counters().withdrawn, simple.counters.withdrawn);
    for (const std::uint64_t count : {queue.counters().merged, queue.counters().opposed,
                                      queue.counters().withdrawn, queue.counters().popped[1]}) {
        EXPECT_GT(count, 10'000u);
    }
}

}  // namespace
}  // namespace planet
