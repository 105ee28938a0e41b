// The state of a Planet. Internal to the library.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "planet/base/stopwatch.h"
#include "planet/paging/chunk_paging.h"
#include "planet/paging/normal_roots.h"
#include "planet/paging/pager.h"
#include "planet/paging/tile_paging.h"
#include "planet/planet_types.h"
#include "planet/select/prediction.h"
#include "planet/select/tile_select.h"

namespace planet {

// The course of one view: where it has been, and where it is announced to be.
struct ViewCourse {
    ViewHistory history;
    std::vector<AnnouncedView> announced;  // ascending times, seconds from the last step
};

// The blocks that views are predicted to want and to use, by kind.
struct Predicted {
    std::array<std::vector<MergedRequest>, blockKindCount> wanted;
    std::array<std::vector<NodeIndex>, blockKindCount> touched;
    // The parents of the blocks that a view will want when what it requests now has arrived.
    std::array<std::unordered_set<NodeIndex>, blockKindCount> lasting;
};

// How long a block waits for its read while loaders fall behind: by Little's law, the number of queued blocks over the
// rate of reads. All of it is known to a replay too.
struct Backlog {
    std::size_t queued = 0;  // blocks that views want, at the last step
    std::size_t ended = 0;   // reads, in this step
    double readsPerS = 0;    // over the last seconds in which loaders were busy; 0: unknown

    double waitS() const { return readsPerS > 0 ? static_cast<double>(queued) / readsPerS : 0; }
};

struct PlanetState {
    using Clock = std::chrono::steady_clock;

    PlanetState(ChunkTree&& tree, std::uint32_t chunkSlots, std::shared_ptr<const ChunkFile> chunkFile,
                std::unique_ptr<NormalDeriver> deriver);

    PagingSettings settings;
    std::shared_ptr<const ChunkFile> file;
    std::optional<ColourPyramid> colour;
    std::vector<PlanetView> views{1};
    std::array<ViewCourse, maxViews> courses;
    Backlog backlog;
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

    void announce(std::span<const AnnouncedView> path, std::size_t view);
    void forgetCourses();

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
    void followCourses(double elapsedS);
    std::vector<AnnouncedView> viewsAhead(std::size_t view) const;
    Predicted predict() const;
    void measureBacklog(double elapsedS);
    MergedRequests mergeFor(BlockKind kind) const;
    void noteTaken(const PagingQueue& lockedQueue);
    void selectAgain();
};

// Returns what a view lacks.
const std::vector<ChildrenRequest>& requestsIn(const PlanetView& view, BlockKind kind);
// Sorts by priority, highest first; ties by block.
void sortByPriority(std::vector<MergedRequest>& requests);

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
