// Spreads places evenly over the sphere, for estimates from samples. Internal to the library.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "planet/source/gradient_noise.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

// Returns indices below a total, one in each of equally long stretches; all of them if no more are wanted.
inline std::vector<std::uint64_t> spreadIndices(std::uint64_t total, std::uint64_t wanted) {
    const std::uint64_t count = std::min(wanted, total);
    std::vector<std::uint64_t> chosen;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t first = i * total / count;
        const std::uint64_t end = (i + 1) * total / count;
        chosen.push_back(first + scrambled64(i) % (end - first));
    }
    return chosen;
}

// Returns squares of a level. Neighbours in the quadtree order are neighbours on the sphere, so the places are spread
// evenly.
inline std::vector<ChunkId> spreadPlaces(int level, std::uint64_t wanted) {
    std::vector<ChunkId> chosen;
    for (const std::uint64_t i : spreadIndices(std::uint64_t{faceCount} << (2 * level), wanted))
        chosen.push_back(chunkInQuadtreeOrder(i, level));
    return chosen;
}

}  // namespace planet
