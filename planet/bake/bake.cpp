#include "planet/bake/bake.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <span>
#include <utility>

#include "planet/bake/bake_tile.h"
#include "planet/bake/colour_bake.h"
#include "planet/bake/level_images.h"
#include "planet/base/atomic_file.h"
#include "planet/base/little_endian.h"
#include "planet/base/parallel.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"

namespace planet {

namespace {

// Takes baked tiles in quadtree order, appends their blocks to the file, and merges four siblings as soon as
// they are complete, so it keeps at most three chunks per level. It also keeps coarse chunks, whose cells are
// wider than a tile, because their tight metric is not known yet.
class Assembler {
public:
    Assembler(const BakeContext& bake, int tileLevel, AtomicFile& file)
        : bake_(bake),
          file_(file),
          coarsestLevel_(coarsestLevelOfTiles(bake.shape, tileLevel)),
          waiting_(static_cast<std::size_t>(tileLevel) + 1),
          offM_(static_cast<std::size_t>(tileLevel)),
          coarse_(static_cast<std::size_t>(std::max(1, coarsestLevel_))) {}

    Result<void> add(BakedTile&& tile) {
        const std::uint64_t shift = file_.size() - provisionalOrigin;
        if (tile.root.entry.children.exists()) tile.root.entry.children.offset += shift;
        TRY(file_.append(tile.blocks));
        for (std::size_t i = 0; i < tile.offAboveM.size(); ++i) {
            double& offM = offM_[static_cast<std::size_t>(coarsestLevel_) + i];
            offM = std::max(offM, tile.offAboveM[i]);
        }
        return addChunk(std::move(tile.root));
    }

    // Bakes the coarse levels after all tiles are added. Calls goOn before each block is read, from one
    // thread at a time.
    Result<void> finish(int threads, const std::function<bool()>& goOn) {
        for (int level = coarsestLevel_ - 1; level >= 0; --level) {
            if (level < coarsestLevel_ - 1) {
                TRY(mergeCoarse(level));
            }
            TRY(searchCoarse(level, threads, goOn));
        }
        return {};
    }

    std::span<const BakedChunk> roots() const { return coarse_[0]; }

private:
    using Siblings = std::span<const BakedChunk, quadrantCount>;

    Result<void> addChunk(BakedChunk&& chunk) {
        const std::size_t level = chunk.id.level;
        if (level == 0 || chunk.id.level < coarsestLevel_) {
            coarse_[level].push_back(std::move(chunk));
            return {};
        }
        std::vector<BakedChunk>& siblings = waiting_[level];
        siblings.push_back(std::move(chunk));
        if (siblings.size() < quadrantCount) return {};
        TRY_ASSIGN(auto parent, merge(Siblings(siblings), std::exchange(offM_[level - 1], 0)));
        siblings.clear();
        return addChunk(std::move(parent));
    }

    Result<BakedChunk> merge(Siblings children, double finestDistanceM) {
        std::vector<std::byte> block;
        BakedChunk parent = mergeChildren(bake_, parentOf(children[0].id), children, finestDistanceM,
                                          file_.size(), scratch_, block);
        TRY(file_.append(block));
        return parent;
    }

    Result<void> mergeCoarse(int level) {
        const std::span<const BakedChunk> below = coarse_[static_cast<std::size_t>(level) + 1];
        for (std::size_t i = 0; i < below.size(); i += quadrantCount) {
            TRY_ASSIGN(auto parent, merge(below.subspan(i).first<quadrantCount>(), 0));
            coarse_[static_cast<std::size_t>(level)].push_back(std::move(parent));
        }
        return {};
    }

    // Raises the tight metric of a level's chunks to their distance from the finest samples.
    Result<void> searchCoarse(int level, int threads, const std::function<bool()>& goOn) {
        TRY_ASSIGN(const auto written, writtenSoFar());
        const ReadChildren readChildren = [&](const ChunkData& parent) {
            return childrenOf(written, parent);
        };
        std::vector<BakedChunk>& chunks = coarse_[static_cast<std::size_t>(level)];
        std::mutex mutex;  // guards outcome; held during calls of goOn
        Result<void> outcome;
        const auto mayGoOn = [&] {
            const std::lock_guard lock(mutex);
            if (outcome && !goOn()) outcome = cancelled();
            return outcome.has_value();
        };
        parallelFor(threads, chunks.size(), [&](std::size_t i) {
            const Result<double> offM =
                searchFinestDistance(bake_.shape, dataOf(chunks[i]), readChildren, mayGoOn);
            const std::lock_guard lock(mutex);
            if (!offM && outcome) outcome = tl::unexpected(offM.error());
            if (!outcome) return;
            ChunkEntry& entry = chunks[i].entry;
            entry.deltaTightM = tightMetric(*offM, entry.deltaTightM, entry.deltaCM);
        });
        return outcome;
    }

    // Opens the unfinished file, with a temporary header.
    Result<ChunkFile> writtenSoFar() {
        ChunkFileInfo info;
        info.shape = bake_.shape;
        info.minStep = info.maxStep = coarse_[static_cast<std::size_t>(coarsestLevel_) - 1][0].entry.minStep;
        TRY(file_.overwrite(0, headerBytes(info, file_.size())));
        return ChunkFile::open(
            file_.path().string(), file_.size(),
            [this](std::uint64_t offset, std::span<std::byte> out) { return file_.read(offset, out); });
    }

    static ChunkData dataOf(const BakedChunk& chunk) {
        const ChunkEntry& entry = chunk.entry;
        return {chunk.id,      entry.deltaCM,  entry.deltaTightM, entry.minStep,
                entry.maxStep, entry.children, chunk.heights};
    }

    Result<std::array<ChunkData, quadrantCount>> childrenOf(const ChunkFile& written,
                                                            const ChunkData& parent) const {
        if (parent.id.level + 1 >= coarsestLevel_) {
            return written.readChildren(parent.id, parent.children, parent.heights);
        }
        const std::vector<BakedChunk>& level = coarse_[parent.id.level + 1u];
        const std::uint64_t first = quadrantCount * indexInQuadtreeOrder(parent.id);
        std::array<ChunkData, quadrantCount> children;
        for (std::size_t q = 0; q < children.size(); ++q) children[q] = dataOf(level[first + q]);
        return children;
    }

    const BakeContext& bake_;
    AtomicFile& file_;
    int coarsestLevel_;  // coarsest level whose tight metric is computed from tiles
    std::vector<std::vector<BakedChunk>> waiting_;  // by level
    std::vector<double> offM_;                      // by level, of the chunk whose tiles are being added
    // The levels above coarsestLevel_, or only the roots if there are none; each in quadtree order.
    std::vector<std::vector<BakedChunk>> coarse_;
    BakeScratch scratch_;
};

// Reports the progress a few times per second.
class ProgressMeter {
public:
    ProgressMeter(const BakeProgressCallback& callback, std::uint64_t samplesTotal)
        : callback_(callback), total_(samplesTotal) {}

    // Returns false if the caller cancels.
    bool add(std::uint64_t samples) {
        done_ += samples;
        const bool hasEnded = samples > 0 && done_ == total_;
        if (!callback_ || (!hasEnded && sinceReport_.elapsedMs() < 100)) return true;
        sinceReport_ = {};
        const double elapsedS = sinceStart_.elapsedS();
        const double rate = elapsedS > 0 ? static_cast<double>(done_) / elapsedS : 0;
        return callback_(
            {done_, total_, elapsedS, rate, rate > 0 ? static_cast<double>(total_ - done_) / rate : 0});
    }

private:
    const BakeProgressCallback& callback_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
    Stopwatch sinceStart_;
    Stopwatch sinceReport_;
};

Result<void> bakeTiles(const BakeContext& bake, int tileLevel, int threads, Assembler& assembler,
                       ProgressMeter& meter) {
    const std::uint64_t tileCount = std::uint64_t{faceCount} << (2 * tileLevel);
    const auto cells = static_cast<std::uint64_t>(faceCells(bake.shape) >> tileLevel);
    // The tiles in progress, in a ring buffer: they end in the order in which they began.
    struct Work {
        ChunkId id;
        Result<BakedTile> tile;
    };
    std::vector<Work> underWay(static_cast<std::size_t>(threads) * 3);
    tbb::enumerable_thread_specific<BakeScratch> scratches;
    Result<void> outcome;
    std::atomic<bool> stop = false;
    std::uint64_t next = 0;
    // Input and output run in order, one at a time; only the output uses outcome.
    const auto begin = [&](tbb::flow_control& control) -> std::size_t {
        if (stop || next == tileCount) {
            control.stop();
            return 0;
        }
        const std::size_t place = next % underWay.size();
        underWay[place].id = chunkInQuadtreeOrder(next++, tileLevel);
        return place;
    };
    const auto bakeOne = [&](std::size_t place) {
        underWay[place].tile = bakeTile(bake, underWay[place].id, scratches.local());
        return place;
    };
    const auto write = [&](Result<BakedTile>&& tile) {
        if (!tile) {
            outcome = tl::unexpected(tile.error());
        } else if (auto added = assembler.add(*std::move(tile)); !added) {
            outcome = added;
        } else if (!meter.add(cells * cells)) {
            outcome = cancelled();
        }
        if (!outcome) stop = true;
    };
    const auto writeOne = [&](std::size_t place) {
        if (outcome) write(std::move(underWay[place].tile));
    };
    using tbb::filter_mode;
    Handover handover;
    handover.give();
    tbb::task_arena(threads).execute([&] {
        tbb::parallel_pipeline(
            underWay.size(),
            tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, Stage(handover, begin)) &
                tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, Stage(handover, bakeOne)) &
                tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, Stage(handover, writeOne)));
    });
    handover.take();
    return outcome;
}

// The weight of a colour tile in the progress.
constexpr std::uint64_t samplesPerColourTile = std::uint64_t{colourTileCells} * colourTileCells;

// Appends the root blocks and fills in the header.
Result<void> writeRoots(const BakeContext& bake, const Assembler& assembler, AtomicFile& file,
                        ChunkFileInfo& info) {
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
        TRY(file.append(block));
    }
    return {};
}

Result<void> writeColours(const ColourSource& source, const BakeSettings& settings, AtomicFile& file,
                          ProgressMeter& meter, ChunkFileInfo& info) {
    const auto progress = [&](std::uint64_t tiles) { return meter.add(tiles * samplesPerColourTile); };
    TRY_ASSIGN(info.colour, bakeColour(source, settings.colour, bakeThreads(settings), file, progress));
    return {};
}

}  // namespace

Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress,
                        const ColourSource* colour) {
    const Stopwatch stopwatch;
    TRY(checkBakeSettings(settings));
    TRY_ASSIGN(const auto shape, chooseShape(source, settings));
    const int tileLevel = tileLevelOf(shape, settings.tileLevels);
    const BakeContext context{source, shape, settings.compressionLevel};
    std::uint64_t colourTiles = 0;
    if (colour) {
        TRY_ASSIGN(const auto leaf, colourLeafLevel(*colour, settings.colour));
        colourTiles = tileCountOf(leaf);
    }

    TRY_ASSIGN(auto file, AtomicFile::create(output, settings.fileCalls));
    TRY(file.append(std::vector<std::byte>(chunkFileHeaderBytes)));
    Assembler assembler(context, tileLevel, file);
    const auto cells = static_cast<std::uint64_t>(faceCells(shape));
    ProgressMeter meter(progress, faceCount * cells * cells + colourTiles * samplesPerColourTile);
    const int threads = bakeThreads(settings);
    TRY(bakeTiles(context, tileLevel, threads, assembler, meter));
    TRY(assembler.finish(threads, [&] { return meter.add(0); }));
    ChunkFileInfo info;
    TRY(writeRoots(context, assembler, file, info));
    const std::uint64_t bytesWithoutColours = file.size();
    if (colour) {
        TRY(writeColours(*colour, settings, file, meter, info));
    }
    const std::uint64_t fileBytes = file.size();
    TRY(file.overwrite(0, headerBytes(info, fileBytes)));
    TRY(file.commit());

    if (!settings.debugLevelsFolder.empty()) {
        TRY(writeLevelImages(output, settings.debugLevelsFolder));
    }
    BakeReport report;
    report.shape = shape;
    report.samples = sampleCountOf(shape);
    report.chunks = chunkCountOf(shape);
    report.fileBytes = fileBytes;
    report.missingSamples = source.missingCount;
    report.colourTiles = colourTiles;
    report.colourBytes = fileBytes - bytesWithoutColours;
    if (colour) report.colourNotice = colour->notice;
    for (const BakedChunk& root : assembler.roots()) {
        report.largestDeltaCM = std::max(report.largestDeltaCM, root.entry.deltaCM);
        report.largestDeltaTightM = std::max(report.largestDeltaTightM, root.entry.deltaTightM);
    }
    report.seconds = stopwatch.elapsedS();
    return report;
}

}  // namespace planet
