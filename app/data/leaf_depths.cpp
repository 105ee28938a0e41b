#include "app/data/leaf_depths.h"

#include <algorithm>

namespace worldy {

namespace {

using planet::ChunkId;
using planet::Result;

struct IndexWalk {
    const planet::ChunkFile& file;
    const std::function<bool()>& goOn;
    std::size_t mostChunks;
    std::uint64_t bytesLeft;
    LeafDepths depths{};

    // Returns the level of the deepest leaf under a chunk.
    Result<int> deepestUnder(const ChunkId& chunk, planet::BlockLocation children) {
        if (!children.exists()) return chunk.level;
        if (goOn && !goOn()) return planet::cancelled();
        if (Result<void> spent = planet::spendOn(file, children, bytesLeft); !spent)
            return tl::unexpected(std::move(spent).error());
        const auto entries = file.readEntries(chunk, children);
        if (!entries) return tl::unexpected(entries.error());
        int deepest = chunk.level;
        for (int quadrant = 0; quadrant < planet::quadrantCount; ++quadrant) {
            const Result<int> under = deepestUnder(planet::childOf(chunk, quadrant),
                                                   (*entries)[static_cast<std::size_t>(quadrant)].children);
            if (!under) return under;
            deepest = std::max(deepest, *under);
        }
        if (deepest > chunk.level + 1 && depths.below.size() < mostChunks)
            depths.below.emplace(chunk, static_cast<std::uint8_t>(deepest));
        return deepest;
    }
};

}  // namespace

Result<LeafDepths> leafDepthsOf(const planet::ChunkFile& file, const std::function<bool()>& goOn,
                                std::size_t mostChunks) {
    if (planet::isDense(file.info())) return LeafDepths{planet::deepestLevelOf(file.info().shape)};
    IndexWalk walk{file, goOn, mostChunks, file.sizeBytes()};
    for (const planet::Face face : planet::allFaces) {
        const Result<planet::ChunkData> root = file.readRoot(face);
        if (!root) return tl::unexpected(root.error());
        if (const Result<int> deepest = walk.deepestUnder(root->id, root->children); !deepest)
            return tl::unexpected(deepest.error());
    }
    return std::move(walk.depths);
}

int deepestLeaf(const LeafDepths& depths, const ChunkId& chunk, bool isLeaf) {
    if (isLeaf) return chunk.level;
    if (depths.everywhere >= 0) return depths.everywhere;
    const auto found = depths.below.find(chunk);
    return found == depths.below.end() ? chunk.level + 1 : found->second;
}

}  // namespace worldy
