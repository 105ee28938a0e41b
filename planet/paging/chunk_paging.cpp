#include "planet/paging/chunk_paging.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <utility>

namespace planet {

namespace {

// Limits the yielding blocks per frame, because their ground becomes coarser at once.
constexpr std::size_t yieldsPerFrame = 8;

constexpr std::uint64_t noFrame = std::numeric_limits<std::uint64_t>::max();  // later than any frame

}  // namespace

Error namingFile(const ChunkFile* file, Error error) {
    if (file) error.message = fmt::format("{}: {}; bake it again", file->name(), error.message);
    return error;
}

Result<std::uint32_t> chunkSlotsFor(const PlanetShape& shape, std::uint64_t allChunks,
                                    std::size_t budgetBytes) {
    const std::size_t bytes = chunkBytesCpu(shape) + chunkBytesGpu(shape);
    const std::size_t wanted =
        faceCount + 4 * quadrantCount * static_cast<std::size_t>(deepestLevelOf(shape));
    const std::size_t least = std::min<std::uint64_t>(wanted, chunkCountOf(shape));
    if (budgetBytes < least * bytes) {
        return badInput(fmt::format("budget too small for this planet: {} bytes; expected at least {}",
                                    budgetBytes, least * bytes));
    }
    constexpr std::uint64_t most = std::uint64_t{1} << 31;
    // A damaged header may count too few chunks.
    const std::uint64_t useful = std::max<std::uint64_t>(allChunks, least);
    const std::uint64_t slots = std::min({std::uint64_t{budgetBytes / bytes}, useful, most});
    return static_cast<std::uint32_t>(slots - (slots - faceCount) % quadrantCount);
}

ChunkPaging::ChunkPaging(ChunkTree&& chunks, std::uint32_t capacity, std::shared_ptr<const ChunkFile> file)
    : BlockPaging(BlockKind::Heights), tree(std::move(chunks)), file_(std::move(file)) {
    resetSlots(capacity, faceCount);
}

void ChunkPaging::describe(NodeIndex parent, PagingRequest& request) const {
    request.location = tree.nodes[parent].children;
    request.parentHeights = tree.nodes[parent].heights;
}

Result<void> ChunkPaging::check(NodeIndex parent, const LoadedBlock& block) const {
    return checkChildren(tree, parent, std::get<SiblingBlock>(block)).map_error([&](Error error) {
        return namingFile(file_.get(), std::move(error));
    });
}

void ChunkPaging::addResident(NodeIndex parent, LoadedBlock&& block, std::uint64_t lastUsedFrame,
                              PagingRun& run, const UploadChunk& upload) {
    SiblingBlock& children = std::get<SiblingBlock>(block);
    std::array<std::uint32_t, quadrantCount> slots{};
    for (std::uint32_t slot = takeSlots(); std::uint32_t & of : slots) of = slot++;
    for (std::size_t q = 0; q < quadrantCount; ++q) upload(slots[q], children[q].heights);
    const NodeIndex first = addChildren(tree, parent, std::move(children), slots);
    ++blocksLoaded_;
    for (NodeIndex child = first; child < first + quadrantCount; ++child) {
        ChunkNode& node = tree.nodes[child];
        node.lastUsedFrame = lastUsedFrame;
        node.loadedAtS = run.nowS;
        node.loadOrder = blocksLoaded_;
        recallFailure(node.id, node.childrenState, run.sinceResetS);
    }
    watched_.push_back(first);
}

void ChunkPaging::use(PagingQueue& queue, NodeIndex index, PagingRun& run) {
    ChunkNode& node = tree.nodes[index];
    if (node.lastUsedFrame == run.frame) return;  // another view has used it already
    ++usedChunks_;
    const bool wasOutOfUse = std::exchange(node.lastUsedFrame, run.frame) + 1 < run.frame;
    if (node.parent == noNode || quadrantOf(node.id) != 0) return;
    watched_.push_back(index);
    noteUse(parentOf(node.id));
    if (!wasOutOfUse) return;
    // The page-in and the pending page-out cancel each other.
    const ChunkId parentId = parentOf(node.id);
    if (const PagingRequest* pageOut = queue.find(parentId)) {
        run.log.ended(*pageOut, PagingOutcome::Cancelled, run.nowS);
        queue.submit({.parent = parentId, .type = PagingType::PageIn, .renewedFrame = run.frame});
    }
}

void ChunkPaging::markUsed(PagingQueue& queue, std::span<const Selection* const> views, PagingRun& run) {
    const std::vector<NodeIndex> before = std::exchange(watched_, {});
    usedChunks_ = 0;
    for (const Selection* view : views) {
        for (const VisitedNode& visited : view->touched) use(queue, visited.node, run);
        // Children that wait for a fade are in use too.
        for (const DrawItem& item : view->draw) {
            for (NodeIndex q = 0; item.splitWaits && q < quadrantCount; ++q)
                use(queue, tree.nodes[item.node].firstChild + q, run);
        }
    }
    for (const NodeIndex index : before) {
        const ChunkNode& node = tree.nodes[index];
        if (node.lastUsedFrame != run.frame) queuePageOut(queue, node, run);
    }
}

// first: the first node of the block.
void ChunkPaging::queuePageOut(PagingQueue& queue, const ChunkNode& first, const PagingRun& run) const {
    queue.submit({.parent = parentOf(first.id),
                  .type = PagingType::PageOut,
                  .priority = first.id.level / 32.0 - static_cast<double>(first.lastUsedFrame),
                  .renewedFrame = run.frame,
                  .askedAtS = run.nowS});
}

void ChunkPaging::markPredicted(PagingQueue& queue, std::span<const NodeIndex> predicted,
                                const PagingRun& run) {
    for (const NodeIndex index : predicted) {
        ChunkNode& node = tree.nodes[index];
        if (node.lastUsedFrame >= oldestPredictedUse(run)) continue;
        node.lastUsedFrame = predictedUse(run);
        if (node.parent == noNode || quadrantOf(node.id) != 0) continue;
        // A block that has just arrived is watched and has no page-out yet.
        if (queue.find(parentOf(node.id))) queuePageOut(queue, node, run);
    }
}

bool ChunkPaging::makeRoom(PagingQueue& queue, const MergedRequest&, const std::vector<MergedRequest>&,
                           PagingRun& run) {
    return run.frame > framesKept && evictUsedBefore(queue, run.frame - framesKept, run);
}

bool ChunkPaging::makeRoomForPrefetch(PagingQueue& queue, PagingRun& run) {
    return evictUsedBefore(queue, oldestPredictedUse(run), run);
}

// Evicts the least recently used block if its last use was before a frame. Page-outs of blocks that are needed by
// their children are put off.
bool ChunkPaging::evictUsedBefore(PagingQueue& queue, std::uint64_t frame, PagingRun& run) {
    while (const PagingRequest* oldest = queue.best(PagingType::PageOut)) {
        const NodeIndex parent = findNode(tree, oldest->parent);
        const NodeIndex first = tree.nodes[parent].firstChild;
        if (tree.nodes[first].lastUsedFrame >= frame) return false;
        if (isBottom(tree, first)) {
            evict(queue, parent, run);
            return true;
        }
        queue.popBest(PagingType::PageOut);
        watched_.push_back(first);
    }
    return false;
}

// Evicts a block and ends its page-out, if one is pending. Does not change watched_.
void ChunkPaging::evict(PagingQueue& queue, NodeIndex parent, PagingRun& run) {
    PagingRequest request{.parent = tree.nodes[parent].id, .type = PagingType::PageOut, .askedAtS = run.nowS};
    if (auto pending = queue.pop(request.parent)) request = std::move(*pending);
    assert(request.type == PagingType::PageOut);
    freeSlots(tree.nodes[tree.nodes[parent].firstChild].slot);
    removeChildren(tree, parent);
    noteEviction(request, true, run);
}

// Merged requests have the highest priority of the views that split the block.
void ChunkPaging::chooseYielding(const MergedRequests& requests) {
    std::vector<MergedRequest> least = requests.splits;
    std::erase_if(least, [&](const MergedRequest& split) {
        return !isBottom(tree, tree.nodes[split.parent].firstChild);
    });
    std::sort(least.begin(), least.end(), [](const MergedRequest& a, const MergedRequest& b) {
        return a.priority != b.priority ? a.priority < b.priority : a.parentId < b.parentId;
    });
    for (const MergedRequest& one : requests.wanted) {
        if (tree.nodes[one.parent].childrenState != ChildrenState::Absent) continue;
        const std::size_t next = yielding_.size();
        if (next == std::min(least.size(), yieldsPerFrame)) return;
        if (one.priority <= yieldFactor * least[next].priority) return;
        yielding_.push_back(least[next].parentId);
    }
}

void ChunkPaging::dropYielding(PagingQueue& queue, PagingRun& run) {
    for (const ChunkId& parentId : yielding_) evict(queue, findNode(tree, parentId), run);
    cancelYielding();
}

void ChunkPaging::cancelYielding() {
    yielding_.clear();
    forgetGone();
}

bool ChunkPaging::roomIsComing() const {
    return counters().budgetWaits > 0 && (tree.residentChunks > usedChunks_ || isYielding());
}

// Removes freed nodes from watched_: they have no parent. The roots have none either, but are never watched.
void ChunkPaging::forgetGone() {
    std::erase_if(watched_, [&](NodeIndex index) { return tree.nodes[index].parent == noNode; });
}

bool ChunkPaging::isOver(std::size_t blocks) const {
    return (tree.residentChunks - faceCount) / quadrantCount + reserved() > blocks;
}

// Drops blocks last used before a frame, until few enough are left or no such block remains: least recently
// used first, then deepest first. Works in rounds, because dropping a block can free its parent's block.
void ChunkPaging::evictLeastUsed(PagingQueue& queue, std::size_t blocks, std::uint64_t usedBefore,
                                 PagingRun& run) {
    if (!isOver(blocks)) return;
    struct Candidate {
        NodeIndex parent;
        std::uint64_t lastUsedFrame;
        std::uint8_t level;
    };
    std::vector<Candidate> candidates;
    forEachNode(tree, [&](NodeIndex index, const ChunkNode& node) {
        if (node.childrenState != ChildrenState::Resident) return;
        const std::uint64_t lastUsedFrame = tree.nodes[node.firstChild].lastUsedFrame;
        if (lastUsedFrame < usedBefore) candidates.push_back({index, lastUsedFrame, node.id.level});
    });
    std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.lastUsedFrame != b.lastUsedFrame ? a.lastUsedFrame < b.lastUsedFrame : a.level > b.level;
    });
    bool dropped = true;
    while (dropped) {
        dropped = false;
        for (const Candidate& candidate : candidates) {
            if (!isOver(blocks)) return;
            const ChunkNode& node = tree.nodes[candidate.parent];
            if (node.childrenState != ChildrenState::Resident || !isBottom(tree, node.firstChild)) continue;
            evict(queue, candidate.parent, run);
            dropped = true;
        }
    }
}

// Evicts the blocks that no view uses, then cancels the requests with the lowest priority, then evicts the
// least recently used blocks. Discards reads that would keep even those blocks resident.
void ChunkPaging::resize(PagingQueue& queue, std::uint32_t capacity, PagingRun& run) {
    const std::size_t blocks = (capacity - faceCount) / quadrantCount;
    evictLeastUsed(queue, blocks, run.frame, run);
    while (isOver(blocks)) {
        const PagingRequest* least = queue.worst(PagingType::PageIn, BlockKind::Heights);
        if (!least) break;
        withdraw(*queue.cancel(least->block()), run);
    }
    evictLeastUsed(queue, blocks, noFrame, run);
    if (isOver(blocks)) {
        discardReads(run);
        evictLeastUsed(queue, blocks, noFrame, run);
        assert(!isOver(blocks));
    }
    renumber(capacity);
}

// Gives resident chunks the lowest slots, in the order of the tree.
void ChunkPaging::renumber(std::uint32_t capacity) {
    std::uint32_t next = faceCount;
    forEachNode(tree, [&](NodeIndex, const ChunkNode& node) {
        if (node.childrenState != ChildrenState::Resident) return;
        for (NodeIndex q = 0; q < quadrantCount; ++q) tree.nodes[node.firstChild + q].slot = next++;
    });
    resetSlots(capacity, next);
}

void ChunkPaging::dropAll(PagingQueue& queue, PagingRun& run) {
    discardReads(run);
    evictLeastUsed(queue, 0, noFrame, run);
}

void ChunkPaging::resetBlocks(PagingRun&) {
    counters().evicted += (tree.residentChunks - faceCount) / quadrantCount;
    tree.nodes.resize(faceCount);
    tree.freeGroups.clear();
    tree.residentChunks = faceCount;
    for (ChunkNode& root : tree.nodes) {
        if (root.childrenState != ChildrenState::None && root.childrenState != ChildrenState::Absent)
            changeState(root.childrenState, ChildrenState::Absent);
        root.firstChild = noNode;
        root.lastUsedFrame = 0;
    }
    resetSlots(capacity(), faceCount);
    watched_.clear();
    yielding_.clear();
    usedChunks_ = 0;
}

}  // namespace planet
