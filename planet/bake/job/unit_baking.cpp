#include "planet/bake/job/unit_baking.h"

#include <cassert>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "planet/bake/bake_finish.h"
#include "planet/bake/job/job_bytes.h"
#include "planet/bake/subtree_merging.h"
#include "planet/base/little_endian.h"
#include "planet/base/parallel.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"

namespace planet {

namespace {

// A part of a unit that one task bakes: a tile of heights, or a tile of colours.
struct Piece {
    std::uint64_t unit = 0;
    std::variant<TreeUnit, ChunkId> what;
    bool isLast = false;  // of its unit
};

struct BakedPiece {
    Piece piece;
    Result<BakedTile> heights;
    Result<PackedColourTile> colours;
    double seconds = 0;
};

// Divides the units of a feed into pieces.
class Pieces {
public:
    Pieces(const JobPlan& plan, UnitFeed& feed) : plan_(plan), feed_(feed) {}

    std::optional<Piece> next() {
        while (next_ == pieces_.size()) {
            const std::optional<std::uint64_t> unit = feed_.next();
            if (!unit) return std::nullopt;
            open(*unit);
        }
        return pieces_[next_++];
    }

private:
    void open(std::uint64_t unit) {
        pieces_.clear();
        next_ = 0;
        const std::size_t heights = plan_.heightUnits.size();
        if (unit < heights) {
            for (const TreeUnit& tile : unitsUnder(plan_.source, plan_.bake.shape, plan_.heightUnits[unit],
                                                   plan_.tileLevels, plan_.unitLevels))
                pieces_.push_back({unit, tile});
        } else {
            const ColourUnit& colours = plan_.colourUnits[static_cast<std::size_t>(unit - heights)];
            const auto& ids = plan_.colourTree.levels[colours.level].ids;
            for (const ChunkId& id : std::span(ids).subspan(colours.firstTile, colours.tiles))
                pieces_.push_back({unit, id});
        }
        pieces_.back().isLast = true;
    }

    const JobPlan& plan_;
    UnitFeed& feed_;
    std::vector<Piece> pieces_;
    std::size_t next_ = 0;
};

// Puts the pieces of units together, in their order, and spools them.
class UnitAssembly final : private SubtreeSink {
public:
    UnitAssembly(const JobPlan& plan, SpoolWriter& spool, std::vector<SpoolEntry>& finished,
                 UnitCounts& counts)
        : plan_(plan), spool_(spool), finished_(finished), counts_(counts), stack_(plan.bake, *this) {}

    Result<void> add(BakedPiece&& baked) {
        const Piece& piece = baked.piece;
        const Stopwatch stopwatch;
        if (const auto* tile = std::get_if<TreeUnit>(&piece.what)) {
            TRY_ASSIGN(auto heights, std::move(baked.heights));
            const auto along = static_cast<std::uint64_t>(cellsAlong(*tile, plan_.bake.shape));
            take(heights.blocks, along * along);
            TRY(stack_.push(subtreeOf(std::move(heights), piece.unit)));
        } else {
            TRY_ASSIGN(const auto colours, std::move(baked.colours));
            packedBytes_.push_back(colours.entry.packedBytes);
            take(colours.bytes, samplesPerColourTile);
        }
        done_.seconds += baked.seconds + stopwatch.elapsedS();
        return piece.isLast ? spool(piece.unit) : Result<void>();
    }

private:
    Result<void> takeBlock(const Subtree&, std::span<const std::byte> block) override {
        body_.insert(body_.end(), block.begin(), block.end());
        return {};
    }
    void hold(Subtree&&) override { assert(false && "a unit is too large: its blocks do not lie together"); }

    void take(std::span<const std::byte> bytes, std::uint64_t samples) {
        body_.insert(body_.end(), bytes.begin(), bytes.end());
        done_.samples += samples;
        counts_.samples += samples;
    }

    Result<void> spool(std::uint64_t unit) {
        std::vector<std::byte> front;
        if (unit < plan_.heightUnits.size()) {
            const std::vector<Subtree> whole = stack_.takeWaiting();
            assert(whole.size() == 1 && whole[0].bytes == body_.size());
            putSubtree(front, whole[0]);
        } else {
            front = colourFront(packedBytes_);
        }
        done_.unit = unit;
        TRY_ASSIGN(const auto entry, spool_.append(done_, front, body_));
        finished_.push_back(entry);
        ++counts_.units;
        done_ = {};
        body_.clear();
        packedBytes_.clear();
        return {};
    }

    const JobPlan& plan_;
    SpoolWriter& spool_;
    std::vector<SpoolEntry>& finished_;
    UnitCounts& counts_;
    SubtreeStack stack_;
    FinishedUnit done_;
    std::vector<std::byte> body_;
    std::vector<std::uint32_t> packedBytes_;
};

void bakePiece(const JobPlan& plan, BakeScratch& scratch, BakedPiece& work) {
    const Stopwatch stopwatch;
    if (const auto* tile = std::get_if<TreeUnit>(&work.piece.what))
        work.heights = bakeTile(plan.bake, *tile, scratch);
    else
        work.colours =
            packColourTile(*plan.colour, plan.settings.colour.format, std::get<ChunkId>(work.piece.what));
    work.seconds = stopwatch.elapsedS();
}

}  // namespace

Result<void> bakeFeed(const JobPlan& plan, UnitFeed& feed, SpoolWriter& spool,
                      std::vector<SpoolEntry>& finished, UnitCounts& counts) {
    const int threads = bakeThreads(plan.settings);
    Pieces pieces(plan, feed);
    UnitAssembly assembly(plan, spool, finished, counts);
    std::vector<BakedPiece> underWay(static_cast<std::size_t>(threads) * 3);
    PerThread<BakeScratch> scratches;
    Result<void> outcome;
    const auto begin = [&](std::size_t place) {
        const std::optional<Piece> piece = feed.hasStopped() ? std::nullopt : pieces.next();
        if (piece) underWay[place].piece = *piece;
        return piece.has_value();
    };
    const auto bakeOne = [&](std::size_t place) { bakePiece(plan, scratches.local(), underWay[place]); };
    const auto addOne = [&](std::size_t place) {
        if (!outcome) return;
        outcome = assembly.add(std::move(underWay[place]));
        if (!outcome) feed.stop();
    };
    parallelInOrder(threads, underWay.size(), begin, bakeOne, addOne);
    return outcome;
}

std::vector<std::byte> colourFront(const std::vector<std::uint32_t>& packedBytes) {
    std::vector<std::byte> front;
    for (const std::uint32_t bytes : packedBytes) ByteWriter(front).put(bytes);
    return front;
}

Result<std::vector<std::uint32_t>> colourSizes(std::span<const std::byte> front, const ColourUnit& unit) {
    if (front.size() != unit.tiles * sizeof(std::uint32_t))
        return badInput("the bytes of a finished unit of colours are not as they were written");
    ByteReader in(front);
    std::vector<std::uint32_t> sizes(unit.tiles);
    for (std::uint32_t& size : sizes) size = in.get<std::uint32_t>();
    return sizes;
}

}  // namespace planet
