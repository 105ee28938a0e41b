#include "planet/bake/subtree_merging.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "planet/base/parallel.h"
#include "planet/base/try.h"

namespace planet {

namespace {

std::array<BakedChunk, quadrantCount> rootsOf(std::span<Subtree, quadrantCount> children) {
    std::array<BakedChunk, quadrantCount> roots;
    std::uint64_t before = 0;
    for (std::size_t q = 0; q < roots.size(); ++q) {
        roots[q] = std::move(children[q].root);
        if (roots[q].entry.children.exists()) roots[q].entry.children.offset += before;
        before += children[q].bytes;
    }
    return roots;
}

// Returns what the parent of four siblings is known to be before its own chunk is made.
Subtree around(std::span<const Subtree, quadrantCount> children) {
    Subtree parent;
    parent.root.id = parentOf(children[0].root.id);
    parent.firstTile = children.front().firstTile;
    parent.lastTile = children.back().lastTile;
    for (const Subtree& child : children) {
        parent.bytes += child.bytes;
        parent.deepestUnitLevel = std::max(parent.deepestUnitLevel, child.deepestUnitLevel);
    }
    return parent;
}

// Returns the largest distances of four siblings, by level from `coarsest`.
std::vector<double> largestAbove(std::span<const Subtree, quadrantCount> children, const PlanetShape& shape,
                                 int coarsest) {
    std::vector<double> largestM;
    for (const Subtree& child : children) {
        const auto skipped =
            static_cast<std::size_t>(coarsest - coarsestLevelOfTiles(child.deepestUnitLevel, shape));
        for (std::size_t i = skipped; i < child.offAboveM.size(); ++i) {
            if (largestM.size() <= i - skipped) largestM.resize(i - skipped + 1);
            largestM[i - skipped] = std::max(largestM[i - skipped], child.offAboveM[i]);
        }
    }
    return largestM;
}

ChunkData dataOf(const BakedChunk& chunk) {
    const ChunkEntry& entry = chunk.entry;
    return {chunk.id,
            entry.deltaCM,
            entry.deltaTightM,
            entry.minStep,
            entry.maxStep,
            entry.children,
            Steps(std::span<const std::int32_t>(chunk.heights))};
}

}  // namespace

Subtree subtreeOf(BakedTile&& tile, std::uint64_t number) {
    Subtree subtree;
    subtree.root = std::move(tile.root);
    subtree.bytes = tile.blocks.size();
    subtree.deepestUnitLevel = tile.deepestUnitLevel;
    subtree.offAboveM = std::move(tile.offAboveM);
    subtree.firstTile = subtree.lastTile = number;
    return subtree;
}

std::optional<float> SubtreeStack::known(const ChunkId& id) const {
    const auto found = known_.find(id);
    return found == known_.end() ? std::nullopt : std::optional(found->second);
}

bool SubtreeStack::endsWithSiblings() const {
    if (waiting_.size() < quadrantCount) return false;
    const auto last = std::span(waiting_).last<quadrantCount>();
    const ChunkId& id = last.back().root.id;
    if (id.level == 0) return false;
    for (int q = 0; q < quadrantCount; ++q) {
        if (last[static_cast<std::size_t>(q)].root.id != childOf(parentOf(id), q)) return false;
    }
    return true;
}

Result<void> SubtreeStack::push(Subtree&& subtree) {
    waiting_.push_back(std::move(subtree));
    while (endsWithSiblings()) {
        const auto children = std::span(waiting_).last<quadrantCount>();
        const bool isHeld = std::ranges::any_of(
            children, [](const Subtree& child) { return child.isUnknown || child.isLater; });
        Subtree parent;
        if (isHeld) {
            parent = holdBack(children);
        } else {
            TRY_ASSIGN(parent, merge(children));
        }
        waiting_.resize(waiting_.size() - quadrantCount);
        waiting_.push_back(std::move(parent));
    }
    return {};
}

Result<Subtree> SubtreeStack::merge(std::span<Subtree, quadrantCount> children) {
    Subtree parent = around(children);
    const ChunkId id = parent.root.id;
    const int coarsest = coarsestLevelOfTiles(parent.deepestUnitLevel, bake_.shape);
    parent.offAboveM = largestAbove(children, bake_.shape, coarsest);
    parent.isUnknown = id.level < coarsest;
    const auto own = static_cast<std::size_t>(std::max(0, id.level - coarsest));
    const double offM = parent.isUnknown || own >= parent.offAboveM.size() ? 0 : parent.offAboveM[own];
    if (parent.offAboveM.size() > own) parent.offAboveM.resize(own);
    std::vector<std::byte> block;
    parent.root = mergeChildren(bake_, id, rootsOf(children), {{}, offM}, provisionalOrigin + parent.bytes,
                                scratch_, block);
    parent.bytes += block.size();
    parent.deltaTightM = known(id);
    if (parent.deltaTightM) {
        parent.root.entry.deltaTightM = *parent.deltaTightM;
        known_.erase(id);
    }
    TRY(sink_.takeBlock(parent, block));
    return parent;
}

Subtree SubtreeStack::holdBack(std::span<Subtree, quadrantCount> children) {
    Subtree parent = around(children);
    parent.isLater = true;
    for (Subtree& child : children) {
        if (!child.isLater) sink_.hold(std::move(child));
    }
    return parent;
}

DeferredChunk deferredChunk(Subtree&& subtree, std::uint64_t offset) {
    DeferredChunk chunk{std::move(subtree.root), subtree.isUnknown, subtree.deltaTightM};
    if (chunk.baked.entry.children.exists()) chunk.baked.entry.children.offset += offset - provisionalOrigin;
    return chunk;
}

void sortInQuadtreeOrder(std::vector<DeferredChunk>& chunks) {
    std::ranges::sort(chunks, {},
                      [](const DeferredChunk& chunk) { return indexInQuadtreeOrder(chunk.baked.id); });
}

Result<void> searchTightMetrics(const BakeContext& bake, std::span<DeferredChunk> chunks, int threads,
                                const ReadChildren& readChildren, const std::function<bool()>& goOn) {
    std::vector<BakedChunk*> unknown;
    for (DeferredChunk& chunk : chunks) {
        if (chunk.deltaTightM)
            chunk.baked.entry.deltaTightM = *chunk.deltaTightM;
        else if (chunk.isUnknown)
            unknown.push_back(&chunk.baked);
    }
    std::mutex mutex;  // guards outcome; held during calls of goOn
    Result<void> outcome;
    const auto mayGoOn = [&] {
        const std::lock_guard lock(mutex);
        if (outcome && !goOn()) outcome = cancelled();
        return outcome.has_value();
    };
    parallelFor(threads, unknown.size(), [&](std::size_t i) {
        ChunkEntry& entry = unknown[i]->entry;
        const Result<double> offM =
            searchFinestDistance(bake.shape, dataOf(*unknown[i]), readChildren, mayGoOn);
        const std::lock_guard lock(mutex);
        if (!offM && outcome) outcome = tl::unexpected(offM.error());
        if (outcome) entry.deltaTightM = tightMetric(*offM, entry.deltaTightM, entry.deltaCM);
    });
    return outcome;
}

DeferredParent mergeDeferred(const BakeContext& bake, std::span<DeferredChunk, quadrantCount> children,
                             std::uint64_t offset, BakeScratch& scratch) {
    std::array<BakedChunk, quadrantCount> baked;
    for (std::size_t q = 0; q < baked.size(); ++q) baked[q] = std::move(children[q].baked);
    DeferredParent merged;
    merged.parent = mergeChildren(bake, parentOf(baked[0].id), baked, {}, offset, scratch, merged.block);
    return merged;
}

}  // namespace planet
