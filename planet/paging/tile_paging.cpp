#include "planet/paging/tile_paging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "planet/format/colour_tile.h"
#include "planet/format/tile_layout.h"

namespace planet {

void TilePaging::begin(std::uint32_t capacity, double sinceResetS) {
    assert(capacity == 0 || (capacity >= faceCount && (capacity - faceCount) % quadrantCount == 0));
    assert(reserved() == 0);
    wastePrefetches();
    for (const TileNode& node : tree.nodes)
        if (node.childrenState == ChildrenState::Resident && !node.hasFailed) ++counters().evicted;
    tree = capacity > 0 ? makeTileTree(leafLevel, !checkers, roots) : TileTree{};
    resetSlots(capacity, faceCount);
    roomIsComing_ = false;
    forgetRetryTime();
    changes.clear();
    if (capacity == 0) return;
    changes.push_back({.resets = true});
    for (TileNode& root : tree.nodes) recallFailure(root.id, root.childrenState, sinceResetS);
    for (std::uint32_t face = 0; face < faceCount; ++face) {
        if (!roots[face].texels.empty()) changes.push_back({.firstSlot = face, .arrived = {roots[face]}});
    }
}

void TilePaging::use(const std::vector<NodeIndex>& touched, std::uint64_t frame) {
    for (const NodeIndex index : touched) {
        TileNode& node = tree.nodes[index];
        node.lastUsedFrame = frame;
        if (node.parent != noNode) noteUse(tree.nodes[node.parent].id);
    }
}

void TilePaging::markPredicted(const std::vector<NodeIndex>& predicted, const PagingRun& run) {
    for (const NodeIndex index : predicted) {
        std::uint64_t& lastUsedFrame = tree.nodes[index].lastUsedFrame;
        lastUsedFrame = std::max(lastUsedFrame, predictedUse(run));
    }
}

void TilePaging::describe(NodeIndex parent, PagingRequest& request) const {
    request.location = tree.nodes[parent].children;
}

void TilePaging::dropAll(PagingQueue&, PagingRun& run) {
    if (!isOn()) return;
    discardReads(run);
    begin(capacity(), run.sinceResetS);
}

// Evicts the least recently used block, or one that is in use with a far lower priority.
bool TilePaging::makeRoom(PagingQueue&, const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                          PagingRun& run) {
    return evictUnused(run) || evictLessWanted(wanted, splits, run);
}

bool TilePaging::makeRoomForPrefetch(PagingQueue&, PagingRun& run) {
    const NodeIndex oldest = findUnused(oldestPredictedUse(run), run).oldest;
    if (oldest != noNode) evict(oldest, run);
    return oldest != noNode;
}

bool TilePaging::evictUnused(PagingRun& run) {
    const Unused unused = findUnused(run.frame > framesKept ? run.frame - framesKept : 0, run);
    roomIsComing_ = roomIsComing_ || unused.hasRecent;
    if (unused.oldest != noNode) evict(unused.oldest, run);
    return unused.oldest != noNode;
}

TilePaging::Unused TilePaging::findUnused(std::uint64_t usedBefore, const PagingRun& run) const {
    Unused found;
    NodeIndex& oldest = found.oldest;
    const auto age = [&](NodeIndex parent) {
        const TileNode& first = tree.nodes[tree.nodes[parent].firstChild];
        return std::pair(first.lastUsedFrame, -static_cast<int>(first.id.level));
    };
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
        if (!mayBeEvicted(i)) continue;
        const std::uint64_t lastUsed = age(i).first;
        if (lastUsed == run.frame) continue;
        if (lastUsed >= usedBefore) {
            found.hasRecent = true;
            continue;
        }
        if (oldest == noNode || age(i) < age(oldest)) oldest = i;
    }
    return found;
}

bool TilePaging::evictLessWanted(const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                                 PagingRun& run) {
    for (auto split = splits.rbegin(); split != splits.rend(); ++split) {
        if (wanted.priority <= yieldFactor * split->priority) return false;
        // A tile may have a higher priority than its parent, because their bounds are not nested, but it
        // needs its parent resident.
        if (split->parent == tree.nodes[wanted.parent].parent) continue;
        // Another request of this step may have evicted it already.
        if (!mayBeEvicted(split->parent) || tree.nodes[split->parent].id != split->parentId) continue;
        evict(split->parent, run);
        return true;
    }
    return false;
}

bool TilePaging::mayBeEvicted(NodeIndex parent) const {
    const TileNode& node = tree.nodes[parent];
    return node.childrenState == ChildrenState::Resident && isBottom(tree, node.firstChild);
}

void TilePaging::evict(NodeIndex parent, PagingRun& run) {
    const PagingRequest request{
        .parent = tree.nodes[parent].id, .kind = kind(), .type = PagingType::PageOut, .askedAtS = run.nowS};
    const bool wasLoaded = !tree.nodes[parent].hasFailed;  // a checker pattern was never loaded
    remove(parent);
    noteEviction(request, wasLoaded, run);
}

void TilePaging::remove(NodeIndex parent) {
    freeSlots(tree.nodes[tree.nodes[parent].firstChild].slot);
    changes.push_back({.gone = tree.nodes[parent].id});
    removeTiles(tree, parent);
}

void TilePaging::addResident(NodeIndex parent, LoadedBlock&& block, std::uint64_t lastUsedFrame,
                             PagingRun& run, const UploadChunk&) {
    addTilesUnder(parent, std::get<TileBlock>(std::move(block)), lastUsedFrame, run);
}

void TilePaging::addTilesUnder(NodeIndex parent, TileBlock&& tiles, std::uint64_t lastUsedFrame,
                               const PagingRun& run) {
    const std::uint32_t slot = takeSlots();
    const NodeIndex first = addTiles(tree, parent, tiles, slot);
    for (NodeIndex child = first; child < first + quadrantCount; ++child) {
        tree.nodes[child].lastUsedFrame = lastUsedFrame;
        recallFailure(tree.nodes[child].id, tree.nodes[child].childrenState, run.sinceResetS);
    }
    TileChange change{.firstSlot = slot};
    for (TileData& tile : tiles) change.arrived.push_back(std::move(tile));
    changes.push_back(std::move(change));
}

void TilePaging::addStandIn(NodeIndex parent, PagingRun& run) {
    TileBlock block;
    for (int q = 0; q < quadrantCount; ++q)
        block[static_cast<std::size_t>(q)] = {
            childOf(tree.nodes[parent].id, q), {}, checkerTexels(*checkers)};
    addTilesUnder(parent, std::move(block), run.frame - 1, run);
    tree.nodes[parent].hasFailed = true;
}

void TilePaging::dropStandIn(NodeIndex parent) {
    if (tree.nodes[parent].hasFailed) remove(parent);
}

Result<std::uint32_t> tileSlotsFor(const TilePyramid& pyramid, std::size_t budgetBytes, std::uint32_t most) {
    const std::size_t bytes = pyramid.tileBytes;
    // Counts one path to the finest level with the siblings of each tile, twice, for places where tiles meet.
    const std::uint64_t wanted =
        faceCount + 2 * quadrantCount * static_cast<std::uint64_t>(pyramid.leafLevel);
    const std::uint64_t all = tileCountOf(pyramid.leafLevel);
    const std::uint64_t least = std::min(wanted, all);
    if (budgetBytes / bytes < least || most < least) {
        return badInput(fmt::format("budget too small for this planet: {} {}; expected at least {}, {} bytes",
                                    std::min<std::uint64_t>(budgetBytes / bytes, most), pyramid.name, least,
                                    least * bytes));
    }
    const std::uint64_t tiles = std::min({std::uint64_t{budgetBytes / bytes}, std::uint64_t{most}, all});
    return static_cast<std::uint32_t>(tiles - (tiles - faceCount) % quadrantCount);
}

}  // namespace planet
