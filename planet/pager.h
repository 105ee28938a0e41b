// The loader threads: they take page-ins from the paging queue, best first, read and decode them, and leave
// what they loaded in a list for the owning thread.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

#include "planet/chunk_file.h"
#include "planet/paging_queue.h"
#include "planet/result.h"

namespace planet {

using SiblingBlock = std::array<ChunkData, quadrantCount>;

// Reads the four children of a chunk, as ChunkFile::readChildren does. Called from loader threads, several at
// once.
using LoadChildren = std::function<Result<SiblingBlock>(const ChunkId& parent, BlockLocation location,
                                                        std::span<const std::int16_t> parentHeights)>;

struct FinishedLoad {
    PagingRequest request;  // as it was when a loader took it
    Result<SiblingBlock> children;
    double seconds = 0;  // reading and decoding
};

struct PagerStatus {
    std::uint32_t queued = 0;   // page-ins waiting for a loader
    std::uint32_t loading = 0;  // taken by a loader and not yet finished
    std::uint32_t finished = 0;

    bool idle() const { return queued + loading + finished == 0; }
};

class Pager {
public:
    // threads: [1, 64].
    Pager(LoadChildren load, int threads);
    // Lets the blocks being read come to their end and drops everything else.
    ~Pager();
    Pager(const Pager&) = delete;
    Pager& operator=(const Pager&) = delete;

    // Calls edit(PagingQueue&) while no loader touches the queue, and wakes the loaders. Keep it short.
    template <class Edit>
    auto withQueue(Edit&& edit) {
        // Destroyed in reverse: the lock is gone before the loaders wake.
        const Wake wake{workArrived_};
        const std::lock_guard lock(mutex_);
        return edit(queue_);
    }

    // The finished loads in the order they finished, one a call.
    std::optional<FinishedLoad> takeFinished();

    // Waits until a load is finished, but not past a moment, nor while there is nothing to wait for. True if
    // one is.
    bool waitForFinished(std::chrono::steady_clock::time_point until);

    PagerStatus status() const;

private:
    struct Wake {
        std::condition_variable_any& condition;
        ~Wake() { condition.notify_all(); }
    };

    void runLoader(const std::stop_token& stop);
    PagerStatus statusLocked() const;

    const LoadChildren load_;
    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable_any workArrived_;
    std::condition_variable_any loadFinished_;
    PagingQueue queue_;
    std::deque<FinishedLoad> finished_;
    std::uint32_t loading_ = 0;
    std::vector<std::jthread> loaders_;  // last: joined before the rest goes
};

}  // namespace planet
