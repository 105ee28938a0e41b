#include "planet/bake/bake_estimate.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "planet/bake/bake_tile.h"
#include "planet/bake/spread_places.h"
#include "planet/base/elapsed.h"

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

// About a second's work for one core. Half of it for single blocks, of which many places can be looked at;
// half for blocks whose parents' block is made too, which tell how blocks grow from level to level.
constexpr std::uint64_t samplesToBake = 4'000'000;
constexpr std::uint64_t fewestPlaces = 8;
constexpr std::uint64_t mostPlaces = 2048;

struct Sample {
    std::uint64_t leafBlocks = 0;
    std::uint64_t leafBlockBytes = 0;
    std::uint64_t upperBlocks = 0;  // those one level above,
    std::uint64_t upperBlockBytes = 0;
    std::uint64_t belowUpperBytes = 0;  // and what of leafBlockBytes lies under them
    std::uint64_t finestSamples = 0;
    double bakeS = 0;  // of one thread, with the source's blocks at hand
    double readS = 0;  // getting them

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

// One sample of the tile's corner is enough to have the source read what lies there; where it was read before
// this takes no time. A tile that lies on several of the source's blocks has its other three corners read
// too.
Result<void> readCorners(const BakeContext& bake, const ChunkId& root) {
    const int cells = faceCells(bake.shape) >> root.level;
    for (const int corner : {0, 1, 2, 3}) {
        float height = 0;
        const SampleTile tile{root.face,
                              faceCells(bake.shape),
                              (static_cast<int>(root.x) + (corner & 1)) * cells,
                              (static_cast<int>(root.y) + (corner >> 1)) * cells,
                              1,
                              1};
        if (auto read = bake.source.sample(tile, {&height, 1}); !read) return read;
    }
    return {};
}

Result<Sample> bakePlace(const BakeContext& bake, const ChunkId& root, BakeScratch& scratch) {
    Sample sample;
    const Clock::time_point start = Clock::now();
    if (auto read = readCorners(bake, root); !read) return tl::unexpected(read.error());
    sample.readS = secondsSince(start);
    const Clock::time_point bakeStart = Clock::now();
    const Result<BakedTile> tile = bakeTile(bake, root, scratch);
    if (!tile) return tl::unexpected(tile.error());
    sample.bakeS = secondsSince(bakeStart);

    const auto cells = static_cast<std::uint64_t>(faceCells(bake.shape) >> root.level);
    sample.finestSamples = cells * cells;
    const std::uint64_t lastBlock = tile->root.entry.children.size;
    if (root.level + 1 == leafLevel(bake.shape)) {
        sample.leafBlocks = 1;
        sample.leafBlockBytes = lastBlock;
    } else {
        sample.leafBlocks = quadrantCount;
        sample.leafBlockBytes = tile->blocks.size() - lastBlock;
        sample.belowUpperBytes = sample.leafBlockBytes;
        sample.upperBlocks = 1;
        sample.upperBlockBytes = lastBlock;
    }
    return sample;
}

Result<Sample> bakePlaces(const BakeContext& bake, const std::vector<ChunkId>& roots, int threads,
                          const std::function<bool()>& goOn) {
    std::mutex mutex;  // guards next and outcome, and goOn is asked under it
    std::size_t next = 0;
    Result<Sample> outcome;
    const auto takePlace = [&]() -> std::optional<std::size_t> {
        const std::lock_guard lock(mutex);
        return outcome && next < roots.size() ? std::optional(next++) : std::nullopt;
    };
    const auto work = [&] {
        BakeScratch scratch;
        while (const std::optional<std::size_t> place = takePlace()) {
            const Result<Sample> sample = bakePlace(bake, roots[*place], scratch);
            const std::lock_guard lock(mutex);
            if (!outcome) return;
            if (!sample) {
                outcome = tl::unexpected(sample.error());
            } else {
                outcome->add(*sample);
                if (goOn && !goOn()) outcome = cancelled();
            }
        }
    };
    const std::size_t helpers = std::min(static_cast<std::size_t>(threads), roots.size()) - 1;
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < helpers; ++i) workers.emplace_back(work);
    work();
    workers.clear();  // waits for them
    return outcome;
}

// Bytes of all sibling blocks: level by level, the finest first, each with a quarter as many as the one
// before. What a coarser level's block takes more than a finer one's, since its samples lie farther apart, it
// takes again on the next level; no more than the bare samples would.
double estimatedBlockBytes(const PlanetShape& shape, const Sample& sample) {
    const double cells = chunkCells(shape);
    const double bareBytes = 2 * ((2 * cells + 1) * (2 * cells + 1) - (cells + 1) * (cells + 1)) + 128;
    double bytes = static_cast<double>(sample.leafBlockBytes) / static_cast<double>(sample.leafBlocks);
    // Both of the same places, which differ more from each other than their levels do.
    const double growth = sample.upperBlocks == 0
                              ? 0
                              : bytes * (static_cast<double>(quadrantCount * sample.upperBlockBytes) /
                                             static_cast<double>(sample.belowUpperBytes) -
                                         1);
    double total = 0;
    for (int level = leafLevel(shape) - 1; level >= 0; --level) {
        total += bytes * static_cast<double>(std::uint64_t{faceCount} << (2 * level));
        bytes = std::clamp(bytes + growth, 0.0, bareBytes);
    }
    return total;
}

// The root chunks are written whole; where there is nothing else, so are all.
Result<double> rootBytes(const BakeContext& bake, BakeScratch& scratch) {
    const double samples = chunkVertexCount(bake.shape);
    if (leafLevel(bake.shape) > 0) {
        // Neighbours lie far apart on a root; hardly a bit is saved.
        return faceCount * (1.8 * samples + 100);
    }
    double bytes = 0;
    for (const Face face : allFaces) {
        const Result<BakedTile> tile = bakeTile(bake, {face, 0, 0, 0}, scratch);
        if (!tile) return tl::unexpected(tile.error());
        std::vector<std::byte> coded;
        encodeGrid(tile->root.heights, chunkSize(bake.shape), coded);
        bytes += static_cast<double>(coded.size() + 8);
    }
    return bytes;
}

// Single blocks everywhere; and, where the planet has two levels of them, fewer places with two.
std::vector<ChunkId> placesToBake(const PlanetShape& shape) {
    const std::uint64_t cells = 2 * static_cast<std::uint64_t>(chunkCells(shape));
    const std::uint64_t wanted = std::clamp(samplesToBake / 2 / (cells * cells), fewestPlaces, mostPlaces);
    std::vector<ChunkId> roots = spreadPlaces(leafLevel(shape) - 1, wanted);
    if (leafLevel(shape) > 1) {
        const std::vector<ChunkId> more =
            spreadPlaces(leafLevel(shape) - 2, std::max(wanted / 4, fewestPlaces / 2));
        roots.insert(roots.end(), more.begin(), more.end());
    }
    return roots;
}

Result<BakeEstimate> estimateHeights(const HeightSource& source, const BakeSettings& settings,
                                     const std::function<bool()>& goOn) {
    if (auto valid = checkBakeSettings(settings); !valid) return tl::unexpected(valid.error());
    const auto shape = chooseShape(source, settings);
    if (!shape) return tl::unexpected(shape.error());
    const BakeContext context{source, *shape, settings.compressionLevel};
    if (goOn && !goOn()) return cancelled();

    BakeEstimate estimate;
    estimate.shape = *shape;
    estimate.samples = sampleCountOf(*shape);
    estimate.chunks = chunkCountOf(*shape);
    const Clock::time_point start = Clock::now();
    BakeScratch scratch;
    const Result<double> roots = rootBytes(context, scratch);
    if (!roots) return tl::unexpected(roots.error());
    estimate.fileBytes = static_cast<double>(chunkFileHeaderBytes) + *roots;
    estimate.seconds = secondsSince(start);
    if (leafLevel(*shape) == 0) return estimate;

    const int threads = bakeThreads(settings);
    const Result<Sample> sample = bakePlaces(context, placesToBake(*shape), threads, goOn);
    if (!sample) return tl::unexpected(sample.error());
    estimate.fileBytes += estimatedBlockBytes(*shape, *sample);
    estimate.seconds += (sample->readS + sample->bakeS * static_cast<double>(estimate.samples) /
                                             static_cast<double>(sample->finestSamples)) /
                        threads;
    return estimate;
}

}  // namespace

Result<BakeEstimate> estimateBake(const HeightSource& source, const BakeSettings& settings,
                                  const std::function<bool()>& goOn, const ColourSource* colour) {
    Result<BakeEstimate> estimate = estimateHeights(source, settings, goOn);
    if (!estimate || !colour) return estimate;
    const Result<ColourEstimate> colours =
        estimateColours(*colour, settings.colour, bakeThreads(settings), defaultColourCacheBytes, goOn);
    if (!colours) return tl::unexpected(colours.error());
    estimate->fileBytes += colours->fileBytes;
    estimate->seconds += colours->seconds;
    estimate->colour = *colours;
    return estimate;
}

}  // namespace planet
