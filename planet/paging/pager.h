// The loader threads: they take page-ins from the paging queue, best first, read and decode them, and leave
// what they loaded in a list for the owning thread. One thread owns a pager and makes all calls.
//
// By simulated time no thread reads. As many virtual loaders take requests as there would be threads, at the
// moment they are free and something is queued. A read lasts as long as diskFault() says, nothing without a
// bad disk, and is over once advance() has reached its end; takeFinished() then reads the block, at once. So
// the same calls give the same loads in the same order, on any machine.
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

namespace planet {

using SiblingBlock = std::array<ChunkData, quadrantCount>;
using TileBlock = std::array<TileData, quadrantCount>;
// By the request's kind.
using LoadedBlock = std::variant<SiblingBlock, TileBlock>;

// Reads the four children of a chunk, as ChunkFile::readChildren does. Called from loader threads, several at
// once.
using LoadChildren = std::function<Result<SiblingBlock>(const ChunkId& parent, BlockLocation location,
                                                        std::span<const std::int16_t> parentHeights)>;
// The same for a tile of colour, as ChunkFile::readColourChildren does.
using LoadColours = std::function<Result<TileBlock>(const ChunkId& parent, BlockLocation location)>;

// Derives the four children of a tile of normals. Called as the others are.
using LoadNormals = std::function<Result<TileBlock>(const ChunkId& parent)>;

struct BlockLoaders {
    LoadChildren chunks;
    LoadColours colours{};  // none where no colours are asked for
    LoadNormals normals{};  // nor these where no normals are
};

struct FinishedLoad {
    PagingRequest request;  // as it was when a loader took it
    Result<LoadedBlock> block;
    double seconds = 0;       // reading and decoding, a bad disk's waiting included
    std::uint32_t bytes = 0;  // of the block in the file; 0 where a bad disk failed the read, and of normals
};

// A request that a loader has taken.
struct LoadInProgress {
    ChunkId parent;
    BlockKind kind = BlockKind::Heights;
    double priority = 0;
    std::uint32_t bytes = 0;
    double seconds = 0;  // since it was taken
};

struct PagerStatus {
    std::uint32_t queued = 0;   // page-ins waiting for a loader
    std::uint32_t loading = 0;  // taken by a loader and not yet finished
    std::uint32_t finished = 0;
    bool held = false;  // paused, and no queued page-in is let through

    bool idle() const { return queued + loading + finished == 0; }
    // Nothing is on its way, and nothing will be by itself.
    bool atRest() const { return loading + finished == 0 && (queued == 0 || held); }
};

inline constexpr int maxLoaderThreads = 64;

// By what a read's end is decided.
enum class PagingTime : std::uint8_t {
    Clock,      // loader threads, as fast as they are
    Simulated,  // virtual loaders, by the bad disk's settings and seed, in the time of advance()
    Recorded,   // whoever calls take() and finish()
};

class Pager {
public:
    // threads: [1, maxLoaderThreads].
    Pager(BlockLoaders load, int threads);
    // Lets the blocks being read come to their end and drops everything else.
    ~Pager();
    Pager(const Pager&) = delete;
    Pager& operator=(const Pager&) = delete;

    // Calls edit(PagingQueue&) while no loader touches the queue, and wakes the loaders. Keep it short.
    template <class Edit>
    auto withQueue(Edit&& edit) {
        // Destroyed in reverse: virtual loaders take, then the lock is gone, then the threads wake.
        const Wake wake{workArrived_};
        const std::lock_guard lock(mutex_);
        const VirtualLoaders loaders{*this};
        return edit(queue_);
    }
    // The same for looking only: wakes nobody.
    template <class Look>
    auto readQueue(Look&& look) const {
        const std::lock_guard lock(mutex_);
        return look(queue_);
    }

    // How many loaders take requests from now on. Waits for no read: a loader that is one too many goes when
    // its read is done, so for that long there may be more.
    void setThreads(int threads);

    // While paused the loaders take nothing but what loadOne() lets through, one request a call; with nothing
    // queued it does nothing.
    void setPaused(bool paused);
    void loadOne();

    // Reads are slowed and fail as these say, those that wait already included. A block's attempts are
    // counted while there is trouble, and anew after each change.
    void setBadDisk(const BadDiskSettings& settings);
    // So that the bad disk's troubles come again as they came.
    void forgetAttempts();

    // Another time from now on; simulated seconds begin at 0. What was being read, or has been read and not
    // been taken, is given up: its requests are returned, as they were taken, and their results come to
    // nothing.
    std::vector<PagingRequest> setTime(PagingTime time);
    // The same without another time.
    std::vector<PagingRequest> giveUp();
    PagingTime time() const;
    // Only of Simulated and Recorded: lets so many seconds, >= 0, pass.
    void advance(double seconds);
    // Only of Simulated: seconds until the next read ends; nothing while none is under way.
    std::optional<double> untilNextEnd() const;
    // Only of Recorded: starts the read of a queued block, and ends one that was started. False where there
    // is none such. Of several reads of the same block all but the last taken are such as will be thrown
    // away.
    bool take(const BlockId& block);
    // failure: of what kind, where the read is to fail.
    bool finish(const BlockId& block, std::optional<ErrorKind> failure, bool last = true);

    // The blocks that were taken since the last call of this, in order. withQueue sees to it that none is
    // taken in between: call it from there.
    std::vector<BlockId> takeTaken(const PagingQueue& lockedQueue);

    // The finished loads in the order they finished, one a call. But for Clock the block is read here.
    std::optional<FinishedLoad> takeFinished();

    // Waits until a load is finished, but not past a moment, nor while there is nothing to wait for. True if
    // one is.
    bool waitForFinished(std::chrono::steady_clock::time_point until);

    PagerStatus status() const;
    // Longest first.
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
    // Of a virtual loader, in the order they were taken. Seconds of the pager's own time.
    struct VirtualReading {
        PagingRequest request;
        double sinceS = 0;
        double endS = 0;
        std::optional<ErrorKind> failure{};  // where it fails
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
    bool sitOutBadDisk(const Reading& reading, const std::stop_token& stop, Lock& lock);
    bool mayTake() const;
    PagingRequest takeNext();
    void startVirtualReads();
    void endVirtualRead(std::size_t index);
    std::size_t nextVirtualEnd() const;
    DiskFault nextFault(const PagingRequest& request);
    std::vector<PagingRequest> giveUpReads();
    std::optional<FinishedLoad> readFinished(Lock& lock);
    PagerStatus statusLocked() const;

    const BlockLoaders load_;
    mutable std::mutex mutex_;  // guards what follows, but the threads
    std::condition_variable_any workArrived_;
    std::condition_variable_any loadFinished_;
    std::condition_variable_any badDiskChanged_;
    PagingQueue queue_;
    std::deque<FinishedLoad> finished_;
    std::size_t loadersWanted_ = 0;
    std::array<Loader, maxLoaderThreads> loaders_{};
    bool paused_ = false;
    std::size_t letThrough_ = 0;  // requests that may still be taken while paused
    BadDiskSettings badDisk_{};
    std::uint64_t badDiskVersion_ = 0;  // one more with each change
    std::unordered_map<BlockId, std::uint32_t> attempts_;
    PagingTime time_ = PagingTime::Clock;
    std::uint64_t epoch_ = 0;  // one more each time reads are given up
    double nowS_ = 0;          // of Simulated and Recorded
    std::vector<VirtualReading> virtualReadings_;
    std::deque<VirtualReading> virtuallyFinished_;  // endS: when it ended
    std::vector<BlockId> taken_;
    std::array<std::jthread, maxLoaderThreads> threads_;  // last: joined before the rest goes
};

}  // namespace planet
