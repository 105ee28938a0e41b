// A tile of the colour quadtree: encoding of its texels for the GPU, and compression for the file. Pure
// functions, any thread.
//
// tile_layout.h describes the texels of a tile. Two neighbouring tiles have the same values in their shared
// texels.
//
// The quadtree is also the mip chain: the texels of a level are the source filtered to that level's spacing.
//
// BC1: 4 x 4 texels in 8 bytes (S3TC, Iourcha et al. 1999). The size of the border makes the blocks of two
// neighbouring tiles of a face cover the same texels, so that shared texels stay equal after encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/tile_layout.h"

namespace planet {

inline constexpr int colourTileCells = tileCells;
inline constexpr int colourBorderBefore = tileBorderBefore;
inline constexpr int colourBorderAfter = tileBorderAfter;
inline constexpr int colourTileTexels = tileTexels;
static_assert(colourTileTexels % 4 == 0 && colourTileCells % 4 == 0);
inline constexpr int maxColourLevel = maxTileLevel;

enum class ColourFormat : std::uint8_t { Bc1, Lossless };

// Returns the size of a tile in the GPU's format, row 0 at the south: BC1 blocks, or sRGB with 3 bytes per
// texel.
std::size_t colourTileBytes(ColourFormat format);

// Encodes a tile of 8-bit sRGB, 3 bytes per texel, for the GPU.
std::vector<std::byte> colourTexels(ColourFormat format, std::span<const std::uint8_t> rgb);
// Decodes encoded texels to the colours that the GPU samples.
std::vector<std::uint8_t> rgbOfColourTexels(ColourFormat format, std::span<const std::byte> texels);

// Returns a conspicuous checker pattern, which replaces unreadable tiles.
std::vector<std::byte> checkerTexels(ColourFormat format);

// Compresses texels without loss, for the file.
std::vector<std::byte> packColourTexels(ColourFormat format, std::span<const std::byte> texels);
// Decompresses texels. Accepts any bytes; the Error describes what is wrong with them.
Result<std::vector<std::byte>> unpackColourTexels(ColourFormat format, std::span<const std::byte> packed);
// Returns the largest size of a packed tile, bytes.
std::size_t largestPackedColourTile(ColourFormat format);

}  // namespace planet
