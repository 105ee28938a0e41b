#include "planet/gl/store/height_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "planet/gl/device/gpu_memory.h"

namespace planet::gl {

namespace {

constexpr int usualPageSize = 2048;
constexpr int mostSlotsPerRow = 1 << 10;  // the range of packedPlace
constexpr int mostPages = 1 << 12;

PoolLayout layoutWithPages(std::uint32_t slotCapacity, const PlanetShape& shape, int largestPage) {
    // A page is no larger than needed for all slots.
    const int wholeRow = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(slotCapacity))));
    PoolLayout layout;
    layout.chunkSize = chunkSize(shape);
    layout.texelBytes = stepBytesOf(shape);
    layout.slotsPerRow = std::min({largestPage / layout.chunkSize, std::max(wholeRow, 1), mostSlotsPerRow});
    layout.pageSize = layout.slotsPerRow * layout.chunkSize;
    const auto slotsPerPage =
        static_cast<std::uint64_t>(layout.slotsPerRow) * static_cast<std::uint64_t>(layout.slotsPerRow);
    layout.pages = static_cast<int>((slotCapacity + slotsPerPage - 1) / slotsPerPage);
    return layout;
}

}  // namespace

std::size_t PoolLayout::bytes() const {
    const auto side = static_cast<std::size_t>(pageSize);
    return side * side * static_cast<std::size_t>(pages) * texelBytes;
}

SlotPlace placeOf(const PoolLayout& layout, std::uint32_t slot) {
    const auto row = static_cast<std::uint32_t>(layout.slotsPerRow);
    const std::uint32_t inPage = slot % (row * row);
    return {static_cast<int>(inPage % row) * layout.chunkSize,
            static_cast<int>(inPage / row) * layout.chunkSize, static_cast<int>(slot / (row * row))};
}

std::uint32_t packedPlace(const PoolLayout& layout, std::uint32_t slot) {
    const auto row = static_cast<std::uint32_t>(layout.slotsPerRow);
    const std::uint32_t inPage = slot % (row * row);
    return inPage % row + ((inPage / row) << 10) + ((slot / (row * row)) << 20);
}

Result<PoolLayout> poolLayout(std::uint32_t slotCapacity, const PlanetShape& shape, int maxTextureSize,
                              int maxLayers) {
    if (slotCapacity == 0) return badInput("the pool of heights needs at least one slot");
    for (const int largestPage : {std::min(usualPageSize, maxTextureSize), maxTextureSize}) {
        if (largestPage < chunkSize(shape)) continue;
        const PoolLayout layout = layoutWithPages(slotCapacity, shape, largestPage);
        if (layout.pages <= std::min(maxLayers, mostPages)) return layout;
    }
    return badInput(
        fmt::format("GPU limit: heights of {} chunks of {} x {} are too many: GL_MAX_TEXTURE_SIZE is {}, "
                    "GL_MAX_ARRAY_TEXTURE_LAYERS {}; reduce the memory budget",
                    slotCapacity, chunkSize(shape), chunkSize(shape), maxTextureSize, maxLayers));
}

Result<HeightPool> HeightPool::create(std::uint32_t slotCapacity, const PlanetShape& shape) {
    GLint maxTextureSize = 0;
    GLint maxLayers = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &maxTextureSize);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
    const Result<PoolLayout> layout = poolLayout(slotCapacity, shape, maxTextureSize, maxLayers);
    if (!layout) return tl::unexpected(layout.error());

    HeightPool pool;
    pool.layout_ = *layout;
    pool.slotCapacity_ = slotCapacity;
    pool.texture_ = makeTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, pool.texture());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    const bool made = hasRoomFor([&] {
        const bool isShort = layout->texelBytes == sizeof(std::int16_t);
        glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, isShort ? GL_R16I : GL_R32I, layout->pageSize, layout->pageSize,
                     layout->pages, 0, GL_RED_INTEGER, isShort ? GL_SHORT : GL_INT, nullptr);
    });
    if (!made) {
        return badInput(fmt::format("GPU out of memory: {:.1f} MiB of heights; reduce the memory budget",
                                    static_cast<double>(layout->bytes()) / (1 << 20)));
    }
    return pool;
}

void HeightPool::upload(std::uint32_t slot, StepsView heights) {
    assert(slot < slotCapacity_);
    assert(heights.size() ==
           static_cast<std::size_t>(layout_.chunkSize) * static_cast<std::size_t>(layout_.chunkSize));
    const SlotPlace place = placeOf(layout_, slot);
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture());
    const auto put = [&](GLenum type, const void* texels) {
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, place.x, place.y, place.page, layout_.chunkSize,
                        layout_.chunkSize, 1, GL_RED_INTEGER, type, texels);
    };
    if (layout_.texelBytes == sizeof(std::int32_t)) {
        longs_.resize(heights.size());
        heights.copyTo(longs_);
        return put(GL_INT, longs_.data());
    }
    std::span<const std::int16_t> shorts = heights.plain();
    if (shorts.empty()) {
        shorts_.resize(heights.size());
        std::ranges::transform(heights, shorts_.begin(),
                               [](std::int32_t step) { return static_cast<std::int16_t>(step); });
        shorts = shorts_;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    put(GL_SHORT, shorts.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace planet::gl
