// The paging queue against the rules of its header written out naively: every sequence of operations up to a
// length, and random ones far beyond. All that can be seen of the queue is compared after each operation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "planet/paging/paging_queue.h"
#include "tests/support/sanitized.h"

namespace planet {
namespace {

bool same(const PagingRequest& a, const PagingRequest& b) {
    return a.parent == b.parent && a.kind == b.kind && a.type == b.type && a.urgency == b.urgency &&
           a.priority == b.priority && a.renewedFrame == b.renewedFrame && a.askedAtS == b.askedAtS &&
           a.timesAsked == b.timesAsked && a.viewPriority == b.viewPriority &&
           a.location.offset == b.location.offset && a.location.size == b.location.size &&
           a.parentHeights == b.parentHeights && a.ticket == b.ticket;
}

bool same(const std::vector<PagingRequest>& a, const std::vector<PagingRequest>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const PagingRequest& x, const PagingRequest& y) { return same(x, y); });
}

bool isBetter(const PagingRequest& a, const PagingRequest& b) {
    return a.priority != b.priority ? a.priority > b.priority : a.block() < b.block();
}

// Requests in the order they came; everything is found by looking at each.
class Model {
public:
    SubmitOutcome submit(const PagingRequest& request) {
        PagingRequest* pending = at(request.block());
        if (!pending) {
            requests_.push_back(request);
            ++counters_.added[static_cast<std::size_t>(request.type)];
            return SubmitOutcome::Added;
        }
        if (pending->type != request.type) {
            remove(request.block());
            ++counters_.opposed;
            return SubmitOutcome::Opposed;
        }
        ++counters_.merged;
        ++pending->timesAsked;
        const bool later = request.renewedFrame > pending->renewedFrame;
        for (std::size_t v = 0; v < maxViews; ++v) {
            const float now = request.viewPriority[v];
            if (later || now > pending->viewPriority[v]) pending->viewPriority[v] = now;
        }
        if (later || request.priority > pending->priority) pending->priority = request.priority;
        if (later) pending->renewedFrame = request.renewedFrame;
        return SubmitOutcome::Merged;
    }

    std::optional<PagingRequest> popBest(PagingType type) {
        const std::vector<PagingRequest> order = sorted(type);
        return order.empty() ? std::nullopt : pop(order.front().block());
    }
    std::optional<PagingRequest> pop(const BlockId& block) {
        const PagingRequest* pending = at(block);
        if (!pending) return std::nullopt;
        ++counters_.popped[static_cast<std::size_t>(pending->type)];
        return remove(block);
    }
    template <class PlaceOf>
    std::optional<PagingRequest> popFirst(PagingType type, const PlaceOf& placeOf) {
        std::vector<PagingRequest> order = sorted(type);
        if (order.empty()) return std::nullopt;
        const auto before = [&](const PagingRequest& a, const PagingRequest& b) {
            const std::uint64_t placeA = placeOf(a.block()), placeB = placeOf(b.block());
            return placeA != placeB ? placeA < placeB : a.block() < b.block();
        };
        return pop(std::min_element(order.begin(), order.end(), before)->block());
    }
    std::optional<PagingRequest> cancel(const BlockId& block) {
        if (!at(block)) return std::nullopt;
        ++counters_.withdrawn;
        return remove(block);
    }
    std::vector<PagingRequest> cancelNotRenewed(PagingType type, std::uint64_t sinceFrame) {
        std::vector<PagingRequest> cancelled;
        for (const PagingRequest& request : sorted(type)) {
            if (request.renewedFrame < sinceFrame) cancelled.push_back(*cancel(request.block()));
        }
        return cancelled;
    }

    std::vector<PagingRequest> sorted(PagingType type) const {
        std::vector<PagingRequest> order;
        for (const PagingRequest& request : requests_) {
            if (request.type == type) order.push_back(request);
        }
        std::sort(order.begin(), order.end(), isBetter);
        return order;
    }
    const PagingRequest* find(const BlockId& block) const { return const_cast<Model*>(this)->at(block); }
    const PagingQueueCounters& counters() const { return counters_; }

private:
    PagingRequest* at(const BlockId& block) {
        for (PagingRequest& request : requests_) {
            if (request.block() == block) return &request;
        }
        return nullptr;
    }
    PagingRequest remove(const BlockId& block) {
        PagingRequest removed = *at(block);
        std::erase_if(requests_, [&](const PagingRequest& request) { return request.block() == block; });
        return removed;
    }

    std::vector<PagingRequest> requests_;
    PagingQueueCounters counters_;
};

enum class Do { Submit, NextFrame, PopBest, Pop, PopFirst, Cancel, CancelNotRenewed };

struct Operation {
    Do what = Do::Submit;
    std::size_t block = 0;  // of Submit, Pop and Cancel; of PopFirst whose place is last
    PagingType type = PagingType::PageIn;
    double priority = 0;  // of Submit
};

std::string textOf(const Operation& operation, std::span<const BlockId> blocks) {
    constexpr std::array names = {"submit",   "next frame", "popBest",         "pop",
                                  "popFirst", "cancel",     "cancelNotRenewed"};
    return std::string(names[static_cast<std::size_t>(operation.what)]) + " " +
           (operation.type == PagingType::PageIn ? "in " : "out ") + toString(blocks[operation.block]) + " " +
           std::to_string(operation.priority);
}

// What an operation hands back.
struct Answer {
    std::optional<SubmitOutcome> outcome;
    std::vector<PagingRequest> taken;
};

bool same(const Answer& a, const Answer& b) {
    return a.outcome == b.outcome && same(a.taken, b.taken);
}

struct World {
    std::span<const BlockId> blocks;
    std::uint64_t frame = 1;
    std::uint64_t calls = 0;  // so that no two requests are the same
};

PagingRequest requestOf(const Operation& operation, const World& world) {
    const BlockId& block = world.blocks[operation.block];
    PagingRequest request{.parent = block.parent,
                          .kind = block.kind,
                          .type = operation.type,
                          .priority = operation.priority,
                          .renewedFrame = world.frame,
                          .askedAtS = static_cast<double>(world.calls),
                          .location = {100 * world.calls, 1},
                          .ticket = world.calls};
    // Each priority from a view of its own, so that views are merged too.
    request.viewPriority[static_cast<std::size_t>(operation.priority) % maxViews] =
        static_cast<float>(operation.priority);
    return request;
}

template <class Queue>
Answer applyTo(Queue& queue, const Operation& operation, const World& world) {
    const BlockId& block = world.blocks[operation.block];
    const auto one = [](std::optional<PagingRequest>&& taken) {
        Answer answer;
        if (taken) answer.taken.push_back(*std::move(taken));
        return answer;
    };
    switch (operation.what) {
        case Do::Submit:
            return {queue.submit(requestOf(operation, world)), {}};
        case Do::NextFrame:
            return {};
        case Do::PopBest:
            return one(queue.popBest(operation.type));
        case Do::Pop:
            return one(queue.pop(block));
        case Do::PopFirst:
            return one(queue.popFirst(
                operation.type, [&](const BlockId& id) { return static_cast<std::uint64_t>(id == block); }));
        case Do::Cancel:
            return one(queue.cancel(block));
        case Do::CancelNotRenewed:
            break;
    }
    return {std::nullopt, queue.cancelNotRenewed(operation.type, world.frame)};
}

bool same(const PagingRequest* seen, const PagingRequest* expected) {
    return seen && expected ? same(*seen, *expected) : seen == expected;
}

// Why the two differ; empty: they do not.
std::string difference(const PagingQueue& queue, const Model& model, std::span<const BlockId> blocks) {
    for (const PagingType type : {PagingType::PageIn, PagingType::PageOut}) {
        const std::vector<PagingRequest> order = model.sorted(type);
        const auto last = [&](std::optional<BlockKind> kind) -> const PagingRequest* {
            const auto found = std::find_if(order.rbegin(), order.rend(), [&](const PagingRequest& request) {
                return !kind || request.kind == *kind;
            });
            return found == order.rend() ? nullptr : &*found;
        };
        if (queue.count(type) != order.size()) return "count";
        if (!same(queue.sorted(type), order)) return "sorted";
        if (!same(queue.best(type), order.empty() ? nullptr : &order.front())) return "best";
        if (!same(queue.worst(type), last({}))) return "worst";
        for (const BlockKind kind : {BlockKind::Heights, BlockKind::Colours, BlockKind::Normals}) {
            if (!same(queue.worst(type, kind), last(kind))) return "worst of a kind";
        }
    }
    for (const BlockId& block : blocks) {
        if (!same(queue.find(block), model.find(block))) return "find " + toString(block);
    }
    const PagingQueueCounters &seen = queue.counters(), &expected = model.counters();
    if (seen.added != expected.added || seen.popped != expected.popped || seen.merged != expected.merged ||
        seen.opposed != expected.opposed || seen.withdrawn != expected.withdrawn)
        return "counters";
    return {};
}

// One operation on both; why they differ, or nothing.
std::string step(PagingQueue& queue, Model& model, const Operation& operation, World& world) {
    ++world.calls;
    if (operation.what == Do::NextFrame) ++world.frame;
    const Answer seen = applyTo(queue, operation, world);
    const Answer expected = applyTo(model, operation, world);
    if (!same(seen, expected)) return "what " + textOf(operation, world.blocks) + " gave back";
    return difference(queue, model, world.blocks);
}

// All sequences of an alphabet up to a length, the shared beginnings done once.
struct Search {
    std::vector<Operation> alphabet;
    std::size_t length = 0;
    std::uint64_t sequences = 0;
    std::vector<Operation> soFar{};
    std::string problem{};

    void from(const PagingQueue& queue, const Model& model, const World& world) {
        for (const Operation& operation : alphabet) {
            PagingQueue nextQueue = queue;
            Model nextModel = model;
            World nextWorld = world;
            soFar.push_back(operation);
            ++sequences;
            problem = step(nextQueue, nextModel, operation, nextWorld);
            if (!problem.empty()) {
                for (const Operation& done : soFar) problem += "\n  " + textOf(done, world.blocks);
                return;
            }
            if (soFar.size() < length) from(nextQueue, nextModel, nextWorld);
            if (!problem.empty()) return;
            soFar.pop_back();
        }
    }
};

void trySequences(std::span<const BlockId> blocks, std::vector<Operation> alphabet, std::size_t length) {
    Search search{std::move(alphabet), length};
    search.from({}, {}, {blocks});
    std::cout << search.sequences << " sequences of up to " << length << " operations out of "
              << search.alphabet.size() << "\n";
    testing::Test::RecordProperty("sequences", std::to_string(search.sequences));
    EXPECT_EQ(search.problem, "");
    EXPECT_GT(search.sequences, 10'000u);
}

// Two of heights, and one of colours that has its parent in common with one of those.
const std::array<BlockId, 3> threeBlocks = {
    {{{Face::PosX, 3, 1, 2}}, {{Face::PosX, 3, 1, 2}, BlockKind::Colours}, {{Face::NegZ, 2, 0, 1}}}};

TEST(PagingQueueModel, EveryShortSequenceOfAllOperationsActsAsTheRulesSay) {
    std::vector<Operation> alphabet{{.what = Do::NextFrame}};
    for (const PagingType type : {PagingType::PageIn, PagingType::PageOut}) {
        for (std::size_t block = 0; block < threeBlocks.size(); ++block) {
            alphabet.push_back({Do::Submit, block, type, 1});
            alphabet.push_back({Do::Submit, block, type, 2});
        }
        alphabet.push_back({.what = Do::PopBest, .type = type});
        alphabet.push_back({.what = Do::PopFirst, .block = 1, .type = type});
        alphabet.push_back({.what = Do::CancelNotRenewed, .type = type});
    }
    for (std::size_t block = 0; block < threeBlocks.size(); ++block) {
        alphabet.push_back({.what = Do::Pop, .block = block});
        alphabet.push_back({.what = Do::Cancel, .block = block});
    }
    trySequences(threeBlocks, std::move(alphabet), tests::sanitized ? 3 : 4);
}

TEST(PagingQueueModel, EverySequenceOfFiveOperationsOnTwoBlocksActsAsTheRulesSay) {
    std::vector<Operation> alphabet{{.what = Do::NextFrame},
                                    {.what = Do::Pop, .block = 0},
                                    {.what = Do::Cancel, .block = 1},
                                    {.what = Do::PopFirst, .block = 0}};
    for (const PagingType type : {PagingType::PageIn, PagingType::PageOut}) {
        for (std::size_t block = 0; block < 2; ++block) {
            alphabet.push_back({Do::Submit, block, type, 1});
            alphabet.push_back({Do::Submit, block, type, 2});
        }
        alphabet.push_back({.what = Do::PopBest, .type = type});
        alphabet.push_back({.what = Do::CancelNotRenewed, .type = type});
    }
    trySequences(std::span(threeBlocks).first(2), std::move(alphabet), tests::sanitized ? 4 : 5);
}

// Fewer operations, so that longer sequences can all be tried: priorities that rise and fall over frames.
TEST(PagingQueueModel, EveryLongerSequenceOfAFewOperationsActsAsTheRulesSay) {
    std::vector<Operation> alphabet{{.what = Do::NextFrame},
                                    {.what = Do::PopBest},
                                    {.what = Do::CancelNotRenewed},
                                    {Do::Submit, 0, PagingType::PageIn, 1},
                                    {Do::Submit, 0, PagingType::PageIn, 3},
                                    {Do::Submit, 1, PagingType::PageIn, 2},
                                    {Do::Submit, 0, PagingType::PageOut, 1}};
    trySequences(threeBlocks, std::move(alphabet), tests::sanitized ? 6 : 8);
}

TEST(PagingQueueModel, AHundredThousandRandomOperationsActAsTheRulesSay) {
    std::vector<BlockId> blocks;
    for (std::uint32_t x = 0; x < 8; ++x) {
        for (int kind = 0; kind < blockKindCount; ++kind)
            blocks.emplace_back(ChunkId{Face::PosY, 3, x, 0}, static_cast<BlockKind>(kind));
    }
    constexpr int operations = tests::sanitized ? 20'000 : 100'000;
    std::mt19937 random(20);
    PagingQueue queue;
    Model model;
    World world{blocks};
    std::size_t most = 0;
    for (int i = 0; i < operations; ++i) {
        // Mostly submissions, so that the queue fills and the rest finds something.
        const std::uint32_t draw = static_cast<std::uint32_t>(random() % 32);
        const Do what = draw < 24 ? Do::Submit : static_cast<Do>(1 + draw % 6);
        const Operation operation{what, random() % blocks.size(),
                                  random() % 4 == 0 ? PagingType::PageOut : PagingType::PageIn,
                                  static_cast<double>(random() % 6)};
        ASSERT_EQ(step(queue, model, operation, world), "") << i << ": " << textOf(operation, blocks);
        most = std::max(most, queue.count(PagingType::PageIn) + queue.count(PagingType::PageOut));
    }
    std::cout << operations << " operations, up to " << most << " requests at a time\n";
    RecordProperty("operations", operations);
    EXPECT_GT(most, 10u);
}

}  // namespace
}  // namespace planet
