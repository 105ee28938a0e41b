#include "planet/trace/trace_quadtree.h"

namespace planet {

TraceQuadtreePlace traceQuadtreePlace(std::uint64_t id) {
    constexpr std::uint64_t coordinate = (std::uint64_t{1} << 28) - 1;
    return {static_cast<std::uint32_t>(id >> 61), static_cast<std::uint32_t>(id >> 56 & 31),
            static_cast<std::uint32_t>(id & coordinate), static_cast<std::uint32_t>(id >> 28 & coordinate)};
}

std::uint64_t traceQuadtreeId(const TraceQuadtreePlace& place) {
    return std::uint64_t{place.face} << 61 | std::uint64_t{place.level} << 56 | std::uint64_t{place.y} << 28 |
           place.x;
}

std::optional<TraceQuadtreePlace> tracePlaceBeyond(const TraceQuadtreePlace& place, Edge edge, bool isCube) {
    constexpr std::uint32_t mostLevels = 28;
    if (place.level > mostLevels) return std::nullopt;
    const std::uint32_t last = (std::uint32_t{1} << place.level) - 1;
    if (place.x > last || place.y > last) return std::nullopt;
    const bool leaves = (edge == Edge::West && place.x == 0) || (edge == Edge::East && place.x == last) ||
                        (edge == Edge::South && place.y == 0) || (edge == Edge::North && place.y == last);
    if (leaves && (!isCube || place.face >= faceCount)) return std::nullopt;
    const ChunkId beyond = neighbourOf(
        {static_cast<Face>(place.face), static_cast<std::uint8_t>(place.level), place.x, place.y}, edge);
    return TraceQuadtreePlace{static_cast<std::uint32_t>(beyond.face), place.level, beyond.x, beyond.y};
}

}  // namespace planet
