// What a Planet holds. Inside the library only.
//
// Slots come in fours, one four for each sibling block, and are taken when a block has been read. Each
// page-in that is queued or being read is promised a four, without saying which, so that a block that arrives
// always finds room: freeSlots.size() >= promised.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/elapsed.h"
#include "planet/paging/block_failures.h"
#include "planet/paging/normal_tile.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_queue.h"
#include "planet/paging/paging_types.h"
#include "planet/paging/tile_paging.h"
#include "planet/planet_types.h"
#include "planet/select/tile_select.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

using BlockSlots = std::array<std::uint32_t, quadrantCount>;

// One view of the last step.
struct PlanetView {
    ViewInput input;
    Selection selection;
    TileSelection colours;
    TileSelection normals;

    const TileSelection& tiles(BlockKind kind) const {
        return kind == BlockKind::Colours ? colours : normals;
    }
};

// What is wrong with chunks whose checksums match, with the name of the file that they come from, if any.
Error namingFile(const ChunkFile* file, Error error);

struct PlanetState {
    using Clock = std::chrono::steady_clock;

    PagingSettings settings;
    std::shared_ptr<const ChunkFile> file;
    ChunkTree tree;
    std::vector<PlanetView> views{1};
    PagingCounters paging;
    StageTimes times;
    std::uint32_t slotCapacity = 0;
    std::vector<BlockSlots> freeSlots;
    std::size_t promised = 0;           // page-ins that will want slots
    std::vector<NodeIndex> watched;     // first nodes of resident blocks that have no page-out pending
    std::vector<ChunkId> yielding;      // parents of blocks that the next step drops before it selects
    std::vector<MergedRequest> wanted;  // by any view, the most wanted first; of the last step
    std::size_t usedChunks = 0;         // visited by any view in the last step
    std::uint64_t frame = 0;            // of the current step; the first is 1
    bool changed = false;               // by something other than a step, since the last step
    std::uint64_t nextTicket = 1;
    std::uint64_t oldestTicketKept = 1;         // loads of older ones are thrown away
    std::uint64_t thrownAway = 0;               // their number
    std::uint32_t blocksLoaded = 0;             // for ChunkNode::loadOrder
    Clock::time_point lastStep = Clock::now();  // or when it was opened
    double nowS = 0;                            // since it was opened, as of the last step
    double sinceAnewS = 0;                      // the same since startAnew: by this, blocks are tried again
    BlockFailures failures;                     // of heights
    std::deque<PagingEvent> history;
    std::vector<std::string> problems;  // for takeProblems()
    double lastElapsedS = 0;            // of the last step: since the one before
    bool keepsMoves = false;
    PagingMoves moves;
    std::optional<ColourPyramid> colour;
    TilePaging colours;  // only where there is a pyramid
    TilePaging normals;
    std::string normalProblem;                       // the last that was told
    std::unique_ptr<NormalDeriver> deriver;          // only where there may be normals; loader threads use it
    std::uint32_t normalCapacity = 0;                // of normals; theirs is 0 until their roots are derived
    std::size_t nextNormalRoot = 0;                  // the first that followNormalRoots() has not asked for
    std::future<Result<TileData>> normalRootComing;  // uses deriver, so is destroyed before it
    std::unique_ptr<Pager> pager;

    double clockS();
    // A step; fadeElapsedS as selectChunks wants it.
    void step(std::span<const ViewInput> inputs, const UploadChunk& upload, double elapsedS,
              double fadeElapsedS);
    // Its stages.
    void dropYielding();
    void uploadFinished(const UploadChunk& upload);
    void select(double fadeElapsedS);
    void markUsed(PagingQueue& queue);
    void request(PagingQueue& queue);
    void chooseYielding();
    void count();

    void finish(FinishedLoad&& load, const UploadChunk& upload);
    TilePaging& tilesOf(BlockKind kind) { return kind == BlockKind::Colours ? colours : normals; }
    void finishTiles(FinishedLoad&& load);
    void requestTiles(PagingQueue& queue, TilePaging& tiles, const std::vector<MergedRequest>& wantedTiles);
    void renew(PagingQueue& queue, const std::vector<MergedRequest>& pending, BlockKind kind) const;
    // Their requests too; those being read come to nothing.
    void resizeTiles(TilePaging& tiles, std::uint32_t tileCapacity);
    void dropTiles(PagingQueue& queue, TilePaging& tiles);
    // Room for so many tiles of normals, 0: none, and for so many bytes of heights to derive them. What was
    // resident of them is gone. problem: why there are none, to be told once.
    void beginNormals(std::uint32_t tileCapacity, std::size_t heightBytes, const std::string& problem);
    // Those of whole faces that are not there yet. True if any is now.
    bool deriveNormalRoots();
    // Normals begin once their roots are there: derived on a thread of their own, one after the other, or at
    // once where each step must be the same on any machine.
    bool normalsArePending() const { return normals.tileCapacity != normalCapacity; }
    void followNormalRoots();
    void finishNormalRoots();
    bool takeNormalRoot(Result<TileData>&& derived);
    void fail(NodeIndex parent, const FinishedLoad& load, Error error);
    void tell(std::string problem);
    void noteFailure(const FinishedLoad& load, const BlockFailures& known, bool badData);
    // Seconds until the first block that is wanted may be tried again; none where none waits for that.
    std::optional<double> untilRetryS() const;
    // Lets blocks that failed be asked for again.
    void retryAll();
    void retryOne(const BlockId& block);
    void forgetFailures();
    void throwAway(const FinishedLoad& load);
    void withdraw(const PagingRequest& request);
    bool promiseRoom(PagingQueue& queue, double priority);
    bool evictOne(PagingQueue& queue);
    void evict(PagingQueue& queue, NodeIndex parent);
    bool mayBeEvicted(NodeIndex firstChild) const;
    bool hasBlocksOutOfUse() const { return tree.residentChunks > usedChunks; }

    // Changes between steps.
    void resize(std::uint32_t newCapacity);
    void dropEverything();
    void startAnew();
    void putBack(std::vector<PagingRequest> givenUp);

    void note(const PagingRequest& request, PagingOutcome outcome, const FinishedLoad* load = nullptr);
    bool isKept(const PagingRequest& request) const {
        if (request.kind == BlockKind::Heights) return request.ticket >= oldestTicketKept;
        return request.ticket >= (request.kind == BlockKind::Colours ? colours : normals).oldestTicketKept;
    }
    // Of the queue that is locked, before it is changed.
    void noteTaken(const PagingQueue& queue);

private:
    bool isOver(std::size_t blocks) const;
    void shrinkTo(PagingQueue& queue, std::size_t blocks);
    void evictLeastUsed(PagingQueue& queue, std::size_t blocks, std::uint64_t usedBefore);
    void abandonLoads();
    void renumber();
    void forgetGone();
    void afterDrops();
};

// For what is there from the start or not at all: a disk that stumbles is asked again at once.
template <class Read>
auto readRoot(const Read& read) {
    constexpr int attempts = 3;
    auto root = read();
    for (int i = 1; i < attempts && !root && root.error().kind == ErrorKind::Io; ++i) root = read();
    return root;
}

// The requests or the splits of all views, merged by parent, the largest priority first.
using RequestsOf = std::function<const std::vector<ChildrenRequest>&(const PlanetView&)>;
std::vector<MergedRequest> mergeRequests(const std::vector<PlanetView>& views, const RequestsOf& requestsOf);

// What of a budget is for what, bytes.
struct BudgetShares {
    std::size_t chunks = 0;
    std::size_t colours = 0;
    std::size_t normals = 0;        // their tiles
    std::size_t normalHeights = 0;  // that are kept to derive them
};
BudgetShares sharesOf(const PagingSettings& settings, bool hasColours, bool hasNormals);

// The slots that a budget pays for: the roots' six and then whole sibling blocks, and no more than the planet
// has chunks. The Error says what the least is: enough that the finest level can be reached in one place,
// even where four chunks meet.
Result<std::uint32_t> slotsFor(const PlanetShape& shape, std::size_t budgetBytes);

// Every slot from one on, in fours; the lowest are taken first.
std::vector<BlockSlots> freeSlotsFrom(std::uint32_t firstFree, std::uint32_t slotCapacity);

}  // namespace planet
