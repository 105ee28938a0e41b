// What the vertex shader is told of each chunk that is drawn. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "planet/gl/device/gl_objects.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/gl/store/height_pool.h"
#include "planet/select/lod_types.h"

namespace planet::gl {

// One drawn chunk, as shaders/chunk.vert reads it.
struct ChunkInstance {
    std::uint32_t faceAndLevel = 0;  // face + 8 level
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t slot = 0;                         // packedPlace
    std::array<std::uint32_t, edgeCount> beside{};  // packedPlace of the neighbours, west to north, or noSlot
    float skirtDepthM = 0;
    float morph = 0;
    std::array<std::uint8_t, 4> tint{};  // sRGB and strength
    std::array<std::uint8_t, edgeCount> coarserBy{};
    std::array<float, edgeCount> edgeMorph{};
};
static_assert(sizeof(ChunkInstance) == 64);
inline constexpr std::uint32_t noSlot = ~std::uint32_t{0};

// Slots of drawn chunks by keyOf(), to find those beside a chunk.
using DrawnSlots = std::unordered_map<std::uint64_t, std::uint32_t>;

class ChunkInstances {
public:
    // Of the items, with a tint for each or none, and after them of the chunks that only throw shadows.
    void fill(const PoolLayout& layout, std::span<const DrawItem> items, std::span<const ChunkTint> tints,
              bool stitched, std::span<const DrawItem> shadowCasters);

    std::span<const ChunkInstance> all() const { return instances_; }

private:
    std::vector<ChunkInstance> instances_;
    DrawnSlots drawnSlots_;
};

// Tells the vertex array that is bound where shaders/chunk.vert finds its inputs: a GridVertex a vertex, a
// ChunkInstance an instance.
void describeChunkVertices(const Buffer& gridVertices, const Buffer& instances);

// The switches for what vertices do beside standing where their heights say.
int slidingSwitches(std::span<const DrawItem> items, bool stitched);

}  // namespace planet::gl
