#include "planet/gl/draw/chunk_instances.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "planet/gl/draw/chunk_grid.h"

namespace planet::gl {

namespace {

constexpr GLuint gridInputCount = 2;
constexpr auto vertexInputs = std::to_array<VertexInput>({
    {"gridVertex", 2, GL_UNSIGNED_BYTE, InputKind::Integer, offsetof(GridVertex, column)},
    {"skirt", 1, GL_UNSIGNED_BYTE, InputKind::Integer, offsetof(GridVertex, skirt)},
    {"chunkFace", 1, GL_UNSIGNED_SHORT, InputKind::Integer, offsetof(ChunkInstance, face)},
    {"chunkLevel", 1, GL_UNSIGNED_SHORT, InputKind::Integer, offsetof(ChunkInstance, level)},
    {"chunkPlace", 2, GL_UNSIGNED_INT, InputKind::Integer, offsetof(ChunkInstance, x)},
    {"chunkSlot", 1, GL_UNSIGNED_INT, InputKind::Integer, offsetof(ChunkInstance, slot)},
    {"beside", 4, GL_UNSIGNED_INT, InputKind::Integer, offsetof(ChunkInstance, beside)},
    {"skirtDepthM", 1, GL_FLOAT, InputKind::Float, offsetof(ChunkInstance, skirtDepthM)},
    {"morph", 1, GL_FLOAT, InputKind::Float, offsetof(ChunkInstance, morph)},
    {"chunkTint", 4, GL_UNSIGNED_BYTE, InputKind::Normalised, offsetof(ChunkInstance, tint)},
    {"coarserBy", 4, GL_UNSIGNED_BYTE, InputKind::Integer, offsetof(ChunkInstance, coarserBy)},
    {"edgeMorph", 4, GL_FLOAT, InputKind::Float, offsetof(ChunkInstance, edgeMorph)},
});

// Returns the slots of the chunk's neighbours of its own level on its own face; noSlot for those not drawn.
std::array<std::uint32_t, edgeCount> slotsBeside(const DrawnSlots& drawn, const ChunkId& id) {
    const std::uint32_t last = (1u << id.level) - 1;
    const auto slotAt = [&](bool onFace, std::uint32_t x, std::uint32_t y) {
        if (!onFace) return noSlot;
        const auto found = drawn.find(keyOf({id.face, id.level, x, y}));
        return found == drawn.end() ? noSlot : found->second;
    };
    return {slotAt(id.x > 0, id.x - 1, id.y), slotAt(id.x < last, id.x + 1, id.y),
            slotAt(id.y > 0, id.x, id.y - 1), slotAt(id.y < last, id.x, id.y + 1)};
}

// Returns the instance without its slots and tint.
ChunkInstance instanceOf(const DrawItem& item, bool stitched) {
    ChunkInstance instance;
    instance.face = static_cast<std::uint16_t>(item.id.face);
    instance.level = item.id.level;
    instance.x = item.id.x;
    instance.y = item.id.y;
    instance.skirtDepthM = item.skirtDepthM;
    instance.morph = item.morph;
    instance.edgeMorph = item.edgeMorph;
    if (stitched) instance.coarserBy = item.coarserBy;
    return instance;
}

}  // namespace

void ChunkInstances::fill(const PoolLayout& layout, std::span<const DrawItem> items,
                          std::span<const ChunkTint> tints, bool stitched,
                          std::span<const DrawItem> shadowCasters) {
    assert(tints.empty() || tints.size() == items.size());
    drawnSlots_.clear();
    for (const DrawItem& item : items) drawnSlots_[keyOf(item.id)] = packedPlace(layout, item.slot);
    instances_.clear();
    for (std::size_t i = 0; i < items.size(); ++i) {
        instances_.push_back(instanceOf(items[i], stitched));
        ChunkInstance& instance = instances_.back();
        instance.slot = packedPlace(layout, items[i].slot);
        instance.beside = slotsBeside(drawnSlots_, items[i].id);
        if (!tints.empty()) instance.tint = tints[i].rgba;
    }
    for (const DrawItem& item : shadowCasters) {
        instances_.push_back(instanceOf(item, stitched));
        instances_.back().slot = packedPlace(layout, item.slot);
        instances_.back().beside.fill(noSlot);
    }
}

std::span<const VertexInput> chunkInputs() {
    return vertexInputs;
}

void describeChunkVertices(const Buffer& gridVertices, const Buffer& instances) {
    const std::span<const VertexInput> all = vertexInputs;
    glBindBuffer(GL_ARRAY_BUFFER, gridVertices.name());
    describeInputs(all.first(gridInputCount), 0, sizeof(GridVertex), 0);
    glBindBuffer(GL_ARRAY_BUFFER, instances.name());
    describeInputs(all.subspan(gridInputCount), gridInputCount, sizeof(ChunkInstance), 1);
}

Switches slidingSwitches(std::span<const DrawItem> items, bool stitched) {
    const auto anyOver0 = [](const auto& values) {
        return std::any_of(values.begin(), values.end(), [](auto value) { return value > 0; });
    };
    const auto morphs = [&](const DrawItem& item) { return item.morph > 0 || anyOver0(item.edgeMorph); };
    if (std::any_of(items.begin(), items.end(), morphs))
        return switchSlide | switchMorph | (stitched ? switchGather : Switches{0});
    const auto moves = [&](const DrawItem& item) { return anyOver0(item.coarserBy); };
    return stitched && std::any_of(items.begin(), items.end(), moves) ? switchSlide : Switches{0};
}

}  // namespace planet::gl
