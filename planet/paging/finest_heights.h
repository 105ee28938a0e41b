// Reads the finest data under any chunk. Decodes blocks from the chunk downwards and caches the most recently
// used ones.
//
// Meters of error take this data as the truth, so it does not depend on a δc, a bound or an extreme of the
// file, only on heights, which a checksum protects.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "planet/base/result.h"
#include "planet/paging/pager.h"
#include "planet/sphere/planet_shape.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// A chunk with its heights and the location of its children.
struct HeldChunk {
    ChunkId id;
    SharedHeights heights;   // never null
    BlockLocation children;  // none at a leaf
};

// The four children of a chunk, in quadrant order.
using HeldBlock = std::array<HeldChunk, quadrantCount>;

// The resident blocks of a tree, by keyOf(parent). They are used without reading the file.
using ResidentBlocks = std::unordered_map<std::uint64_t, std::shared_ptr<const HeldBlock>>;

// Adds the children of a resident node and of all its resident descendants.
void addResidentBlocks(const ChunkTree& tree, NodeIndex node, ResidentBlocks& blocks);

// Reads and caches decoded blocks. Thread-safe; a block that two threads request at once may be read twice.
class FinestHeights {
public:
    static constexpr std::size_t usualCacheBytes = std::size_t{256} << 20;

    // cacheBytes: the limit of cached heights, >= 0. Blocks beyond it are dropped and read again.
    explicit FinestHeights(LoadChildren load, std::size_t cacheBytes = usualCacheBytes);
    explicit FinestHeights(std::shared_ptr<const ChunkFile> file, std::size_t cacheBytes = usualCacheBytes);

    // Returns the children of a chunk, which must not be a leaf. The Error names the file and the chunk.
    Result<std::shared_ptr<const HeldBlock>> childrenOf(const HeldChunk& chunk,
                                                        const ResidentBlocks& resident);

    // Returns the chunk with an id at or under a held one, or the leaf that covers its place.
    Result<HeldChunk> chunkUnder(const HeldChunk& top, const ChunkId& id, const ResidentBlocks& resident);

    // Visits every leaf at or under a chunk, in quadrant order; visit returns false to stop.
    Result<void> forEachLeaf(const HeldChunk& top, const ResidentBlocks& resident,
                             const std::function<bool(const HeldChunk& leaf)>& visit);

    void setCacheBytes(std::size_t bytes);  // as above; drops the excess

    std::uint64_t blocksRead() const;
    std::size_t cachedBytes() const;

private:
    struct Kept {
        std::uint64_t key = 0;
        std::shared_ptr<const HeldBlock> block;
        std::size_t bytes = 0;
    };
    void dropSurplus();
    std::shared_ptr<const HeldBlock> find(std::uint64_t key);
    void keep(std::uint64_t key, std::shared_ptr<const HeldBlock> block);
    Result<bool> visitLeaves(const HeldChunk& top, const ResidentBlocks& resident,
                             const std::function<bool(const HeldChunk& leaf)>& visit);

    const LoadChildren load_;
    mutable std::mutex mutex_;  // guards the members below
    std::size_t cacheBytes_;
    std::list<Kept> kept_;  // most recently used first
    std::unordered_map<std::uint64_t, std::list<Kept>::iterator> byKey_;
    std::size_t bytes_ = 0;
    std::uint64_t blocksRead_ = 0;
};

}  // namespace planet
