#include "planet/bake.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <mutex>

#include "planet/atomic_file.h"
#include "planet/chunk_file_format.h"
#include "planet/chunk_surface.h"
#include "planet/geometric_error.h"
#include "planet/level_images.h"
#include "planet/little_endian.h"
#include "planet/quantise.h"

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

// Blocks are made before their place in the file is known, as if their run began here.
constexpr std::uint64_t provisionalOrigin = chunkFileHeaderBytes;

// A tile is the subtree that one task bakes: 128 cells a side or more, so that what neighbouring tiles both
// sample is little, and small enough for a core's cache.
constexpr int tileCellsLog2 = 7;

struct BakedChunk {
    ChunkId id;
    ChunkEntry entry;
    std::vector<std::int16_t> heights;
};

struct TileResult {
    Result<BakedChunk> root;
    std::vector<std::byte> blocks;
};

struct Scratch {
    std::vector<float> sampledM;
    std::vector<std::int16_t> steps;
    std::vector<std::int16_t> refined;
    GeometricErrorScratch geometry;
};

struct BakeContext {
    const HeightSource& source;
    PlanetShape shape;
    int compressionLevel;
    int tileLevel;  // level of the chunk at a tile's root
};

std::span<std::int16_t> joinQuarters(const PlanetShape& shape,
                                     const std::array<BakedChunk, quadrantCount>& children,
                                     std::vector<std::int16_t>& refined) {
    const auto side = static_cast<std::size_t>(chunkSize(shape));
    const std::size_t refinedSide = 2 * side - 1;
    refined.resize(refinedSide * refinedSide);
    for (std::size_t q = 0; q < children.size(); ++q) {
        placeQuarter(children[q].heights, chunkCells(shape), static_cast<int>(q), refined);
    }
    return refined;
}

std::vector<std::int16_t> everyOther(std::span<const std::int16_t> refined, std::size_t side) {
    const std::size_t refinedSide = 2 * side - 1;
    std::vector<std::int16_t> coarse(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) coarse[j * side + i] = refined[2 * j * refinedSide + 2 * i];
    }
    return coarse;
}

void appendChecksum(std::vector<std::byte>& blocks, std::size_t blockStart, const ChunkId& parent) {
    const std::uint64_t sum = siblingChecksum(std::span(blocks).subspan(blockStart), parent);
    ByteWriter(blocks).put(sum);
}

// Removes every other row and column: appends the block of the four children, returns their parent. Places in
// the file count from origin, where the first of the blocks lies.
BakedChunk mergeChildren(const BakeContext& bake, const ChunkId& parent,
                         const std::array<BakedChunk, quadrantCount>& children, std::uint64_t origin,
                         Scratch& scratch, std::vector<std::byte>& blocks) {
    const auto refined = joinQuarters(bake.shape, children, scratch.refined);
    BakedChunk chunk;
    chunk.id = parent;
    chunk.heights = everyOther(refined, static_cast<std::size_t>(chunkSize(bake.shape)));
    chunk.entry.minStep = children[0].entry.minStep;
    chunk.entry.maxStep = children[0].entry.maxStep;
    float childrenDeltaM = 0;
    for (const BakedChunk& child : children) {
        chunk.entry.minStep = std::min(chunk.entry.minStep, child.entry.minStep);
        chunk.entry.maxStep = std::max(chunk.entry.maxStep, child.entry.maxStep);
        childrenDeltaM = std::max(childrenDeltaM, child.entry.deltaCM);
    }
    const double deltaG = geometricErrorM(bake.shape, parent, refined, scratch.geometry);
    chunk.entry.deltaCM = roundedUp(deltaG + childrenDeltaM);

    const std::size_t start = blocks.size();
    const std::uint64_t offset = origin + start;
    if (parent.level + 1 < leafLevel(bake.shape)) {
        for (const BakedChunk& child : children) putEntry(blocks, child.entry, offset);
    }
    encodeRefinement(refined, chunkCells(bake.shape), bake.compressionLevel, blocks);
    appendChecksum(blocks, start, parent);
    chunk.entry.children = {offset, static_cast<std::uint32_t>(blocks.size() - start)};
    return chunk;
}

BakedChunk cutLeaf(const BakeContext& bake, const ChunkId& id, const SampleTile& tile,
                   std::span<const std::int16_t> steps) {
    const auto side = static_cast<std::size_t>(chunkSize(bake.shape));
    const auto cells = static_cast<std::size_t>(chunkCells(bake.shape));
    const std::size_t column = id.x * cells - static_cast<std::size_t>(tile.firstColumn);
    const std::size_t row = id.y * cells - static_cast<std::size_t>(tile.firstRow);
    BakedChunk leaf;
    leaf.id = id;
    leaf.heights.resize(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        const auto from = steps.subspan((row + j) * static_cast<std::size_t>(tile.columns) + column, side);
        std::copy(from.begin(), from.end(), leaf.heights.begin() + static_cast<std::ptrdiff_t>(j * side));
    }
    const auto [lowest, highest] = std::minmax_element(leaf.heights.begin(), leaf.heights.end());
    leaf.entry.minStep = *lowest;
    leaf.entry.maxStep = *highest;
    return leaf;
}

BakedChunk bakeSubtree(const BakeContext& bake, const ChunkId& id, const SampleTile& tile, Scratch& scratch,
                       std::vector<std::byte>& blocks) {
    if (id.level == leafLevel(bake.shape)) return cutLeaf(bake, id, tile, scratch.steps);
    std::array<BakedChunk, quadrantCount> children;
    for (int q = 0; q < quadrantCount; ++q) {
        children[static_cast<std::size_t>(q)] = bakeSubtree(bake, childOf(id, q), tile, scratch, blocks);
    }
    return mergeChildren(bake, id, children, provisionalOrigin, scratch, blocks);
}

TileResult bakeTile(const BakeContext& bake, const ChunkId& root, Scratch& scratch) {
    const int cells = faceCells(bake.shape) >> root.level;
    const SampleTile tile{root.face,
                          faceCells(bake.shape),
                          static_cast<int>(root.x) * cells,
                          static_cast<int>(root.y) * cells,
                          cells + 1,
                          cells + 1};
    const auto count = static_cast<std::size_t>(tile.columns) * static_cast<std::size_t>(tile.rows);
    scratch.sampledM.resize(count);
    scratch.steps.resize(count);
    if (auto sampled = bake.source.sample(tile, scratch.sampledM); !sampled) {
        return {tl::unexpected(sampled.error()), {}};
    }
    if (auto fitted = quantise(bake.shape, bake.source, scratch.sampledM, scratch.steps); !fitted) {
        return {tl::unexpected(fitted.error()), {}};
    }
    TileResult result;
    result.root = bakeSubtree(bake, root, tile, scratch, result.blocks);
    return result;
}

// The tile chunks in quadtree order: face by face, each quarter whole before the next.
ChunkId tileInQuadtreeOrder(std::uint64_t index, int tileLevel) {
    const std::uint64_t tilesPerFace = std::uint64_t{1} << (2 * tileLevel);
    ChunkId id{static_cast<Face>(index / tilesPerFace), 0, 0, 0};
    for (int level = tileLevel - 1; level >= 0; --level) {
        id = childOf(id, static_cast<int>((index >> (2 * level)) & 3));
    }
    return id;
}

// Takes baked tiles in quadtree order, appends their blocks to the file, and merges upwards as soon as four
// siblings are there; so it holds at most three chunks a level.
class Assembler {
public:
    Assembler(const BakeContext& bake, AtomicFile& file)
        : bake_(bake), file_(file), waiting_(static_cast<std::size_t>(bake.tileLevel) + 1) {}

    Result<void> add(TileResult&& tile) {
        const std::uint64_t shift = file_.size() - provisionalOrigin;
        if (tile.root->entry.children.exists()) tile.root->entry.children.offset += shift;
        if (auto appended = file_.append(tile.blocks); !appended) return appended;
        return addChunk(*std::move(tile.root));
    }

    const std::array<BakedChunk, faceCount>& roots() const { return roots_; }

private:
    Result<void> addChunk(BakedChunk&& chunk) {
        if (chunk.id.level == 0) {
            roots_[static_cast<std::size_t>(chunk.id.face)] = std::move(chunk);
            return {};
        }
        std::vector<BakedChunk>& siblings = waiting_[chunk.id.level];
        siblings.push_back(std::move(chunk));
        if (siblings.size() < quadrantCount) return {};
        std::array<BakedChunk, quadrantCount> children;
        std::move(siblings.begin(), siblings.end(), children.begin());
        siblings.clear();
        std::vector<std::byte> block;
        BakedChunk parent =
            mergeChildren(bake_, parentOf(children[0].id), children, file_.size(), scratch_, block);
        if (auto appended = file_.append(block); !appended) return appended;
        return addChunk(std::move(parent));
    }

    const BakeContext& bake_;
    AtomicFile& file_;
    std::vector<std::vector<BakedChunk>> waiting_;  // by level
    std::array<BakedChunk, faceCount> roots_;
    Scratch scratch_;
};

// Tells the caller how far it is, a few times a second.
class ProgressMeter {
public:
    ProgressMeter(const BakeProgressCallback& callback, std::uint64_t samplesTotal)
        : callback_(callback), total_(samplesTotal) {}

    // False when the caller wants to stop.
    bool add(std::uint64_t samples) {
        done_ += samples;
        const Clock::time_point now = Clock::now();
        if (!callback_ || (done_ < total_ && now - reported_ < std::chrono::milliseconds(100))) return true;
        reported_ = now;
        const double elapsedS = std::chrono::duration<double>(now - start_).count();
        const double rate = elapsedS > 0 ? static_cast<double>(done_) / elapsedS : 0;
        return callback_(
            {done_, total_, elapsedS, rate, rate > 0 ? static_cast<double>(total_ - done_) / rate : 0});
    }

private:
    const BakeProgressCallback& callback_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
    Clock::time_point start_ = Clock::now();
    Clock::time_point reported_ = start_;
};

// oneTBB orders the stages of a pipeline, but a thread sanitizer cannot see into the library. What one stage
// leaves for the next is therefore also handed over where it can see: give after writing, take before
// reading.
class Handover {
public:
    void give() { turn_.fetch_add(1, std::memory_order_release); }
    void take() const { static_cast<void>(turn_.load(std::memory_order_acquire)); }

private:
    std::atomic<unsigned> turn_ = 0;
};

Result<void> bakeTiles(const BakeContext& bake, int threads, Assembler& assembler,
                       const BakeProgressCallback& progress) {
    const std::uint64_t tileCount = std::uint64_t{faceCount} << (2 * bake.tileLevel);
    const auto cells = static_cast<std::uint64_t>(faceCells(bake.shape) >> bake.tileLevel);
    ProgressMeter meter(progress, tileCount * cells * cells);
    tbb::enumerable_thread_specific<Scratch> scratches;
    Result<void> outcome;
    std::atomic<bool> stop = false;
    std::uint64_t next = 0;
    // Input and output run in order, one at a time; outcome belongs to the output.
    Handover handover;
    const auto input = [&](tbb::flow_control& control) -> ChunkId {
        handover.take();
        if (stop || next == tileCount) {
            control.stop();
            return {};
        }
        const ChunkId id = tileInQuadtreeOrder(next++, bake.tileLevel);
        handover.give();
        return id;
    };
    const auto work = [&](const ChunkId& id) {
        handover.take();
        TileResult tile = bakeTile(bake, id, scratches.local());
        handover.give();
        return tile;
    };
    const auto write = [&](TileResult&& tile) {
        if (!tile.root) {
            outcome = tl::unexpected(tile.root.error());
        } else if (auto added = assembler.add(std::move(tile)); !added) {
            outcome = added;
        } else if (!meter.add(cells * cells)) {
            outcome = cancelled();
        }
        if (!outcome) stop = true;
    };
    const auto output = [&](TileResult tile) {
        handover.take();
        if (outcome) write(std::move(tile));
        handover.give();
    };
    handover.give();
    tbb::task_arena(threads).execute([&] {
        tbb::parallel_pipeline(
            static_cast<std::size_t>(threads) * 3,
            tbb::make_filter<void, ChunkId>(tbb::filter_mode::serial_in_order, input) &
                tbb::make_filter<ChunkId, TileResult>(tbb::filter_mode::parallel, work) &
                tbb::make_filter<TileResult, void>(tbb::filter_mode::serial_in_order, output));
    });
    handover.take();
    return outcome;
}

Result<void> writeRootsAndHeader(const BakeContext& bake, const Assembler& assembler, AtomicFile& file) {
    ChunkFileInfo info;
    info.shape = bake.shape;
    info.missingSamples = bake.source.missingCount;
    info.source = bake.source.description;
    info.minStep = assembler.roots()[0].entry.minStep;
    info.maxStep = assembler.roots()[0].entry.maxStep;
    for (const BakedChunk& root : assembler.roots()) {
        info.minStep = std::min(info.minStep, root.entry.minStep);
        info.maxStep = std::max(info.maxStep, root.entry.maxStep);
        std::vector<std::byte> block;
        if (leafLevel(bake.shape) > 0) putEntry(block, root.entry, file.size());
        encodeGrid(root.heights, chunkSize(bake.shape), block);
        ByteWriter(block).put(rootChecksum(block, root.id.face));
        info.roots[static_cast<std::size_t>(root.id.face)] = {file.size(),
                                                              static_cast<std::uint32_t>(block.size())};
        if (auto appended = file.append(block); !appended) return appended;
    }
    return file.overwrite(0, headerBytes(info, file.size()));
}

Result<PlanetShape> chooseShape(const HeightSource& source, const BakeSettings& settings) {
    PlanetShape shape;
    const int chunk = settings.chunkSize;
    if (chunk != 17 && chunk != 33 && chunk != 65 && chunk != 129) {
        return badInput(fmt::format("chunk size {}: must be 17, 33, 65 or 129", chunk));
    }
    shape.chunkCellsLog2 = std::countr_zero(static_cast<unsigned>(chunk - 1));
    const int face = settings.faceSize.value_or(std::max(source.naturalFaceSize, chunk));
    if (face < 2 || !std::has_single_bit(static_cast<unsigned>(face - 1))) {
        return badInput(fmt::format("face size {}: must be 2^n + 1, such as 1025, 2049 or 4097", face));
    }
    shape.faceCellsLog2 = std::countr_zero(static_cast<unsigned>(face - 1));
    if (face < chunk || shape.faceCellsLog2 > maxFaceCellsLog2 || leafLevel(shape) > maxLevel) {
        return badInput(fmt::format("face size {}: must be from the chunk size {} to {}", face, chunk,
                                    (1 << std::min(maxFaceCellsLog2, maxLevel + shape.chunkCellsLog2)) + 1));
    }
    if (!(settings.radiusM > 0 && settings.radiusM <= 1e9)) {
        return badInput(fmt::format("radius {} m: must be over 0 and at most 1e9", settings.radiusM));
    }
    shape.radiusM = settings.radiusM;
    if (auto chosen = chooseQuantum(source, settings.quantumM, shape); !chosen)
        return tl::unexpected(chosen.error());
    if (shape.radiusM + heightM(shape, -32768) <= 0 && shape.radiusM + source.minM <= 0) {
        return badInput(
            fmt::format("{}: its lowest height, {} m, is below the centre of a planet of radius {} m",
                        source.description, source.minM, shape.radiusM));
    }
    return shape;
}

Result<void> checkSettings(const BakeSettings& settings) {
    if (settings.compressionLevel < minCompressionLevel || settings.compressionLevel > maxCompressionLevel) {
        return badInput(fmt::format("compression level {}: must be {} to {}", settings.compressionLevel,
                                    minCompressionLevel, maxCompressionLevel));
    }
    if (settings.threads < 0 || settings.threads > 1024) {
        return badInput(fmt::format("{} threads: must be 1 to 1024, or 0 for one a core", settings.threads));
    }
    return {};
}

}  // namespace

Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress) {
    const Clock::time_point start = Clock::now();
    if (auto valid = checkSettings(settings); !valid) return tl::unexpected(valid.error());
    const auto shape = chooseShape(source, settings);
    if (!shape) return tl::unexpected(shape.error());
    const int tileLevels = std::max(1, tileCellsLog2 - shape->chunkCellsLog2);
    const BakeContext context{source, *shape, settings.compressionLevel,
                              std::max(0, leafLevel(*shape) - tileLevels)};

    auto file = AtomicFile::create(output);
    if (!file) return tl::unexpected(file.error());
    if (auto reserved = file->append(std::vector<std::byte>(chunkFileHeaderBytes)); !reserved) {
        return tl::unexpected(reserved.error());
    }
    const int threads = settings.threads > 0 ? settings.threads : tbb::this_task_arena::max_concurrency();
    Assembler assembler(context, *file);
    if (auto baked = bakeTiles(context, threads, assembler, progress); !baked)
        return tl::unexpected(baked.error());
    if (auto ended = writeRootsAndHeader(context, assembler, *file); !ended)
        return tl::unexpected(ended.error());
    const std::uint64_t fileBytes = file->size();
    if (auto committed = file->commit(); !committed) return tl::unexpected(committed.error());

    if (!settings.debugLevelsFolder.empty()) {
        if (auto written = writeLevelImages(output, settings.debugLevelsFolder); !written) {
            return tl::unexpected(written.error());
        }
    }
    BakeReport report;
    report.shape = *shape;
    const auto cells = static_cast<std::uint64_t>(faceCells(*shape));
    report.samples = faceCount * cells * cells + 2;
    for (int level = 0; level <= leafLevel(*shape); ++level)
        report.chunks += std::uint64_t{faceCount} << (2 * level);
    report.fileBytes = fileBytes;
    report.missingSamples = source.missingCount;
    report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return report;
}

}  // namespace planet
