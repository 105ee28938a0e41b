// The ranks of a job as threads of one process, for tests.
#pragma once

#include <barrier>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "planet/bake/job/ranks.h"

namespace planet::test {

// The state that the threads share.
struct RankHub {
    explicit RankHub(int count)
        : boxes(static_cast<std::size_t>(count)), exchanged(boxes.size()), barrier(count) {}

    std::mutex mutex;  // guards boxes
    std::vector<std::deque<RankMessage>> boxes;
    std::vector<std::vector<std::vector<std::byte>>> exchanged;  // by sender, between two barriers
    std::barrier<> barrier;
};

class ThreadRank final : public Ranks {
public:
    ThreadRank(RankHub& hub, int rank) : hub_(hub), rank_(rank) {}

    int rank() const override { return rank_; }
    int count() const override { return static_cast<int>(hub_.boxes.size()); }

    void send(int to, std::span<const std::byte> bytes) override {
        const std::lock_guard lock(hub_.mutex);
        hub_.boxes[static_cast<std::size_t>(to)].push_back({rank_, {bytes.begin(), bytes.end()}});
    }
    std::optional<RankMessage> receive() override {
        const std::lock_guard lock(hub_.mutex);
        auto& box = hub_.boxes[static_cast<std::size_t>(rank_)];
        if (box.empty()) return std::nullopt;
        RankMessage message = std::move(box.front());
        box.pop_front();
        return message;
    }

    std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> toEach) override {
        const auto own = static_cast<std::size_t>(rank_);
        hub_.exchanged[own] = std::move(toEach);
        hub_.barrier.arrive_and_wait();
        std::vector<std::vector<std::byte>> fromEach;
        for (const auto& messages : hub_.exchanged) fromEach.push_back(messages[own]);
        hub_.barrier.arrive_and_wait();
        return fromEach;
    }
    std::uint64_t sumBefore(std::uint64_t value) override {
        std::vector<std::byte> bytes(sizeof(value));
        std::memcpy(bytes.data(), &value, sizeof(value));
        std::uint64_t sum = 0;
        const auto all = exchange(std::vector(hub_.boxes.size(), bytes));
        for (int rank = 0; rank < rank_; ++rank) {
            std::memcpy(&value, all[static_cast<std::size_t>(rank)].data(), sizeof(value));
            sum += value;
        }
        return sum;
    }

private:
    RankHub& hub_;
    int rank_;
};

// Runs a function on some ranks at the same time, and returns what each has returned.
template <class Work>
auto onRanks(int count, const Work& work) {
    RankHub hub(count);
    std::vector<std::optional<decltype(work(std::declval<Ranks&>()))>> results(
        static_cast<std::size_t>(count));
    std::vector<std::thread> threads;
    for (int rank = 0; rank < count; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadRank own(hub, rank);
            results[static_cast<std::size_t>(rank)].emplace(work(own));
        });
    }
    for (std::thread& thread : threads) thread.join();
    return results;
}

}  // namespace planet::test
