// The instance data of drawn chunks. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "planet/gl/device/gl_objects.h"
#include "planet/gl/device/vertex_inputs.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/gl/draw/shader_switches.h"
#include "planet/gl/store/height_pool.h"
#include "planet/select/lod_types.h"

namespace planet::gl {

// One drawn chunk, in the layout of shaders/chunk.vert.
struct ChunkInstance {
    std::uint16_t face = 0;
    std::uint16_t level = 0;
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

// The slots of drawn chunks by keyOf(), to find a chunk's neighbours.
using DrawnSlots = std::unordered_map<std::uint64_t, std::uint32_t>;

class ChunkInstances {
public:
    // Adds the items, with one tint each or none, followed by the chunks that only cast shadows.
    void fill(const PoolLayout& layout, std::span<const DrawItem> items, std::span<const ChunkTint> tints,
              bool stitched, std::span<const DrawItem> shadowCasters);

    std::span<const ChunkInstance> all() const { return instances_; }

private:
    std::vector<ChunkInstance> instances_;
    DrawnSlots drawnSlots_;
};

// Returns the inputs of shaders/chunk.vert: those of a GridVertex, then those of a ChunkInstance.
std::span<const VertexInput> chunkInputs();

// Makes the bound vertex array read them from these buffers.
void describeChunkVertices(const Buffer& gridVertices, const Buffer& instances);

// Returns the switches for vertices that move away from the places their heights give them.
Switches slidingSwitches(std::span<const DrawItem> items, bool stitched);

}  // namespace planet::gl
