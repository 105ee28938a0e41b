// The facade: an open chunk file, its resident tree and its loader threads, stepped once a frame.
//
//     auto planet = Planet::open("earth.chk", {}).value();
//     for (;;) {
//         planet->step(view, lodSettings, [&](std::uint32_t slot, auto heights) { renderer.upload(slot,
//         heights); }); renderer.draw(view, planet->selection().draw, renderSettings);
//     }
//
// All calls from one thread; the loader threads are its own.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/bad_disk.h"
#include "planet/block_failures.h"
#include "planet/chunk_file.h"
#include "planet/chunk_tree.h"
#include "planet/lod_select.h"
#include "planet/pager.h"
#include "planet/paging_queue.h"
#include "planet/result.h"
#include "planet/tile_select.h"
#include "planet/tile_tree.h"

namespace planet {

struct PagingSettings {
    std::size_t budgetBytes =
        256u << 20;            // for resident chunks, CPU and GPU together; smaller: coarser when it is full
    int loaderThreads = 1;     // [1, maxLoaderThreads]
    double uploadLimitMs = 4;  // >= 0, of a frame, for making loaded chunks drawable; at least one block is
    bool paused = false;       // loaders take nothing but what loadOne() lets through
    BadDiskSettings badDisk{};
    // How often a block that could not be read is asked for again by itself, and how long after the first
    // failure; after each further one twice as long. What is read and wrong is not.
    RetryRules retry{};
    // Of a planet with colours: the share of the budget that is for their tiles, [0.01, 0.9]; larger: sharper
    // colours, and coarser ground when the budget is full.
    double colourShare = 0.25;
    std::uint32_t maxColourTiles = 2048;  // that the renderer's pool can hold at most
    // Tiles of normals (normal_tile.h), where the heights fill any. Off: no memory is taken, and no view has
    // them.
    bool normals = false;
    // What they and the heights kept to derive them take of the budget that colours leave, [0.01, 0.9];
    // larger: finer light on coarse chunks, and coarser ground when the budget is full. Where it is too
    // little for any there are none, and takeProblems() says so.
    double normalShare = 0.2;
    std::uint32_t maxNormalTiles = 2048;  // as of colours
    // Simulated: reads last as long as badDisk says, in the time of step()'s elapsedS, and a block arrives in
    // the first step at or past its end; uploadLimitMs does not hold. The same steps, settings and calls then
    // give the same selections, requests and arrivals, bit for bit, on any machine.
    PagingTime time = PagingTime::Clock;

    bool operator==(const PagingSettings&) const = default;
};

// One of the views that share a planet.
struct ViewInput {
    View lodView;
    LodSettings lod;
    double priorityFactor = 1;  // of its requests against the other views'; > 0
    TileSettings colours{};
    TileSettings normals{};
};

enum class PagingOutcome : std::uint8_t { Loaded, Failed, Evicted, Cancelled };
// How a request ended. A block that is asked for again after it has failed is another request.
struct PagingEvent {
    ChunkId parent;  // of the block
    BlockKind kind = BlockKind::Heights;
    PagingOutcome outcome = PagingOutcome::Loaded;
    double atS = 0;                // seconds since the planet was opened
    double waitedS = 0;            // since it was first asked for
    double readS = 0;              // reading and decoding, a bad disk's waiting included
    std::uint32_t bytes = 0;       // read
    std::uint32_t timesAsked = 1;  // over 1: merged
    double priority = 0;
    PagingType type = PagingType::PageIn;  // only of Cancelled may be either
};

// What the loaders did to the requests in one step or one call between steps: all about paging that a clock
// decides, and what was asked for.
struct PagingMoves {
    struct Arrival {
        BlockId block;
        PagingOutcome outcome = PagingOutcome::Loaded;  // Cancelled: thrown away
        bool badData = false;  // Failed by what was read, not by reading: not to be asked for again

        bool operator==(const Arrival&) const = default;
    };
    bool gaveUp = false;           // the paging's time changed: what was being read went back into the queue
    std::vector<BlockId> taken{};  // after that, by loaders, in order
    std::vector<Arrival> arrived{};    // after that, in order
    std::vector<BlockId> requested{};  // at the end

    bool operator==(const PagingMoves&) const = default;
};

// Totals since the file was opened, unless said otherwise. Requests are counted over all kinds of blocks;
// loaded, evicted, failed and bytesRead of heights alone, since TilePagingCounters has those of each kind of
// tiles. Of each kind loaded - evicted blocks are resident now, checker patterns in place of failed ones
// apart.
struct PagingCounters {
    std::uint64_t requested = 0;       // page-ins put into the queue
    std::uint64_t merged = 0;          // asked again while queued
    std::uint64_t cancelled = 0;       // taken back by the opposite request, no longer wanted, or thrown away
    std::uint64_t loaded = 0;          // blocks of heights read and made resident
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

// The same of one kind of tiles, colours or normals.
struct TilePagingCounters {
    std::uint64_t loaded = 0;        // blocks read and made resident
    std::uint64_t evicted = 0;       // loaded blocks that are no longer resident
    std::uint64_t failed = 0;        // reads that failed
    std::uint64_t bytesRead = 0;     // from the file; for normals the heights that they are derived from
    std::uint32_t budgetWaits = 0;   // blocks wanted last step that the share has no room for
    std::size_t residentTiles = 0;   // now
    std::uint32_t tileCapacity = 0;  // 0: off, or no room for any
};

// What a pool of tiles has to do to keep up with a step, in order.
struct TileChange {
    bool beginsAnew = false;          // every slot is empty, as when the planet was opened
    std::optional<ChunkId> gone{};    // the tiles under this one are no longer resident
    std::uint32_t firstSlot = 0;      // of those that have arrived
    std::vector<TileData> arrived{};  // a root alone, or four siblings in slots one after the other
};

// What each stage of the last step took, milliseconds.
struct StageTimes {
    double uploadMs = 0;
    double selectMs = 0;
    double pagingMs = 0;  // page-out and requests
};

// Makes one chunk's heights drawable: chunkVertexCount steps into a slot below slotCapacity().
using UploadChunk = std::function<void(std::uint32_t slot, std::span<const std::int16_t> heights)>;

// For whom nothing is drawn.
inline void noUpload(std::uint32_t, std::span<const std::int16_t>) {}

// What a planet is made of: a chunk file, or for tests and generated planets anything that acts like one.
struct PlanetSource {
    PlanetShape shape;
    std::int16_t minStep = 0;  // over the whole planet
    std::int16_t maxStep = 0;
    std::array<ChunkData, faceCount> roots;  // in face order
    LoadChildren loadChildren;
    // Colours: none without a pyramid.
    std::optional<ColourPyramid> colour{};
    std::array<TileData, faceCount> colourRoots{};
    LoadColours loadColours{};
    std::vector<std::string> problems{};    // that it is opened in spite of, for takeProblems()
    std::shared_ptr<const ChunkFile> file;  // what the above comes from; null where there is no file
};

class Planet {
public:
    // The Error names the file and what is wrong with it, or a setting and its range; for a budget that is
    // too small it says the least that will do.
    static Result<std::unique_ptr<Planet>> open(const std::filesystem::path& path,
                                                const PagingSettings& settings,
                                                const FileCalls& calls = systemFileCalls());
    static Result<std::unique_ptr<Planet>> open(ChunkFile file, const PagingSettings& settings);
    static Result<std::unique_ptr<Planet>> open(PlanetSource source, const PagingSettings& settings);
    ~Planet();  // joins the loader threads
    Planet(const Planet&) = delete;
    Planet& operator=(const Planet&) = delete;

    // One frame: uploads what was loaded, selects, drops what the budget asks for, requests what is missing.
    // The first step uploads the root chunks too.
    void step(const View& lodView, const LodSettings& settings, const UploadChunk& upload);

    // The same as if so many seconds, >= 0, had passed since the step before: seconds() goes on by just that,
    // whatever the clock says. Fades go on by that too.
    void step(std::span<const ViewInput> views, const UploadChunk& upload, double elapsedS);

    // By the clock, for several views, 1 to maxViews: each has its own selection, and asks for what it wants
    // with its own priorities; a block that several want is loaded once, at the highest.
    void step(std::span<const ViewInput> views, const UploadChunk& upload);

    // Steps until nothing more is wanted or can be had; every fade is at its end. False if that takes longer
    // than the given seconds, or if a pause holds up what is wanted. By simulated time it steps from the end
    // of one read to that of the next, and the seconds are simulated; by recorded time it takes one step.
    bool settle(const View& lodView, const LodSettings& settings, const UploadChunk& upload, double timeoutS);
    bool settle(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS);

    // New settings, at once, waiting for no read: loaders are started or sent home, blocks are dropped down
    // to a smaller budget, those out of use first. Where the paging's time changes, what is being read goes
    // back into the queue, to be read anew. Where normals come on, those of the whole faces are derived at
    // once, which reads. True if slotCapacity() has changed; then every slot has
    // moved, the selections are made anew, and the renderer wants a pool of that size and uploadAll. The
    // Error says what is wrong, as open's does, and nothing has changed.
    Result<bool> setPaging(const PagingSettings& settings);
    const PagingSettings& pagingSettings() const;
    // While paused: lets the most urgent request through.
    void loadOne();
    // Drops all blocks and every request; the roots stay, and may be refined again if that failed. Blocks now
    // being read are thrown away when they arrive. The selections are made anew. A bad disk's troubles come
    // again as they came.
    void dropAll();

    // Chooses and loads from here on as if just opened with the present settings and exaggeration: all blocks
    // but the roots, all requests and reads, the selections and what they remember are gone, and simulated
    // time begins anew. Totals, history and seconds() go on. Nothing is selected until the next step.
    void startAnew();

    // Forgets the selections, which hysteresis and fades refer to: the next step selects as the first one
    // does. Resident blocks and requests stay. Nothing is selected until the next step.
    void forgetSelections();

    // Whether moves are kept for takeMoves(); at first they are not.
    void keepMoves(bool kept);
    // Those since the last call. To be called after each step and each other call while moves are kept: a
    // call that gives reads up begins them anew.
    PagingMoves takeMoves();
    // By recorded time: does again what takeMoves() told of a call, before that call, or of a step, before
    // that step. False where something in it has no request to be about, because what went before was not
    // the same; that is left out.
    bool follow(const PagingMoves& moves);

    // Draws heights this many times as high, (0, 100], but no more than largestExaggeration(tree()), which
    // keeps the lowest ground off the planet's centre; tree().exaggeration says what it is. Bounds and
    // delta_c follow at once, the selection at the next step. Tell the renderer shape(). No slot changes.
    void setExaggeration(double factor);

    // Uploads every resident chunk again: for a renderer that was made anew.
    void uploadAll(const UploadChunk& upload) const;

    // Of the file, if it has colours.
    const std::optional<ColourPyramid>& colour() const;
    const TileTree& colourTree() const;
    // Of the last step, as selection().
    const TileSelection& colourSelection(std::size_t view = 0) const;
    const TilePagingCounters& colourPaging() const;
    // What has become of tiles since the last call; to be called after each step where colours are drawn.
    std::vector<TileChange> takeColourChanges();
    // For a renderer that was made anew: all tiles but the roots are dropped, and begin to come again.
    void beginColoursAnew();

    // The finest level of tiles of normals that the heights fill, whether they are on or not; -1: there are
    // none.
    int normalLeafLevel() const;
    // Of the same as above, of normals. A tree without nodes where they are off.
    const TileTree& normalTree() const;
    const TileSelection& normalSelection(std::size_t view = 0) const;
    const TilePagingCounters& normalPaging() const;
    std::vector<TileChange> takeNormalChanges();
    void beginNormalsAnew();

    const ChunkFile& file() const;  // only of a planet that was opened from one
    const PlanetShape& shape() const;
    const ChunkTree& tree() const;
    // Of the last step; its nodes and slots hold until the next.
    const Selection& selection(std::size_t view = 0) const;
    std::size_t viewCount() const;  // of the last step; 1 before it
    const PagingCounters& paging() const;
    std::uint64_t bytesRead() const;  // from the file since it was opened, for blocks of all kinds
    const StageTimes& times() const;
    std::uint32_t slotCapacity() const;  // slots of the pool of heights that the budget pays for
    // True when the last selection waits for nothing that can still arrive, a block that is to be tried again
    // included.
    bool settled() const;
    // Messages of blocks that have failed for good since the last call, for a log; the first 1000.
    std::vector<std::string> takeProblems();
    // The blocks that could not be read and have not been since, of heights, then of colours, then of
    // normals, each in their order; of the latest 4096 of each kind.
    std::vector<FailedBlock> failedBlocks() const;
    // Lets blocks that failed be asked for again at once, as if they never had; all, or one.
    void retryFailed();
    void retryFailed(const BlockId& block);
    // The pending requests of a type, most urgent first: a copy, for display. Page-outs are the blocks out of
    // use, the longest unused first; they stay resident until their room is needed.
    std::vector<PagingRequest> pendingRequests(PagingType type) const;
    // Those that a view wants, by its own priorities. No view wants a page-out.
    std::vector<PagingRequest> pendingRequests(PagingType type, std::size_t view) const;
    std::vector<LoadInProgress> loadingNow() const;
    // How the last 1000 requests ended, oldest first.
    const std::deque<PagingEvent>& pagingHistory() const;
    double seconds() const;                                      // since it was opened, as of the last step
    double elapsedS() const;                                     // of the last step: since the one before
    const LodSettings& lodSettings(std::size_t view = 0) const;  // of the last step
    const View& lodView(std::size_t view = 0) const;

private:
    struct State;
    explicit Planet(std::unique_ptr<State> state);
    bool settleSimulated(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS);
    std::unique_ptr<State> state_;
};

}  // namespace planet
