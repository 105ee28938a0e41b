#include "planet/paging/finest_heights.h"
#include "planet/base/try.h"

#include <cassert>
#include <utility>

namespace planet {

namespace {

std::size_t bytesOf(const HeldBlock& block) {
    std::size_t bytes = sizeof(HeldBlock);
    for (const HeldChunk& chunk : block) bytes += chunk.heights->bytes();
    return bytes;
}

std::shared_ptr<const HeldBlock> heldBlock(SiblingBlock&& children) {
    auto block = std::make_shared<HeldBlock>();
    for (std::size_t q = 0; q < block->size(); ++q) {
        ChunkData& child = children[q];
        (*block)[q] = {child.id, std::make_shared<const Steps>(std::move(child.heights)), child.children};
    }
    return block;
}

int quadrantTowards(const ChunkId& top, const ChunkId& id) {
    const int shift = id.level - top.level - 1;
    return static_cast<int>((id.x >> shift) & 1u) + 2 * static_cast<int>((id.y >> shift) & 1u);
}

}  // namespace

void addResidentBlocks(const ChunkTree& tree, NodeIndex node, ResidentBlocks& blocks) {
    const ChunkNode& parent = tree.nodes[node];
    if (parent.childrenState != ChildrenState::Resident) return;
    auto block = std::make_shared<HeldBlock>();
    for (std::size_t q = 0; q < block->size(); ++q) {
        const NodeIndex index = parent.firstChild + static_cast<NodeIndex>(q);
        const ChunkNode& child = tree.nodes[index];
        (*block)[q] = {child.id, child.heights, child.children};
        addResidentBlocks(tree, index, blocks);
    }
    blocks.emplace(keyOf(parent.id), std::move(block));
}

FinestHeights::FinestHeights(LoadChildren load, std::size_t cacheBytes)
    : load_(std::move(load)), cacheBytes_(cacheBytes) {}

FinestHeights::FinestHeights(std::shared_ptr<const ChunkFile> file, std::size_t cacheBytes)
    : FinestHeights(
          [file = std::move(file)](const ChunkId& parent, BlockLocation location, StepsView parentHeights) {
              return file->readChildren(parent, location, parentHeights);
          },
          cacheBytes) {}

std::shared_ptr<const HeldBlock> FinestHeights::find(std::uint64_t key) {
    const std::lock_guard lock(mutex_);
    const auto found = byKey_.find(key);
    if (found == byKey_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found->second);
    return found->second->block;
}

void FinestHeights::keep(std::uint64_t key, std::shared_ptr<const HeldBlock> block) {
    const std::size_t bytes = bytesOf(*block);
    const std::lock_guard lock(mutex_);
    ++blocksRead_;
    if (byKey_.contains(key)) return;
    kept_.push_front({key, std::move(block), bytes});
    byKey_[key] = kept_.begin();
    bytes_ += bytes;
    dropSurplus();
}

void FinestHeights::setCacheBytes(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    cacheBytes_ = bytes;
    dropSurplus();
}

// Drops the least recently used blocks. Call it with the mutex locked.
void FinestHeights::dropSurplus() {
    while (bytes_ > cacheBytes_) {
        bytes_ -= kept_.back().bytes;
        byKey_.erase(kept_.back().key);
        kept_.pop_back();
    }
}

Result<std::shared_ptr<const HeldBlock>> FinestHeights::childrenOf(const HeldChunk& chunk,
                                                                   const ResidentBlocks& resident) {
    const std::uint64_t key = keyOf(chunk.id);
    if (const auto found = resident.find(key); found != resident.end()) return found->second;
    if (std::shared_ptr<const HeldBlock> kept = find(key)) return kept;
    TRY_ASSIGN(auto children, load_(chunk.id, chunk.children, *chunk.heights));
    const std::shared_ptr<const HeldBlock> block = heldBlock(std::move(children));
    keep(key, block);
    return block;
}

Result<HeldChunk> FinestHeights::chunkUnder(const HeldChunk& top, const ChunkId& id,
                                            const ResidentBlocks& resident) {
    assert(id.level >= top.id.level);
    HeldChunk at = top;
    while (at.id.level < id.level && at.children.exists()) {
        TRY_ASSIGN(const auto block, childrenOf(at, resident));
        at = (*block)[static_cast<std::size_t>(quadrantTowards(at.id, id))];
    }
    return at;
}

Result<bool> FinestHeights::visitLeaves(const HeldChunk& top, const ResidentBlocks& resident,
                                        const std::function<bool(const HeldChunk& leaf)>& visit) {
    if (!top.children.exists()) return visit(top);
    TRY_ASSIGN(const auto block, childrenOf(top, resident));
    for (const HeldChunk& child : *block) {
        const Result<bool> goOn = visitLeaves(child, resident, visit);
        if (!goOn || !*goOn) return goOn;
    }
    return true;
}

Result<void> FinestHeights::forEachLeaf(const HeldChunk& top, const ResidentBlocks& resident,
                                        const std::function<bool(const HeldChunk& leaf)>& visit) {
    TRY(visitLeaves(top, resident, visit));
    return {};
}

std::uint64_t FinestHeights::blocksRead() const {
    const std::lock_guard lock(mutex_);
    return blocksRead_;
}

std::size_t FinestHeights::cachedBytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

}  // namespace planet
