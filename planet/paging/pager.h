// The loader threads. They take page-ins from the paging queue, best first, read and decode them, and add the
// results to a list for the owner. One thread owns a pager and makes all calls.
//
// In simulated time no thread reads. Virtual loaders, as many as the threads, take requests when they are
// free and a request is queued. A read lasts as long as diskFault() says, or no time without fault injection.
// It ends when advance() has reached its end, and takeFinished() then reads the block. So the same calls give
// the same loads in the same order on any machine.
//
// Prefetches are read only while nothing else is queued, and take at most a share of the loaders' time. A read that
// lasts d seconds delays the next prefetch until d / (share x loaders) seconds after its own beginning, or after the
// end of the delay before that. So a prefetch that is being read can delay what is wanted by the rest of its own read,
// on its own loader, and by nothing else.
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
#include <unordered_map>
#include <variant>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/paging/disk_simulator.h"
#include "planet/paging/paging_queue.h"
#include "planet/sphere/steps.h"

namespace planet {

using SiblingBlock = std::array<ChunkData, quadrantCount>;
using TileBlock = std::array<TileData, quadrantCount>;
// The kind of the request determines the alternative.
using LoadedBlock = std::variant<SiblingBlock, TileBlock>;

// Reads the four children of a chunk, as ChunkFile::readChildren does. Called from several loader threads at
// once.
using LoadChildren = std::function<Result<SiblingBlock>(const ChunkId& parent, BlockLocation location,
                                                        StepsView parentHeights)>;
// Reads the four children of a tile of colours, as ChunkFile::readColourChildren does.
using LoadColours = std::function<Result<TileBlock>(const ChunkId& parent, BlockLocation location)>;

// Derives the four children of a tile of normals. Called from loader threads.
using LoadNormals = std::function<Result<TileBlock>(const ChunkId& parent)>;

struct BlockLoaders {
    LoadChildren chunks;
    LoadColours colours{};  // unset if no colours are requested
    LoadNormals normals{};  // unset if no normals are requested
};

struct FinishedLoad {
    PagingRequest request;  // as it was when a loader took it
    Result<LoadedBlock> block;
    double seconds = 0;       // reading and decoding, including injected delays
    std::uint32_t bytes = 0;  // of the block in the file; 0 for normals and injected failures
};

// A request that a loader has taken.
struct LoadInProgress {
    ChunkId parent;
    BlockKind kind = BlockKind::Heights;
    bool isPrefetch = false;
    double priority = 0;
    std::uint32_t bytes = 0;
    double seconds = 0;  // since it was taken
};

struct PagerStatus {
    std::uint32_t queued = 0;   // page-ins waiting for a loader
    std::uint32_t loading = 0;  // taken by a loader and not yet finished
    std::uint32_t finished = 0;
    bool held = false;  // paused, and no queued page-in may start

    bool idle() const { return queued + loading + finished == 0; }
    // Returns whether no read is in progress or finished, and no queued request can start.
    bool atRest() const { return loading + finished == 0 && (queued == 0 || held); }
};

inline constexpr int maxLoaderThreads = 64;

// Determines when a read ends.
enum class PagingTime : std::uint8_t {
    Clock,      // loader threads, in real time
    Simulated,  // virtual loaders, by fault injection settings and seed, in the time of advance()
    Recorded,   // calls of take() and finish()
};

class Pager {
public:
    // threads: [1, maxLoaderThreads].
    Pager(BlockLoaders load, int threads);
    // Waits for the blocks being read and discards everything else.
    ~Pager();
    Pager(const Pager&) = delete;
    Pager& operator=(const Pager&) = delete;

    // Calls edit(PagingQueue&) with the queue locked, then wakes the loaders. It must be quick.
    template <class Edit>
    auto withQueue(Edit&& edit) {
        // Destruction runs in reverse order: virtual loaders take requests, the lock is released, the threads
        // wake.
        const Wake wake{workArrived_};
        const std::lock_guard lock(mutex_);
        const VirtualLoaders loaders{*this};
        return edit(queue_);
    }
    // Calls look(const PagingQueue&) with the queue locked; wakes no loader.
    template <class Look>
    auto readQueue(Look&& look) const {
        const std::lock_guard lock(mutex_);
        return look(queue_);
    }

    // Sets the number of loaders without waiting: a surplus loader stops when its read is done.
    void setThreads(int threads);

    // While paused, the loaders take only the requests that loadOne() lets through, one per call. loadOne()
    // does nothing if no request is queued.
    void setPaused(bool paused);
    void loadOne();

    // Sets the share of the loaders' time for prefetches, (0, 1].
    void setPrefetchShare(double share);

    // Sets the injected faults, also for reads that are waiting. The attempts of a block are counted while
    // faults are injected, starting from 0 after each change.
    void setBadDisk(const BadDiskSettings& settings);
    // Resets the attempts to 0, so that the injected faults repeat.
    void forgetAttempts();

    // Sets the paging's time; simulated seconds begin at 0. Abandons the reads in progress and the finished
    // reads that have not been taken: discards their results and returns their requests.
    std::vector<PagingRequest> setTime(PagingTime time);
    // Abandons the same reads without changing the time.
    std::vector<PagingRequest> abandonReads();
    PagingTime time() const;
    // Advances simulated or recorded time by seconds, >= 0.
    void advance(double seconds);
    // Returns the simulated seconds until the next read ends; nothing if none is in progress.
    std::optional<double> untilNextEnd() const;
    // Recorded time: take() starts the read of a queued block, and finish() ends one. They return false if
    // there is no such read. Of several reads of one block, all but the last result are discarded.
    bool take(const BlockId& block);
    // failure: the kind of the failure; unset: the read succeeds.
    bool finish(const BlockId& block, std::optional<ErrorKind> failure, bool last = true);

    // Returns the blocks that were taken since the last call, in order. Call it inside withQueue, so that no
    // block is taken in the meantime.
    std::vector<BlockId> takeTaken(const PagingQueue& lockedQueue);

    // Returns the next finished load, in the order of finishing. Except with PagingTime::Clock, this call
    // reads the block.
    std::optional<FinishedLoad> takeFinished();

    // Waits until `count` loads are finished, `until` has passed, or nothing remains to wait for. Returns whether a
    // load is finished. count: >= 1; fewer are enough if no loader reads and none may begin to.
    bool waitForFinished(std::chrono::steady_clock::time_point until, std::size_t count = 1);

    PagerStatus status() const;
    // Returns the reads in progress, longest first.
    std::vector<LoadInProgress> loadingNow() const;

private:
    using Clock = std::chrono::steady_clock;
    using Lock = std::unique_lock<std::mutex>;
    struct Wake {
        std::condition_variable_any& condition;
        ~Wake() { condition.notify_all(); }
    };
    struct Reading {
        PagingRequest request;
        Clock::time_point since;
    };
    // The reads of virtual loaders, in the order in which they were taken. Times are seconds of the pager's
    // time.
    struct VirtualReading {
        PagingRequest request;
        double sinceS = 0;
        double endS = 0;
        std::optional<ErrorKind> failure{};  // unset: it succeeds
    };
    struct VirtualLoaders {
        Pager& pager;
        ~VirtualLoaders() { pager.startVirtualReads(); }
    };
    struct Loader {
        bool running = false;
        std::optional<Reading> reading;
    };

    void runLoader(std::size_t index, const std::stop_token& stop);
    void serve(std::size_t index, const std::stop_token& stop, Lock& lock);
    bool waitForInjectedDelay(const Reading& reading, const std::stop_token& stop, Lock& lock);
    bool mayTake() const;
    bool hasEnoughFinished() const;
    PagingRequest takeNext();
    double timeS() const;
    double prefetchLoaders() const;
    bool hasLoaderForPrefetch() const;
    void endPrefetch(const PagingRequest& request, double sinceS);
    std::optional<double> nextPrefetchAtS() const;
    void startVirtualReads();
    void endVirtualRead(std::size_t index);
    std::size_t nextVirtualEnd() const;
    DiskFault nextFault(const PagingRequest& request);
    std::vector<PagingRequest> giveUpReads();
    std::optional<FinishedLoad> readFinished(Lock& lock);
    PagerStatus statusLocked() const;
    std::size_t ownedLoads() const;

    const BlockLoaders load_;
    // Finished loads that the owner's thread has taken over all at once, and the first that takeFinished() has not returned
    // yet. With a lock for each, a loader would often find the mutex locked, and sleep. The two vectors of loads swap their
    // memory, so that no thread frees what another one allocates: that would lock the other's heap.
    std::vector<FinishedLoad> handedOver_;
    std::size_t nextHandedOver_ = 0;

    mutable std::mutex mutex_;  // guards the members below, except the threads
    std::condition_variable_any workArrived_;
    std::condition_variable_any loadFinished_;
    std::condition_variable_any badDiskChanged_;
    PagingQueue queue_;
    std::vector<FinishedLoad> finished_;
    std::size_t awaited_ = 1;      // finished loads that the owner waits for
    std::size_t ownedInWait_ = 0;  // of those, the ones that it owned when it began to wait
    std::size_t loadersWanted_ = 0;
    std::array<Loader, maxLoaderThreads> loaders_{};
    bool paused_ = false;
    std::size_t letThrough_ = 0;  // number of requests that may still be taken while paused
    BadDiskSettings badDisk_{};
    std::uint64_t badDiskVersion_ = 0;  // incremented by each change
    std::unordered_map<BlockId, std::uint32_t> attempts_;
    PagingTime time_ = PagingTime::Clock;
    std::uint64_t epoch_ = 0;  // incremented when reads are abandoned
    double nowS_ = 0;          // of Simulated and Recorded
    std::vector<VirtualReading> virtualReadings_;
    std::deque<VirtualReading> virtuallyFinished_;  // endS: the time when it ended
    double prefetchShare_ = 1;
    std::size_t prefetching_ = 0;  // reads in progress
    double nextPrefetchS_ = 0;     // no prefetch begins before this time
    Clock::time_point startedAt_ = Clock::now();
    std::vector<BlockId> taken_;
    std::array<std::jthread, maxLoaderThreads> threads_;  // last, so joined before the other members go
};

}  // namespace planet
