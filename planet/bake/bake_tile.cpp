#include "planet/bake/bake_tile.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <span>
#include <tuple>

#include "planet/bake/quantise.h"
#include "planet/base/check_range.h"
#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"
#include "planet/source/sample_tiles.h"
#include "planet/sphere/chunk_surface.h"

namespace planet {

namespace {

std::span<std::int32_t> joinQuarters(const PlanetShape& shape,
                                     std::span<const BakedChunk, quadrantCount> children,
                                     std::vector<std::int32_t>& refined) {
    const auto side = static_cast<std::size_t>(chunkSize(shape));
    const std::size_t refinedSide = 2 * side - 1;
    refined.resize(refinedSide * refinedSide);
    for (std::size_t q = 0; q < children.size(); ++q) {
        placeQuarter(children[q].heights, chunkCells(shape), static_cast<int>(q), refined);
    }
    return refined;
}

std::vector<std::int32_t> everyOther(std::span<const std::int32_t> refined, std::size_t side) {
    const std::size_t refinedSide = 2 * side - 1;
    std::vector<std::int32_t> coarse(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) coarse[j * side + i] = refined[2 * j * refinedSide + 2 * i];
    }
    return coarse;
}

BakedChunk cutLeaf(const BakeContext& bake, const ChunkId& id, const SampleTile& tile,
                   std::span<const std::int32_t> steps) {
    const auto side = static_cast<std::size_t>(chunkSize(bake.shape));
    const SampleTile square = tileOf(bake.shape, id, id.level);
    BakedChunk leaf;
    leaf.id = id;
    leaf.heights.resize(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        const std::size_t at = indexIn(tile, square.firstColumn, square.firstRow + static_cast<int>(j));
        const auto from = steps.subspan(at, side);
        std::copy(from.begin(), from.end(), leaf.heights.begin() + static_cast<std::ptrdiff_t>(j * side));
    }
    std::tie(leaf.entry.minStep, leaf.entry.maxStep) = lowestAndHighest(leaf.heights);
    return leaf;
}

// Returns the δg of a chunk of a unit. positions: those of the unit's samples.
double deltaGOf(const PlanetShape& shape, const ChunkId& id, int leafLevel, const SampleTile& tile,
                const GeometricErrorScratch& positions) {
    const SampleTile square = tileOf(shape, id, leafLevel);
    const auto cells = static_cast<std::size_t>(2 * chunkCells(shape));
    const auto stride = static_cast<std::size_t>(square.columns - 1) / cells;
    return geometricErrorOnGridM(positions, static_cast<std::size_t>(tile.columns),
                                 {static_cast<std::size_t>(square.firstColumn - tile.firstColumn),
                                  static_cast<std::size_t>(square.firstRow - tile.firstRow), stride, cells});
}

BakedChunk bakeSubtree(const BakeContext& bake, const ChunkId& id, int leafLevel, const SampleTile& tile,
                       BakeScratch& scratch, std::vector<std::byte>& blocks) {
    if (id.level == leafLevel) return cutLeaf(bake, id, tile, scratch.steps);
    std::array<BakedChunk, quadrantCount> children;
    for (int q = 0; q < quadrantCount; ++q) {
        children[static_cast<std::size_t>(q)] =
            bakeSubtree(bake, childOf(id, q), leafLevel, tile, scratch, blocks);
    }
    const bool aboveLeaves = id.level + 1 == leafLevel;
    const double finestDistanceM = aboveLeaves ? 0 : scratch.distances.of(id);
    const double deltaGM = deltaGOf(bake.shape, id, leafLevel, tile, scratch.geometry);
    return mergeChildren(bake, id, children, {deltaGM, finestDistanceM}, provisionalOrigin, scratch, blocks);
}

}  // namespace

Result<void> checkBakeSettings(const BakeSettings& settings) {
    TRY(checkRange("compression level", settings.compressionLevel, minCompressionLevel, maxCompressionLevel));
    if (settings.threads < 0 || settings.threads > 1024) {
        return badInput(fmt::format("threads: {} is out of range; expected [1, 1024] or 0 (one per core)",
                                    settings.threads));
    }
    if (settings.finestQuantumM && !(*settings.finestQuantumM > 0 && *settings.finestQuantumM <= 1e6)) {
        return badInput(fmt::format("finest quantum: {} m is out of range; expected (0, 1e6] m",
                                    *settings.finestQuantumM));
    }
    return checkRange("levels per tile", settings.tileLevels.value_or(0), 0, 10);
}

Result<PlanetShape> chooseShape(const HeightSource& source, const BakeSettings& settings) {
    PlanetShape shape;
    const int chunk = settings.chunkSize;
    if (chunk != 17 && chunk != 33 && chunk != 65 && chunk != 129) {
        return badInput(fmt::format("chunk size: {} is invalid; expected 17, 33, 65 or 129", chunk));
    }
    shape.chunkCellsLog2 = std::countr_zero(static_cast<unsigned>(chunk - 1));
    const int face = settings.faceSize.value_or(std::max(source.naturalFaceSize, chunk));
    if (face < 2 || !std::has_single_bit(static_cast<unsigned>(face - 1))) {
        return badInput(
            fmt::format("face size: {} is invalid; expected 2^n + 1, for example 1025, 2049 or 4097", face));
    }
    shape.faceCellsLog2 = std::countr_zero(static_cast<unsigned>(face - 1));
    if (face < chunk || shape.faceCellsLog2 > maxFaceCellsLog2 || deepestLevelOf(shape) > maxLevel) {
        return badInput(fmt::format("face size: {} is out of range; expected [{}, {}], from the chunk size",
                                    face, chunk,
                                    (1 << std::min(maxFaceCellsLog2, maxLevel + shape.chunkCellsLog2)) + 1));
    }
    if (!source.finestCells && shape.faceCellsLog2 > maxDenseFaceCellsLog2) {
        return badInput(fmt::format(
            "face size: {} is too large for a source that is equally fine everywhere; expected at most {}",
            face, (1 << maxDenseFaceCellsLog2) + 1));
    }
    if (!(settings.radiusM >= leastRadiusM && settings.radiusM <= mostRadiusM)) {
        return badInput(fmt::format("radius: {} m is out of range; expected [{}, {:g}] m", settings.radiusM,
                                    leastRadiusM, mostRadiusM));
    }
    shape.radiusM = settings.radiusM;
    TRY(chooseQuantum(source, settings.quantumM, shape));
    // A quantum that is asked for counts for the whole file, unless finer ones are asked for too.
    const bool isFixed = settings.quantumM && !settings.finestQuantumM;
    if (!isFixed) chooseFractions(source, settings.finestQuantumM.value_or(0), shape);
    if (shape.radiusM + heightM(shape, lowestStepOf(shape.fractionBits)) <= 0 &&
        shape.radiusM + source.minM <= 0) {
        return badInput(
            fmt::format("{}: its lowest height, {} m, is below the centre of a planet of radius {} m",
                        source.description, source.minM, shape.radiusM));
    }
    return shape;
}

int bakeThreads(const BakeSettings& settings) {
    return settings.threads > 0 ? settings.threads : tbb::this_task_arena::max_concurrency();
}

Result<BakedTile> bakeTile(const BakeContext& bake, const TreeUnit& unit, BakeScratch& scratch) {
    const SampleTile tile = tileOf(bake.shape, unit.root, unit.leafLevel);
    scratch.steps.resize(samplesIn(tile));
    TRY(sampleSteps(bake.shape, bake.source, tile, scratch.sampled, scratch.steps));
    BakedTile result;
    result.deepestUnitLevel = unit.root.level;
    result.offAboveM = measureUnit(bake.shape, unit, scratch);
    result.root = bakeSubtree(bake, unit.root, unit.leafLevel, tile, scratch, result.blocks);
    return result;
}

std::vector<double> measureUnit(const PlanetShape& shape, const TreeUnit& unit, BakeScratch& scratch) {
    measureTile(shapeOfLevel(shape, unit.leafLevel), unit.root, scratch.steps, scratch.geometry,
                scratch.distances);
    std::vector<double> offAboveM;
    for (int level = scratch.distances.coarsestLevel;
         level <= std::min(unit.root.level - 1, unit.leafLevel - 2); ++level) {
        offAboveM.push_back(scratch.distances.above(level));
    }
    return offAboveM;
}

BakedChunk mergeChildren(const BakeContext& bake, const ChunkId& parent,
                         std::span<const BakedChunk, quadrantCount> children, const ChunkErrors& errors,
                         std::uint64_t origin, BakeScratch& scratch, std::vector<std::byte>& blocks) {
    const auto refined = joinQuarters(bake.shape, children, scratch.refined);
    BakedChunk chunk;
    chunk.id = parent;
    chunk.heights = everyOther(refined, static_cast<std::size_t>(chunkSize(bake.shape)));
    chunk.entry.minStep = children[0].entry.minStep;
    chunk.entry.maxStep = children[0].entry.maxStep;
    float childrenDeltaM = 0;
    float childrenTightM = 0;
    bool aboveLeaves = false;
    std::array<ChunkEntry, quadrantCount> entries;
    for (std::size_t q = 0; q < children.size(); ++q) {
        const BakedChunk& child = children[q];
        entries[q] = child.entry;
        aboveLeaves = aboveLeaves || !child.entry.children.exists();
        chunk.entry.minStep = std::min(chunk.entry.minStep, child.entry.minStep);
        chunk.entry.maxStep = std::max(chunk.entry.maxStep, child.entry.maxStep);
        childrenDeltaM = std::max(childrenDeltaM, child.entry.deltaCM);
        childrenTightM = std::max(childrenTightM, child.entry.deltaTightM);
    }
    const double deltaGM =
        errors.deltaGM ? *errors.deltaGM : geometricErrorM(bake.shape, parent, refined, scratch.geometry);
    chunk.entry.deltaCM = roundedUp(deltaGM + childrenDeltaM);
    // The samples of a leaf child lie off the parent's surface by at most δg. For other children, δg is not
    // larger than the distance from the samples below them.
    const double ownM = aboveLeaves ? std::max(deltaGM, errors.finestDistanceM) : errors.finestDistanceM;
    chunk.entry.deltaTightM = tightMetric(ownM, childrenTightM, chunk.entry.deltaCM);

    const std::size_t start = blocks.size();
    const std::uint64_t offset = origin + start;
    putIndex(blocks, entries, offset);
    encodeRefinement(refined, chunkCells(bake.shape), bake.compressionLevel, bake.shape.fractionBits, blocks);
    ByteWriter(blocks).put(siblingChecksum(std::span(blocks).subspan(start), parent));
    chunk.entry.children = {offset, static_cast<std::uint32_t>(blocks.size() - start)};
    return chunk;
}

}  // namespace planet
