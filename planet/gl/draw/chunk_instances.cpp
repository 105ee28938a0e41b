#include "planet/gl/draw/chunk_instances.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "planet/gl/draw/chunk_grid.h"
#include "planet/gl/draw/frame_uniforms.h"

namespace planet::gl {

namespace {

// The chunk's neighbours of its own level on its own face, as far as they are drawn.
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

// Without the slots and the tint.
ChunkInstance instanceOf(const DrawItem& item, bool stitched) {
    ChunkInstance instance;
    instance.faceAndLevel = static_cast<std::uint32_t>(item.id.face) + 8u * item.id.level;
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

void describeChunkVertices(const Buffer& gridVertices, const Buffer& instances) {
    const auto byteOffset = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
    constexpr GLsizei stride = sizeof(ChunkInstance);
    glBindBuffer(GL_ARRAY_BUFFER, gridVertices.name());
    glVertexAttribIPointer(0, 4, GL_UNSIGNED_BYTE, sizeof(GridVertex), nullptr);
    glBindBuffer(GL_ARRAY_BUFFER, instances.name());
    glVertexAttribIPointer(1, 4, GL_UNSIGNED_INT, stride, byteOffset(offsetof(ChunkInstance, faceAndLevel)));
    glVertexAttribIPointer(2, 4, GL_UNSIGNED_INT, stride, byteOffset(offsetof(ChunkInstance, beside)));
    glVertexAttribPointer(3, 2, GL_FLOAT, GL_FALSE, stride, byteOffset(offsetof(ChunkInstance, skirtDepthM)));
    glVertexAttribPointer(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, byteOffset(offsetof(ChunkInstance, tint)));
    glVertexAttribPointer(5, 4, GL_FLOAT, GL_FALSE, stride, byteOffset(offsetof(ChunkInstance, edgeMorph)));
    glVertexAttribIPointer(6, 4, GL_UNSIGNED_BYTE, stride, byteOffset(offsetof(ChunkInstance, coarserBy)));
    for (GLuint attribute = 0; attribute <= 6; ++attribute) glEnableVertexAttribArray(attribute);
    for (GLuint attribute = 1; attribute <= 6; ++attribute) glVertexAttribDivisor(attribute, 1);
}

int slidingSwitches(std::span<const DrawItem> items, bool stitched) {
    const auto anyOver0 = [](const auto& values) {
        return std::any_of(values.begin(), values.end(), [](auto value) { return value > 0; });
    };
    const auto morphs = [&](const DrawItem& item) { return item.morph > 0 || anyOver0(item.edgeMorph); };
    if (std::any_of(items.begin(), items.end(), morphs))
        return switchSlide | switchMorph | (stitched ? switchGather : 0);
    const auto moves = [&](const DrawItem& item) { return anyOver0(item.coarserBy); };
    return stitched && std::any_of(items.begin(), items.end(), moves) ? switchSlide : 0;
}

}  // namespace planet::gl
