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

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/paging/block_failures.h"
#include "planet/paging/pager.h"
#include "planet/paging/paging_queue.h"
#include "planet/paging/paging_types.h"
#include "planet/planet_types.h"
#include "planet/select/lod_types.h"
#include "planet/select/tile_select.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"
#include "planet/tree/tile_tree.h"

namespace planet {

struct PlanetState;  // planet_state.h

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
    // Whether tiles of normals begin as soon as their roots are derived, which a thread of its own does.
    bool normalsArePending() const;
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
    explicit Planet(std::unique_ptr<PlanetState> state);
    bool settleSimulated(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS);
    std::unique_ptr<PlanetState> state_;
};

}  // namespace planet
