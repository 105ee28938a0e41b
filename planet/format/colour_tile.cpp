#include "planet/format/colour_tile.h"

#include <fmt/format.h>
#include <squish.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cassert>

#define STB_DXT_IMPLEMENTATION
#include <stb/stb_dxt.h>

namespace planet {

namespace {

constexpr auto sideTexels = static_cast<std::size_t>(colourTileTexels);
constexpr std::size_t texelCount = sideTexels * sideTexels;
constexpr std::size_t blockSide = 4;
constexpr std::size_t blockTexels = blockSide * blockSide;
constexpr std::size_t bc1BlockBytes = 8;
constexpr std::size_t halfBlockBytes = bc1BlockBytes / 2;
constexpr int zstdLevel = 9;

// Predicts a texel of a plane from the previous ones, by the median predictor of LOCO-I (Weinberger et al.
// 2000). Lossless tiles store the residuals of three planes: green, and red and blue minus green.
int foretold(const std::vector<std::uint8_t>& plane, std::size_t i) {
    const bool firstColumn = i % sideTexels == 0;
    const bool firstRow = i < sideTexels;
    const int west = firstColumn ? 0 : plane[i - 1];
    const int south = firstRow ? 0 : plane[i - sideTexels];
    if (firstColumn) return south;
    if (firstRow) return west;
    const int corner = plane[i - sideTexels - 1];
    return std::clamp(west + south - corner, std::min(west, south), std::max(west, south));
}

std::vector<std::uint8_t> planesOf(std::span<const std::byte> texels) {
    std::vector<std::uint8_t> residuals;
    residuals.reserve(3 * texelCount);
    std::vector<std::uint8_t> plane(texelCount);
    for (const std::size_t channel : {1u, 0u, 2u}) {
        for (std::size_t i = 0; i < texelCount; ++i) {
            const int green = channel == 1 ? 0 : std::to_integer<int>(texels[3 * i + 1]);
            plane[i] = static_cast<std::uint8_t>(std::to_integer<int>(texels[3 * i + channel]) - green);
        }
        for (std::size_t i = 0; i < texelCount; ++i)
            residuals.push_back(static_cast<std::uint8_t>(plane[i] - foretold(plane, i)));
    }
    return residuals;
}

std::vector<std::byte> texelsOfPlanes(std::span<const std::uint8_t> residuals) {
    std::vector<std::byte> texels(3 * texelCount);
    std::vector<std::uint8_t> plane(texelCount);
    for (const std::size_t channel : {1u, 0u, 2u}) {
        for (std::size_t i = 0; i < texelCount; ++i)
            plane[i] = static_cast<std::uint8_t>(residuals[i] + foretold(plane, i));
        residuals = residuals.subspan(texelCount);
        for (std::size_t i = 0; i < texelCount; ++i) {
            const int green = channel == 1 ? 0 : std::to_integer<int>(texels[3 * i + 1]);
            texels[3 * i + channel] = static_cast<std::byte>(plane[i] + green);
        }
    }
    return texels;
}

std::array<unsigned char, 4 * blockTexels> blockAt(std::span<const std::uint8_t> rgb, std::size_t column,
                                                   std::size_t row) {
    std::array<unsigned char, 4 * blockTexels> rgba;
    rgba.fill(255);
    for (std::size_t i = 0; i < blockTexels; ++i) {
        const std::size_t texel = (row + i / blockSide) * sideTexels + column + i % blockSide;
        std::copy_n(&rgb[3 * texel], 3, &rgba[4 * i]);
    }
    return rgba;
}

// Reorders blocks, with all colours before all indices, which compresses better.
std::vector<std::uint8_t> halvesOf(std::span<const std::byte> blocks) {
    std::vector<std::uint8_t> halves(blocks.size());
    const std::size_t middle = blocks.size() / 2;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const std::size_t half = i % bc1BlockBytes / halfBlockBytes * middle;
        halves[half + i / bc1BlockBytes * halfBlockBytes + i % halfBlockBytes] =
            std::to_integer<std::uint8_t>(blocks[i]);
    }
    return halves;
}

std::vector<std::byte> blocksOfHalves(std::span<const std::uint8_t> halves) {
    std::vector<std::byte> blocks(halves.size());
    const std::size_t middle = halves.size() / 2;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const std::size_t half = i % bc1BlockBytes / halfBlockBytes * middle;
        blocks[i] = std::byte{halves[half + i / bc1BlockBytes * halfBlockBytes + i % halfBlockBytes]};
    }
    return blocks;
}

}  // namespace

std::size_t colourTileBytes(ColourFormat format) {
    return format == ColourFormat::Bc1 ? texelCount / blockTexels * bc1BlockBytes : 3 * texelCount;
}

std::vector<std::byte> colourTexels(ColourFormat format, std::span<const std::uint8_t> rgb) {
    assert(rgb.size() == 3 * texelCount);
    if (format == ColourFormat::Lossless) {
        const auto bytes = std::as_bytes(rgb);
        return {bytes.begin(), bytes.end()};
    }
    std::vector<std::byte> blocks(colourTileBytes(format));
    std::size_t block = 0;
    for (std::size_t row = 0; row < sideTexels; row += blockSide) {
        for (std::size_t column = 0; column < sideTexels; column += blockSide, ++block) {
            const std::array<unsigned char, 4 * blockTexels> rgba = blockAt(rgb, column, row);
            stb_compress_dxt_block(reinterpret_cast<unsigned char*>(&blocks[block * bc1BlockBytes]),
                                   rgba.data(), 0, STB_DXT_HIGHQUAL);
        }
    }
    return blocks;
}

std::vector<std::uint8_t> rgbOfColourTexels(ColourFormat format, std::span<const std::byte> texels) {
    assert(texels.size() == colourTileBytes(format));
    std::vector<std::uint8_t> rgb(3 * texelCount);
    if (format == ColourFormat::Lossless) {
        std::transform(texels.begin(), texels.end(), rgb.begin(),
                       [](std::byte byte) { return std::to_integer<std::uint8_t>(byte); });
        return rgb;
    }
    std::vector<squish::u8> rgba(4 * texelCount);
    squish::DecompressImage(rgba.data(), colourTileTexels, colourTileTexels, texels.data(), squish::kDxt1);
    for (std::size_t i = 0; i < texelCount; ++i) std::copy_n(&rgba[4 * i], 3, &rgb[3 * i]);
    return rgb;
}

std::vector<std::byte> checkerTexels(ColourFormat format) {
    constexpr std::size_t squareTexels = 32;
    std::vector<std::uint8_t> rgb(3 * texelCount, 0);
    for (std::size_t i = 0; i < texelCount; ++i) {
        const std::size_t column = i % sideTexels + squareTexels - colourBorderBefore;
        const std::size_t row = i / sideTexels + squareTexels - colourBorderBefore;
        if ((column / squareTexels + row / squareTexels) % 2 == 0) rgb[3 * i] = rgb[3 * i + 2] = 255;
    }
    return colourTexels(format, rgb);
}

std::vector<std::byte> packColourTexels(ColourFormat format, std::span<const std::byte> texels) {
    assert(texels.size() == colourTileBytes(format));
    const std::vector<std::uint8_t> ordered =
        format == ColourFormat::Bc1 ? halvesOf(texels) : planesOf(texels);
    std::vector<std::byte> packed(ZSTD_compressBound(ordered.size()));
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), ordered.data(), ordered.size(), zstdLevel);
    assert(!ZSTD_isError(size));
    packed.resize(size);
    return packed;
}

Result<std::vector<std::byte>> unpackColourTexels(ColourFormat format, std::span<const std::byte> packed) {
    std::vector<std::uint8_t> ordered(colourTileBytes(format));
    const std::size_t size = ZSTD_decompress(ordered.data(), ordered.size(), packed.data(), packed.size());
    if (ZSTD_isError(size)) return badInput(fmt::format("its colours: {}", ZSTD_getErrorName(size)));
    if (size != ordered.size()) {
        return badInput(fmt::format("its colours are {} bytes; {} were expected", size, ordered.size()));
    }
    return format == ColourFormat::Bc1 ? blocksOfHalves(ordered) : texelsOfPlanes(ordered);
}

std::size_t largestPackedColourTile(ColourFormat format) {
    return ZSTD_compressBound(colourTileBytes(format));
}

}  // namespace planet
