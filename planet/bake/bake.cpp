#include "planet/bake/bake.h"

#include <fmt/format.h>

#include <atomic>
#include <optional>
#include <span>
#include <utility>

#include "planet/bake/bake_finish.h"
#include "planet/bake/bake_reuse.h"
#include "planet/bake/bake_tile.h"
#include "planet/bake/bake_tree.h"
#include "planet/bake/colour_bake.h"
#include "planet/bake/level_images.h"
#include "planet/bake/subtree_merging.h"
#include "planet/base/atomic_file.h"
#include "planet/base/parallel.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"

namespace planet {

namespace {

// Takes baked units in quadtree order, and appends their blocks and those of the merged chunks above them to the file.
// Whatever comes from an earlier bake is held back as if it did not, so that the order of the blocks does not depend on
// what is copied.
class Assembler final : private SubtreeSink {
public:
    Assembler(const BakeContext& bake, AtomicFile& file)
        : bake_(bake),
          file_(file),
          stack_(bake, *this),
          held_(static_cast<std::size_t>(deepestLevelOf(bake.shape)) + 1) {}

    // Says what the tight metric of a chunk is, before the first unit under it is added.
    void know(const UnchangedChunk& chunk) { stack_.know(chunk.id, chunk.deltaTightM); }

    Result<void> add(BakedTile&& tile) {
        const std::uint64_t offset = file_.size();
        TRY(file_.append(tile.blocks));
        return stack_.push(subtreeOf(std::move(tile), offset));
    }

    // Bakes the chunks that were held back, after all units are added. Calls goOn before each block is read,
    // from one thread at a time.
    Result<void> finish(int threads, const std::function<bool()>& goOn) {
        for (Subtree& root : stack_.takeWaiting()) {
            if (!root.isLater) hold(std::move(root));
        }
        BakeScratch scratch;
        for (std::size_t level = held_.size(); level-- > 0;) {
            std::vector<DeferredChunk>& chunks = held_[level];
            sortInQuadtreeOrder(chunks);
            TRY(search(chunks, threads, goOn));
            if (level == 0) break;
            for (std::size_t i = 0; i < chunks.size(); i += quadrantCount) {
                DeferredParent merged = mergeDeferred(
                    bake_, std::span(chunks).subspan(i).first<quadrantCount>(), file_.size(), scratch);
                TRY(file_.append(merged.block));
                const std::optional<float> known = stack_.known(merged.parent.id);
                held_[level - 1].push_back({std::move(merged.parent), true, known});
            }
            chunks = {};
        }
        return {};
    }

    // Returns the roots of the faces, in their order.
    std::vector<DeferredChunk> takeRoots() { return std::move(held_[0]); }

private:
    Result<void> takeBlock(const Subtree&, std::span<const std::byte> block) override {
        return file_.append(block);
    }

    void hold(Subtree&& subtree) override {
        const std::uint64_t offset = subtree.firstTile;
        held_[subtree.root.id.level].push_back(deferredChunk(std::move(subtree), offset));
    }

    Result<void> search(std::vector<DeferredChunk>& chunks, int threads, const std::function<bool()>& goOn) {
        if (chunks.empty()) return {};
        TRY_ASSIGN(const auto written, openUnfinished(file_.path().string(), file_.size(), bake_.shape,
                                                      chunks[0].baked.entry.minStep,
                                                      [this](std::uint64_t offset, std::span<std::byte> out) {
                                                          return file_.read(offset, out);
                                                      }));
        const ReadChildren readChildren = [&](const ChunkData& parent) {
            return written.readChildren(parent.id, parent.children, parent.heights);
        };
        return searchTightMetrics(bake_, chunks, threads, readChildren, goOn);
    }

    const BakeContext& bake_;
    AtomicFile& file_;
    SubtreeStack stack_;                            // counts tiles by the offset of their first block
    std::vector<std::vector<DeferredChunk>> held_;  // by level; the roots are at level 0
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

// Notes the first damage of the earlier bake.
void noteDamage(BakeReport& report, const std::string& problem) {
    if (problem.empty() || report.reuseIsDamaged) return;
    report.reuseNotice = problem;
    report.reuseIsDamaged = true;
}

// Bakes or copies all units. Fills in what the report says of copies.
Result<void> bakeTiles(const BakeContext& bake, int tileLevels, int threads, const EarlierBake* earlier,
                       Assembler& assembler, ProgressMeter& meter, BakeReport& report) {
    BakeWalk walk(bake.source, bake.shape, tileLevels, earlier);
    // The steps in progress.
    struct Work {
        BakeStep step;
        Result<StepResult> made;
    };
    std::vector<Work> underWay(static_cast<std::size_t>(threads) * 3);
    PerThread<BakeScratch> scratches;
    Result<void> outcome;
    std::atomic<bool> stop = false;
    const auto begin = [&](std::size_t place) {
        std::optional<BakeStep> step = stop ? std::nullopt : walk.next();
        if (!step) return false;
        underWay[place].step = *std::move(step);
        return true;
    };
    const auto bakeOne = [&](std::size_t place) {
        underWay[place].made = runStep(bake, earlier, underWay[place].step, scratches.local());
    };
    const auto add = [&](Work&& work) -> Result<void> {
        TRY_ASSIGN(auto made, std::move(work.made));
        for (const UnchangedChunk& chunk : work.step.unchanged) assembler.know(chunk);
        for (BakedTile& tile : made.tiles) TRY(assembler.add(std::move(tile)));
        report.sampledCells += made.sampledCells;
        report.copiedChunks += made.copiedChunks;
        noteDamage(report, made.problem);
        return meter.add(made.cells) ? Result<void>() : cancelled();
    };
    const auto write = [&](Work&& work) {
        outcome = add(std::move(work));
        if (!outcome) stop = true;
    };
    const auto writeOne = [&](std::size_t place) {
        if (outcome) write(std::move(underWay[place]));
    };
    parallelInOrder(threads, underWay.size(), begin, bakeOne, writeOne);
    noteDamage(report, walk.problem());
    return outcome;
}

Result<void> writeColours(const ColourSource& source, const ColourTree& tree, const BakeSettings& settings,
                          const EarlierBake* earlier, AtomicFile& file, ProgressMeter& meter,
                          ChunkFileInfo& info, BakeReport& report) {
    const auto progress = [&](std::uint64_t tiles) { return meter.add(tiles * samplesPerColourTile); };
    if (earlier && earlier->hasSameColours()) {
        std::string problem;
        TRY_ASSIGN(info.colour, copyColours(earlier->file(), file, progress, problem));
        if (info.colour) {
            // The name of the image is no part of what the colours depend on.
            info.colour->source = source.description;
            report.copiedColourTiles = tree.tileCount();
            return {};
        }
        noteDamage(report, problem);
    }
    TRY_ASSIGN(info.colour,
               bakeColour(source, tree, settings.colour.format, bakeThreads(settings), file, progress));
    return {};
}

// Opens the earlier bake of the settings; nothing, and the reason in notice, if it cannot be used.
std::optional<EarlierBake> earlierBake(const HeightSource& source, const BakeSettings& settings,
                                       const PlanetShape& shape, const std::optional<SourceRecord>& record,
                                       std::string& notice) {
    if (settings.reuse.empty()) return std::nullopt;
    Result<ChunkFile> file = ChunkFile::open(settings.reuse);
    if (!file) {
        notice = file.error().message;
        return std::nullopt;
    }
    if (record) {
        auto earlier = EarlierBake::make(*std::move(file), source, shape, *record, notice);
        if (earlier && !earlier->difference().empty())
            notice = fmt::format("{}: no chunk was copied from it, because {}", settings.reuse.string(),
                                 earlier->difference());
        return earlier;
    }
    notice = fmt::format("{}: nothing was copied from it, because the source cannot say what it depends on",
                         settings.reuse.string());
    return std::nullopt;
}

}  // namespace

Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress,
                        const ColourSource* colour) {
    const Stopwatch stopwatch;
    TRY(checkBakeSettings(settings));
    TRY_ASSIGN(const auto shape, chooseShape(source, settings));
    const int tileLevels = deepestLevelOf(shape) - tileLevelOf(shape, settings.tileLevels);
    const TreeCount tree = countTree(source, shape).value();
    const BakeContext context{source, shape, settings.compressionLevel};
    ColourTree colourTree;
    if (colour) {
        TRY_ASSIGN(colourTree, colourTreeOf(*colour, settings.colour));
    }
    const std::uint64_t colourTiles = colourTree.tileCount();

    BakeReport report;
    const std::optional<SourceRecord> record = recordOf(source, settings, shape, colour);
    const std::optional<EarlierBake> earlier =
        earlierBake(source, settings, shape, record, report.reuseNotice);
    const bool mayCopy = earlier && earlier->difference().empty();
    TRY_ASSIGN(auto file, AtomicFile::create(output, settings.fileCalls));
    TRY(file.append(std::vector<std::byte>(chunkFileHeaderBytes)));
    Assembler assembler(context, file);
    ProgressMeter meter(progress, tree.leafCells + colourTiles * samplesPerColourTile);
    const int threads = bakeThreads(settings);
    TRY(bakeTiles(context, tileLevels, threads, mayCopy ? &*earlier : nullptr, assembler, meter, report));
    TRY(assembler.finish(threads, [&] { return meter.add(0); }));
    ChunkFileInfo info;
    info.chunks = tree.chunks;
    info.coarsestLeafLevel = tree.coarsestLeafLevel;
    const std::vector<DeferredChunk> roots = assembler.takeRoots();
    TRY(writeRoots(context, std::span(roots).first<faceCount>(), file, info));
    const std::uint64_t bytesWithoutColours = file.size();
    if (colour) {
        TRY(writeColours(*colour, colourTree, settings, earlier ? &*earlier : nullptr, file, meter, info,
                         report));
    }
    const std::uint64_t colourBytes = file.size() - bytesWithoutColours;
    TRY(commitBake(record, file, info));
    if (!settings.debugLevelsFolder.empty()) {
        TRY(writeLevelImages(output, settings.debugLevelsFolder));
    }
    describeBake(source, settings, colour, info, std::span(roots).first<faceCount>(), report);
    report.fileBytes = file.size();
    report.colourTiles = colourTiles;
    report.colourBytes = colourBytes;
    report.seconds = stopwatch.elapsedS();
    return report;
}

}  // namespace planet
