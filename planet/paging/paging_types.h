// Paging's settings, counters, events and changes: plain data that a Planet is given and tells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
    // With colours: the share of the budget for their tiles, [0.01, 0.9]; larger: sharper colours, and
    // coarser ground when the budget is full.
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
// How a request ended. A block that is requested again after it has failed is a new request.
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

// Totals since the file was opened, unless said otherwise. Requests are counted over all kinds of blocks;
// loaded, evicted, failed and bytesRead count heights alone, since TilePagingCounters has those of each kind
// of tiles. For each kind, loaded - evicted blocks are resident now, not counting checker patterns in place
// of failed ones.
struct PagingCounters {
    std::uint64_t requested = 0;          // page-ins put into the queue
    std::uint64_t merged = 0;             // requested again while queued
    std::uint64_t cancelled = 0;          // replaced by the opposite request, no longer wanted, or discarded
    std::uint64_t pageOutsQueued = 0;     // page-outs put into the queue
    std::uint64_t pageOutsCancelled = 0;  // those in cancelled; the others are page-ins
    std::uint64_t loaded = 0;             // blocks of heights read and made resident
    double loadSeconds = 0;            // spent on reading and decoding blocks of any kind, over all threads
    std::uint64_t evicted = 0;         // blocks of heights paged out
    std::uint64_t failed = 0;          // reads of heights that failed
    std::uint64_t bytesRead = 0;       // from the file, for blocks of heights
    std::uint32_t failedForGood = 0;   // blocks of any kind, now: not requested again until told to
    std::uint32_t awaitingRetry = 0;   // other blocks of any kind, now, whose last read failed
    std::uint32_t queued = 0;          // now
    std::uint32_t loading = 0;         // now being read, or read and waiting for their upload
    std::uint32_t budgetWaits = 0;     // blocks wanted last step that the budget has no room for
    std::size_t residentChunks = 0;    // now
    std::size_t residentBytesCpu = 0;  // now
    std::size_t residentBytesGpu = 0;  // now: heights in the pool that hold a resident chunk
};

// The counters of one kind of tiles, colours or normals.
struct TilePagingCounters {
    std::uint64_t loaded = 0;        // blocks read and made resident
    std::uint64_t evicted = 0;       // loaded blocks that are no longer resident
    std::uint64_t failed = 0;        // reads that failed
    std::uint64_t bytesRead = 0;     // from the file; for normals the heights that they are derived from
    std::uint32_t budgetWaits = 0;   // blocks wanted last step that the share has no room for
    std::size_t residentTiles = 0;   // now
    std::uint32_t tileCapacity = 0;  // 0: off, or no room for any
};

// An update that a pool of tiles makes to follow a step; updates are applied in order.
struct TileChange {
    bool beginsAnew = false;          // every slot is empty, as when the planet was opened
    std::optional<ChunkId> gone{};    // the tiles under this one are no longer resident
    std::uint32_t firstSlot = 0;      // of those that have arrived
    std::vector<TileData> arrived{};  // a root alone, or four siblings in consecutive slots
};

}  // namespace planet
