// The facade of the runtime: an open chunk file, its resident tree and its loader threads, stepped once per
// frame.
//
//     auto planet = Planet::open("earth.chk", {}).value();
//     for (;;) {
//         planet->step(view, lodSettings, upload);
//         renderer.draw(view, planet->selection().draw, renderSettings);
//     }
//
// Make all calls from one thread; the planet has its own loader threads. planet_tools.h adds what editors,
// tests and recordings need.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"
#include "planet/format/chunk_file.h"
#include "planet/paging/paging_types.h"
#include "planet/planet_types.h"
#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"
#include "planet/tree/tile_tree.h"

namespace planet {

struct PlanetState;     // planet_state.h
class PlanetInspector;  // planet_tools.h
class PlanetTools;      // planet_tools.h

class Planet {
public:
    // Open a planet from a chunk file or another source. The Error names the file and its problem, or a
    // setting and its range. For a budget that is too small, it gives the smallest one.
    static Result<std::unique_ptr<Planet>> open(const std::filesystem::path& path,
                                                const PagingSettings& settings,
                                                const FileCalls& calls = systemFileCalls());
    static Result<std::unique_ptr<Planet>> open(PlanetSource source, const PagingSettings& settings);
    ~Planet();  // joins the loader threads
    Planet(const Planet&) = delete;
    Planet& operator=(const Planet&) = delete;

    // Advances by one frame: uploads loaded blocks, selects, drops blocks beyond the budget, and requests
    // missing ones. The first step also uploads the root chunks. views: 1 to maxViews; each has its own
    // selection and requests blocks with its own priorities. A block that several views request is loaded
    // once, with the highest priority. elapsedS: seconds since the last step, >= 0, for fades and simulated
    // time; by default the real time.
    void step(std::span<const ViewInput> views, const UploadChunk& upload,
              std::optional<double> elapsedS = {});
    void step(const View& lodView, const LodSettings& settings, const UploadChunk& upload);

    // Steps until no more blocks are needed or available, and every fade has ended. Returns false if that
    // takes longer than timeoutS seconds, or if a needed block cannot load because paging is paused. In
    // simulated time, it steps from the end of one read to the end of the next, and seconds are simulated. In
    // recorded time, it takes one step.
    bool settle(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS);
    bool settle(const View& lodView, const LodSettings& settings, const UploadChunk& upload, double timeoutS);
    // Returns whether the last selection waits for no block that can still arrive, retries included.
    bool settled() const;

    // Applies new settings at once, without waiting for reads: starts or stops loaders, and drops blocks down
    // to a smaller budget, unused ones first. If the paging's time changes, reads in progress are requeued.
    // If normals are turned on in simulated or recorded time, or while moves are kept, the normals of whole
    // faces are derived at once, which reads the file.
    //
    // Returns true if the capacity of heights has changed. Then every slot has moved, the selections are made
    // again, and the renderer needs a pool of that size and uploadAll. The Error describes the problem as
    // open's does; then nothing has changed.
    Result<bool> setPaging(const PagingSettings& settings);
    const PagingSettings& pagingSettings() const;

    // Multiplies all heights by a factor, (0, 100], limited to largestExaggeration(tree()), which keeps the
    // lowest ground away from the planet's centre. tree().exaggeration is the factor used. Bounds and δc
    // change at once, the selection at the next step. Pass tree().shape to the renderer. Slots do not change.
    void setExaggeration(double factor);

    // Sets the regions (region.h); none for an empty list. Bounds and heights stay, so only the selection changes, at the
    // next step. The Error is that of checkRegions; then nothing has changed. tree().regions holds them.
    Result<void> setRegions(std::vector<Region> regions);

    // Uploads every resident chunk, for a new renderer.
    void uploadAll(const UploadChunk& upload) const;

    // Announces where a view will be, so that its blocks are loaded early: points of its path, in any order,
    // or just a destination. view: its index in step(); the announced views get its settings. Replaces what
    // was announced for that view, and takes effect at the next step. A point is forgotten once its time has
    // passed. No effect unless PrefetchSettings::mode is Announced. At most maxAnnounced points; the rest are
    // ignored, the latest first.
    void announce(std::span<const AnnouncedView> path, std::size_t view = 0);

    // Returns the changes to the tiles of colours or normals since the last call. Call it after each step in
    // which they are drawn.
    std::vector<TileChange> takeTileChanges(BlockKind kind);
    // Drops all tiles of colours or normals except the roots, and loads them again, for a new renderer.
    void reloadTiles(BlockKind kind);

    // Returns the first 1000 problems since the last call, for a log: blocks that have failed for good,
    // colours or normals without room, roots that could not be read.
    std::vector<std::string> takeProblems();

    const ChunkFile& file() const;  // requires a planet that was opened from a file
    const ChunkTree& tree() const;
    const std::optional<ColourPyramid>& colour() const;  // the file's colours, if it has any
    // Returns the tree of colours or normals; it has no nodes if they are off.
    const TileTree& tiles(BlockKind kind) const;

    // Return the views of the last step with their selections. Nodes and slots in them are valid until the
    // next step.
    std::span<const PlanetView> views() const;
    const Selection& selection(std::size_t view = 0) const;
    const PagingCounters& paging() const;
    const LastStep& lastStep() const;

    PlanetInspector inspect() const;
    PlanetTools tools();

private:
    explicit Planet(std::unique_ptr<PlanetState> state);
    bool settleSimulated(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS);
    std::unique_ptr<PlanetState> state_;
};

// Reads the roots of a chunk file for Planet::open. The Error names the file and the chunk.
Result<PlanetSource> planetSource(ChunkFile file);

}  // namespace planet
