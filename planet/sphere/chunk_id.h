// The id of a node of one of the six quadtrees, with its relatives and neighbours. Pure functions, any
// thread.
#pragma once

#include <array>
#include <cassert>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "planet/sphere/cube_sphere.h"

namespace planet {

inline constexpr int maxLevel = 24;  // on Earth, chunks of 17 vertices per side then have cells of 3.7 cm

struct ChunkId {
    Face face = Face::PosX;
    std::uint8_t level = 0;  // [0, maxLevel], 0 is the face's root
    std::uint32_t x = 0;     // [0, 2^level), along u
    std::uint32_t y = 0;     // [0, 2^level), along v

    auto operator<=>(const ChunkId&) const = default;
};

// Returns a key that is unique over all valid ids: 3 bits of face, 5 of level, 28 each of y and x.
inline std::uint64_t keyOf(const ChunkId& id) {
    return (static_cast<std::uint64_t>(id.face) << 61) | (static_cast<std::uint64_t>(id.level) << 56) |
           (static_cast<std::uint64_t>(id.y) << 28) | id.x;
}

// A quadrant is (x & 1) + 2 (y & 1).
inline constexpr int quadrantCount = 4;
inline ChunkId childOf(const ChunkId& parent, int quadrant) {
    assert(quadrant >= 0 && quadrant < quadrantCount && parent.level < maxLevel);
    const auto q = static_cast<std::uint32_t>(quadrant);
    return {parent.face, static_cast<std::uint8_t>(parent.level + 1), parent.x * 2 + (q & 1),
            parent.y * 2 + (q >> 1)};
}
inline ChunkId parentOf(const ChunkId& child) {
    assert(child.level > 0);
    return {child.face, static_cast<std::uint8_t>(child.level - 1), child.x / 2, child.y / 2};
}
inline int quadrantOf(const ChunkId& child) {
    return static_cast<int>((child.x & 1) + 2 * (child.y & 1));
}
// Returns the chunk of a level that contains this one; the chunk itself if it has that level or a coarser
// one.
inline ChunkId ancestorOf(const ChunkId& id, int level) {
    if (id.level <= level) return id;
    const int up = id.level - level;
    return {id.face, static_cast<std::uint8_t>(level), id.x >> up, id.y >> up};
}

enum class Edge : std::uint8_t { West, East, South, North };  // u = min, u = max, v = min, v = max
inline constexpr int edgeCount = 4;
inline constexpr std::array allEdges = {Edge::West, Edge::East, Edge::South, Edge::North};

// Returns the chunk of the same level beyond an edge; it is on the next face if the edge lies on an edge of
// the face.
ChunkId neighbourOf(const ChunkId& id, Edge edge);
// Returns the edge beyond which another chunk of the same level lies; nothing if the two are no neighbours.
std::optional<Edge> edgeTowards(const ChunkId& id, const ChunkId& other);

// The square of a chunk on its face.
struct FaceSquare {
    double u = -1;    // west edge, [-1, 1]
    double v = -1;    // south edge, [-1, 1]
    double side = 2;  // (0, 2]
};
FaceSquare faceSquareOf(const ChunkId& id);

// Returns the chunk of a level that contains a point of its face; the last row or column if u or v is 1.
ChunkId chunkAt(const FacePoint& point, int level);

// Quadtree order lists the chunks of a level face by face, each quarter completely before the next. The
// children of chunk i of a level are chunks 4 i to 4 i + 3 of the next level.
ChunkId chunkInQuadtreeOrder(std::uint64_t index, int level);
std::uint64_t indexInQuadtreeOrder(const ChunkId& id);

// Convert an id to and from text: "z_pos/3/5/2" is face, level, x, y.
std::string toString(const ChunkId& id);
std::optional<ChunkId> chunkIdFromString(std::string_view text);

}  // namespace planet

template <>
struct std::hash<planet::ChunkId> {
    std::size_t operator()(const planet::ChunkId& id) const noexcept {
        return std::hash<std::uint64_t>{}(planet::keyOf(id) * 0x9E3779B97F4A7C15u);
    }
};
