#include "planet/measure/atlas_tree.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/base/parallel.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_types.h"
#include "planet/measure/atlas.h"
#include "planet/paging/pager.h"
#include "planet/planet_types.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

namespace {

std::uint64_t digestOf(const ChunkData& chunk) {
    std::vector<std::byte> bytes;
    ByteWriter out(bytes);
    out.put(chunk.deltaCM);
    out.put(chunk.deltaTightM);
    out.put(chunk.minStep);
    out.put(chunk.maxStep);
    for (std::size_t i = 0; i < chunk.heights.size(); ++i) out.put(std::int32_t{chunk.heights[i]});
    return XXH3_64bits(bytes.data(), bytes.size());
}

// Walks the chunks of a planet.
class TreeReader {
public:
    TreeReader(const LoadChildren& load, const std::function<bool()>& goOn) : load_(load), goOn_(goOn) {}

    // Appends a chunk and what is listed below it.
    Result<void> list(const ChunkData& chunk, std::vector<AtlasChunk>& out) const {
        const std::size_t at = out.size();
        out.push_back({.deltaCM = chunk.deltaCM});
        std::uint64_t digest = digestOf(chunk);
        if (chunk.children.exists()) {
            TRY_ASSIGN(const SiblingBlock children, childrenOf(chunk));
            if (chunk.id.level < deepestAtlasTreeLevel) {
                out[at].hasChildren = true;
                for (const ChunkData& child : children) TRY(list(child, out));
            } else {
                out[at].isSummary = true;
                TRY(addBelow(children, digest));
            }
        }
        out[at].digest = static_cast<std::uint32_t>(digest);
        return {};
    }

    Result<SiblingBlock> childrenOf(const ChunkData& chunk) const {
        if (!goOn_()) return cancelled();
        return load_(chunk.id, chunk.children, chunk.heights);
    }

private:
    Result<void> addBelow(const SiblingBlock& block, std::uint64_t& digest) const {
        for (const ChunkData& chunk : block) {
            const std::array<std::uint64_t, 3> both{digest, digestOf(chunk),
                                                    chunk.children.exists() ? 1u : 0u};
            digest = XXH3_64bits(both.data(), sizeof both);
            if (!chunk.children.exists()) continue;
            TRY_ASSIGN(const SiblingBlock children, childrenOf(chunk));
            TRY(addBelow(children, digest));
        }
        return {};
    }

    const LoadChildren& load_;
    const std::function<bool()>& goOn_;
};

// A chunk near the top, whose subtree is read by one thread.
struct ReadSubtree {
    ChunkData chunk;
    std::vector<AtlasChunk> chunks;
    std::optional<Error> problem;
};

// Splits the subtrees at the front into those of their children, so that there is work for all cores. Lists what is
// above, as the chunks of the first subtree below it.
Result<std::vector<ReadSubtree>> subtreesOf(const PlanetSource& source, const TreeReader& reader) {
    constexpr int subtreeLevel = 2;
    std::vector<ReadSubtree> open;
    for (const ChunkData& root : source.roots) open.push_back({root, {}, {}});
    for (int level = 0; level < subtreeLevel; ++level) {
        std::vector<ReadSubtree> next;
        for (ReadSubtree& subtree : open) {
            if (!subtree.chunk.children.exists() || subtree.chunk.id.level < level) {
                next.push_back(std::move(subtree));
                continue;
            }
            TRY_ASSIGN(SiblingBlock children, reader.childrenOf(subtree.chunk));
            std::vector<AtlasChunk> above = std::move(subtree.chunks);
            above.push_back(
                {subtree.chunk.deltaCM, static_cast<std::uint32_t>(digestOf(subtree.chunk)), true, false});
            for (ChunkData& child : children)
                next.push_back({std::move(child), std::exchange(above, {}), {}});
        }
        open = std::move(next);
    }
    return open;
}

struct ListedChunk {
    const AtlasChunk* chunk = nullptr;
    ChunkId id;
};
std::vector<ListedChunk> listedChunks(const AtlasTree& tree) {
    std::vector<ListedChunk> all;
    forEachChunk(tree, [&](const ChunkId& id, const AtlasChunk& chunk) { all.push_back({&chunk, id}); });
    return all;
}

// Returns the chunks above a level that have changed chunks below them.
std::unordered_set<ChunkId> chunksAbove(const std::vector<AtlasChunkChange>& changes, int level) {
    std::unordered_set<ChunkId> above;
    for (const AtlasChunkChange& one : changes) {
        for (int up = std::min(int{one.chunk.level}, level); up-- > 0;) {
            if (!above.insert(ancestorOf(one.chunk, up)).second) break;
        }
    }
    return above;
}

std::optional<AtlasChange> changeOf(const AtlasChunk& old, const AtlasChunk& now) {
    if (old.deltaCM != now.deltaCM) return AtlasChange::Error;
    if (old.digest == now.digest && old.isSummary == now.isSummary) return std::nullopt;
    return old.isSummary || now.isSummary ? AtlasChange::Below : AtlasChange::Heights;
}

}  // namespace

Result<AtlasTree> atlasTreeOf(const PlanetSource& source, const std::function<bool()>& goOn) {
    const TreeReader reader(source.loadChildren, goOn);
    TRY_ASSIGN(std::vector<ReadSubtree> subtrees, subtreesOf(source, reader));
    parallelFor(subtrees.size(), [&](std::size_t i) {
        if (Result<void> listed = reader.list(subtrees[i].chunk, subtrees[i].chunks); !listed)
            subtrees[i].problem = std::move(listed).error();
    });
    AtlasTree tree;
    for (ReadSubtree& subtree : subtrees) {
        if (subtree.problem) return tl::unexpected(*std::move(subtree.problem));
        tree.chunks.insert(tree.chunks.end(), subtree.chunks.begin(), subtree.chunks.end());
    }
    return tree;
}

bool forEachChunk(const AtlasTree& tree,
                  const std::function<void(const ChunkId& id, const AtlasChunk& chunk)>& visit) {
    std::vector<ChunkId> next;
    for (std::size_t face = faceCount; face-- > 0;) next.push_back({allFaces[face], 0, 0, 0});
    if (tree.chunks.empty()) return true;
    for (const AtlasChunk& chunk : tree.chunks) {
        if (next.empty()) return false;
        const ChunkId id = next.back();
        next.pop_back();
        if (chunk.hasChildren && id.level >= deepestAtlasTreeLevel) return false;
        visit(id, chunk);
        if (!chunk.hasChildren) continue;
        for (int quadrant = quadrantCount; quadrant-- > 0;) next.push_back(childOf(id, quadrant));
    }
    return next.empty();
}

std::vector<AtlasChunkChange> changesBetween(const AtlasTree& old, const AtlasTree& now) {
    const std::vector<ListedChunk> before = listedChunks(old);
    std::unordered_map<ChunkId, const AtlasChunk*> left;
    for (const ListedChunk& one : before) left.emplace(one.id, one.chunk);
    std::vector<AtlasChunkChange> changes;
    for (const ListedChunk& one : listedChunks(now)) {
        const auto found = left.find(one.id);
        if (found == left.end()) {
            changes.push_back({one.id, AtlasChange::Added, 0, one.chunk->deltaCM});
            continue;
        }
        if (const auto change = changeOf(*found->second, *one.chunk))
            changes.push_back({one.id, *change, found->second->deltaCM, one.chunk->deltaCM});
        left.erase(found);
    }
    for (const ListedChunk& one : before) {
        if (left.contains(one.id)) changes.push_back({one.id, AtlasChange::Removed, one.chunk->deltaCM, 0});
    }
    return changes;
}

std::uint64_t AtlasChangedArea::sum() const {
    return std::accumulate(chunks.begin(), chunks.end(), std::uint64_t{0});
}

std::vector<AtlasChangedArea> changedAreas(const std::vector<AtlasChunkChange>& changes, int level) {
    const std::unordered_set<ChunkId> above = chunksAbove(changes, level);
    std::map<ChunkId, AtlasChangedArea> byCell;
    for (const AtlasChunkChange& one : changes) {
        // Almost any change of a bake changes the chunks above it too, which say nothing about the place.
        const bool isOnePlace = one.change == AtlasChange::Added || one.change == AtlasChange::Removed;
        if (!isOnePlace && above.contains(one.chunk)) continue;
        const ChunkId cell = ancestorOf(one.chunk, level);
        AtlasChangedArea& area = byCell[cell];
        area.cell = cell;
        ++area.chunks[static_cast<std::size_t>(one.change)];
        if (one.change != AtlasChange::Error || !(one.oldDeltaCM > 0)) continue;
        const double ratio = static_cast<double>(one.newDeltaCM) / static_cast<double>(one.oldDeltaCM);
        area.leastRatio = std::min(area.leastRatio, ratio);
        area.mostRatio = std::max(area.mostRatio, ratio);
    }
    std::vector<AtlasChangedArea> areas;
    for (auto& [cell, area] : byCell) areas.push_back(area);
    std::stable_sort(areas.begin(), areas.end(),
                     [](const AtlasChangedArea& a, const AtlasChangedArea& b) { return a.sum() > b.sum(); });
    return areas;
}

}  // namespace planet
