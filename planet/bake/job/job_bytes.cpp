#include "planet/bake/job/job_bytes.h"

#include <cmath>
#include <cstdint>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr std::size_t chunkHeadBytes = 10 + 28 + 4;

void putChunk(std::vector<std::byte>& out, const BakedChunk& chunk) {
    ByteWriter to(out);
    to.put(static_cast<std::uint8_t>(chunk.id.face));
    to.put(chunk.id.level);
    to.put(chunk.id.x);
    to.put(chunk.id.y);
    to.put(chunk.entry.deltaCM);
    to.put(chunk.entry.deltaTightM);
    to.put(chunk.entry.minStep);
    to.put(chunk.entry.maxStep);
    to.put(chunk.entry.children.offset);
    to.put(chunk.entry.children.size);
    to.put(static_cast<std::uint32_t>(chunk.heights.size()));
    for (const std::int32_t step : chunk.heights) to.put(step);
}

tl::unexpected<Error> damaged() {
    return badInput("the bytes of a baked chunk are not as they were written");
}

bool isValid(const ChunkId& id, const PlanetShape& shape) {
    return static_cast<int>(id.face) < faceCount && id.level <= deepestLevelOf(shape) &&
           (id.x >> id.level) == 0 && (id.y >> id.level) == 0;
}

bool isValid(const ChunkEntry& entry) {
    return std::isfinite(entry.deltaCM) && entry.deltaCM >= 0 && entry.deltaTightM >= 0 &&
           entry.deltaTightM <= entry.deltaCM && entry.minStep <= entry.maxStep;
}

// Takes a chunk, with its heights unless it has none.
Result<BakedChunk> takeChunk(std::span<const std::byte>& bytes, const PlanetShape& shape) {
    if (bytes.size() < chunkHeadBytes) return damaged();
    ByteReader in(bytes);
    BakedChunk chunk;
    chunk.id.face = static_cast<Face>(in.get<std::uint8_t>());
    chunk.id.level = in.get<std::uint8_t>();
    chunk.id.x = in.get<std::uint32_t>();
    chunk.id.y = in.get<std::uint32_t>();
    chunk.entry.deltaCM = in.get<float>();
    chunk.entry.deltaTightM = in.get<float>();
    chunk.entry.minStep = in.get<std::int32_t>();
    chunk.entry.maxStep = in.get<std::int32_t>();
    chunk.entry.children.offset = in.get<std::uint64_t>();
    chunk.entry.children.size = in.get<std::uint32_t>();
    const auto count = in.get<std::uint32_t>();
    if (!isValid(chunk.id, shape) || !isValid(chunk.entry) ||
        in.rest().size() / sizeof(std::int32_t) < count ||
        (count != 0 && count != static_cast<std::uint32_t>(chunkVertexCount(shape))))
        return damaged();
    chunk.heights.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto step = in.get<std::int32_t>();
        if (step < lowestStepOf(shape.fractionBits) || step > highestStepOf(shape.fractionBits))
            return damaged();
        chunk.heights.push_back(step);
    }
    bytes = in.rest();
    return chunk;
}

}  // namespace

void putSubtree(std::vector<std::byte>& out, const Subtree& subtree) {
    putChunk(out, subtree.root);
    ByteWriter to(out);
    to.put(subtree.bytes);
    to.put(subtree.firstTile);
    to.put(subtree.lastTile);
    to.put(static_cast<std::uint8_t>(subtree.deepestUnitLevel));
    to.put(static_cast<std::uint8_t>(subtree.isUnknown));
    to.put(static_cast<std::uint8_t>(subtree.isLater));
    to.put(static_cast<std::uint8_t>(subtree.offAboveM.size()));
    for (const double offM : subtree.offAboveM) to.put(offM);
}

Result<Subtree> takeSubtree(std::span<const std::byte>& bytes, const PlanetShape& shape) {
    constexpr std::size_t tailBytes = 3 * 8 + 4;
    Subtree subtree;
    TRY_ASSIGN(subtree.root, takeChunk(bytes, shape));
    if (bytes.size() < tailBytes) return damaged();
    ByteReader in(bytes);
    subtree.bytes = in.get<std::uint64_t>();
    subtree.firstTile = in.get<std::uint64_t>();
    subtree.lastTile = in.get<std::uint64_t>();
    subtree.deepestUnitLevel = in.get<std::uint8_t>();
    subtree.isUnknown = in.get<std::uint8_t>() != 0;
    subtree.isLater = in.get<std::uint8_t>() != 0;
    const std::size_t levels = in.get<std::uint8_t>();
    if (subtree.deepestUnitLevel > deepestLevelOf(shape) || in.rest().size() / sizeof(double) < levels ||
        subtree.root.heights.empty() != subtree.isLater)
        return damaged();
    for (std::size_t i = 0; i < levels; ++i) subtree.offAboveM.push_back(in.get<double>());
    bytes = in.rest();
    return subtree;
}

void putDeferredChunk(std::vector<std::byte>& out, const DeferredChunk& chunk) {
    putChunk(out, chunk.baked);
    ByteWriter(out).put(static_cast<std::uint8_t>(chunk.isUnknown));
}

Result<DeferredChunk> takeDeferredChunk(std::span<const std::byte>& bytes, const PlanetShape& shape) {
    DeferredChunk chunk;
    TRY_ASSIGN(chunk.baked, takeChunk(bytes, shape));
    if (bytes.empty() || chunk.baked.heights.empty()) return damaged();
    chunk.isUnknown = bytes[0] != std::byte{0};
    bytes = bytes.subspan(1);
    return chunk;
}

}  // namespace planet
