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
#include "planet/sphere/steps.h"

namespace planet {

// Prefetching loads blocks before any view wants them (planet/select/prediction.h). Announced: the views of
// Planet::announce(), and the motion of views without an announcement.
enum class PrefetchMode : std::uint8_t { Off, Motion, Announced };

struct PrefetchSettings {
    PrefetchMode mode = PrefetchMode::Off;
    // How far ahead views are predicted, s, [0.1, 60]. Larger: more is there in time if the camera goes on as
    // predicted, and more is read in vain if it does not.
    double horizonS = 10;
    // Share of the loaders' time for prefetches, [0.01, 1]. They are read only while nothing that a view wants
    // is queued. Smaller: a loader is more often free for what a view wants next.
    double share = 1;
    // Among the blocks that views want, loads those first that are predicted to be wanted still when they can
    // arrive. It matters while a disk falls behind: what the camera passes before it arrives is read in vain.
    bool lastingFirst = true;

    bool operator==(const PrefetchSettings&) const = default;
};

struct PagingSettings {
    std::size_t budgetBytes = 256u << 20;  // for resident chunks, CPU and GPU together; smaller is coarser
    int loaderThreads = 1;                 // [1, maxLoaderThreads]
    // Time per frame for making loaded chunks drawable, ms, >= 0. At least one block is uploaded per frame.
    double uploadLimitMs = 4;
    bool paused = false;  // loaders take only the requests that loadOne() lets through
    BadDiskSettings badDisk{};
    // Retries of failed reads: their number, and the delay before the first one, which doubles with each.
    // Corrupt blocks are never retried.
    RetryRules retry{};
    // Share of the budget for colour tiles, if the planet has any, [0.01, 0.9]. Larger values give sharper
    // colours, and coarser ground when the budget is exhausted.
    double colourShare = 0.25;
    std::uint32_t maxColourTiles = 2048;  // the capacity of the renderer's pool
    // Lets the renderer unpack BC1 tiles, each of which then takes the memory of a lossless one, if the share has room
    // for all of them or for enough to fill a screen: a CPU draws unpacked tiles faster. BlockCounters tells whether.
    bool unpackedColours = false;
    // Loads tiles of normals (normal_tile.h) if the heights fill any. Off: they take no memory, and no view
    // uses them.
    bool normals = false;
    // Share of the budget left by colours for tiles of normals and for the heights to derive them from,
    // [0.01, 0.9]. Larger values give finer lighting on coarse chunks, and coarser ground when the budget is
    // exhausted. If it is too small for any tile, there are none, and takeProblems() reports it.
    double normalShare = 0.2;
    std::uint32_t maxNormalTiles = 2048;  // the capacity of the renderer's pool
    PrefetchSettings prefetch{};
    // Simulated: reads last as long as badDisk says, in the time of step()'s elapsedS. A block arrives in the
    // first step at or after the end of its read; uploadLimitMs has no effect. The same steps, settings and
    // calls then give the same selections, requests and arrivals, bit for bit, on any machine.
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
    double readS = 0;              // reading and decoding, including injected delays
    std::uint32_t bytes = 0;       // read
    std::uint32_t timesAsked = 1;  // > 1: merged
    double priority = 0;
    bool isPrefetch = false;
    PagingType type = PagingType::PageIn;  // the outcome implies it, except Cancelled
};

// The outcomes of requests in one step, or in one call between steps: everything in the paging that depends
// on a clock, and the requested blocks.
struct PagingMoves {
    struct Arrival {
        BlockId block;
        PagingOutcome outcome = PagingOutcome::Loaded;  // Cancelled: discarded
        bool badData = false;                           // Failed because the block is corrupt: no retry

        bool operator==(const Arrival&) const = default;
    };
    bool gaveUp = false;               // the paging's time changed: reads in progress were requeued
    std::vector<BlockId> taken{};      // by loaders, in order; after gaveUp
    std::vector<Arrival> arrived{};    // in order; after taken
    std::vector<BlockId> requested{};  // last

    bool operator==(const PagingMoves&) const = default;
};

// The prefetched blocks. blocks - hits - wasted are resident now, and no view has wanted them yet.
struct PrefetchCounters {
    // Since the planet was opened.
    std::uint64_t blocks = 0;       // that became resident
    std::uint64_t bytes = 0;        // read, failed and discarded reads included
    std::uint64_t hits = 0;         // that a view has wanted since
    std::uint64_t hitBytes = 0;     // of those
    std::uint64_t wasted = 0;       // evicted before any view wanted them
    std::uint64_t wastedBytes = 0;  // of those, and of discarded reads

    std::uint32_t pending = 0;  // queued or being read now, and not wanted yet

    std::uint64_t unused() const { return blocks - hits - wasted; }

    bool operator==(const PrefetchCounters&) const = default;
};

// The counters of one kind of blocks. loaded - evicted blocks are resident now, not counting the checker
// patterns that replace failed blocks of colours.
struct BlockCounters {
    // Since the planet was opened.
    std::uint64_t loaded = 0;     // blocks read and made resident
    std::uint64_t evicted = 0;    // loaded blocks that are no longer resident
    std::uint64_t failed = 0;     // reads that failed
    std::uint64_t bytesRead = 0;  // from the file; for normals, of the heights that they are derived from

    // Now.
    std::uint32_t budgetWaits = 0;        // blocks wanted in the last step that the budget has no room for
    std::uint32_t failedPermanently = 0;  // blocks that are not requested again until retryFailed()
    std::uint32_t awaitingRetry = 0;      // other blocks whose last read failed
    std::size_t resident = 0;             // chunks or tiles, including roots
    std::uint32_t capacity = 0;           // slots for them; 0 if the kind is off or has no room
    bool unpacked = false;                // of colours: BC1 tiles are to be unpacked

    PrefetchCounters prefetch{};  // part of loaded, evicted and bytesRead
};

// Counters over all kinds of blocks, since the planet was opened unless noted, and those of each kind.
struct PagingCounters {
    std::uint64_t requested = 0;          // queued page-ins
    std::uint64_t merged = 0;             // requested again while queued
    std::uint64_t cancelled = 0;          // cancelled by the opposite request, no longer wanted, or discarded
    std::uint64_t pageOutsQueued = 0;     // queued page-outs
    std::uint64_t pageOutsCancelled = 0;  // number of page-outs among the cancelled
    double loadSeconds = 0;               // reading and decoding, over all threads
    std::uint32_t queued = 0;             // now, without prefetches
    std::uint32_t loading = 0;            // now being read, or read and waiting for upload
    std::size_t residentBytesCpu = 0;     // now, of chunks
    std::size_t residentBytesGpu = 0;     // now, of the slots that hold a resident chunk
    std::array<BlockCounters, blockKindCount> blocks{};

    const BlockCounters& operator[](BlockKind kind) const { return blocks[static_cast<std::size_t>(kind)]; }
    BlockCounters& operator[](BlockKind kind) { return blocks[static_cast<std::size_t>(kind)]; }

    // Sums over the kinds.
    std::uint64_t bytesRead() const { return sum(&BlockCounters::bytesRead); }
    std::uint32_t failedPermanently() const { return sum(&BlockCounters::failedPermanently); }
    std::uint32_t awaitingRetry() const { return sum(&BlockCounters::awaitingRetry); }
    PrefetchCounters prefetch() const {
        PrefetchCounters all;
        for (const BlockCounters& kind : blocks) {
            all.blocks += kind.prefetch.blocks;
            all.bytes += kind.prefetch.bytes;
            all.hits += kind.prefetch.hits;
            all.hitBytes += kind.prefetch.hitBytes;
            all.wasted += kind.prefetch.wasted;
            all.wastedBytes += kind.prefetch.wastedBytes;
            all.pending += kind.prefetch.pending;
        }
        return all;
    }

private:
    template <class Count>
    Count sum(Count BlockCounters::*count) const {
        Count total = 0;
        for (const BlockCounters& kind : blocks) total += kind.*count;
        return total;
    }
};

// Makes the heights of one chunk drawable: chunkVertexCount steps into a slot below the capacity of heights.
// Called on the thread that steps the planet.
using UploadChunk = std::function<void(std::uint32_t slot, StepsView heights)>;

// No-op upload, for headless use.
inline void noUpload(std::uint32_t, StepsView) {}

// An update for a pool of tiles after a step. Updates are applied in order.
struct TileChange {
    bool resets = false;              // all slots become empty, as after opening
    std::optional<ChunkId> gone{};    // the tiles under this one are no longer resident
    std::uint32_t firstSlot = 0;      // of the arrived tiles
    std::vector<TileData> arrived{};  // a root alone, or four siblings in consecutive slots
};

}  // namespace planet
