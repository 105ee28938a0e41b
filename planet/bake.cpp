#include "planet/bake.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>

#include "planet/atomic_file.h"
#include "planet/bake_tile.h"
#include "planet/chunk_file_format.h"
#include "planet/level_images.h"
#include "planet/little_endian.h"

namespace planet {

namespace {

using Clock = std::chrono::steady_clock;

// Tiles of 128 cells a side or more, so that what neighbouring tiles both sample is little, and small enough
// for a core's cache.
constexpr int tileCellsLog2 = 7;

// Takes baked tiles in quadtree order, appends their blocks to the file, and merges upwards as soon as four
// siblings are there; so it holds at most three chunks a level.
class Assembler {
public:
    Assembler(const BakeContext& bake, int tileLevel, AtomicFile& file)
        : bake_(bake), file_(file), waiting_(static_cast<std::size_t>(tileLevel) + 1) {}

    Result<void> add(BakedTile&& tile) {
        const std::uint64_t shift = file_.size() - provisionalOrigin;
        if (tile.root.entry.children.exists()) tile.root.entry.children.offset += shift;
        if (auto appended = file_.append(tile.blocks); !appended) return appended;
        return addChunk(std::move(tile.root));
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
    BakeScratch scratch_;
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

Result<void> bakeTiles(const BakeContext& bake, int tileLevel, int threads, Assembler& assembler,
                       const BakeProgressCallback& progress) {
    const std::uint64_t tileCount = std::uint64_t{faceCount} << (2 * tileLevel);
    const auto cells = static_cast<std::uint64_t>(faceCells(bake.shape) >> tileLevel);
    ProgressMeter meter(progress, tileCount * cells * cells);
    tbb::enumerable_thread_specific<BakeScratch> scratches;
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
        const ChunkId id = chunkInQuadtreeOrder(next++, tileLevel);
        handover.give();
        return id;
    };
    const auto work = [&](const ChunkId& id) {
        handover.take();
        Result<BakedTile> tile = bakeTile(bake, id, scratches.local());
        handover.give();
        return tile;
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
    const auto output = [&](Result<BakedTile> tile) {
        handover.take();
        if (outcome) write(std::move(tile));
        handover.give();
    };
    handover.give();
    tbb::task_arena(threads).execute([&] {
        tbb::parallel_pipeline(
            static_cast<std::size_t>(threads) * 3,
            tbb::make_filter<void, ChunkId>(tbb::filter_mode::serial_in_order, input) &
                tbb::make_filter<ChunkId, Result<BakedTile>>(tbb::filter_mode::parallel, work) &
                tbb::make_filter<Result<BakedTile>, void>(tbb::filter_mode::serial_in_order, output));
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

}  // namespace

Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress) {
    const Clock::time_point start = Clock::now();
    if (auto valid = checkBakeSettings(settings); !valid) return tl::unexpected(valid.error());
    const auto shape = chooseShape(source, settings);
    if (!shape) return tl::unexpected(shape.error());
    const int tileLevels = std::max(1, tileCellsLog2 - shape->chunkCellsLog2);
    const int tileLevel = std::max(0, leafLevel(*shape) - tileLevels);
    const BakeContext context{source, *shape, settings.compressionLevel};

    auto file = AtomicFile::create(output);
    if (!file) return tl::unexpected(file.error());
    if (auto reserved = file->append(std::vector<std::byte>(chunkFileHeaderBytes)); !reserved) {
        return tl::unexpected(reserved.error());
    }
    Assembler assembler(context, tileLevel, *file);
    if (auto baked = bakeTiles(context, tileLevel, bakeThreads(settings), assembler, progress); !baked)
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
    report.samples = sampleCountOf(*shape);
    report.chunks = chunkCountOf(*shape);
    report.fileBytes = fileBytes;
    report.missingSamples = source.missingCount;
    report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return report;
}

}  // namespace planet
