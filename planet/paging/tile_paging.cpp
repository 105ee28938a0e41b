#include "planet/paging/tile_paging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "planet/format/colour_tile.h"
#include "planet/format/tile_layout.h"

namespace planet {

namespace {

// A tile has become resident whose children may be known to fail. Those that are shown as checkers are Absent
// until there is room for these.
void recall(const BlockFailures& failures, TileNode& node, bool staysAway, double sinceAnewS) {
    if (node.childrenState != ChildrenState::Absent) return;
    const ChildrenState known = failures.stateAt(node.id, sinceAnewS);
    if (known == ChildrenState::AwaitingRetry || (known == ChildrenState::Failed && staysAway))
        changeState(node.childrenState, known);
}

}  // namespace

void TilePaging::begin(std::uint32_t capacity, double sinceAnewS) {
    assert(capacity == 0 || (capacity >= faceCount && (capacity - faceCount) % quadrantCount == 0));
    for (const TileNode& node : tree.nodes)
        if (node.childrenState == ChildrenState::Resident && !node.hasFailed) ++counters.evicted;
    tileCapacity = capacity;
    tree = capacity > 0 ? makeTileTree(leafLevel, !checkers, roots) : TileTree{};
    promised = 0;
    freeBlocks.clear();
    for (std::uint32_t end = capacity; end > faceCount; end -= quadrantCount)
        freeBlocks.push_back(end - quadrantCount);
    roomToCome = false;
    failures.beginStep();
    changes.clear();
    if (capacity == 0) return;
    changes.push_back({.beginsAnew = true});
    for (TileNode& root : tree.nodes) recall(failures, root, !checkers, sinceAnewS);
    for (std::uint32_t face = 0; face < faceCount; ++face) {
        if (!roots[face].texels.empty()) changes.push_back({.firstSlot = face, .arrived = {roots[face]}});
    }
}

void TilePaging::use(const std::vector<NodeIndex>& touched, std::uint64_t frame) {
    for (const NodeIndex index : touched) tree.nodes[index].lastUsedFrame = frame;
}

void TilePaging::request(PagingQueue& queue, const std::vector<MergedRequest>& wanted,
                         const std::vector<MergedRequest>& splits, const Asking& asking) {
    counters.budgetWaits = 0;
    roomToCome = false;
    failures.beginStep();
    for (const MergedRequest& one : wanted) {
        if (!failures.mayAsk(one.parentId, tree.nodes[one.parent].childrenState, asking.sinceAnewS)) continue;
        if (!promiseRoom(queue, one, splits, asking)) {
            ++counters.budgetWaits;
            continue;
        }
        TileNode& parent = tree.nodes[one.parent];
        changeState(parent.childrenState, ChildrenState::Requested);
        if (failures.isForGood(one.parentId)) {
            showCheckers(one.parentId, asking.frame, asking.sinceAnewS);
            continue;
        }
        const BlockId block{one.parentId, kind};
        if (asking.requested) asking.requested->push_back(block);
        queue.submit({.parent = one.parentId,
                      .kind = kind,
                      .priority = one.priority,
                      .renewedFrame = asking.frame,
                      .askedAtS = asking.nowS,
                      .viewPriority = one.viewPriority,
                      .location = parent.children,
                      .ticket = asking.nextTicket++});
    }
}

// Free slots first, then those of the block that is out of use longest, of one that is in use but wanted far
// less, and those promised to a page-in that is wanted less.
bool TilePaging::promiseRoom(PagingQueue& queue, const MergedRequest& wanted,
                             const std::vector<MergedRequest>& splits, const Asking& asking) {
    if (freeBlocks.size() <= promised && !evictUnused(asking) && !evictLessWanted(wanted, splits, asking)) {
        const PagingRequest* least = queue.worst(PagingType::PageIn, kind);
        if (!least || least->priority >= static_cast<double>(wanted.priority)) return false;
        const PagingRequest cancelled = *queue.cancel(least->block());
        withdraw(cancelled.parent);
        asking.note(cancelled, PagingOutcome::Cancelled);
    }
    ++promised;
    return true;
}

bool TilePaging::evictUnused(const Asking& asking) {
    NodeIndex oldest = noNode;
    const auto age = [&](NodeIndex parent) {
        const TileNode& first = tree.nodes[tree.nodes[parent].firstChild];
        return std::pair(first.lastUsedFrame, -static_cast<int>(first.id.level));
    };
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
        if (!mayBeEvicted(i)) continue;
        const std::uint64_t lastUsed = age(i).first;
        if (lastUsed == asking.frame) continue;
        if (lastUsed + framesKept >= asking.frame) {
            roomToCome = true;
            continue;
        }
        if (oldest == noNode || age(i) < age(oldest)) oldest = i;
    }
    if (oldest == noNode) return false;
    evict(oldest, asking);
    return true;
}

// splits: of all views, the most wanted first.
bool TilePaging::evictLessWanted(const MergedRequest& wanted, const std::vector<MergedRequest>& splits,
                                 const Asking& asking) {
    for (auto split = splits.rbegin(); split != splits.rend(); ++split) {
        if (wanted.priority <= yieldFactor * split->priority) return false;
        // A tile may be wanted more than the one above it, since their bounds do not lie in each other; it is
        // needed all the same.
        if (split->parent == tree.nodes[wanted.parent].parent) continue;
        // Another of this step's requests may have had it already.
        if (!mayBeEvicted(split->parent) || tree.nodes[split->parent].id != split->parentId) continue;
        evict(split->parent, asking);
        return true;
    }
    return false;
}

// Not while anything below is resident or on its way.
bool TilePaging::mayBeEvicted(NodeIndex parent) const {
    const TileNode& node = tree.nodes[parent];
    if (node.childrenState != ChildrenState::Resident) return false;
    const auto begin = tree.nodes.begin() + node.firstChild;
    return std::none_of(begin, begin + quadrantCount, [](const TileNode& child) {
        return child.childrenState == ChildrenState::Resident ||
               child.childrenState == ChildrenState::Requested;
    });
}

void TilePaging::evict(NodeIndex parent, const Asking& asking) {
    const PagingRequest request{
        .parent = tree.nodes[parent].id, .kind = kind, .type = PagingType::PageOut, .askedAtS = asking.nowS};
    if (!tree.nodes[parent].hasFailed) ++counters.evicted;  // a checker pattern was never loaded
    remove(parent);
    asking.note(request, PagingOutcome::Evicted);
}

void TilePaging::remove(NodeIndex parent) {
    freeBlocks.push_back(tree.nodes[tree.nodes[parent].firstChild].slot);
    changes.push_back({.gone = tree.nodes[parent].id});
    removeTiles(tree, parent);
}

void TilePaging::withdraw(const ChunkId& parent) {
    const NodeIndex node = findTile(tree, parent);
    assert(node != noNode && tree.nodes[node].childrenState == ChildrenState::Requested);
    changeState(tree.nodes[node].childrenState, ChildrenState::Absent);
    --promised;
}

void TilePaging::finish(const ChunkId& parent, TileBlock&& tiles, std::uint64_t frame, double sinceAnewS) {
    failures.forget(parent);
    addResident(parent, std::move(tiles), frame, sinceAnewS);
    ++counters.loaded;
}

void TilePaging::addResident(const ChunkId& parent, TileBlock&& tiles, std::uint64_t frame,
                             double sinceAnewS) {
    const NodeIndex node = findTile(tree, parent);
    assert(node != noNode && tree.nodes[node].childrenState == ChildrenState::Requested && promised > 0);
    --promised;
    const std::uint32_t slot = freeBlocks.back();
    freeBlocks.pop_back();
    const NodeIndex first = addTiles(tree, node, tiles, slot);
    // As if used by the frame that asked for it, in case this one no longer does.
    for (NodeIndex q = 0; q < quadrantCount; ++q) {
        tree.nodes[first + q].lastUsedFrame = frame - 1;
        recall(failures, tree.nodes[first + q], !checkers, sinceAnewS);
    }
    TileChange change{.firstSlot = slot};
    for (TileData& tile : tiles) change.arrived.push_back(std::move(tile));
    changes.push_back(std::move(change));
}

bool TilePaging::fail(const ChunkId& parent, Error error, std::uint64_t frame, double sinceAnewS,
                      const RetryRules& rules) {
    ++counters.failed;
    const bool forGood = failures.failed(parent, std::move(error), sinceAnewS, rules);
    if (forGood && checkers) {
        showCheckers(parent, frame, sinceAnewS);
        return true;
    }
    const NodeIndex node = findTile(tree, parent);
    assert(node != noNode && promised > 0);
    changeState(tree.nodes[node].childrenState,
                forGood ? ChildrenState::Failed : ChildrenState::AwaitingRetry);
    --promised;
    return forGood;
}

void TilePaging::showCheckers(const ChunkId& parent, std::uint64_t frame, double sinceAnewS) {
    TileBlock block;
    for (int q = 0; q < quadrantCount; ++q)
        block[static_cast<std::size_t>(q)] = {childOf(parent, q), {}, checkerTexels(*checkers)};
    addResident(parent, std::move(block), frame, sinceAnewS);
    tree.nodes[findTile(tree, parent)].hasFailed = true;
}

void TilePaging::retry(NodeIndex index) {
    TileNode& node = tree.nodes[index];
    if (node.hasFailed) remove(index);
    if (node.childrenState == ChildrenState::Failed || node.childrenState == ChildrenState::AwaitingRetry)
        changeState(node.childrenState, ChildrenState::Absent);
}

void TilePaging::retryAll() {
    failures.clear();
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) retry(i);
}

void TilePaging::retryOne(const ChunkId& parent) {
    failures.forget(parent);
    if (!isOn()) return;
    if (const NodeIndex node = findTile(tree, parent); node != noNode) retry(node);
}

void TilePaging::count() {
    counters.residentTiles = tree.residentTiles;
    counters.tileCapacity = tileCapacity;
}

Result<std::uint32_t> tilesFor(const TilePyramid& pyramid, std::size_t budgetBytes, std::uint32_t most) {
    const std::size_t bytes = pyramid.tileBytes;
    // One path down, with the siblings of each tile beside it and the same once more where it meets others.
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
