// The settings, counters, events and changes of a Planet's paging, as plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planet/format/chunk_file_types.h"
#include "planet/paging/block_failures.h"
#include "planet/paging/disk_simulator.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_queue.h"
#include "planet/sphere/block_id.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

struct PagingSettings {
    std::size_t budgetBytes = 256u << 20;  // for resident chunks, CPU and GPU together; smaller: coarser
    int loaderThreads = 1;                 // [1, maxLoaderThreads]
    // Time per frame for making loaded chunks drawable, ms, >= 0; at least one block is uploaded.
    double uploadLimitMs = 4;
    bool paused = false;  // loaders take only what loadOne() lets through
    BadDiskSettings badDisk{};
    // Retries of failed reads: their number, and the delay before the first one, which doubles with each.
    // Corrupt blocks are never retried.
    RetryRules retry{};
    // The share of the budget for tiles of colours, if the planet has any, [0.01, 0.9]; larger: sharper
    // colours, and coarser ground when the budget is full.
    double colourShare = 0.25;
    std::uint32_t maxColourTiles = 2048;  // the renderer's pool holds at most so many
    // Loads tiles of normals (normal_tile.h) if the heights fill any. Off: they take no memory, and no view
    // has them.
    bool normals = false;
    // The share of the budget left by colours for tiles of normals and the heights that they are derived
    // from, [0.01, 0.9]; larger: finer light on coarse chunks, and coarser ground when the budget is full. If
    // it is too small for any tile there are none, and takeProblems() says so.
    double normalShare = 0.2;
    std::uint32_t maxNormalTiles = 2048;  // the renderer's pool holds at most so many
    // Simulated: reads last as long as badDisk says, in the time of step()'s elapsedS, and a block arrives in
    // the first step at or past the end of its read; uploadLimitMs has no effect. The same steps, settings
    // and calls then give the same selections, requests and arrivals, bit for bit, on any machine.
    PagingTime time = PagingTime::Clock;

    bool operator==(const PagingSettings&) const = default;
};

enum class PagingOutcome : std::uint8_t { Loaded, Failed, Evicted, Cancelled };
// The end of a request. A block that is requested again after a failure is a new request.
struct PagingEvent {
    ChunkId parent;  // of the block
    BlockKind kind = BlockKind::Heights;
    PagingOutcome outcome = PagingOutcome::Loaded;
    double atS = 0;                // seconds since the planet was opened
    double waitedS = 0;            // since it was first requested
    double readS = 0;              // reading and decoding, a bad disk's delays included
    std::uint32_t bytes = 0;       // read
    std::uint32_t timesAsked = 1;  // over 1: merged
    double priority = 0;
    PagingType type = PagingType::PageIn;  // only Cancelled has either; page-outs end in no other way
};

// The outcome of requests in one step or one call between steps: everything about paging that depends on a
// clock, and the blocks that were requested.
struct PagingMoves {
    struct Arrival {
        BlockId block;
        PagingOutcome outcome = PagingOutcome::Loaded;  // Cancelled: discarded
        bool badData = false;                           // Failed because the block is corrupt: no retry

        bool operator==(const Arrival&) const = default;
    };
    bool gaveUp = false;               // the paging's time changed: reads in progress were requeued
    std::vector<BlockId> taken{};      // after that, by loaders, in order
    std::vector<Arrival> arrived{};    // after that, in order
    std::vector<BlockId> requested{};  // at the end

    bool operator==(const PagingMoves&) const = default;
};

// The counters of one kind of blocks. loaded - evicted blocks are resident now, not counting checker patterns
// in place of blocks of colours that failed.
struct BlockCounters {
    // Since the planet was opened.
    std::uint64_t loaded = 0;   // blocks read and made resident
    std::uint64_t evicted = 0;  // loaded blocks that are no longer resident
    std::uint64_t failed = 0;   // reads that failed
    std::uint64_t bytesRead =
        0;  // from the file; for normals those of the heights that they are derived from

    // Now.
    std::uint32_t budgetWaits = 0;    // blocks wanted in the last step that the budget has no room for
    std::uint32_t failedForGood = 0;  // blocks that are not requested again until retryFailed()
    std::uint32_t awaitingRetry = 0;  // other blocks whose last read failed
    std::size_t resident = 0;         // chunks or tiles, roots included
    std::uint32_t capacity = 0;       // slots for them; 0 if the kind is off or has no room
};

// Counters over all kinds of blocks, since the planet was opened unless said otherwise, and those of each.
struct PagingCounters {
    std::uint64_t requested = 0;          // page-ins put into the queue
    std::uint64_t merged = 0;             // requested again while queued
    std::uint64_t cancelled = 0;          // replaced by the opposite request, no longer wanted, or discarded
    std::uint64_t pageOutsQueued = 0;     // page-outs put into the queue
    std::uint64_t pageOutsCancelled = 0;  // the page-outs among the cancelled
    double loadSeconds = 0;               // spent on reading and decoding, over all threads
    std::uint32_t queued = 0;             // now
    std::uint32_t loading = 0;            // now being read, or read and waiting for their upload
    std::size_t residentBytesCpu = 0;     // now, of chunks
    std::size_t residentBytesGpu = 0;     // now, of the slots that hold a resident chunk
    std::array<BlockCounters, blockKindCount> blocks{};

    const BlockCounters& operator[](BlockKind kind) const { return blocks[static_cast<std::size_t>(kind)]; }
    BlockCounters& operator[](BlockKind kind) { return blocks[static_cast<std::size_t>(kind)]; }

    // Sums over the kinds.
    std::uint64_t bytesRead() const { return sum(&BlockCounters::bytesRead); }
    std::uint32_t failedForGood() const { return sum(&BlockCounters::failedForGood); }
    std::uint32_t awaitingRetry() const { return sum(&BlockCounters::awaitingRetry); }

private:
    template <class Count>
    Count sum(Count BlockCounters::*count) const {
        Count total = 0;
        for (const BlockCounters& kind : blocks) total += kind.*count;
        return total;
    }
};

// Makes the heights of one chunk drawable: chunkVertexCount steps into a slot below the capacity of heights.
// Called by the thread that steps the planet.
using UploadChunk = std::function<void(std::uint32_t slot, std::span<const std::int16_t> heights)>;

// No-op upload, for headless use.
inline void noUpload(std::uint32_t, std::span<const std::int16_t>) {}

// An update that a pool of tiles makes to follow a step; updates are applied in order.
struct TileChange {
    bool beginsAnew = false;          // every slot is empty, as when the planet was opened
    std::optional<ChunkId> gone{};    // the tiles under this one are no longer resident
    std::uint32_t firstSlot = 0;      // of those that have arrived
    std::vector<TileData> arrived{};  // a root alone, or four siblings in consecutive slots
};

}  // namespace planet
