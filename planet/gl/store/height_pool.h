// Heights on the GPU: an integer texture array whose layers are pages of equal square slots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

// How slots are packed. A slot is chunkSize x chunkSize texels, a page slotsPerRow x slotsPerRow slots.
struct PoolLayout {
    int chunkSize = 0;
    int slotsPerRow = 0;
    int pageSize = 0;  // texels a side
    int pages = 0;

    std::size_t bytes() const;
};

struct SlotPlace {
    int x = 0;  // texel of the slot's first height
    int y = 0;
    int page = 0;
};
SlotPlace placeOf(const PoolLayout& layout, std::uint32_t slot);

// The same as the vertex shader wants it: column + 2^10 row + 2^20 page, counted in slots.
std::uint32_t packedPlace(const PoolLayout& layout, std::uint32_t slot);

// Pages of up to 2048 texels a side, larger ones only where the context has too few layers. The Error names
// the limits that are too small.
Result<PoolLayout> poolLayout(std::uint32_t slotCapacity, int chunkSize, int maxTextureSize, int maxLayers);

class HeightPool {
public:
    static Result<HeightPool> create(std::uint32_t slotCapacity, int chunkSize);

    void upload(std::uint32_t slot, std::span<const std::int16_t> heights);

    const PoolLayout& layout() const { return layout_; }
    std::uint32_t slotCapacity() const { return slotCapacity_; }
    GLuint texture() const { return texture_.name(); }

private:
    HeightPool() = default;

    PoolLayout layout_;
    std::uint32_t slotCapacity_ = 0;
    Texture texture_;
};

}  // namespace planet::gl
