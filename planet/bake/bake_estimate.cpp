#include "planet/bake/bake_estimate.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "planet/bake/bake_tile.h"
#include "planet/bake/bake_tree.h"
#include "planet/bake/spread_places.h"
#include "planet/base/parallel.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"
#include "planet/source/sample_tiles.h"

namespace planet {

namespace {

// Takes one core about a second. Half of it is spent on single blocks at many places. The other half is spent
// on blocks with their parent's block, which show how blocks grow from level to level.
constexpr std::uint64_t samplesToBake = 4'000'000;
constexpr std::uint64_t fewestPlaces = 8;
constexpr std::uint64_t mostPlaces = 2048;

struct Sample {
    std::uint64_t leafBlocks = 0;
    std::uint64_t leafBlockBytes = 0;
    std::uint64_t upperBlocks = 0;  // blocks one level above
    std::uint64_t upperBlockBytes = 0;
    std::uint64_t belowUpperBytes = 0;  // part of leafBlockBytes under them
    std::uint64_t finestSamples = 0;
    double bakeS = 0;  // on one thread, with the source's blocks cached
    double readS = 0;  // loading these blocks

    void add(const Sample& other) {
        leafBlocks += other.leafBlocks;
        leafBlockBytes += other.leafBlockBytes;
        upperBlocks += other.upperBlocks;
        upperBlockBytes += other.upperBlockBytes;
        belowUpperBytes += other.belowUpperBytes;
        finestSamples += other.finestSamples;
        bakeS += other.bakeS;
        readS += other.readS;
    }
};

// Reads the four corners of a tile, so that the source loads its blocks there; cached blocks take no time.
Result<void> readCorners(const BakeContext& bake, const TreeUnit& unit) {
    const SampleTile square = tileOf(bake.shape, unit.root, unit.leafLevel);
    for (const int corner : {0, 1, 2, 3}) {
        float height = 0;
        SampleTile tile = square;
        tile.firstColumn += (corner & 1) * (square.columns - 1);
        tile.firstRow += (corner >> 1) * (square.rows - 1);
        tile.columns = tile.rows = 1;
        TRY(bake.source.sample(tile, {&height, 1}));
    }
    return {};
}

Result<Sample> bakePlace(const BakeContext& bake, const TreeUnit& unit, BakeScratch& scratch) {
    Sample sample;
    const Stopwatch reading;
    TRY(readCorners(bake, unit));
    sample.readS = reading.elapsedS();
    const Stopwatch baking;
    TRY_ASSIGN(const auto tile, bakeTile(bake, unit, scratch));
    sample.bakeS = baking.elapsedS();

    const auto cells = static_cast<std::uint64_t>(cellsAlong(unit, bake.shape));
    sample.finestSamples = cells * cells;
    const std::uint64_t lastBlock = tile.root.entry.children.size;
    if (unit.root.level + 1 == unit.leafLevel) {
        sample.leafBlocks = 1;
        sample.leafBlockBytes = lastBlock;
    } else {
        sample.leafBlocks = quadrantCount;
        sample.leafBlockBytes = tile.blocks.size() - lastBlock;
        sample.belowUpperBytes = sample.leafBlockBytes;
        sample.upperBlocks = 1;
        sample.upperBlockBytes = lastBlock;
    }
    return sample;
}

Result<Sample> bakePlaces(const BakeContext& bake, const std::vector<TreeUnit>& units, int threads,
                          const std::function<bool()>& goOn) {
    std::mutex mutex;  // guards outcome; held during calls of goOn
    Result<Sample> outcome;
    const auto hasFailed = [&] {
        const std::lock_guard lock(mutex);
        return !outcome;
    };
    PerThread<BakeScratch> scratches;
    parallelFor(threads, units.size(), [&](std::size_t i) {
        if (hasFailed()) return;
        const Result<Sample> sample = bakePlace(bake, units[i], scratches.local());
        const std::lock_guard lock(mutex);
        if (!outcome) return;
        if (!sample) {
            outcome = tl::unexpected(sample.error());
        } else {
            outcome->add(*sample);
            if (goOn && !goOn()) outcome = cancelled();
        }
    });
    return outcome;
}

// Returns the bytes of all sibling blocks, by the height of their parents, from the leaves' parents upwards.
// A coarser level's blocks are larger, because its samples are farther apart. So the estimate adds the
// measured growth for each level, up to the size of uncoded samples.
double estimatedBlockBytes(const PlanetShape& shape, const TreeCount& tree, const Sample& sample) {
    const double cells = chunkCells(shape);
    const double bareBytes = 2 * ((2 * cells + 1) * (2 * cells + 1) - (cells + 1) * (cells + 1)) + 128;
    double bytes = static_cast<double>(sample.leafBlockBytes) / static_cast<double>(sample.leafBlocks);
    // Both numbers are from the same places, because places differ more than levels do.
    const double growth = sample.upperBlocks == 0
                              ? 0
                              : bytes * (static_cast<double>(quadrantCount * sample.upperBlockBytes) /
                                             static_cast<double>(sample.belowUpperBytes) -
                                         1);
    double total = 0;
    for (const std::uint64_t blocks : tree.refinedByHeight) {
        total += bytes * static_cast<double>(blocks);
        bytes = std::clamp(bytes + growth, 0.0, bareBytes);
    }
    return total;
}

// Returns the bytes of the root blocks.
Result<double> rootBytes(const BakeContext& bake, BakeScratch& scratch) {
    const double samples = chunkVertexCount(bake.shape);
    if (deepestLevelOf(bake.shape) > 0) {
        // On a root, neighbouring samples are far apart, so it hardly compresses.
        return faceCount * (1.8 * samples + 100);
    }
    double bytes = 0;
    for (const Face face : allFaces) {
        TRY_ASSIGN(const auto tile, bakeTile(bake, {{face, 0, 0, 0}, 0}, scratch));
        std::vector<std::byte> coded;
        encodeGrid(tile.root.heights, chunkSize(bake.shape), bake.shape.fractionBits, coded);
        bytes += static_cast<double>(coded.size() + 8);
    }
    return bytes;
}

// A random choice of units, of as many as are wanted, made while they come by. Each has the same chance.
struct Choice {
    std::uint64_t wanted = 0;
    std::uint64_t seen = 0;
    std::vector<TreeUnit> units{};

    void offer(const TreeUnit& unit) {
        const std::uint64_t place = scrambled64(seen) % (seen + 1);
        ++seen;
        if (units.size() < wanted)
            units.push_back(unit);
        else if (place < wanted)
            units[static_cast<std::size_t>(place)] = unit;
    }
};

// Returns leaves' parents of a sparse tree, and fewer units of two levels of blocks, if there are any.
Result<std::vector<TreeUnit>> sparsePlaces(const BakeContext& bake, std::uint64_t wanted, std::uint64_t fewer,
                                           const std::function<bool()>& goOn) {
    constexpr std::uint64_t unitsBetweenCalls = 1024;
    Choice single{wanted};
    Choice twoLevels{fewer};
    std::uint64_t walked = 0;
    TreeWalk walk(bake.source, bake.shape, 2);
    while (const std::optional<TreeUnit> unit = walk.next()) {
        if (++walked % unitsBetweenCalls == 0 && goOn && !goOn()) return cancelled();
        const int levels = unit->leafLevel - unit->root.level;
        if (levels == 1) single.offer(*unit);
        if (levels < 2) continue;
        twoLevels.offer(*unit);
        for (int q = 0; q < quadrantCount; ++q) single.offer({childOf(unit->root, q), unit->leafLevel});
    }
    single.units.insert(single.units.end(), twoLevels.units.begin(), twoLevels.units.end());
    return single.units;
}

// Returns places for single blocks and, if the planet has two levels of blocks, fewer places for two levels.
Result<std::vector<TreeUnit>> placesToBake(const BakeContext& bake, const std::function<bool()>& goOn) {
    const PlanetShape& shape = bake.shape;
    const std::uint64_t cells = 2 * static_cast<std::uint64_t>(chunkCells(shape));
    const std::uint64_t wanted = std::clamp(samplesToBake / 2 / (cells * cells), fewestPlaces, mostPlaces);
    const std::uint64_t fewer = std::max(wanted / 4, fewestPlaces / 2);
    if (bake.source.finestCells) return sparsePlaces(bake, wanted, fewer, goOn);
    std::vector<TreeUnit> units;
    for (const ChunkId& root : spreadPlaces(deepestLevelOf(shape) - 1, wanted))
        units.push_back({root, deepestLevelOf(shape)});
    if (deepestLevelOf(shape) == 1) return units;
    for (const ChunkId& root : spreadPlaces(deepestLevelOf(shape) - 2, fewer))
        units.push_back({root, deepestLevelOf(shape)});
    return units;
}

// Returns the memory of a bake of heights.
std::uint64_t memoryOfBake(const HeightSource& source, const BakeSettings& settings,
                           const PlanetShape& shape) {
    constexpr std::uint64_t libraryBytes = 12u << 20;   // of GDAL and PROJ, and of the image library
    constexpr std::uint64_t usualCallBytes = 2u << 20;  // samples that a call reads at once
    constexpr std::uint64_t bytesPerSampleAtWork = 96;  // heights, quanta, steps, positions and errors
    const int tileLevels = deepestLevelOf(shape) - tileLevelOf(shape, settings.tileLevels);
    const std::uint64_t side = (static_cast<std::uint64_t>(chunkCells(shape)) << tileLevels) + 1;
    const std::uint64_t callBytes = std::min(source.sampleCount * sizeof(float), usualCallBytes);
    const auto threads = static_cast<std::uint64_t>(
        std::min(bakeThreads(settings), static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u))));
    return source.memoryBytes + (source.sampleCount > 0 ? libraryBytes : 0) +
           threads * (callBytes + side * side * bytesPerSampleAtWork);
}

Result<BakeEstimate> estimateHeights(const HeightSource& source, const BakeSettings& settings,
                                     const std::function<bool()>& goOn) {
    TRY(checkBakeSettings(settings));
    TRY_ASSIGN(const auto shape, chooseShape(source, settings));
    const BakeContext context{source, shape, settings.compressionLevel};
    if (goOn && !goOn()) return cancelled();

    const std::optional<TreeCount> tree = countTree(source, shape, goOn);
    if (!tree) return cancelled();
    BakeEstimate estimate;
    estimate.shape = shape;
    estimate.samples = tree->leafCells + 2;
    estimate.chunks = tree->chunks;
    estimate.coarsestLeafLevel = tree->coarsestLeafLevel;
    estimate.bakeBytes = memoryOfBake(source, settings, shape);
    const Stopwatch stopwatch;
    BakeScratch scratch;
    TRY_ASSIGN(const auto roots, rootBytes(context, scratch));
    estimate.fileBytes = static_cast<double>(chunkFileHeaderBytes) + roots;
    estimate.seconds = stopwatch.elapsedS();
    if (deepestLevelOf(shape) == 0) return estimate;

    const int threads = bakeThreads(settings);
    TRY_ASSIGN(const auto places, placesToBake(context, goOn));
    TRY_ASSIGN(const auto sample, bakePlaces(context, places, threads, goOn));
    estimate.fileBytes += estimatedBlockBytes(shape, *tree, sample);
    estimate.seconds += (sample.readS + sample.bakeS * static_cast<double>(estimate.samples) /
                                            static_cast<double>(sample.finestSamples)) /
                        threads;
    return estimate;
}

}  // namespace

Result<BakeEstimate> estimateBake(const HeightSource& source, const BakeSettings& settings,
                                  const std::function<bool()>& goOn, const ColourSource* colour) {
    Result<BakeEstimate> estimate = estimateHeights(source, settings, goOn);
    if (!estimate || !colour) return estimate;
    TRY_ASSIGN(const auto colours, estimateColours(*colour, settings.colour, bakeThreads(settings),
                                                   defaultColourCacheBytes, goOn));
    estimate->fileBytes += colours.fileBytes;
    estimate->seconds += colours.seconds;
    estimate->bakeBytes += colours.bakeBytes;
    estimate->colour = colours;
    return estimate;
}

}  // namespace planet
