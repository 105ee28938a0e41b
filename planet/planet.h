// The facade of the runtime: an open chunk file, its resident tree and its loader threads, stepped once per
// frame.
//
//     auto planet = Planet::open("earth.chk", {}).value();
//     for (;;) {
//         planet->step(view, lodSettings, upload);
//         renderer.draw(view, planet->selection().draw, renderSettings);
//     }
//
// Make all calls from one thread; the loader threads are the planet's own. planet_tools.h has what an editor,
// a test or a recording needs beyond this.
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
    // The Error names the file and what is wrong with it, or a setting and its range; for a budget that is
    // too small it says the least that is enough.
    static Result<std::unique_ptr<Planet>> open(const std::filesystem::path& path,
                                                const PagingSettings& settings,
                                                const FileCalls& calls = systemFileCalls());
    static Result<std::unique_ptr<Planet>> open(PlanetSource source, const PagingSettings& settings);
    ~Planet();  // joins the loader threads
    Planet(const Planet&) = delete;
    Planet& operator=(const Planet&) = delete;

    // Advances by one frame: uploads loaded blocks, selects, drops blocks beyond the budget, and requests
    // missing ones. The first step uploads the root chunks too. views: 1 to maxViews; each has its own
    // selection and requests blocks with its own priorities. A block that several views want is loaded once,
    // with the highest priority. elapsedS: seconds since the last step, >= 0, for fades and simulated time;
    // by default the time that has passed.
    void step(std::span<const ViewInput> views, const UploadChunk& upload,
              std::optional<double> elapsedS = {});
    void step(const View& lodView, const LodSettings& settings, const UploadChunk& upload);

    // Steps until no more blocks are wanted or available, and every fade has ended. Returns false if that
    // takes longer than timeoutS seconds, or if a pause holds up a block that is wanted. In simulated time it
    // steps from the end of one read to the end of the next, and the seconds are simulated; in recorded time
    // it takes one step.
    bool settle(std::span<const ViewInput> views, const UploadChunk& upload, double timeoutS);
    bool settle(const View& lodView, const LodSettings& settings, const UploadChunk& upload, double timeoutS);
    // Returns whether the last selection waits for no block that can still arrive, including retries.
    bool settled() const;

    // Applies new settings at once, without waiting for reads: starts or stops loaders, and drops blocks down
    // to a smaller budget, those out of use first. Where the paging's time changes, reads in progress are
    // requeued. Where normals are turned on in simulated or recorded time, or while moves are kept, the
    // normals of whole faces are derived at once, which reads. Returns true if the capacity of heights has
    // changed: then every slot has moved, the selections are made again, and the renderer needs a pool of
    // that size and uploadAll. The Error says what is wrong, as open's does; then nothing has changed.
    Result<bool> setPaging(const PagingSettings& settings);
    const PagingSettings& pagingSettings() const;

    // Draws heights this many times as high, (0, 100], but no more than largestExaggeration(tree()), which
    // keeps the lowest ground away from the planet's centre; tree().exaggeration is the factor used. Bounds
    // and delta_c follow at once, the selection at the next step. Give the renderer tree().shape. No slot
    // changes.
    void setExaggeration(double factor);

    // Uploads every resident chunk again, for a new renderer.
    void uploadAll(const UploadChunk& upload) const;

    // Returns the changes to the tiles of colours or normals since the last call. Call it after each step in
    // which they are drawn.
    std::vector<TileChange> takeTileChanges(BlockKind kind);
    // Drops all tiles of colours or normals but the roots, and loads them again, for a new renderer.
    void beginTilesAnew(BlockKind kind);

    // Returns the problems since the last call, for a log: blocks that have failed for good, colours or
    // normals that there is no room for, roots that could not be read. The first 1000.
    std::vector<std::string> takeProblems();

    const ChunkFile& file() const;  // only of a planet that was opened from one
    const ChunkTree& tree() const;
    const std::optional<ColourPyramid>& colour() const;  // the file's colours, if it has any
    // Returns the tree of colours or normals; it has no nodes if they are off.
    const TileTree& tiles(BlockKind kind) const;

    // The views of the last step with their selections, whose nodes and slots are valid until the next step.
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
