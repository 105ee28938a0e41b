#include "planet/bake/job/join.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "planet/bake/bake_finish.h"
#include "planet/bake/job/job_bytes.h"
#include "planet/bake/job/unit_baking.h"
#include "planet/bake/subtree_merging.h"
#include "planet/base/little_endian.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"

namespace planet {

namespace {

using Messages = std::vector<std::vector<std::byte>>;

Messages noMessages(const Team& team) {
    return Messages(static_cast<std::size_t>(team.count()));
}

// Writes one run of bytes in large pieces.
class RunWriter {
public:
    RunWriter(Join& join, std::uint64_t offset) : join_(join), offset_(offset) {}

    Result<void> append(std::span<const std::byte> bytes) {
        constexpr std::size_t pieceBytes = std::size_t{4} << 20;
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
        return buffer_.size() >= pieceBytes ? flush() : Result<void>();
    }
    std::uint64_t position() const { return offset_ + buffer_.size(); }
    Result<void> flush() {
        TRY(join_.output.write(offset_, buffer_));
        offset_ += buffer_.size();
        join_.bytesWritten += buffer_.size();
        buffer_.clear();
        return {};
    }

private:
    Join& join_;
    std::uint64_t offset_;
    std::vector<std::byte> buffer_;
};

// A run of bytes in the output: those of a unit, or the block of four merged siblings after the units under them.
struct OutputRun {
    std::uint64_t lastUnit = 0;
    int level = unitLevel;         // of the parent of the siblings
    std::vector<std::byte> block;  // empty: the unit's own
    std::uint64_t offset = 0;

    static constexpr int unitLevel = maxLevel + 1;
    // Blocks of deeper siblings come first.
    bool operator<(const OutputRun& other) const {
        return std::tuple(lastUnit, -level) < std::tuple(other.lastUnit, -other.level);
    }
};

class RunSink final : public SubtreeSink {
public:
    Result<void> takeBlock(const Subtree& parent, std::span<const std::byte> block) override {
        output.push_back({parent.lastTile, parent.root.id.level, {block.begin(), block.end()}, 0});
        return {};
    }
    void hold(Subtree&& subtree) override { held.push_back(std::move(subtree)); }

    std::vector<OutputRun> output;
    std::vector<Subtree> held;
};

// Joins the blocks below all chunks that are held back.
class HeightJoin {
public:
    explicit HeightJoin(Join& join)
        : join_(join), shares_(sharesOf(heights(), join.team.count())), stack_(join.plan.bake, sink_) {}

    // Returns the chunks that this rank holds back, and the end of all blocks.
    Result<std::pair<std::vector<DeferredChunk>, std::uint64_t>> run(std::uint64_t offset) {
        TRY(join_.team.agree(mergeOwn()));
        TRY(reduce());
        TRY(sendHome());
        std::uint64_t end = 0;
        TRY(place(offset, end));
        TRY(join_.team.agree(write()));
        return std::pair(std::move(held_), end);
    }

private:
    std::span<const SpoolEntry> heights() const { return join_.units.first(join_.plan.heightUnits.size()); }
    std::size_t rank() const { return static_cast<std::size_t>(join_.team.rank()); }
    std::size_t homeOf(std::uint64_t unit) const {
        return static_cast<std::size_t>(std::ranges::upper_bound(shares_, unit) - shares_.begin()) - 1;
    }

    Result<void> mergeOwn() {
        for (std::size_t unit = shares_[rank()]; unit < shares_[rank() + 1]; ++unit) {
            TRY_ASSIGN(const auto* spool, join_.spool.at(heights()[unit].file));
            TRY_ASSIGN(const auto front, spool->front(heights()[unit]));
            std::span<const std::byte> bytes = front;
            TRY_ASSIGN(auto subtree, takeSubtree(bytes, join_.plan.bake.shape));
            if (subtree.root.id != join_.plan.heightUnits[unit] || subtree.bytes != heights()[unit].bodyBytes)
                return badInput(
                    "a finished unit is not of this bake; remove the folder of the finished units");
            subtree.firstTile = subtree.lastTile = unit;
            sink_.output.push_back({unit, OutputRun::unitLevel, {}, 0});
            TRY(stack_.push(std::move(subtree)));
        }
        return {};
    }

    // Merges what the ranks have left, up a binary tree of ranks.
    Result<void> reduce() {
        const int rank = join_.team.rank();
        for (int step = 1; step < join_.team.count(); step *= 2) {
            Messages messages = noMessages(join_.team);
            if (rank % (2 * step) == step) {
                for (const Subtree& subtree : stack_.takeWaiting())
                    putSubtree(messages[static_cast<std::size_t>(rank - step)], subtree);
            }
            const Messages received = join_.team.exchange(std::move(messages));
            TRY(join_.team.agree(pushAll(received)));
        }
        for (Subtree& root : stack_.takeWaiting()) {
            assert(root.root.id.level == 0);
            if (!root.isLater) sink_.hold(std::move(root));
        }
        return {};
    }

    Result<void> pushAll(const Messages& received) {
        for (const std::vector<std::byte>& message : received) {
            std::span<const std::byte> bytes = message;
            while (!bytes.empty()) {
                TRY_ASSIGN(auto subtree, takeSubtree(bytes, join_.plan.bake.shape));
                TRY(stack_.push(std::move(subtree)));
            }
        }
        return {};
    }

    // Sends merged blocks to the rank that writes the bytes before them, and what is held back to the rank that knows where
    // its blocks begin.
    Result<void> sendHome() {
        Messages blocks = noMessages(join_.team);
        std::vector<OutputRun> own;
        for (OutputRun& run : sink_.output) {
            const std::size_t home = homeOf(run.lastUnit);
            if (home == rank()) {
                own.push_back(std::move(run));
                continue;
            }
            ByteWriter to(blocks[home]);
            to.put(run.lastUnit);
            to.put(std::int32_t{run.level});
            to.put(static_cast<std::uint64_t>(run.block.size()));
            blocks[home].insert(blocks[home].end(), run.block.begin(), run.block.end());
        }
        sink_.output = std::move(own);
        for (const std::vector<std::byte>& message : join_.team.exchange(std::move(blocks))) {
            ByteReader in(message);
            while (!in.rest().empty()) {
                OutputRun run;
                run.lastUnit = in.get<std::uint64_t>();
                run.level = in.get<std::int32_t>();
                const auto block = in.take(static_cast<std::size_t>(in.get<std::uint64_t>()));
                run.block.assign(block.begin(), block.end());
                sink_.output.push_back(std::move(run));
            }
        }
        std::ranges::sort(sink_.output, std::less<>());
        Messages held = noMessages(join_.team);
        for (const Subtree& subtree : sink_.held) putSubtree(held[homeOf(subtree.firstTile)], subtree);
        sink_.held.clear();
        Result<void> taken;
        for (const std::vector<std::byte>& message : join_.team.exchange(std::move(held))) {
            std::span<const std::byte> bytes = message;
            while (taken && !bytes.empty()) {
                Result<Subtree> subtree = takeSubtree(bytes, join_.plan.bake.shape);
                if (subtree)
                    sink_.held.push_back(*std::move(subtree));
                else
                    taken = tl::unexpected(subtree.error());
            }
        }
        return join_.team.agree(taken);
    }

    std::uint64_t bytesOf(const OutputRun& run) const {
        return run.level == OutputRun::unitLevel ? heights()[static_cast<std::size_t>(run.lastUnit)].bodyBytes
                                                 : run.block.size();
    }

    Result<void> place(std::uint64_t offset, std::uint64_t& end) {
        std::uint64_t total = 0;
        for (const OutputRun& run : sink_.output) total += bytesOf(run);
        std::uint64_t at = offset + join_.team.sumBefore(total);
        end = offset + join_.team.sumOf(total);
        for (OutputRun& run : sink_.output) {
            run.offset = at;
            at += bytesOf(run);
        }
        for (Subtree& subtree : sink_.held) {
            const OutputRun key{subtree.firstTile, OutputRun::unitLevel, {}, 0};
            const auto first = std::ranges::lower_bound(sink_.output, key, std::less<>());
            assert(first != sink_.output.end() && first->lastUnit == subtree.firstTile);
            held_.push_back(deferredChunk(std::move(subtree), first->offset));
        }
        return {};
    }

    Result<void> write() {
        if (sink_.output.empty()) return {};
        RunWriter out(join_, sink_.output.front().offset);
        for (const OutputRun& run : sink_.output) {
            if (!join_.goOn()) return cancelled();
            if (run.level != OutputRun::unitLevel) {
                TRY(out.append(run.block));
                continue;
            }
            const SpoolEntry& entry = heights()[static_cast<std::size_t>(run.lastUnit)];
            TRY_ASSIGN(const auto* spool, join_.spool.at(entry.file));
            TRY_ASSIGN(const auto body, spool->body(entry));
            TRY(out.append(body));
        }
        return out.flush();
    }

    Join& join_;
    std::vector<std::size_t> shares_;
    RunSink sink_;
    SubtreeStack stack_;
    std::vector<DeferredChunk> held_;
};

// Moves a block of four siblings to another offset: it names the blocks below it by distance.
std::vector<std::byte> moved(std::span<const std::byte> block, const ChunkId& parent, std::uint64_t from,
                             std::uint64_t to) {
    const BlockIndex index = indexFrom(block, quadrantCount, true, from).value();
    std::vector<std::byte> result;
    putIndex(result, index.entries, to);
    assert(result.size() == index.bytes);
    const auto heights = block.subspan(index.bytes, block.size() - index.bytes - checksumBytes);
    result.insert(result.end(), heights.begin(), heights.end());
    ByteWriter(result).put(siblingChecksum(result, parent));
    return result;
}

// Makes the chunks that are held back, from the deepest level to the roots.
class HeldJoin {
public:
    HeldJoin(Join& join, std::vector<DeferredChunk> held, std::uint64_t end)
        : join_(join),
          byLevel_(static_cast<std::size_t>(deepestLevelOf(join.plan.bake.shape)) + 1),
          end_(end) {
        for (DeferredChunk& chunk : held) byLevel_[chunk.baked.id.level].push_back(std::move(chunk));
    }

    Result<JoinedHeights> run() {
        for (std::size_t level = byLevel_.size(); level-- > 0;) {
            std::vector<DeferredChunk> own;
            TRY_ASSIGN(const auto any, share(level, own));
            if (!any) continue;
            TRY(join_.team.agree(search(own)));
            if (level == 0) return roots(own);
            TRY(merge(own, level));
        }
        return badInput("no root was baked");
    }

private:
    // Shares out the chunks of a level, so that siblings stay together. Returns whether there are any on any rank.
    Result<bool> share(std::size_t level, std::vector<DeferredChunk>& own) {
        std::vector<std::byte> mine;
        for (const DeferredChunk& chunk : byLevel_[level])
            ByteWriter(mine).put(indexInQuadtreeOrder(chunk.baked.id));
        std::vector<std::uint64_t> all;
        for (const std::vector<std::byte>& theirs : join_.team.tellAll(mine)) {
            ByteReader in(theirs);
            while (!in.rest().empty()) all.push_back(in.get<std::uint64_t>());
        }
        if (all.empty()) return false;
        std::ranges::sort(all);
        const std::size_t together = level == 0 ? 1 : quadrantCount;
        const std::size_t groups = all.size() / together;
        Messages messages = noMessages(join_.team);
        for (const DeferredChunk& chunk : byLevel_[level]) {
            const auto at = std::ranges::lower_bound(all, indexInQuadtreeOrder(chunk.baked.id)) - all.begin();
            const std::size_t group = static_cast<std::size_t>(at) / together;
            putDeferredChunk(messages[group * messages.size() / groups], chunk);
        }
        byLevel_[level].clear();
        TRY_ASSIGN(own, taken(join_.team.exchange(std::move(messages))));
        return true;
    }

    Result<std::vector<DeferredChunk>> taken(const Messages& received) {
        std::vector<DeferredChunk> chunks;
        Result<void> outcome;
        for (const std::vector<std::byte>& message : received) {
            std::span<const std::byte> bytes = message;
            while (outcome && !bytes.empty()) {
                Result<DeferredChunk> chunk = takeDeferredChunk(bytes, join_.plan.bake.shape);
                if (chunk)
                    chunks.push_back(*std::move(chunk));
                else
                    outcome = tl::unexpected(chunk.error());
            }
        }
        TRY(join_.team.agree(outcome));
        sortInQuadtreeOrder(chunks);
        return chunks;
    }

    Result<void> search(std::vector<DeferredChunk>& chunks) {
        if (chunks.empty()) return {};
        TRY_ASSIGN(const auto file, openUnfinished(join_.output.name(), end_, join_.plan.bake.shape,
                                                   chunks[0].baked.entry.minStep,
                                                   [&](std::uint64_t offset, std::span<std::byte> out) {
                                                       return join_.output.read(offset, out);
                                                   }));
        const ReadChildren readChildren = [&](const ChunkData& parent) {
            return file.readChildren(parent.id, parent.children, parent.heights);
        };
        return searchTightMetrics(join_.plan.bake, chunks, join_.threads, readChildren, join_.goOn);
    }

    // Merges this rank's siblings of a level, and writes their blocks.
    Result<void> merge(std::vector<DeferredChunk>& chunks, std::size_t level) {
        std::vector<DeferredParent> merged;
        std::uint64_t bytes = 0;
        for (std::size_t i = 0; i < chunks.size(); i += quadrantCount) {
            merged.push_back(mergeDeferred(join_.plan.bake,
                                           std::span(chunks).subspan(i).first<quadrantCount>(), end_ + bytes,
                                           scratch_));
            bytes += merged.back().block.size();
        }
        const std::uint64_t before = join_.team.sumBefore(bytes);
        const std::uint64_t all = join_.team.sumOf(bytes);
        TRY(join_.team.agree(write(merged, before)));
        for (DeferredParent& parent : merged)
            byLevel_[level - 1].push_back({std::move(parent.parent), true, {}});
        end_ += all;
        return {};
    }

    Result<void> write(std::vector<DeferredParent>& merged, std::uint64_t before) {
        RunWriter out(join_, end_ + before);
        for (DeferredParent& held : merged) {
            BlockLocation& location = held.parent.entry.children;
            TRY(out.append(moved(held.block, held.parent.id, location.offset, location.offset + before)));
            location.offset += before;
        }
        return out.flush();
    }

    Result<JoinedHeights> roots(const std::vector<DeferredChunk>& own) {
        Messages messages = noMessages(join_.team);
        for (const DeferredChunk& root : own) putDeferredChunk(messages[0], root);
        TRY_ASSIGN(auto all, taken(join_.team.exchange(std::move(messages))));
        return JoinedHeights{std::move(all), end_};
    }

    Join& join_;
    std::vector<std::vector<DeferredChunk>> byLevel_;
    std::uint64_t end_;
    BakeScratch scratch_;
};

// Joins the blocks of colours.
class ColourJoin {
public:
    explicit ColourJoin(Join& join)
        : join_(join),
          units_(join.units.subspan(join.plan.heightUnits.size())),
          shares_(sharesOf(units_, join.team.count())) {}

    Result<JoinedColours> run(std::uint64_t offset) {
        TRY(join_.team.agree(readSizes()));
        tellSizes(offset);
        TRY(join_.team.agree(write()));
        const ColourTree& tree = join_.plan.colourTree;
        JoinedColours joined;
        joined.pyramid.format = join_.plan.settings.colour.format;
        joined.pyramid.leafLevel = static_cast<int>(tree.levels.size()) - 1;
        joined.pyramid.source = join_.plan.colour->description;
        std::copy(blocks_.end() - faceCount, blocks_.end(), joined.pyramid.roots.begin());
        joined.end = blocks_.back().offset + blocks_.back().size;
        return joined;
    }

private:
    std::size_t firstUnit() const { return shares_[static_cast<std::size_t>(join_.team.rank())]; }
    std::size_t endUnit() const { return shares_[static_cast<std::size_t>(join_.team.rank()) + 1]; }

    Result<void> readSizes() {
        for (std::size_t unit = firstUnit(); unit < endUnit(); ++unit) {
            const ColourUnit& colours = join_.plan.colourUnits[unit];
            TRY_ASSIGN(const auto* spool, join_.spool.at(units_[unit].file));
            TRY_ASSIGN(const auto front, spool->front(units_[unit]));
            TRY_ASSIGN(const auto sizes, colourSizes(front, colours));
            const std::size_t together = colourTilesInBlock(colours.level);
            for (std::size_t i = 0; i < sizes.size(); i += together) {
                std::uint64_t bytes = together * colourEntryBytes + checksumBytes;
                for (std::size_t tile = 0; tile < together; ++tile) bytes += sizes[i + tile];
                ownBlocks_.push_back(static_cast<std::uint32_t>(bytes));
            }
            sizes_.push_back(sizes);
        }
        return {};
    }

    // Tells all ranks the sizes of all blocks; from them follows where each lies.
    void tellSizes(std::uint64_t offset) {
        std::vector<std::byte> own;
        for (const std::uint32_t size : ownBlocks_) ByteWriter(own).put(size);
        for (const std::vector<std::byte>& theirs : join_.team.tellAll(own)) {
            ByteReader in(theirs);
            while (!in.rest().empty()) {
                const auto size = in.get<std::uint32_t>();
                blocks_.push_back({offset, size});
                offset += size;
            }
        }
        std::size_t first = 0;
        firstBlock_.resize(join_.plan.colourTree.levels.size());
        for (std::size_t level = firstBlock_.size(); level-- > 0;) {
            firstBlock_[level] = first;
            first += join_.plan.colourTree.levels[level].ids.size() / colourTilesInBlock(level);
        }
        assert(first == blocks_.size());
    }

    Result<void> write() {
        if (firstUnit() == endUnit()) return {};
        const auto& levels = join_.plan.colourTree.levels;
        const ColourUnit& begin = join_.plan.colourUnits[firstUnit()];
        RunWriter out(
            join_,
            blocks_[firstBlock_[begin.level] + begin.firstTile / colourTilesInBlock(begin.level)].offset);
        // The blocks of a level's children come in the order of the tiles that have children.
        std::size_t level = begin.level;
        std::size_t below = 0;
        for (std::size_t tile = 0; tile < begin.firstTile; ++tile)
            below += levels[level].hasChildren[tile] ? 1 : 0;
        for (std::size_t unit = firstUnit(); unit < endUnit(); ++unit) {
            if (!join_.goOn()) return cancelled();
            const ColourUnit& colours = join_.plan.colourUnits[unit];
            if (std::exchange(level, colours.level) != colours.level) below = 0;
            TRY_ASSIGN(const auto* spool, join_.spool.at(units_[unit].file));
            TRY_ASSIGN(const auto body, spool->body(units_[unit]));
            TRY(writeUnit(colours, sizes_[unit - firstUnit()], body, below, out));
        }
        return out.flush();
    }

    Result<void> writeUnit(const ColourUnit& colours, const std::vector<std::uint32_t>& sizes,
                           std::span<const std::byte> body, std::size_t& below, RunWriter& out) const {
        const ColourTree::Level& level = join_.plan.colourTree.levels[colours.level];
        const std::size_t together = colourTilesInBlock(colours.level);
        for (std::size_t i = 0; i < colours.tiles; i += together) {
            std::vector<PackedColourTile> tiles(together);
            for (std::size_t q = 0; q < together; ++q) {
                if (sizes[i + q] > body.size())
                    return badInput("the bytes of a finished unit of colours are not as they were written");
                const auto bytes = body.first(sizes[i + q]);
                body = body.subspan(sizes[i + q]);
                tiles[q].bytes.assign(bytes.begin(), bytes.end());
                tiles[q].entry.packedBytes = sizes[i + q];
                if (level.hasChildren[colours.firstTile + i + q])
                    tiles[q].entry.children = blocks_[firstBlock_[colours.level + 1] + below++];
            }
            TRY(out.append(colourBlock(level.ids[colours.firstTile + i], tiles, out.position())));
        }
        return {};
    }

    Join& join_;
    std::span<const SpoolEntry> units_;
    std::vector<std::size_t> shares_;
    std::vector<std::vector<std::uint32_t>> sizes_;  // of the tiles of this rank's units
    std::vector<std::uint32_t> ownBlocks_;           // sizes
    std::vector<BlockLocation> blocks_;              // all, in the order of the file
    std::vector<std::size_t> firstBlock_;            // in blocks_, by level
};

}  // namespace

Result<const SpoolReader*> SpoolFiles::at(std::uint32_t file) {
    const auto found = open_.find(file);
    if (found != open_.end()) return &found->second;
    TRY_ASSIGN(auto reader, SpoolReader::open(folder_, file, job_, calls_));
    return &open_.emplace(file, std::move(reader)).first->second;
}

std::vector<std::size_t> sharesOf(std::span<const SpoolEntry> units, int ranks) {
    std::uint64_t total = 0;
    for (const SpoolEntry& unit : units) total += unit.bodyBytes + 1;
    std::vector<std::size_t> shares = {0};
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < units.size(); ++i) {
        before += units[i].bodyBytes + 1;
        while (shares.size() < static_cast<std::size_t>(ranks) &&
               before * static_cast<std::uint64_t>(ranks) >= total * shares.size())
            shares.push_back(i + 1);
    }
    shares.resize(static_cast<std::size_t>(ranks) + 1, units.size());
    return shares;
}

Result<JoinedHeights> joinHeights(Join& join, std::uint64_t offset) {
    TRY_ASSIGN(auto lower, HeightJoin(join).run(offset));
    return HeldJoin(join, std::move(lower.first), lower.second).run();
}

Result<JoinedColours> joinColours(Join& join, std::uint64_t offset) {
    return ColourJoin(join).run(offset);
}

}  // namespace planet
