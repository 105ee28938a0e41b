// The state of a Planet. Internal to the library.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planet/base/stopwatch.h"
#include "planet/paging/chunk_paging.h"
#include "planet/paging/normal_roots.h"
#include "planet/paging/pager.h"
#include "planet/paging/tile_paging.h"
#include "planet/planet_types.h"
#include "planet/select/tile_select.h"

namespace planet {

struct PlanetState {
    using Clock = std::chrono::steady_clock;

    PlanetState(ChunkTree&& tree, std::uint32_t chunkSlots, std::shared_ptr<const ChunkFile> chunkFile,
                std::unique_ptr<NormalDeriver> deriver);

    PagingSettings settings;
    std::shared_ptr<const ChunkFile> file;
    std::optional<ColourPyramid> colour;
    std::vector<PlanetView> views{1};
    PagingRun run;
    ChunkPaging heights;
    TilePaging colours{BlockKind::Colours};  // on only with a pyramid
    TilePaging normals{BlockKind::Normals};
    NormalRoots normalRoots;
    PagingCounters paging;
    LastStep lastStep;
    bool changed = false;                         // since the last step, other than by a step
    Clock::time_point lastStepAt = Clock::now();  // initially the time of opening
    std::unique_ptr<Pager> pager;                 // last, because its threads use the deriver

    // Returns the kinds in the order of their requests.
    std::array<BlockPaging*, blockKindCount> kinds() { return {&heights, &colours, &normals}; }
    std::array<const BlockPaging*, blockKindCount> kinds() const { return {&heights, &colours, &normals}; }
    BlockPaging& of(BlockKind kind) { return *kinds()[static_cast<std::size_t>(kind)]; }
    TilePaging& tilesOf(BlockKind kind) { return kind == BlockKind::Colours ? colours : normals; }
    bool isSettled() const;

    double clockS();
    // Performs a step; fadeElapsedS is for selectChunks.
    void step(std::span<const ViewInput> inputs, const UploadChunk& upload, double elapsedS,
              double fadeElapsedS);
    // The stages of a step.
    void dropYielding();
    void uploadFinished(const UploadChunk& upload);
    void select(double fadeElapsedS);
    void page();
    void count();

    // Returns the seconds until the first needed block may be retried; nothing if none waits for a retry.
    std::optional<double> untilRetryS() const;
    bool normalsArePending() const { return normalRoots.arePending(normals); }

    // Changes between steps.
    void resizeHeights(std::uint32_t capacity);
    void resizeTiles(TilePaging& tiles, std::uint32_t capacity);
    // Sets the number of tiles of normals, 0 for none, and the bytes of cached heights to derive them from.
    // Drops the resident tiles. problem: the reason why there are no normals; it is reported once.
    void beginNormals(std::uint32_t capacity, std::size_t heightBytes, const std::string& problem);
    void finishNormalRoots();
    void dropAll();
    void reset();
    void requeue(std::vector<PagingRequest> givenUp);

private:
    MergedRequests mergeFor(BlockKind kind) const;
    void noteTaken(const PagingQueue& lockedQueue);
    void selectAgain();
};

// Merge the requests or splits of all views by parent, sorted by priority, highest first.
using RequestsOf = std::function<const std::vector<ChildrenRequest>&(const PlanetView&)>;
std::vector<MergedRequest> mergeRequests(const std::vector<PlanetView>& views, const RequestsOf& requestsOf);

// The parts of a budget, bytes.
struct BudgetShares {
    std::size_t chunks = 0;
    std::size_t colours = 0;
    std::size_t normals = 0;        // for tiles
    std::size_t normalHeights = 0;  // for cached heights to derive them from
};
BudgetShares sharesOf(const PagingSettings& settings, bool hasColours, bool hasNormals);

}  // namespace planet
