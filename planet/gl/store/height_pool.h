// Heights on the GPU: an integer texture array whose layers are pages of equal square slots. Texels have 16 bits, or 32
// for a planet with fractions of its quantum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"

namespace planet::gl {

// The packing of slots. A slot has chunkSize x chunkSize texels, a page slotsPerRow x slotsPerRow slots.
struct PoolLayout {
    int chunkSize = 0;
    int slotsPerRow = 0;
    int pageSize = 0;  // texels per side
    int pages = 0;
    std::size_t texelBytes = 2;  // 2 or 4

    std::size_t bytes() const;
};

struct SlotPlace {
    int x = 0;  // texel of the slot's first height, (x, y)
    int y = 0;
    int page = 0;
};
SlotPlace placeOf(const PoolLayout& layout, std::uint32_t slot);

// Returns the place in the vertex shader's format: column + 2^10 row + 2^20 page, counted in slots.
std::uint32_t packedPlace(const PoolLayout& layout, std::uint32_t slot);

// Chooses pages of up to 2048 texels per side, larger ones only if the context has too few layers. The Error
// names the limits that are too small.
Result<PoolLayout> poolLayout(std::uint32_t slotCapacity, const PlanetShape& shape, int maxTextureSize,
                              int maxLayers);

class HeightPool {
public:
    static Result<HeightPool> create(std::uint32_t slotCapacity, const PlanetShape& shape);

    void upload(std::uint32_t slot, StepsView heights);

    const PoolLayout& layout() const { return layout_; }
    std::uint32_t slotCapacity() const { return slotCapacity_; }
    GLuint texture() const { return texture_.name(); }

private:
    HeightPool() = default;

    PoolLayout layout_;
    std::uint32_t slotCapacity_ = 0;
    Texture texture_;
    std::vector<std::int16_t> shorts_;  // scratch of upload
    std::vector<std::int32_t> longs_;
};

}  // namespace planet::gl
