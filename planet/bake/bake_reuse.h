// Takes from an earlier bake what a changed source leaves as it was.
//
// A chunk file says what it was baked from, part by part, and where each part has influence (source_record.h). A
// chunk is unchanged if the same parts, in the same order, have influence on its square, and all settings that
// heights depend on are the same. If the range of the source has changed, to which heights are clamped, the chunk's
// heights must also lie inside both ranges. If the face size has changed, for which the filter is made, both filters must
// be finer than the samples of all its parts. Then the blocks under the chunk are copied as they are: entries name
// their children by distance, so blocks that lie together can move.
//
// A bake copies the largest possible subtrees that lie together in the file, but at most pieceLevels levels of
// units: memory and the work of a task stay bounded. The chunks above the pieces are made again from their
// children, with the tight metric of the earlier bake.
//
// A changed chunk's tight metric is the largest distance from it of all finest samples under it. So the units under
// it that have not changed are decoded and measured too, but neither sampled nor compressed. Those are at most
// as many as lie under a chunk whose cells are as wide as a unit, for each changed place.
//
// The earlier file is untrusted, like any chunk file. A block is copied only if its checksum is right, and if it lies
// exactly where this bake would write it. Where it is damaged, the units are baked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planet/bake/bake_tile.h"
#include "planet/bake/bake_tree.h"
#include "planet/base/atomic_file.h"
#include "planet/format/chunk_file.h"
#include "planet/source/colour_source.h"

namespace planet {

// Returns the record of a bake. Nothing if the source cannot say what it depends on.
std::optional<SourceRecord> recordOf(const HeightSource& source, const BakeSettings& settings,
                                     const PlanetShape& shape, const ColourSource* colour);

// An earlier bake, compared with the source of a new one. Any thread.
class EarlierBake {
public:
    // source: of the new bake, with its shape and record; must outlive this. Returns nothing, and the reason in
    // notice, if the file cannot be used at all.
    static std::optional<EarlierBake> make(ChunkFile file, const HeightSource& source,
                                           const PlanetShape& shape, const SourceRecord& record,
                                           std::string& notice);

    const ChunkFile& file() const { return file_; }
    // Returns an empty text if heights may be copied: the shape and the settings are the same. Otherwise says
    // what differs.
    const std::string& difference() const { return difference_; }
    // Returns whether a chunk of the file comes out the same.
    bool isUnchanged(const ChunkData& chunk) const;
    bool hasSameColours() const { return hasSameColours_; }

private:
    explicit EarlierBake(ChunkFile file) : file_(std::move(file)) {}
    void compareParts(std::vector<SourcePart> old, std::vector<SourcePart> now);
    void compareRanges(const SourceRecord& old, const SourceRecord& now);
    void compareFilters(const PlanetShape& shape, const std::vector<SourcePart>& parts);

    ChunkFile file_;
    const HeightSource* source_ = nullptr;
    std::string difference_;
    bool hasSameColours_ = false;
    // The parts without those at the beginning and at the end that are the same in both.
    std::vector<SourcePart> parts_;
    std::vector<SourcePart> newParts_;
    // The heights that no range has clamped.
    double minM_ = 0;
    double maxM_ = 0;
    // If the face sizes differ: the coarser filter's spacing, its cells along a face, and all parts of the new source
    // that may depend on it.
    double spacingRad_ = 0;
    int cells_ = 0;
    std::vector<SourcePart> filtered_;
};

// A chunk above all units of its subtree that has not changed.
struct UnchangedChunk {
    ChunkId id;
    float deltaTightM = 0;
};

// A step of a bake: what a task does.
struct BakeStep {
    enum class Kind : std::uint8_t {
        Bake,     // sample and compress a unit
        Measure,  // copy a unit, and measure it for the changed chunks above it
        Copy      // copy a subtree
    };
    Kind kind = Kind::Bake;
    std::vector<TreeUnit> units;            // in quadtree order; one unless it copies
    ChunkData old;                          // the root in the earlier bake, unless it bakes
    std::vector<UnchangedChunk> unchanged;  // the chunks above it that no earlier step is below
};

// Divides a tree into steps, in quadtree order. Reads the upper chunks of the earlier bake.
class BakeWalk {
public:
    // earlier: null if there is none. All must outlive the walk.
    BakeWalk(const HeightSource& source, const PlanetShape& shape, int unitLevels,
             const EarlierBake* earlier);

    std::optional<BakeStep> next();  // nothing at the end

    const std::string& problem() const { return problem_; }  // the first Error of reading; empty if none

private:
    struct Place {
        ChunkId id;
        std::optional<ChunkData> old;
        bool isBelowUnchanged = false;
        int changedLevel = -1;  // of the deepest changed chunk above; -1: none
    };
    void open(Place&& place, bool unchanged);
    bool isUnchanged(const Place& place, bool isRefined) const;
    std::vector<TreeUnit> piece(const Place& place) const;

    const HeightSource& source_;
    PlanetShape shape_;
    int unitLevels_;
    const EarlierBake* earlier_;
    std::vector<Place> open_;  // the next one last
    std::vector<UnchangedChunk> unchanged_;
    std::string problem_;
};

// The result of a step.
struct StepResult {
    std::vector<BakedTile> tiles;
    std::uint64_t cells = 0;         // of all leaves
    std::uint64_t sampledCells = 0;  // of those that were sampled
    std::uint64_t copiedChunks = 0;
    std::string problem;  // the Error of copying, if it failed and the units were baked instead
};
Result<StepResult> runStep(const BakeContext& bake, const EarlierBake* earlier, const BakeStep& step,
                           BakeScratch& scratch);

// Appends the colours of the earlier bake to a file, as they are. Nothing, and the reason in notice, if they are
// damaged; then nothing has been appended. Calls progress with a number of tiles; returning false cancels.
Result<std::optional<ColourPyramid>> copyColours(const ChunkFile& earlier, AtomicFile& file,
                                                 const std::function<bool(std::uint64_t)>& progress,
                                                 std::string& notice);

}  // namespace planet
