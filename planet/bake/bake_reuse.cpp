#include "planet/bake/bake_reuse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "planet/bake/colour_bake.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"
#include "planet/source/source_parts.h"
#include "planet/sphere/bounds.h"

namespace planet {

namespace {

// Increase it whenever the same source and settings give other bytes than before.
constexpr std::uint32_t bakeRevision = 2;

// The most levels between a copied subtree and the roots of its units. Chunks at most chunkCellsLog2 levels above
// their units are never searched for their tight metric, so all blocks under them lie together.
constexpr int pieceLevels = 4;

// --- Comparing

// Returns whether a part has influence on a square, with a margin for rounding.
bool touches(const SourcePart& part, const DirectionCone& square) {
    const double apart = std::acos(std::clamp(glm::dot(part.centre, square.axis), -1.0, 1.0));
    return apart <= part.radiusRad + square.halfAngleRad + 1e-7;
}

bool sameParts(std::span<const SourcePart> some, std::span<const SourcePart> others,
               const DirectionCone& square) {
    const auto next = [&](std::span<const SourcePart>& parts) {
        while (!parts.empty() && !touches(parts[0], square)) parts = parts.subspan(1);
        return !parts.empty();
    };
    for (;;) {
        const bool more = next(some);
        if (next(others) != more) return false;
        if (!more) return true;
        if (some[0] != others[0]) return false;
        some = some.subspan(1);
        others = others.subspan(1);
    }
}

// Returns whether the heights of a part in a cap can depend on the grid of a filter, of a spacing or finer.
bool dependsOnFilter(const SourcePart& part, const DirectionCone& cap, double spacingRad) {
    const double farthest = std::asin(std::min(1.0, std::abs(cap.axis.z))) + cap.halfAngleRad + 1e-7;
    const double narrowest = farthest < std::numbers::pi / 2 ? std::cos(farthest) : 0;
    const double along = part.densities.alongPerRad * spacingRad;
    const double around = part.densities.aroundPerRad * spacingRad;
    // The margin is for rounding.
    return !(along < 1 - 1e-9) || !(around <= 0 || around < narrowest * (1 - 1e-9));
}

// Returns what forbids to copy heights from a planet of another shape; empty if nothing does.
std::string differenceOf(const PlanetShape& old, const PlanetShape& now) {
    if (old.radiusM != now.radiusM)
        return fmt::format("its radius is {} m, and that of the new bake {} m", old.radiusM, now.radiusM);
    if (fileQuantumM(old) != fileQuantumM(now) || old.baseHeightM != now.baseHeightM) {
        return fmt::format(
            "it stores heights in steps of {} m from {} m, and the new bake in steps of {} m from {} m",
            fileQuantumM(old), old.baseHeightM, fileQuantumM(now), now.baseHeightM);
    }
    if (old.fractionBits != now.fractionBits)
        return fmt::format("its finest quantum is {} m, and that of the new bake {} m", old.quantumM,
                           now.quantumM);
    if (old.chunkCellsLog2 == now.chunkCellsLog2) return {};
    return fmt::format("its chunk size is {}, and that of the new bake {}", chunkSize(old), chunkSize(now));
}

// --- Copying

struct Copied {
    BakedTile tile;
    std::uint64_t blocks = 0;
};

// Copies the blocks under a chunk of an earlier bake.
class SubtreeCopy {
public:
    SubtreeCopy(const BakeContext& bake, const ChunkFile& file, const ChunkData& root)
        : bake_(bake), file_(file), root_(root) {}

    // mostBytes: more are damage.
    Result<Copied> run(std::uint64_t mostBytes) {
        Copied copied;
        copied.tile.root = {root_.id,
                            {root_.deltaCM, root_.deltaTightM, root_.minStep, root_.maxStep, root_.children},
                            root_.heights.view().toVector()};
        if (!root_.children.exists()) return copied;
        TRY_ASSIGN(first_, firstBlock());
        const std::uint64_t end = root_.children.offset + root_.children.size;
        if (end < root_.children.offset || end <= first_ || end - first_ > mostBytes)
            return elsewhere(root_.id);
        copied.tile.blocks.resize(static_cast<std::size_t>(end - first_));
        TRY(file_.readBytes(first_, copied.tile.blocks));
        bytes_ = copied.tile.blocks;
        TRY(check(root_.id, root_.children));
        if (next_ != bytes_.size()) return elsewhere(root_.id);
        copied.tile.root.entry.children.offset = provisionalOrigin + (root_.children.offset - first_);
        copied.blocks = blocks_;
        return copied;
    }

private:
    // Returns the offset of the first of the blocks, the deepest one of the first chunk that has children.
    Result<std::uint64_t> firstBlock() const {
        ChunkId id = root_.id;
        BlockLocation block = root_.children;
        for (;;) {
            TRY_ASSIGN(const auto entries, file_.readEntries(id, block));
            const auto inner = std::ranges::find_if(
                entries, [](const ChunkEntry& entry) { return entry.children.exists(); });
            if (inner == entries.end()) return block.offset;
            id = childOf(id, static_cast<int>(inner - entries.begin()));
            block = inner->children;
        }
    }

    // Checks the blocks under a chunk: their content, their order and the shape of the tree.
    Result<void> check(const ChunkId& id, BlockLocation block) {
        const std::uint64_t at = block.offset - first_;
        if (block.offset < first_ || at > bytes_.size() || block.size > bytes_.size() - at)
            return elsewhere(id);
        TRY_ASSIGN(const auto entries,
                   file_.checkedEntries(id, block, bytes_.subspan(static_cast<std::size_t>(at), block.size)));
        for (int q = 0; q < quadrantCount; ++q) {
            const ChunkId child = childOf(id, q);
            const BlockLocation below = entries[static_cast<std::size_t>(q)].children;
            if (below.exists() != isRefined(bake_.source, bake_.shape, child)) return elsewhere(child);
            if (below.exists()) TRY(check(child, below));
        }
        if (at != next_) return elsewhere(id);
        next_ = at + block.size;
        ++blocks_;
        return {};
    }

    tl::unexpected<Error> elsewhere(const ChunkId& id) const {
        return badInput(
            fmt::format("{}: the blocks under chunk {} are not where its record of its source says that "
                        "they are; bake it again",
                        file_.name(), toString(id)));
    }

    const BakeContext& bake_;
    const ChunkFile& file_;
    const ChunkData& root_;
    std::span<const std::byte> bytes_;
    std::uint64_t first_ = 0;  // the offset of bytes_ in the file
    std::uint64_t next_ = 0;   // where the next block must lie in bytes_
    std::uint64_t blocks_ = 0;
};

// Puts the heights of a unit's leaves together, in steps.
Result<void> gatherLeaves(const ChunkFile& file, const PlanetShape& shape, const TreeUnit& unit,
                          const ChunkData& chunk, std::span<std::int32_t> steps) {
    if (chunk.children.exists() != (chunk.id.level < unit.leafLevel))
        return badInput(fmt::format("{}: has changed while it was read; bake it again", file.name()));
    if (chunk.children.exists()) {
        TRY_ASSIGN(const auto children, file.readChildren(chunk.id, chunk.children, chunk.heights));
        for (const ChunkData& child : children) TRY(gatherLeaves(file, shape, unit, child, steps));
        return {};
    }
    const int levels = unit.leafLevel - unit.root.level;
    const auto cells = static_cast<std::size_t>(chunkCells(shape));
    const std::size_t side = (cells << levels) + 1;
    const std::size_t column = (chunk.id.x - (unit.root.x << levels)) * cells;
    const std::size_t row = (chunk.id.y - (unit.root.y << levels)) * cells;
    for (std::size_t j = 0; j <= cells; ++j) {
        const StepsView from = chunk.heights.view().subspan(j * (cells + 1), cells + 1);
        from.copyTo(steps.subspan((row + j) * side + column, cells + 1));
    }
    return {};
}

std::uint64_t cellsOf(const TreeUnit& unit, const PlanetShape& shape) {
    const auto along = static_cast<std::uint64_t>(cellsAlong(unit, shape));
    return along * along;
}

Result<Copied> copyStep(const BakeContext& bake, const ChunkFile& file, const BakeStep& step,
                        std::uint64_t cells, BakeScratch& scratch) {
    // The codec needs at most 4 bytes a sample, and each level has a quarter of the samples of the next.
    TRY_ASSIGN(auto copied, SubtreeCopy(bake, file, step.old).run(16 * cells + (1u << 20)));
    for (const TreeUnit& unit : step.units)
        copied.tile.deepestUnitLevel = std::max<int>(copied.tile.deepestUnitLevel, unit.root.level);
    if (step.kind != BakeStep::Kind::Measure) return copied;
    const TreeUnit& unit = step.units[0];
    const auto side = static_cast<std::size_t>(cellsAlong(unit, bake.shape)) + 1;
    scratch.steps.resize(side * side);
    TRY(gatherLeaves(file, bake.shape, unit, step.old, scratch.steps));
    copied.tile.offAboveM = measureUnit(bake.shape, unit, scratch);
    return copied;
}

// A block of colours in a file, and the first of its tiles.
struct ColourBlock {
    ChunkId firstTile;
    BlockLocation location;
};

Result<std::vector<ColourEntry>> readColourBlock(const ChunkFile& file, const ColourBlock& block,
                                                 std::vector<std::byte>& bytes) {
    const std::size_t most =
        quadrantCount * (largestPackedColourTile(file.info().colour->format) + colourEntryBytes) +
        checksumBytes;
    if (block.location.size > most)
        return badInput(fmt::format("{}: a block of colours is too large; bake it again", file.name()));
    bytes.resize(block.location.size);
    TRY(file.readBytes(block.location.offset, bytes));
    return file.checkedColourEntries(block.firstTile, block.location, bytes);
}

// Checks all blocks of colours; returns them in their order, which is that in which a bake writes them.
Result<std::vector<ColourBlock>> colourBlocks(const ChunkFile& file) {
    const ColourPyramid& colour = *file.info().colour;
    std::vector<std::vector<ColourBlock>> levels(static_cast<std::size_t>(colour.leafLevel) + 1);
    for (const Face face : allFaces)
        levels[0].push_back({{face, 0, 0, 0}, colour.roots[static_cast<std::size_t>(face)]});
    std::vector<std::byte> bytes;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        for (const ColourBlock& block : levels[level]) {
            TRY_ASSIGN(const auto entries, readColourBlock(file, block, bytes));
            for (std::size_t q = 0; q < entries.size() && level + 1 < levels.size(); ++q) {
                if (!entries[q].children.exists()) continue;
                ChunkId tile = block.firstTile;
                tile.x += static_cast<std::uint32_t>(q & 1);
                tile.y += static_cast<std::uint32_t>(q >> 1);
                levels[level + 1].push_back({childOf(tile, 0), entries[q].children});
            }
        }
    }
    std::vector<ColourBlock> blocks;
    for (std::size_t level = levels.size(); level-- > 0;)
        blocks.insert(blocks.end(), levels[level].begin(), levels[level].end());
    for (std::size_t i = 1; i < blocks.size(); ++i) {
        const BlockLocation& before = blocks[i - 1].location;
        if (blocks[i].location.offset != before.offset + before.size)
            return badInput(
                fmt::format("{}: its blocks of colours do not lie together; bake it again", file.name()));
    }
    return blocks;
}

}  // namespace

std::optional<SourceRecord> recordOf(const HeightSource& source, const BakeSettings& settings,
                                     const PlanetShape& shape, const ColourSource* colour) {
    if (!source.parts) return std::nullopt;
    Result<std::vector<SourcePart>> parts = source.parts(std::numbers::pi / 2 / faceCells(shape));
    if (!parts || parts->size() > mostSourceParts) return std::nullopt;
    SourceRecord record;
    record.settings = Fingerprint()
                          .add(bakeRevision)
                          .add(std::int32_t{settings.compressionLevel})
                          .add(std::int32_t{deepestLevelOf(shape) - tileLevelOf(shape, settings.tileLevels)})
                          .hash();
    record.minM = source.minM;
    record.maxM = source.maxM;
    record.parts = *std::move(parts);
    if (!colour || !colour->signature) return record;
    const Result<std::uint64_t> signature = colour->signature();
    const Result<int> leaf = colourLeafLevel(*colour, settings.colour);
    if (signature && leaf) {
        record.colours = Fingerprint()
                             .add(bakeRevision)
                             .add(*signature)
                             .add(static_cast<std::uint8_t>(settings.colour.format))
                             .add(std::int32_t{*leaf})
                             .hash();
    }
    return record;
}

std::optional<EarlierBake> EarlierBake::make(ChunkFile file, const HeightSource& source,
                                             const PlanetShape& shape, const SourceRecord& record,
                                             std::string& notice) {
    Result<std::optional<SourceRecord>> earlier = file.readSourceRecord();
    if (!earlier || !*earlier) {
        notice = earlier
                     ? fmt::format(
                           "{}: nothing was copied from it, because it does not say what it was baked from",
                           file.name())
                     : earlier.error().message;
        return std::nullopt;
    }
    SourceRecord& old = **earlier;
    EarlierBake bake(std::move(file));
    bake.source_ = &source;
    bake.difference_ = differenceOf(bake.file_.info().shape, shape);
    if (bake.difference_.empty() && old.settings != record.settings)
        bake.difference_ = "it was baked with other settings or by another version of this program";
    bake.hasSameColours_ = old.colours != 0 && old.colours == record.colours && bake.file_.info().colour;
    bake.compareParts(std::move(old.parts), record.parts);
    bake.compareRanges(old, record);
    bake.compareFilters(shape, record.parts);
    return bake;
}

// Keeps the parts that differ: those at the beginning and at the end that are the same in both do not.
void EarlierBake::compareParts(std::vector<SourcePart> old, std::vector<SourcePart> now) {
    const auto [end, newEnd] = std::mismatch(old.rbegin(), old.rend(), now.rbegin(), now.rend());
    old.erase(end.base(), old.end());
    now.erase(newEnd.base(), now.end());
    const auto [begin, newBegin] = std::mismatch(old.begin(), old.end(), now.begin(), now.end());
    parts_.assign(begin, old.end());
    newParts_.assign(newBegin, now.end());
}

void EarlierBake::compareRanges(const SourceRecord& old, const SourceRecord& now) {
    minM_ = -std::numeric_limits<double>::infinity();
    maxM_ = std::numeric_limits<double>::infinity();
    if (old.minM == now.minM && old.maxM == now.maxM) return;
    // A step of the file is up to half a quantum off, and the ranges are rounded to floats.
    const double largestM =
        std::max({std::abs(old.minM), std::abs(old.maxM), std::abs(now.minM), std::abs(now.maxM)});
    const double marginM = 2 * fileQuantumM(file_.info().shape) + 1e-6 * largestM;
    minM_ = std::max(old.minM, now.minM) + marginM;
    maxM_ = std::min(old.maxM, now.maxM) - marginM;
}

void EarlierBake::compareFilters(const PlanetShape& shape, const std::vector<SourcePart>& parts) {
    const PlanetShape& old = file_.info().shape;
    if (old.faceCellsLog2 == shape.faceCellsLog2) return;
    cells_ = std::min(faceCells(old), faceCells(shape));
    spacingRad_ = std::numbers::pi / 2 / cells_;
    std::ranges::copy_if(parts, std::back_inserter(filtered_), [&](const SourcePart& part) {
        return dependsOnFilter(part, {part.centre, part.radiusRad}, spacingRad_);
    });
}

bool EarlierBake::isUnchanged(const ChunkData& chunk) const {
    const PlanetShape& shape = file_.info().shape;
    if (heightM(shape, chunk.minStep) < minM_ || heightM(shape, chunk.maxStep) > maxM_) return false;
    // The trees may differ too where data is finer than the coarser of both face sizes.
    if (cells_ > 0 && (!source_->finestCells || source_->finestCells(chunk.id) > cells_)) return false;
    if (parts_.empty() && newParts_.empty() && filtered_.empty()) return true;
    const DirectionCone square = chunkDirections(chunk.id).cone;
    return sameParts(parts_, newParts_, square) &&
           std::ranges::none_of(filtered_, [&](const SourcePart& part) {
               return touches(part, square) && dependsOnFilter(part, square, spacingRad_);
           });
}

BakeWalk::BakeWalk(const HeightSource& source, const PlanetShape& shape, int unitLevels,
                   const EarlierBake* earlier)
    : source_(source), shape_(shape), unitLevels_(unitLevels), earlier_(earlier) {
    for (auto face = allFaces.rbegin(); face != allFaces.rend(); ++face) {
        Place place{{*face, 0, 0, 0}, {}, false, -1};
        if (earlier_) {
            Result<ChunkData> root = earlier_->file().readRoot(*face);
            if (root) {
                place.old = *std::move(root);
            } else if (problem_.empty()) {
                problem_ = root.error().message;
            }
        }
        open_.push_back(std::move(place));
    }
}

bool BakeWalk::isUnchanged(const Place& place, bool isRefined) const {
    return place.old && place.old->children.exists() == isRefined &&
           (place.isBelowUnchanged || earlier_->isUnchanged(*place.old));
}

// Returns the units under an unchanged chunk if its subtree can be copied as a whole; else none.
std::vector<TreeUnit> BakeWalk::piece(const Place& place) const {
    // Its finest samples must not be needed by a changed chunk above.
    const auto isNeeded = [&](int unitLevel) {
        return place.changedLevel >= 0 && place.changedLevel >= coarsestLevelOfTiles(unitLevel, shape_);
    };
    if (isNeeded(place.id.level + pieceLevels)) return {};
    std::vector<TreeUnit> units = unitsUnder(source_, shape_, place.id, unitLevels_, pieceLevels);
    if (std::ranges::any_of(units, [&](const TreeUnit& unit) { return isNeeded(unit.root.level); }))
        return {};
    return units;
}

// Goes on with the children of a chunk.
void BakeWalk::open(Place&& place, bool unchanged) {
    std::array<Place, quadrantCount> below;
    for (int q = 0; q < quadrantCount; ++q)
        below[static_cast<std::size_t>(q)] = {
            childOf(place.id, q), {}, unchanged, unchanged ? place.changedLevel : place.id.level};
    if (place.old && place.old->children.exists()) {
        auto children = earlier_->file().readChildren(place.id, place.old->children, place.old->heights);
        for (std::size_t q = 0; children && q < below.size(); ++q) below[q].old = std::move((*children)[q]);
        if (!children && problem_.empty()) problem_ = children.error().message;
    }
    if (unchanged) unchanged_.push_back({place.id, place.old->deltaTightM});
    for (std::size_t q = below.size(); q-- > 0;) open_.push_back(std::move(below[q]));
}

std::optional<BakeStep> BakeWalk::next() {
    using Kind = BakeStep::Kind;
    while (!open_.empty()) {
        Place place = std::move(open_.back());
        open_.pop_back();
        const auto step = [&](Kind kind, std::vector<TreeUnit> units) {
            return BakeStep{kind, std::move(units), kind == Kind::Bake ? ChunkData{} : *std::move(place.old),
                            std::exchange(unchanged_, {})};
        };
        if (const std::optional<TreeUnit> unit = unitAt(source_, shape_, place.id, unitLevels_)) {
            if (!isUnchanged(place, unit->leafLevel > unit->root.level)) return step(Kind::Bake, {*unit});
            const bool isNeeded = place.changedLevel >= 0 &&
                                  place.changedLevel >= coarsestLevelOfTiles(unit->root.level, shape_);
            return step(isNeeded ? Kind::Measure : Kind::Copy, {*unit});
        }
        const bool unchanged = isUnchanged(place, true);
        if (unchanged) {
            if (std::vector<TreeUnit> units = piece(place); !units.empty())
                return step(Kind::Copy, std::move(units));
        }
        open(std::move(place), unchanged);
    }
    return std::nullopt;
}

Result<StepResult> runStep(const BakeContext& bake, const EarlierBake* earlier, const BakeStep& step,
                           BakeScratch& scratch) {
    StepResult result;
    for (const TreeUnit& unit : step.units) result.cells += cellsOf(unit, bake.shape);
    if (step.kind != BakeStep::Kind::Bake) {
        Result<Copied> copied = copyStep(bake, earlier->file(), step, result.cells, scratch);
        if (copied) {
            result.copiedChunks = quadrantCount * copied->blocks;
            result.tiles.push_back(std::move(copied->tile));
            return result;
        }
        result.problem = copied.error().message;
    }
    for (const TreeUnit& unit : step.units) {
        TRY_ASSIGN(auto tile, bakeTile(bake, unit, scratch));
        result.tiles.push_back(std::move(tile));
    }
    result.sampledCells = result.cells;
    return result;
}

Result<std::optional<ColourPyramid>> copyColours(const ChunkFile& earlier, AtomicFile& file,
                                                 const std::function<bool(std::uint64_t)>& progress,
                                                 std::string& notice) {
    const Result<std::vector<ColourBlock>> blocks = colourBlocks(earlier);
    if (!blocks) {
        notice = blocks.error().message;
        return std::nullopt;
    }
    ColourPyramid colour = *earlier.info().colour;
    std::vector<std::byte> bytes;
    for (const ColourBlock& block : *blocks) {
        TRY_ASSIGN(const auto entries, readColourBlock(earlier, block, bytes));
        const bool isRoot = block.firstTile.level == 0;
        if (isRoot)
            colour.roots[static_cast<std::size_t>(block.firstTile.face)] = {file.size(), block.location.size};
        TRY(file.append(bytes));
        if (progress && !progress(entries.size())) return cancelled();
    }
    return colour;
}

}  // namespace planet
