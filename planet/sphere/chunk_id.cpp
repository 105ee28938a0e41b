#include "planet/sphere/chunk_id.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace planet {

ChunkId neighbourOf(const ChunkId& id, Edge edge) {
    const std::uint32_t last = (1u << id.level) - 1;
    if (edge == Edge::West && id.x > 0) return {id.face, id.level, id.x - 1, id.y};
    if (edge == Edge::East && id.x < last) return {id.face, id.level, id.x + 1, id.y};
    if (edge == Edge::South && id.y > 0) return {id.face, id.level, id.x, id.y - 1};
    if (edge == Edge::North && id.y < last) return {id.face, id.level, id.x, id.y + 1};
    // The neighbour lies on the next face. The point is half a chunk's side below the middle of the edge,
    // along this face's normal.
    const FaceSquare square = faceSquareOf(id);
    const double half = square.side / 2;
    const bool across = edge == Edge::West || edge == Edge::East;
    const double end = edge == Edge::West || edge == Edge::South ? -1 : 1;
    const double u = across ? end : square.u + half;
    const double v = across ? square.v + half : end;
    const glm::dvec3 onEdge = cubePoint(id.face, u, v);
    return chunkAt(facePointFromCube(onEdge - half * faceAxes(id.face).normal), id.level);
}

std::optional<Edge> edgeTowards(const ChunkId& id, const ChunkId& other) {
    for (const Edge edge : allEdges) {
        if (neighbourOf(id, edge) == other) return edge;
    }
    return std::nullopt;
}

FaceSquare faceSquareOf(const ChunkId& id) {
    const double side = std::ldexp(2.0, -id.level);
    return {-1 + side * id.x, -1 + side * id.y, side};
}

ChunkId chunkAt(const FacePoint& point, int level) {
    const double count = std::ldexp(1.0, level);
    const auto cell = [&](double t) {
        return static_cast<std::uint32_t>(std::clamp(std::floor((t + 1) / 2 * count), 0.0, count - 1));
    };
    return {point.face, static_cast<std::uint8_t>(level), cell(point.u), cell(point.v)};
}

ChunkId chunkInQuadtreeOrder(std::uint64_t index, int level) {
    const std::uint64_t chunksPerFace = std::uint64_t{1} << (2 * level);
    ChunkId id{static_cast<Face>(index / chunksPerFace), 0, 0, 0};
    for (int below = level - 1; below >= 0; --below) {
        id = childOf(id, static_cast<int>((index >> (2 * below)) & 3));
    }
    return id;
}

std::uint64_t indexInQuadtreeOrder(const ChunkId& id) {
    auto index = static_cast<std::uint64_t>(id.face);
    for (int below = id.level - 1; below >= 0; --below) {
        index = 4 * index + ((id.x >> below) & 1) + 2 * ((id.y >> below) & 1);
    }
    return index;
}

std::string toString(const ChunkId& id) {
    return fmt::format("{}/{}/{}/{}", faceName(id.face), id.level, id.x, id.y);
}

std::optional<ChunkId> chunkIdFromString(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const std::optional<Face> face = faceFromName(text.substr(0, slash));
    if (!face) return std::nullopt;
    std::array<std::uint32_t, 3> numbers{};
    const char* at = text.data() + slash;
    const char* const end = text.data() + text.size();
    for (std::uint32_t& number : numbers) {
        if (at == end || *at != '/') return std::nullopt;
        const auto [after, problem] = std::from_chars(at + 1, end, number);
        if (problem != std::errc{}) return std::nullopt;
        at = after;
    }
    const auto [level, x, y] = numbers;
    if (at != end || level > maxLevel || (x >> level) != 0 || (y >> level) != 0) return std::nullopt;
    return ChunkId{*face, static_cast<std::uint8_t>(level), x, y};
}

}  // namespace planet
