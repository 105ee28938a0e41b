// Spreads places evenly over the sphere, for estimates from samples. Internal to the library.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "planet/source/gradient_noise.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

// Returns squares of a level, one in each of equally long stretches of the quadtree order. Neighbours in that
// order are neighbours on the sphere, so the places are spread evenly. Returns all squares if the level has
// no more than are wanted.
inline std::vector<ChunkId> spreadPlaces(int level, std::uint64_t wanted) {
    const std::uint64_t total = std::uint64_t{faceCount} << (2 * level);
    const std::uint64_t count = std::min(wanted, total);
    std::vector<ChunkId> chosen;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t first = i * total / count;
        const std::uint64_t end = (i + 1) * total / count;
        chosen.push_back(chunkInQuadtreeOrder(first + scrambled64(i) % (end - first), level));
    }
    return chosen;
}

}  // namespace planet
