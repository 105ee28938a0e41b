// Places spread evenly over the sphere: for estimates from a few of many. Inside the library only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "planet/sphere/chunk_id.h"

namespace planet {

// Scrambles a number: the finalizer of splitmix64.
inline std::uint64_t scrambled(std::uint64_t value) {
    value += 0x9E3779B97F4A7C15u;
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
    return value ^ (value >> 31);
}

// Squares of a level, one in each of equally long stretches of the quadtree order: neighbours in that order
// are neighbours on the sphere, so the places are spread evenly. All of them where no more are there.
inline std::vector<ChunkId> spreadPlaces(int level, std::uint64_t wanted) {
    const std::uint64_t total = std::uint64_t{faceCount} << (2 * level);
    const std::uint64_t count = std::min(wanted, total);
    std::vector<ChunkId> chosen;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t first = i * total / count;
        const std::uint64_t end = (i + 1) * total / count;
        chosen.push_back(chunkInQuadtreeOrder(first + scrambled(i) % (end - first), level));
    }
    return chosen;
}

}  // namespace planet
